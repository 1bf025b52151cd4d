"""Wrenches on a measured robot: the same throughout, or over the time of a motion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot

Wrenches = Wrench | Sequence[Wrench]


def check_wrenches(wrenches: Wrenches, robot: Robot, over_time: bool = False) -> None:
    """Refuse what is no wrench on this robot, and profiles where no time passes."""
    model = Model(robot)
    if over_time and isinstance(wrenches, Wrench | Sequence):
        wrenches = [replace(one, profile=None) if _varies(one) else one for one in _each(wrenches)]
    model.wrench_force(np.zeros(model.num_coordinates), wrenches)


def wrenches_at(wrenches: Wrenches, t: float) -> Wrenches:
    """Return the constant wrenches that they are at one time."""
    if not _vary(wrenches):
        return wrenches
    return [one.at(t) for one in _each(wrenches)]


def under(
    function: Callable[..., FloatArray],
    rows: Sequence[FloatArray],
    wrenches: Wrenches,
    times: FloatArray,
) -> FloatArray:
    """Return a function of rows and wrenches at times: row by row where wrenches vary."""
    if not _vary(wrenches):
        return function(*rows, wrenches)
    found = [
        function(*(row[i] for row in rows), wrenches_at(wrenches, float(t)))
        for i, t in enumerate(times)
    ]
    return np.stack(found)


def _each(wrenches: Wrenches) -> Sequence[Wrench]:
    return (wrenches,) if isinstance(wrenches, Wrench) else wrenches


def _vary(wrenches: Wrenches) -> bool:
    return any(map(_varies, _each(wrenches)))


def _varies(one: object) -> bool:
    return isinstance(one, Wrench) and one.profile is not None
