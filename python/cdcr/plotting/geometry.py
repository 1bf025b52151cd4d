"""Where the parts of a robot are in space. Plain arrays, no drawing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from cdcr import Model, Trajectory

__all__ = ["RobotShape", "base_plate", "robot_shape", "states_at"]

Array = NDArray[np.float64]

PIECES = 48  # straight pieces of a section's backbone
CORNERS = 48  # of a disk


@dataclass(frozen=True, eq=False)
class RobotShape:
    """Points in the base frame [m].

    Parameters
    ----------
    backbone : ndarray, shape (K, 3)
        From base to tip.
    disks : list of ndarray, shape (48, 3)
        Rim of each disk, base to tip.
    cables : list of ndarray, shape (M, 3)
        From the base through the holes of the disks to the disk where the cable ends.
    """

    backbone: Array
    disks: list[Array]
    cables: list[Array]

    @property
    def points(self) -> Array:
        """All of them (P, 3)."""
        return np.concatenate([self.backbone, *self.disks, *self.cables])


def robot_shape(model: Model, q: Array) -> RobotShape:
    """Return the shape at q (2n,) [rad].

    A section without disks leads its cables parallel to the backbone, as the model takes them.
    """
    backbone, disks, cables = [np.zeros(3)], [], []
    guides = [(np.eye(3), np.zeros(3))]  # frames whose holes the cables run through
    for i, section in enumerate(model.robot.sections):
        count = section.num_disks
        fine = [model.pose(q, i, k / PIECES) for k in range(1, PIECES + 1)]
        at_disks = [model.pose(q, i, k / count) for k in range(1, count + 1)]
        backbone += [p for _, p in fine]
        disks += [_circle(section.disk_diameter / 2, R, p) for R, p in at_disks]
        guides += at_disks or fine
        for angle in section.cable_angles:
            hole = section.cable_radius * np.array([np.cos(angle), np.sin(angle), 0.0])
            cables.append(np.array([p + R @ hole for R, p in guides]))
    return RobotShape(np.array(backbone), disks, cables)


def base_plate(model: Model) -> Array:
    """Return the rim (48, 3) of a plate that is wider than anything that stands on it [m]."""
    widest = max(
        max(section.disk_diameter / 2, section.cable_radius, section.length / 50)
        for section in model.robot.sections
    )
    return _circle(1.5 * widest, np.eye(3), np.zeros(3))


def _circle(radius: float, R: Array, p: Array) -> Array:
    """Return points (48, 3) of the circle about p in the x-y plane of a frame."""
    angle = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    flat = radius * np.stack([np.cos(angle), np.sin(angle), np.zeros(CORNERS)], axis=1)
    return np.asarray(p + flat @ R.T)


def states_at(run: Trajectory, times: Array) -> Array:
    """Return q (M, 2n) at times (M,) [s]: between samples the cubic that has their q and qd."""
    start, end = run.t[0], run.t[-1]
    if not np.all((times >= start) & (times <= end)):
        raise ValueError(f"times must lie within the run, {start:g} to {end:g} s, got {times}")
    if len(run) == 1:
        return np.repeat(run.q, len(times), axis=0)
    right = np.clip(np.searchsorted(run.t, times, side="right"), 1, len(run) - 1)
    left = right - 1
    h = (run.t[right] - run.t[left])[:, None]
    s = (times - run.t[left])[:, None] / h
    q0, q1, v0, v1 = run.q[left], run.q[right], h * run.qd[left], h * run.qd[right]
    rise = q1 - q0
    return q0 + s * (v0 + s * (3.0 * rise - 2.0 * v0 - v1 + s * (v0 + v1 - 2.0 * rise)))
