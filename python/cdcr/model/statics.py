"""What a model at rest is asked: where it rests, and which tensions give a force."""

from __future__ import annotations

import sys
import warnings
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite
from cdcr.robot.units import ask_about_commands

if TYPE_CHECKING:
    from collections.abc import Sequence

    from cdcr.model.model import Model
    from cdcr.model.wrench import Wrench

FRICTION_LEFT_OUT = (
    "equilibrium leaves out the friction of the cables: with it the robot rests anywhere in a "
    "range of shapes, and cdcr.quasi_static tells where it comes to rest on its way"
)


class ConvergenceError(RuntimeError):
    """A search ended without an answer; the message says what to try next.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> try:
    ...     model.equilibrium([2000.0, 0.0, 0.0])
    ... except cdcr.ConvergenceError as error:
    ...     print("not found")
    not found
    """


class InfeasibleError(ValueError):
    """No tensions within the limits give the force asked for.

    Attributes
    ----------
    tension : (num_cables,) array
        Tensions that come nearest [N].
    force : (d,) array
        The generalised force they give [N m].
    limiting : tuple of int
        Indices of the cables whose limit is in the way.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> try:
    ...     model.allocate([1.0, 0.0], max_tension=10.0)
    ... except cdcr.InfeasibleError as error:
    ...     print(error.tension.round(3), error.limiting)
    [10.  0.  0.] (0, 1, 2)
    """

    def __init__(self, message: str, answer: _core.Allocation) -> None:
        super().__init__(message)
        self._answer = answer
        self.tension = answer.tension
        self.force = answer.force
        self.limiting = tuple(answer.limiting)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle by what it was made of, so that it leaves a process as it is."""
        return type(self), (str(self), self._answer), self.__dict__


class StaticModel(_core.Model):
    """The model of the core, which asks about commands where it looks for rest."""

    def find_equilibrium(
        self,
        tension: ArrayLike | None = None,
        q0: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> _core.Equilibrium:
        """Point of rest, whether found or not, and whether stable.

        Under constant commands and wrenches: cpp/several-sections.md eqs. (40) to (43).

        Parameters
        ----------
        tension : (num_cables,) array_like, optional
            Cable tensions [N]; lengths [m] for cables driven by length; by default `rest_command`.
        q0 : (d,) array_like, optional
            Where to start [rad]; by default the answer without gravity.
        wrenches : Wrench or sequence of Wrench, optional
            Constant forces [N] and moments [N m] on the backbone.

        Returns
        -------
        Equilibrium
            The answer, or in `status` why there is none.

        Raises
        ------
        ValueError
            Naming the argument that is not finite, out of its range or of another shape.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> rest = model.find_equilibrium([5.0, 0.0, 0.0])
        >>> rest.stable, rest.q.round(4) + 0.0
        (True, array([0.2614, 0.    ]))
        """
        return self._rest(tension, q0, wrenches)

    def _rest(
        self,
        tension: ArrayLike | None,
        q0: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> _core.Equilibrium:
        """For public names: whoever calls these is warned of commands that may be tensions."""
        found = super().find_equilibrium(tension, q0, wrenches)
        if tension is not None:
            ask_about_commands(cast("Model", self).robot, finite(tension, "tension"), stacklevel=4)
        return found


def checked_equilibrium(found: _core.Equilibrium, *, warn: bool = False) -> FloatArray:
    """Return q at rest, or raise where none was found; warn of friction that is left out."""
    if warn and found.friction_left_out:
        warnings.warn(FRICTION_LEFT_OUT, UserWarning, stacklevel=3)
    if found.status is not _core.Status.ok:
        raise ConvergenceError(_core.status_message(found.status))
    return found.q


def checked_allocation(
    found: _core.Allocation, force: ArrayLike, limits: tuple[float, float]
) -> FloatArray:
    """Return tensions that give a force, or raise where none within the limits do."""
    if not found.feasible:
        names = ", ".join(found.limits)
        reason = f"limited by {names}" if names else "no cable pulls that way"
        raise InfeasibleError(
            f"force {in_line(force)} N m cannot be met with tensions from {limits[0]} to "
            f"{limits[1]} N: {reason}; the nearest force is {in_line(found.force)} N m",
            found,
        )
    return found.tension


def in_line(numbers: ArrayLike) -> str:
    """Return an array as sentences print it: in one line, however long."""
    return np.array2string(np.asarray(numbers), max_line_width=sys.maxsize)
