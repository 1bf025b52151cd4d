"""What a model at rest is asked: where it rests, and which tensions give a force."""

from __future__ import annotations

import sys
import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray

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
