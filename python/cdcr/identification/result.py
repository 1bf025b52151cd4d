"""What a fit found: estimates, how sure they are, and what is left over."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.identification.data import Data, UnsolvedError, require_data
from cdcr.identification.problem import Problem
from cdcr.identification.setup import Setup
from cdcr.identification.uncertainty import Uncertainty

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path

    from matplotlib.figure import Figure

    from cdcr.identification.crossing import CrossValidation
    from cdcr.plotting.sizes import Size
    from cdcr.robot.robot import Robot


@dataclass(frozen=True)
class Estimate:
    """One number found.

    Attributes
    ----------
    path, name, unit : str
        As it was asked for; what tables call it; its unit.
    value, standard_error : float
        The error is infinite where the data cannot tell the number.
    start, low, high : float
        Where the search began, and its bounds.
    prior : tuple of two floats or None
        What was known before.
    at_bound : bool
        Whether it ended at a bound, where its error means little.
    """

    path: str
    name: str
    unit: str
    value: float
    standard_error: float
    start: float
    low: float
    high: float
    prior: tuple[float, float] | None
    at_bound: bool


@dataclass(frozen=True, eq=False)
class Residual:
    """What is left over of one channel.

    Attributes
    ----------
    data, channel, unit : str
    values : (N, k) array
        Model less measurement; NaN where nothing was measured.
    noise : float
        Standard deviation of one number: given, or found from what is left over.
    noise_given : bool
    """

    data: str
    channel: str
    unit: str
    values: FloatArray
    noise: float
    noise_given: bool

    @property
    def rms(self) -> float:
        """Root mean square over the rows: of distances, where a row is a place."""
        rows = self.values[np.isfinite(self.values).all(axis=1)]
        if not rows.size:
            return np.nan
        place = self.channel == "tip" or self.channel.startswith("marker")
        return float(np.sqrt(np.mean(np.sum(rows**2, axis=1) if place else rows**2)))


@dataclass(frozen=True, eq=False, repr=False)
class Identified:
    """A robot identified.

    Attributes
    ----------
    estimates : tuple of Estimate
        Each number sought, in the order of `identify`.
    robot : Robot
        The robot with them.
    setup : Setup
        The robot in its laboratory: offsets of commands and markers and the clock too.
    residuals : tuple of Residual
        What is left over, by data and channel.
    uncertainty : Uncertainty
        Singular values, directions and covariance, in sizes of the parameters.
    covariance : (n, n) array
        Of the estimates, in their units.
    misfit : float
        Mean square of what is left over, in standard deviations of the noise, over the degrees of
        freedom: 1 where the model is right and the noise is as stated. Where it is larger, standard
        errors are larger by its root.
    costs : tuple of float
        Half the sum of squares at the end of each start.
    success : bool
    message : str
        How the search ended.
    """

    estimates: tuple[Estimate, ...]
    robot: Robot
    setup: Setup
    residuals: tuple[Residual, ...]
    uncertainty: Uncertainty
    covariance: FloatArray
    misfit: float
    costs: tuple[float, ...]
    success: bool
    message: str
    evaluations: int
    loss: str
    data: tuple[Data, ...]
    _refit: Callable[[list[Data]], Identified]

    @classmethod
    def _of(
        cls,
        problem: Problem,
        solution: Any,
        *,
        loss: str,
        costs: Sequence[float],
        refit: Callable[[list[Data]], Identified],
    ) -> Identified:
        """Return what a solution of a problem says."""
        setup, _, answers = problem.answers(solution.x)
        residuals = _residuals(problem, answers)
        freedom = max(problem.num_residuals - len(problem.unknowns), 1)
        misfit = float(2.0 * solution.cost / freedom)
        uncertainty = Uncertainty.of(solution.jac, max(misfit, 1.0))
        values, spread = problem.values(solution.x), uncertainty.deviations * problem.size
        estimates = tuple(
            Estimate(
                one.quantity.path, one.quantity.name, one.quantity.unit, float(values[k]),
                float(spread[k]), one.start, one.low, one.high, one.prior,
                bool(solution.active_mask[k]),
            )
            for k, one in enumerate(problem.unknowns)
        )  # fmt: skip
        with np.errstate(invalid="ignore"):
            covariance = uncertainty.covariance * np.outer(problem.size, problem.size)
        return cls(
            estimates, setup.robot, setup, residuals, uncertainty, covariance, misfit,
            tuple(costs), bool(solution.success), str(solution.message), problem.evaluations, loss,
            tuple(problem.data), refit,
        )  # fmt: skip

    def __getitem__(self, path: str) -> float | FloatArray:
        """Return what a path is: a number, or an array where it names several."""
        found = [one.value for one in self.estimates if path in (one.path, one.name)]
        if not found:
            known = ", ".join(repr(one.path) for one in self.estimates)
            raise KeyError(f"{path!r} was not sought; these were: {known}")
        return found[0] if len(found) == 1 else np.array(found)

    @property
    def correlation(self) -> FloatArray:
        """Correlation of the estimates (n, n); NaN beside what the data cannot tell."""
        return self.uncertainty.correlation

    @property
    def untold(self) -> list[str]:
        """What the data cannot tell: names of parameters, together where only their mix is open."""
        return self.uncertainty.untold([one.name for one in self.estimates])

    def predict(self, data: Data) -> dict[str, FloatArray]:
        """Return what the robot found would show, by channel.

        Parameters
        ----------
        data : Poses, Motion or Frequencies
            What is asked of it, and which channels.

        Raises
        ------
        ValueError
            Where the model has no answer.
        """
        require_data("data", data)
        setup = self._with_places(data)
        try:
            answers = data._answers(setup, data._solve(setup, None))
        except UnsolvedError as error:
            raise ValueError(str(error)) from None
        return {one.name: answer for one, answer in zip(data.channels, answers, strict=True)}

    def errors(self, data: Data) -> tuple[Residual, ...]:
        """Return how far off it is for other data, by channel.

        Parameters
        ----------
        data : Poses, Motion or Frequencies
            Measurements that were not used.
        """
        answers = self.predict(data)
        return tuple(
            Residual(data.name, one.name, one.unit, answers[one.name] - one.values,
                     one.noise or np.nan, one.noise is not None)
            for one in data.channels
        )  # fmt: skip

    def _with_places(self, data: Data) -> Setup:
        new = tuple(place for place in data.places if place not in self.setup.places)
        data._check(self.robot)
        if not new:
            return self.setup
        places, offsets = self.setup.places + new, self.setup.marker_offset
        return replace(
            self.setup, places=places, marker_offset=offsets + ((0.0, 0.0, 0.0),) * len(new)
        )

    def cross_validate(self, folds: int = 5) -> CrossValidation:
        """Fit again without a part of the data, predict that part, and so on for each part.

        Parts are stretches of rows, since neighbours are alike.

        Parameters
        ----------
        folds : int, default 5
            Number of parts.

        Returns
        -------
        CrossValidation
            Errors of prediction by channel, and the estimates of each fit.
        """
        from cdcr.identification.crossing import cross_validate

        return cross_validate(self, folds)

    def plot(self, *, size: Size = None) -> Figure:
        """Draw measured beside predicted, what is left over, and the estimates. Extra ``plot``.

        Parameters
        ----------
        size : optional
            As in `Scenario.figure`.
        """
        from cdcr import plotting

        return plotting.resize(plotting.plot_identified(self._drawn()), size)

    def _drawn(self) -> Mapping[str, Any]:
        """Return what the picture shows, as numbers and names."""
        channels = []
        rest = iter(self.residuals)
        for one in self.data:
            along = getattr(one, "t", None)
            for channel in one.channels:
                left = next(rest)
                channels.append({
                    "name": f"{one.name}: {channel.name}" if len(self.data) > 1 else channel.name,
                    "unit": channel.unit,
                    "along": along,
                    "measured": channel.values,
                    "left": left.values,
                    "rms": left.rms,
                })  # fmt: skip
        return {
            "channels": channels,
            "names": [one.name for one in self.estimates],
            "correlation": self.correlation,
        }

    def report(self) -> str:
        """Return the estimates and what is left over as a table for people."""
        from cdcr.identification.report import report

        return report(self)

    def __repr__(self) -> str:
        return f"<Identified: {len(self.estimates)} numbers, misfit {self.misfit:.3g}>"

    def __str__(self) -> str:
        return self.report()

    def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> Path:
        """Write estimates, errors and where they come from to a TOML file.

        With the version of cdcr, the names and SHA-256 sums of files read, and the robot found.

        Parameters
        ----------
        path : path-like
            The file.
        overwrite : bool
            Whether an existing file may be replaced.

        Returns
        -------
        Path

        Raises
        ------
        FileExistsError
            If the file exists and ``overwrite`` is false.
        """
        from cdcr.identification.report import save

        return save(self, path, overwrite=overwrite)


def _residuals(problem: Problem, answers: list[list[FloatArray]]) -> tuple[Residual, ...]:
    return tuple(
        Residual(
            one.name, channel.name, channel.unit, answer - channel.values, level,
            channel.noise is not None,
        )
        for one, given, levels in zip(problem.data, answers, problem.noise, strict=True)
        for channel, answer, level in zip(one.channels, given, levels, strict=True)
    )  # fmt: skip
