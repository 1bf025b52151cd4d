"""Where the parts of a robot are in space. Plain arrays, no drawing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from cdcr.base.arrays import FloatArray

if TYPE_CHECKING:
    from cdcr.robot.cable import Cable
    from cdcr.robot.robot import Robot
    from cdcr.robot.section import Section

PIECES = 48  # straight pieces of a section's backbone
TURN = 24  # straight pieces of a whole turn of a cable, at least
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
        """Coordinates (N, d)."""

    @property
    def qd(self) -> FloatArray:
        """Their rates (N, d)."""


@dataclass(frozen=True, eq=False)
class RobotShape:
    """Points in the base frame [m].

    Parameters
    ----------
    backbone : ndarray, shape (K, 3)
        From base to tip.
    disks : list of ndarray, shape (48, 3)
        Rim of each disk, base to tip.
    turning : list of bool
        Whether each disk is of a section that twists.
    cables : list of ndarray, shape (M, 3)
        From where it begins to the end of the section it ends on, in the order of the tensions:
        through the holes of the disks where it runs straight, as it runs where it does not.
    tool : list of ndarray, shape (2, 3)
        A line from the tip of the backbone to the tool; none where they are in one place.
    """

    backbone: FloatArray
    disks: list[FloatArray]
    turning: list[bool]
    cables: list[FloatArray]
    tool: list[FloatArray]

    @property
    def sections(self) -> list[FloatArray]:
        """The backbone of each section, list of (49, 3), base to tip."""
        ends = range(0, len(self.backbone) - 1, PIECES)
        return [self.backbone[k : k + PIECES + 1] for k in ends]

    @property
    def marks(self) -> list[FloatArray]:
        """Lines (2, 3) on disks that turn, from the centre to the rim along x of their frames."""
        turning = [rim for rim, turns in zip(self.disks, self.turning, strict=True) if turns]
        return [np.array([rim.mean(axis=0), rim[0]]) for rim in turning]

    @property
    def points(self) -> FloatArray:
        """All of them (P, 3)."""
        return np.concatenate([self.backbone, *self.disks, *self.cables, *self.tool])


class _Place(NamedTuple):
    """A frame on the backbone of a section."""

    fraction: float  # of its length
    R: FloatArray  # (3, 3)
    p: FloatArray  # (3,) [m]


class _Guides(NamedTuple):
    """Frames of a section whose holes cables run through."""

    fine: list[_Place]  # from its base to its end, for cables that wind or converge
    at_disks: list[_Place]  # for those that run straight; none where it has no disks


def robot_shape(model: Posed, q: FloatArray) -> RobotShape:
    """Return the shape at q (d,).

    A section without disks leads its cables parallel to the backbone, as the model takes them.
    """
    robot = model.robot
    base = base_frame(robot)
    backbone, disks, turning, guides = [base[1]], [], [], []
    for i, section in enumerate(robot.sections):
        finer = _finer(robot, i)
        inner = sorted(section.disks)  # by position
        fine, at_disks = (
            [_Place(x, *model.pose(q, i, x)) for x in fractions]
            for fractions in (
                [k / (finer * PIECES) for k in range(1, finer * PIECES + 1)],
                [disk.position for disk in inner],
            )
        )
        disks += [
            _circle(disk.diameter / 2, at.R, at.p) for disk, at in zip(inner, at_disks, strict=True)
        ]
        turning += [twists(section)] * len(inner)
        backbone += [place.p for place in fine[finer - 1 :: finer]]
        guides.append(_Guides([_Place(0.0, *base), *fine], at_disks))
        base = fine[-1][1:]
    cables = [_path(cable, guides) for cable in robot.all_cables]
    return RobotShape(np.array(backbone), disks, turning, cables, _tool(robot, *base))


def twists(section: Section) -> bool:
    """Return whether the disks of a section may be turned about its backbone."""
    return section.twist_order is not None or section.rest_twist != 0.0


def _finer(robot: Robot, section: int) -> int:
    """Return how many times PIECES a section needs for the cables that wind in it."""
    turned = [
        abs(angle[1] - angle[0])
        for cable in robot.all_cables
        if cable.start_section <= section <= cable.end_section
        for _, angle in [cable.route(section)]
    ]
    pieces = max(turned, default=0.0) / (2.0 * math.pi) * TURN
    return max(1, math.ceil(pieces / PIECES - 1e-9))


def _path(cable: Cable, guides: list[_Guides]) -> FloatArray:
    """Return the points (M, 3) that a cable runs through [m]."""
    points = []
    for i in range(cable.start_section, cable.end_section + 1):
        fine, at_disks = guides[i]
        radius, angle = cable.route(i)
        straight = radius[0] == radius[1] and angle[0] == angle[1]
        places = at_disks if straight and at_disks else fine[1:]
        if i == cable.start_section or not straight:
            places = [fine[0], *places]
        if i == cable.end_section and places[-1].fraction < 1.0:
            places = [*places, fine[-1]]
        x = np.array([place.fraction for place in places])
        r, turn = (ends[0] + x * (ends[1] - ends[0]) for ends in (radius, angle))
        holes = np.stack([r * np.cos(turn), r * np.sin(turn), np.zeros_like(r)], axis=1)
        points += [at.p + at.R @ hole for at, hole in zip(places, holes, strict=True)]
    return np.array(points)


def widest(cable: Cable) -> float:
    """Return the largest distance of a cable from the backbone [m]."""
    passed = range(cable.start_section, cable.end_section + 1)
    return max(max(cable.route(section)[0]) for section in passed)


def base_frame(robot: Robot) -> tuple[FloatArray, FloatArray]:
    """Return R (3, 3) and p (3,) [m] of the frame in which the first section begins."""
    return np.array(robot.base_orientation), np.array(robot.base_position)


def _tool(robot: Robot, R: FloatArray, p: FloatArray) -> list[FloatArray]:
    """Return the line to the tool from the end of the backbone, whose frame is given, or none."""
    position = np.array(robot.tool)[:3, 3]
    return [np.array([p, p + R @ position])] if position.any() else []


def base_plate(model: Posed) -> FloatArray:
    """Return the rim (48, 3) of a plate that is wider than anything that stands on it [m]."""
    robot = model.robot
    reach = max(
        [section.length / 50 for section in robot.sections]
        + [disk.diameter / 2 for section in robot.sections for disk in section.disks]
        + [widest(cable) for cable in robot.all_cables]
    )
    return _circle(1.5 * reach, *base_frame(robot))


def _circle(radius: float, R: FloatArray, p: FloatArray) -> FloatArray:
    """Return points (48, 3) of the circle about p in the x-y plane of a frame."""
    angle = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)
    flat = radius * np.stack([np.cos(angle), np.sin(angle), np.zeros(CORNERS)], axis=1)
    return np.asarray(p + flat @ R.T)


def states_at(run: Motion, times: FloatArray) -> FloatArray:
    """Return q (M, d) at times (M,) [s]: between samples the cubic that has their q and qd."""
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
