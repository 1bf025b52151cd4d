"""What a scenario is: a robot, what is done to it, its summary and its picture."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol, cast

import numpy as np

from cdcr._core import Controller
from cdcr.base.arrays import MAX_SAMPLES, FloatArray
from cdcr.base.check import Check, require_kind
from cdcr.base.keywords import by_keyword
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench
from cdcr.robot.robot import Robot
from cdcr.runs.command import TensionTable
from cdcr.runs.simulate import DEFAULT_METHOD, MethodName, integrator_options, simulate
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, run_metrics

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from cdcr.plotting.sizes import Size

FILES = {"picture": ".png", "csv": ".csv", "nc": ".nc", "mcap": ".mcap"}
USUAL_FILES = (".png", ".csv", ".nc")


def _figure(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.run import run_figure

    return run_figure(scenario, run)


class InputSource(Protocol):
    """Something that takes the robot through a run on its own."""

    @property
    def integrates(self) -> bool:
        """Whether equations of motion are integrated."""

    def run(
        self,
        model: Model,
        q0: tuple[float, ...],
        qd0: tuple[float, ...],
        t: FloatArray,
        **options: Any,
    ) -> Trajectory:
        """Run the robot from a state and sample it at output times (N,) [s]."""


@by_keyword
@dataclass(frozen=True, kw_only=True, eq=False)
class Scenario:
    """Something to see that can be repeated: data, and how to summarise and draw it.

    Most are runs. One without `t_end` is a picture of the model alone, in which nothing runs.

    Parameters
    ----------
    name, title, description, source : str
        What it is called, what happens in it, and where its numbers come from.
    paper_figure : int, optional
        Number of the figure of the origin paper that it redraws.
    robot : Robot
        The robot.
    q0 : tuple of float, d, or callable
        Coordinates at t = 0, or a function of the model that returns them.
    qd0 : tuple of float, d
        Their rates.
    tension : tuple of float, num_cables, or TensionTable or callable
        Cable tensions [N], constant or over time, or a function of the model and the end of the run
        [s] that returns them.
    controller : callable, optional
        From the model to a controller that pulls the cables, in place of `tension`.
    input_source : InputSource, optional
        What takes the robot through the run, in place of both.
    files : tuple of str
        Suffixes of the files that the command line writes.
    wrenches : tuple of Wrench
        Forces and moments on the robot.
    t_end : float, optional
        End of the run [s]; 0 where nothing runs.
    num_samples : int, default 1001
        Number of samples, evenly spaced, both ends included.
    formulation : str
        Of the model's equations.
    method : str
        Integration method: "auto", "bdf", "adams", "dopri5", "dop853", "rk4"
        or "rosenbrock".
    rtol, atol, step, max_step, max_steps : optional
        Tolerances of the adaptive methods, step of rk4 and rosenbrock [s], largest step [s] and
        number of steps.
    summarize : callable
        From scenario and run, None where nothing runs, to the findings of `summary`.
    plot : callable
        From scenario and run, None where nothing runs, to the picture of `figure`.

    Examples
    --------
    >>> import cdcr.scenarios
    >>> scenario = cdcr.scenarios.get("free-oscillation")
    >>> scenario.t_end, scenario.robot.num_cables, scenario.has_run
    (60.0, 3, True)
    """

    name: str
    title: str
    description: str
    source: str
    robot: Robot
    paper_figure: int | None = None
    q0: tuple[float, ...] | Callable[[Model], tuple[float, ...]] = ()
    qd0: tuple[float, ...] = ()
    tension: tuple[float, ...] | TensionTable | Callable[[Model, float], TensionTable] = ()
    controller: Callable[[Model], Controller] | None = None
    input_source: InputSource | None = None
    files: tuple[str, ...] = USUAL_FILES
    wrenches: tuple[Wrench, ...] = ()
    t_end: float = 0.0
    num_samples: int = 1001
    formulation: str = "exact"
    method: MethodName = DEFAULT_METHOD
    rtol: float | None = None
    atol: float | None = None
    step: float | None = None
    max_step: float | None = None
    max_steps: int | None = None
    summarize: Callable[[Scenario, Any], tuple[Metric, ...]] = run_metrics
    plot: Callable[[Scenario, Any], Figure] = _figure

    def __repr__(self) -> str:
        return f"<Scenario {self.name!r}: {self.title}>"

    @property
    def has_run(self) -> bool:
        """Whether anything runs in it; else it is a picture of the model alone."""
        return self.t_end > 0.0

    @cached_property
    def model(self) -> Model:
        """Its robot, ready for computing."""
        return Model(self.robot, formulation=self.formulation)

    def start(self, model: Model) -> tuple[float, ...]:
        """Return where a run starts.

        Parameters
        ----------
        model : Model
            The scenario's own.

        Returns
        -------
        tuple of float
            Bending vectors (d,) at t = 0 [rad].
        """
        return self.q0(model) if callable(self.q0) else self.q0

    def times(self, t_end: float | None = None, num_samples: int | None = None) -> FloatArray:
        """Return the output times of a run; another end alone leaves their spacing.

        Parameters
        ----------
        t_end : float, optional
            End of the run [s].
        num_samples : int, optional
            Number of times, both ends included.

        Returns
        -------
        (N,) array
            Times [s].

        Raises
        ------
        ValueError
            For an argument out of its range, or a scenario in which nothing runs.
        """
        if not self.has_run:
            raise ValueError(
                f"nothing runs in the scenario {self.name!r}: it is a picture of the model alone"
            )
        check = Check()
        given, requirement = self.t_end if t_end is None else t_end, "a number > 0 s and finite"
        end = check.number("t_end", given, requirement, above=0.0)
        check.done()
        if num_samples is None:
            spacing = self.t_end / (self.num_samples - 1)
            longest = (MAX_SAMPLES - 1) * spacing
            if end > longest:
                raise ValueError(
                    f"t_end must be at most {longest:.6g} s, which {MAX_SAMPLES} samples "
                    f"{spacing:.6g} s apart reach, got {end:g} s"
                )
            num_samples = 1 + max(1, round((self.num_samples - 1) * end / self.t_end))
        requirement = f"a whole number 2 to {MAX_SAMPLES}"
        num = check.whole("num_samples", num_samples, requirement, low=2, high=MAX_SAMPLES)
        check.done()
        return np.linspace(0.0, end, num)

    def options(self, **given: Any) -> dict[str, Any]:
        """Return the options of a run: those given, and the scenario's own in place of None.

        Parameters
        ----------
        given : optional
            method, rtol, atol, step, max_step and max_steps as in `simulate`.

        Returns
        -------
        dict
            The same names with their values.

        Raises
        ------
        ValueError
            For an option out of its range, or any where nothing is integrated.
        """
        named = [name for name, value in given.items() if value is not None]
        if self.input_source and not self.input_source.integrates:
            if named:
                raise ValueError(
                    "nothing is integrated along a trajectory without simulate = true, so it "
                    f"takes no {', '.join(named)}"
                )
            return {name: getattr(self, name) for name in given}
        options = {name: given[name] if name in named else getattr(self, name) for name in given}
        integrator_options(**options)
        return options

    def simulate(
        self,
        *,
        t_end: float | None = None,
        num_samples: int | None = None,
        method: MethodName | None = None,
        rtol: float | None = None,
        atol: float | None = None,
        step: float | None = None,
        max_step: float | None = None,
        max_steps: int | None = None,
        progress: Callable[[float], None] | None = None,
    ) -> Trajectory:
        """Run the scenario.

        Parameters
        ----------
        t_end : float, optional
            Another end of the run [s]; without `num_samples`, samples keep their spacing.
        num_samples : int, optional
            Another number of samples.
        method, rtol, atol, step, max_step, max_steps : optional
            In place of the scenario's own; see `cdcr.simulate`.
        progress : callable, optional
            Told the time reached, every few hundred steps.

        Returns
        -------
        Trajectory

        Raises
        ------
        ValueError
            For an option out of its range, or a scenario in which nothing runs.
        """
        t, model = self.times(t_end, num_samples), self.model
        options = self.options(
            method=method, rtol=rtol, atol=atol, step=step, max_step=max_step, max_steps=max_steps
        )
        q0 = self.start(model)
        options["progress"] = progress
        if self.wrenches:
            options["wrenches"] = self.wrenches
        if self.input_source:
            return self.input_source.run(model, q0, self.qd0, t, **options)
        if self.controller:
            options["controller"] = self.controller(model)
        else:
            tension = self.tension
            options["tension"] = tension(model, float(t[-1])) if callable(tension) else tension
        return simulate(model, q0, self.qd0, t=t, **options)

    def summary(self, run: Trajectory | None = None) -> tuple[Metric, ...]:
        """Return what is worth knowing about this scenario and a run of it.

        Parameters
        ----------
        run : Trajectory, optional
            The run; None where nothing runs.

        Returns
        -------
        tuple of Metric

        Raises
        ------
        TypeError, ValueError
            For what is no run, and one of another robot.
        """
        self._check_run(run)
        return self.summarize(self, run)

    def _check_run(self, run: object) -> None:
        """Refuse what is no run of this scenario's robot, where anything runs in it."""
        if self.has_run:
            require_kind("run", run, Trajectory)
            d, given = self.model.num_coordinates, cast("Trajectory", run).model.num_coordinates
            if given != d:
                raise ValueError(f"run must be one of a robot of {d} coordinates, got {given}")

    def figure(self, run: Trajectory | None = None, *, size: Size = None) -> Figure:
        """Return a picture of this scenario and a run of it. Needs the extra ``plot``.

        Parameters
        ----------
        run : Trajectory, optional
            The run; None where nothing runs.
        size : str or tuple of float, optional
            "journal" is one column, 8.5 cm wide; "slide" is 16:9; a pair, or "17x12", is width and
            height [cm].
            By default each picture has the size it was made for.

        Returns
        -------
        Figure

        Raises
        ------
        TypeError, ValueError
            For what is no run, one of another robot, and a `size` that is none of these.
        """
        self._check_run(run)
        if size is None:
            return self.plot(self, run)
        from cdcr.plotting.sizes import checked_size, resize

        checked_size(size)
        return resize(self.plot(self, run), size)
