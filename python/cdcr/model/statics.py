"""What a model at rest is asked: where it rests, and which tensions give a force."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core

if TYPE_CHECKING:
    from collections.abc import Sequence

    from cdcr.model.wrench import Wrench

FloatArray = NDArray[np.float64]

METHODS = tuple(method.name for method in _core.AllocationMethod)


class ConvergenceError(RuntimeError):
    """A search ended without an answer; the message says what to try next."""


class InfeasibleError(ValueError):
    """No tensions within the limits give the force asked for.

    Attributes
    ----------
    tension : (num_cables,) array
        Tensions that come nearest [N].
    force : (2n,) array
        The generalised force they give [N m].
    limiting : tuple of int
        Indices of the cables whose limit is in the way.
    """

    def __init__(self, message: str, answer: _core.Allocation) -> None:
        super().__init__(message)
        self.tension = answer.tension
        self.force = answer.force
        self.limiting = tuple(answer.limiting)


def equilibrium(
    model: _core.Model,
    tension: ArrayLike,
    q0: ArrayLike | None,
    wrenches: Wrench | Sequence[Wrench],
) -> FloatArray:
    """Return q at rest; see Model.equilibrium."""
    answer = model.find_equilibrium(tension, q0, wrenches)
    if answer.status is not _core.Status.ok:
        raise ConvergenceError(_core.status_message(answer.status))
    return answer.q


def allocate(
    model: _core.Model, force: ArrayLike, min_tension: float, max_tension: float, method: str
) -> FloatArray:
    """Return tensions for a force; see Model.allocate."""
    if method not in METHODS:
        raise ValueError(f"method must be one of {METHODS}, got {method!r}")
    answer = model.find_tension(
        force, min_tension, max_tension, method=_core.AllocationMethod[method]
    )
    if not answer.feasible:
        limits = ", ".join(answer.limits)
        reason = f"limited by {limits}" if limits else "no cable pulls that way"
        raise InfeasibleError(
            f"force {np.asarray(force)} N m cannot be met with tensions from {min_tension} to "
            f"{max_tension} N: {reason}; the nearest force is {answer.force} N m",
            answer,
        )
    return answer.tension
