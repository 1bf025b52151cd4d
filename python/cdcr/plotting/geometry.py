"""Where the parts of a robot are in space. Plain arrays, no drawing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from cdcr.base.arrays import FloatArray

if TYPE_CHECKING:
    from cdcr.robot.cable import Cable
    from cdcr.robot.robot import Robot

PIECES = 48  # straight pieces of a section's backbone
CORNERS = 48  # of a disk


class Posed(Protocol):
    """A model, as far as it tells where things are."""

    @property
    def robot(self) -> Robot:
        """The robot described."""

    def pose(self, q: FloatArray, section: int, fraction: float) -> tuple[FloatArray, FloatArray]:
        """Return R (3, 3) and p (3,) [m] at a fraction of a section's length."""


class Motion(Protocol):
    """A run or a reference, as far as it tells states over time."""

    @property
    def t(self) -> FloatArray:
        """Times (N,) [s]."""

    @property
    def q(self) -> FloatArray:
        """Bending vectors (N, 2n) [rad]."""

    @property
    def qd(self) -> FloatArray:
        """Their rates (N, 2n) [rad/s]."""


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
        From the base through the holes of the disks to the end of the section it ends on, in the
        order of the tensions.
    tool : list of ndarray, shape (2, 3)
        A line from the tip of the backbone to the tool; none where they are in one place.
    """

    backbone: FloatArray
    disks: list[FloatArray]
    cables: list[FloatArray]
    tool: list[FloatArray]

    @property
    def sections(self) -> list[FloatArray]:
        """The backbone of each section, list of (49, 3), base to tip."""
        ends = range(0, len(self.backbone) - 1, PIECES)
        return [self.backbone[k : k + PIECES + 1] for k in ends]

    @property
    def points(self) -> FloatArray:
        """All of them (P, 3)."""
        return np.concatenate([self.backbone, *self.disks, *self.cables, *self.tool])


def robot_shape(model: Posed, q: FloatArray) -> RobotShape:
    """Return the shape at q (2n,) [rad].

    A section without disks leads its cables parallel to the backbone, as the model takes them.
    """
    robot = model.robot
    R_base, base = base_frame(robot)
    backbone, disks = [base], []
    # Frames whose holes the cables run through, up to the end of each section.
    guides = [(R_base, base)]
    runs = []
    for i, section in enumerate(robot.sections):
        fine = [model.pose(q, i, k / PIECES) for k in range(1, PIECES + 1)]
        backbone += [p for _, p in fine]
        inner = sorted(section.disks)  # by position
        at_disks = [model.pose(q, i, disk.position) for disk in inner]
        disks += [
            _circle(disk.diameter / 2, R, p) for disk, (R, p) in zip(inner, at_disks, strict=True)
        ]
        guides = [*guides, *(at_disks or fine)]
        ends_on_disk = not inner or inner[-1].position == 1.0
        runs.append(guides if ends_on_disk else [*guides, fine[-1]])
    cables = [
        np.array([p + R @ _hole(cable) for R, p in runs[cable.end_section]])
        for cable in robot.all_cables
    ]
    return RobotShape(np.array(backbone), disks, cables, _tool(robot, *fine[-1]))


def base_frame(robot: Robot) -> tuple[FloatArray, FloatArray]:
    """Return R (3, 3) and p (3,) [m] of the frame in which the first section begins."""
    return np.array(robot.base_orientation), np.array(robot.base_position)


def _tool(robot: Robot, R: FloatArray, p: FloatArray) -> list[FloatArray]:
    """Return the line to the tool from the end of the backbone, whose frame is given, or none."""
    position = np.array(robot.tool)[:3, 3]
    return [np.array([p, p + R @ position])] if position.any() else []


def _hole(cable: Cable) -> FloatArray:
    """Return where a cable passes a disk (3,), in the frame of the disk [m]."""
    return cable.radius * np.array([np.cos(cable.angle), np.sin(cable.angle), 0.0])


def base_plate(model: Posed) -> FloatArray:
    """Return the rim (48, 3) of a plate that is wider than anything that stands on it [m]."""
    robot = model.robot
    widest = max(
        [section.length / 50 for section in robot.sections]
        + [disk.diameter / 2 for section in robot.sections for disk in section.disks]
        + [cable.radius for cable in robot.all_cables]
    )
    return _circle(1.5 * widest, *base_frame(robot))


def _circle(radius: float, R: FloatArray, p: FloatArray) -> FloatArray:
    """Return points (48, 3) of the circle about p in the x-y plane of a frame."""
    angle = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    flat = radius * np.stack([np.cos(angle), np.sin(angle), np.zeros(CORNERS)], axis=1)
    return np.asarray(p + flat @ R.T)


def states_at(run: Motion, times: FloatArray) -> FloatArray:
    """Return q (M, 2n) at times (M,) [s]: between samples the cubic that has their q and qd."""
    start, end = run.t[0], run.t[-1]
    if not np.all((times >= start) & (times <= end)):
        raise ValueError(f"times must lie within the run, {start:g} to {end:g} s, got {times}")
    if len(run.t) == 1:
        return np.repeat(run.q, len(times), axis=0)
    right = np.clip(np.searchsorted(run.t, times, side="right"), 1, len(run.t) - 1)
    left = right - 1
    h = (run.t[right] - run.t[left])[:, None]
    s = (times - run.t[left])[:, None] / h
    q0, q1, v0, v1 = run.q[left], run.q[right], h * run.qd[left], h * run.qd[right]
    rise = q1 - q0
    return q0 + s * (v0 + s * (3.0 * rise - 2.0 * v0 - v1 + s * (v0 + v1 - 2.0 * rise)))
