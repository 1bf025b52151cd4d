"""Inverse runs: the tensions that make the robot follow a reference."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core
from cdcr.base.arrays import FloatArray, ReadOnlyArrays, read_only
from cdcr.base.check import Check, one_of, require_kind, short
from cdcr.model.memory import warn_of_friction
from cdcr.model.model import Model
from cdcr.model.statics import InfeasibleError, in_line
from cdcr.motion.reference import Reference
from cdcr.runs.command import Interpolation, TensionTable
from cdcr.runs.simulate import warn_beyond_taylor_range

Infeasible = Literal["raise", "nearest"]


@dataclass(frozen=True, eq=False, repr=False)
class InverseRun(ReadOnlyArrays):
    """Tensions along a reference, one row for each of its times. All arrays are read-only.

    Parameters
    ----------
    model : Model
        The robot.
    reference : Reference
        The motion asked for.
    force : ndarray, shape (N, d)
        Generalised force that the motion needs [N m].
    tension : ndarray, shape (N, num_cables)
        Least-norm tensions within the limits that give it, or come nearest [N].
    feasible : ndarray of bool, shape (N,)
        Whether they give it.
    limiting : tuple of tuple of int, length N
        Cables that stand at a limit where they do not.
    min_tension, max_tension : float
        Limits of every tension [N].
    infeasible : {"raise", "nearest"}
        What `tension_at` does where the limits are too narrow.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> swing = cdcr.Reference.from_angles(np.linspace(0, 1, 11), lambda t: 0.2 + 0.1 * t, 0.0)
    >>> run = cdcr.inverse_run(model, swing, min_tension=0.5)
    >>> run.tension[0].round(3), bool(run.feasible.all())
    (array([4.325, 0.5  , 0.5  ]), True)
    """

    model: Model
    reference: Reference
    force: FloatArray
    tension: FloatArray
    feasible: NDArray[np.bool_]
    limiting: tuple[tuple[int, ...], ...]
    min_tension: float
    max_tension: float
    infeasible: Infeasible

    def __post_init__(self) -> None:
        """Keep others from writing to the arrays."""
        for array in (self.force, self.tension, self.feasible):
            array.setflags(write=False)

    def __len__(self) -> int:
        """Return the number of samples."""
        return len(self.reference)

    def __repr__(self) -> str:
        """Say what a person wants to know first."""
        t, misses = self.t, int(np.sum(~self.feasible))
        end = f", {misses} infeasible" if misses else ""
        return (
            f"<InverseRun: {len(self)} samples, t = {t[0]:g} to {t[-1]:g} s, "
            f"{self.model.num_cables} cables, up to {np.max(self.tension, initial=0.0):.4g} N{end}>"
        )

    @property
    def t(self) -> FloatArray:
        """Times (N,) [s]."""
        return self.reference.t

    @property
    def q(self) -> FloatArray:
        """Coordinates asked for (N, d) [rad, m]."""
        return self.reference.q

    @cached_property
    def tip(self) -> FloatArray:
        """Tip positions asked for (N, 3) in the base frame [m]."""
        return read_only(self.model.tips(self.q))

    @cached_property
    def force_error(self) -> FloatArray:
        """Length of what the tensions lack of the force (N,) [N m]; rounding where feasible."""
        given = np.einsum("...ij,...j", self.model.actuation_matrix(self.q), self.tension)
        return read_only(np.asarray(np.linalg.norm(given - self.force, axis=1)))

    def to_table(self, interpolation: Interpolation = "linear") -> TensionTable:
        """Return the tensions as a table that `simulate` takes.

        Between its times a table is a line or a hold, which the motion is not: the coarser the
        times, the further the robot strays. `tension_at` is exact at every time.

        Parameters
        ----------
        interpolation : {"linear", "previous"}, optional
            As in `TensionTable`.

        Returns
        -------
        TensionTable

        Examples
        --------
        >>> import numpy as np
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> swing = cdcr.Reference.from_angles(np.linspace(0, 1, 11), lambda t: 0.2 + 0.1 * t, 0.0)
        >>> table = cdcr.inverse_run(model, swing).to_table()
        >>> cdcr.simulate(model, swing.q[0], swing.qd[0], t=swing.t, tension=table).success
        True
        """
        return TensionTable(self.t, self.tension, interpolation)

    def tension_at(self, t: float) -> FloatArray:
        """Return the tensions (num_cables,) [N] at any time within the reference [s].

        Continuous in time, so ``cdcr.simulate(..., tension=run.tension_at)`` follows the motion as
        well as its tolerances allow.

        Parameters
        ----------
        t : float
            Time within the reference [s].

        Returns
        -------
        (num_cables,) array
            Tensions [N].

        Raises
        ------
        ValueError
            For a time outside the reference.
        InfeasibleError
            Where the limits are too narrow, unless the run was asked for the nearest tensions.

        Examples
        --------
        >>> import numpy as np
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> swing = cdcr.Reference.from_angles(np.linspace(0, 1, 11), lambda t: 0.2 + 0.1 * t, 0.0)
        >>> cdcr.inverse_run(model, swing).tension_at(0.55).round(3)
        array([4.877, 0.   , 0.   ])
        """
        q, qd, qdd = self.reference.evaluate(t)
        force = self.model.inverse_dynamics(q, qd, qdd)
        limits = self.min_tension, self.max_tension
        answer = self.model.find_tension(force, *limits, q=where(self.model, q))
        if self.infeasible == "raise" and not answer.feasible:
            raise InfeasibleError(_refusal(t, force, answer, limits), answer)
        return answer.tension


def inverse_run(
    model: Model,
    reference: Reference,
    *,
    min_tension: float = 0.0,
    max_tension: float = math.inf,
    infeasible: Infeasible = "raise",
) -> InverseRun:
    """Find the tensions that make the robot follow a reference: B F = M qdd + h, least in norm.

    Parameters
    ----------
    model : Model
        The robot, of any formulation.
    reference : Reference
        The motion.
    min_tension, max_tension : float, optional
        Limits of every tension [N], 0 <= min_tension <= max_tension; a positive `min_tension` is a
        pretension that keeps the cables taut.
    infeasible : {"raise", "nearest"}, optional
        Where no tensions within the limits give the motion, refuse, or take those whose force comes
        nearest; ``run.feasible`` tells.

    Returns
    -------
    InverseRun

    Raises
    ------
    InfeasibleError
        Naming the first such time, the cables at their limits and how many times there are.
    ValueError
        For a reference that does not fit the robot, or bends it beyond ``cdcr.max_bending``.

    Warns
    -----
    UserWarning
        When the motion leaves the range of a Taylor formulation, and when cables rub, whose
        friction is left out.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> t = np.linspace(0.0, 10.0, 51)
    >>> circle = cdcr.Reference.from_angles(t, np.pi / 12, lambda t: np.pi / 5 * t)
    >>> cdcr.inverse_run(model, circle)
    <InverseRun: 51 samples, t = 0 to 10 s, 3 cables, up to 5.754 N>
    """
    _check(model, reference, infeasible)
    limits = Check()
    limits.number("min_tension", min_tension, "a number [N]")
    limits.number("max_tension", max_tension, "a number [N]")
    limits.done()
    warn_beyond_taylor_range(model, reference.q)
    warn_of_friction(model, "inverse_run", stacklevel=2)
    force = model.inverse_dynamics(reference.q, reference.qd, reference.qdd)
    answers = [
        model.find_tension(one, min_tension, max_tension, q=where(model, q))
        for one, q in zip(force, reference.q, strict=True)
    ]
    feasible = np.array([answer.feasible for answer in answers])
    if infeasible == "raise" and not np.all(feasible):
        i = int(np.argmin(feasible))
        sentence = _refusal(reference.t[i], force[i], answers[i], (min_tension, max_tension))
        raise InfeasibleError(
            f"{sentence}; infeasible at {np.sum(~feasible)} of {len(reference)} times; "
            "infeasible='nearest' takes the nearest tensions there",
            answers[i],
        )
    return InverseRun(
        model=model,
        reference=reference,
        force=force,
        tension=np.array([answer.tension for answer in answers]),
        feasible=feasible,
        limiting=tuple(tuple(answer.limiting) for answer in answers),
        min_tension=min_tension,
        max_tension=max_tension,
        infeasible=infeasible,
    )


def where(model: Model, q: FloatArray) -> FloatArray | None:
    """Return q where the actuation matrix depends on it; the search is quicker without."""
    return None if model.has_constant_actuation else q


def _check(model: Model, reference: Reference, infeasible: str) -> None:
    require_kind("model", model, Model)
    require_kind("reference", reference, Reference)
    if not one_of(infeasible, ("raise", "nearest")):
        raise ValueError(f"infeasible must be 'raise' or 'nearest', got {short(infeasible)}")
    wanted = (len(reference), model.num_coordinates)
    if reference.q.shape != wanted:
        raise ValueError(
            f"reference.q must have shape {wanted} for this model, got {reference.q.shape}"
        )
    for j, cable in enumerate(model.robot.all_cables):
        if cable.stiffness > 0.0:
            raise ValueError(
                f"inverse_run gives tensions, but cable {j + 1} is driven by length; "
                "model.commands(q, tension) gives the lengths that hold tensions"
            )
    check_bending(model, reference)


def check_bending(model: Model, reference: Reference) -> None:
    """Refuse a motion that bends a section beyond what the model can."""
    angles, _ = model.polar(reference.q)
    beyond = np.argwhere(angles > _core.max_bending)
    if beyond.size:
        i, section = beyond[0]
        raise ValueError(
            f"the reference bends section {section + 1} by {angles[i, section]:.4g} rad at "
            f"t = {reference.t[i]:g} s, beyond 3 pi rad"
        )


def _refusal(
    t: float, force: ArrayLike, answer: _core.Allocation, limits: tuple[float, float]
) -> str:
    cables = ", ".join(str(cable + 1) for cable in answer.limiting)
    reason = f"limited by cables {cables}" if cables else "no cable pulls that way"
    return (
        f"at t = {t:g} s force {in_line(force)} N m cannot be met with tensions from "
        f"{limits[0]:g} to {limits[1]:g} N: {reason}, the nearest force is {in_line(answer.force)}"
    )
