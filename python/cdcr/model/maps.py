"""What optimisers take of a model: functions of rows of vectors with their exact derivatives."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import require_kind
from cdcr.model.memory import warn_of_memory
from cdcr.model.model import Model
from cdcr.model.steps import AnyDynamics, Steps, or_nan
from cdcr.model.wrench import Wrench

Rows: TypeAlias = Callable[..., tuple[FloatArray, ...]]


@dataclass(frozen=True)
class ExactMap:
    """A function of k rows of named vectors.

    Attributes
    ----------
    name : str
        What it is called.
    takes : dict of str to int
        Arguments and their sizes.
    gives : dict of str to tuple of int
        Answers and their shapes, of one row.
    values : callable
        The answers, (k, ...) each.
    slopes : callable
        Derivatives by each argument, (k, ..., size), all those of the first answer first.
    """

    name: str
    takes: Mapping[str, int]
    gives: Mapping[str, tuple[int, ...]]
    values: Rows
    slopes: Rows


def dynamics(model: Model, wrenches: Wrench | Sequence[Wrench] = ()) -> ExactMap:
    """Return accelerations, of state and commands."""
    motion = AnyDynamics(model, wrenches)
    d = model.num_coordinates
    takes = {"q": d, "qd": d, "tension": model.num_cables}

    def values(*state: FloatArray) -> tuple[FloatArray, ...]:
        return (motion.accelerations(*state),)

    return ExactMap("dynamics", takes, {"qdd": (d,)}, values, motion.derivatives)


def step(
    model: Model, period: float, substeps: int = 1, wrenches: Wrench | Sequence[Wrench] = ()
) -> ExactMap:
    """Return the state after a period, of the state before and of commands held."""
    require_kind("model", model, Model)
    warn_of_memory(model, "a step of the state", stacklevel=3)
    steps = Steps(AnyDynamics(model, wrenches), period, substeps)
    states = 2 * model.num_coordinates

    def values(x: FloatArray, u: FloatArray) -> tuple[FloatArray, ...]:
        return (steps.end(x, u),)

    def slopes(x: FloatArray, u: FloatArray) -> tuple[FloatArray, ...]:
        both = steps.derivatives(x, u)[1]
        return both[..., :states], both[..., states:]

    takes = {"x": states, "tension": model.num_cables}
    return ExactMap("step", takes, {"x_next": (states,)}, values, slopes)


def tip(model: Model) -> ExactMap:
    """Return rotation matrix and position of the tip, of coordinates."""
    require_kind("model", model, Model)

    def values(q: FloatArray) -> tuple[FloatArray, ...]:
        return or_nan(model.tip, q)

    def both(q: FloatArray) -> tuple[FloatArray, ...]:
        return model.tip_jacobian(q), model.tip(q)[0]

    def slopes(q: FloatArray) -> tuple[FloatArray, ...]:
        J, R = or_nan(both, q)
        turning = J[:, 3:].swapaxes(1, 2)  # (k, d, 3)
        columns = R.swapaxes(1, 2)  # each turns as a vector does: w x column
        turned = np.cross(turning[:, :, None], columns[:, None])  # (k, d, column, entry)
        return turned.transpose(0, 3, 2, 1), J[:, :3]

    return ExactMap("tip", {"q": model.num_coordinates}, {"R": (3, 3), "p": (3,)}, values, slopes)


def cable_lengths(model: Model) -> ExactMap:
    """Return the lengths of all cables, of coordinates."""
    require_kind("model", model, Model)

    def values(q: FloatArray) -> tuple[FloatArray, ...]:
        return or_nan(lambda q: (model.cable_lengths(q),), q)

    def slopes(q: FloatArray) -> tuple[FloatArray, ...]:
        return or_nan(lambda q: (-model.actuation_matrix(q).swapaxes(1, 2),), q)

    takes, gives = {"q": model.num_coordinates}, {"lengths": (model.num_cables,)}
    return ExactMap("cable_lengths", takes, gives, values, slopes)
