"""A robot as rigid links: joints in the middle of equal parts of each section.

A part of a section that bends by an angle ends, to first order in it, where two straight halves end
that are joined by a hinge, and so do its disks beyond the hinge; it twists there too, where the
section does. Each link is what lies between two
hinges: half a part of a section, and half of the next.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.export.arcs import Twist
from cdcr.robot.robot import Robot


@dataclass(frozen=True)
class Joint:
    """Where a robot of links bends, and twists."""

    section: int
    part: int  # of the section, from 0
    height: float  # arc length from the base [m]
    stiffness: float  # of each bending component [N m/rad]
    damping: float  # [N m s/rad]
    twist: Twist | None  # about the axis


@dataclass(frozen=True, eq=False)
class Link:
    """A rigid body, its frame at its lower joint (the first one's at the base), Z along it."""

    start: float  # arc length from the base [m]
    end: float
    mass: float  # [kg]
    center: FloatArray  # of mass (3,) [m]
    inertia: FloatArray  # about it (3, 3) [kg m^2]
    disks: tuple[tuple[float, float], ...]  # height in the frame and diameter [m]


@dataclass(frozen=True)
class Piece:
    """A slice of the backbone, or a disk of no height."""

    bottom: float  # arc length from the base [m]
    top: float
    mass: float  # [kg]
    diameter: float  # [m]

    def between(self, start: float, end: float) -> Piece:
        """Return what of it lies there."""
        bottom, top = max(self.bottom, start), min(self.top, end)
        share = (top - bottom) / (self.top - self.bottom)
        return Piece(bottom, top, self.mass * share, self.diameter)


class Chain:
    """A robot of so many links a section.

    Attributes
    ----------
    robot : Robot
        The robot.
    cables : tuple of Cable
        Its cables, in the order of the commands.
    ends : list of float
        Arc lengths at which sections begin, and the last one ends [m].
    joints : list of Joint
        Base to tip.
    links : list of Link
        Between the joints; the first one is fixed to the base, the last one is the tip's.
    """

    def __init__(
        self, robot: Robot, count: int, twists: Sequence[Twist | None] | None = None
    ) -> None:
        twists = twists or [None] * len(robot.sections)
        self.robot = robot
        self.cables = robot.all_cables
        self.ends = list(accumulate((section.length for section in robot.sections), initial=0.0))
        self.joints = [
            Joint(
                section=i,
                part=part,
                height=self.ends[i] + (part + 0.5) * section.length / count,
                stiffness=section.stiffness * count,
                damping=section.damping * count,
                twist=twist and Twist(twist.stiffness * count, twist.damping * count),
            )
            for i, (section, twist) in enumerate(zip(robot.sections, twists, strict=True))
            for part in range(count)
        ]
        length = self.ends[-1]
        borders = [0.0, *(joint.height for joint in self.joints), length]
        self.links = [
            _link(robot, self.ends, *pair, last=pair[1] == length) for pair in pairwise(borders)
        ]

    def fastest(self) -> float:
        """Return the largest frequency of the straight chain, cables held [rad/s]."""
        heights = np.array([joint.height for joint in self.joints])
        twisting = [joint for joint in self.joints if joint.twist]
        twist_heights = np.array([joint.height for joint in twisting])
        mass = np.zeros((len(heights), len(heights)))
        spin = np.zeros((len(twisting), len(twisting)))
        for link in self.links[1:]:
            turns, winds = heights <= link.start, twist_heights <= link.start
            arms = np.where(turns, link.start + link.center[2] - heights, 0.0)
            mass += link.mass * np.outer(arms, arms) + link.inertia[1, 1] * np.outer(turns, turns)
            spin += link.inertia[2, 2] * np.outer(winds, winds)
        stiffness = np.diag([joint.stiffness for joint in self.joints])
        for cable in self.cables:
            through = np.array([joint.section <= cable.end_section for joint in self.joints])
            stiffness += cable.stiffness * cable.farthest**2 * np.outer(through, through)
        winding = np.diag([joint.twist.stiffness for joint in twisting if joint.twist])
        return max(_fastest(mass, stiffness), _fastest(spin, winding))


def _fastest(mass: FloatArray, stiffness: FloatArray) -> float:
    """Return the largest frequency of a mass and a stiffness matrix, 0 of none [rad/s]."""
    if not len(mass):
        return 0.0
    inverse = np.linalg.inv(np.linalg.cholesky(mass))
    return float(np.sqrt(np.linalg.eigvalsh(inverse @ stiffness @ inverse.T)[-1]))


def _link(robot: Robot, ends: Sequence[float], start: float, end: float, *, last: bool) -> Link:
    pieces = list(_pieces(robot, ends, start, end, last))
    bodies = [_as_body(piece, start) for piece in pieces]
    if last and robot.payload:
        position = np.array(robot.payload_position)
        position[2] += end - start
        bodies.append((robot.payload, position, np.array(robot.payload_inertia)))
    mass = sum(body[0] for body in bodies)
    moment = sum((body[0] * body[1] for body in bodies), np.zeros(3))
    center = moment / mass if mass else moment
    inertia = np.zeros((3, 3))
    for weight, position, own in bodies:
        r = position - center
        inertia += own + weight * (r @ r * np.eye(3) - np.outer(r, r))
    disks = [
        (piece.bottom - start, piece.diameter) for piece in pieces if piece.bottom == piece.top
    ]
    return Link(start, end, mass, center, inertia, tuple(disks))


def _pieces(
    robot: Robot, ends: Sequence[float], start: float, end: float, last: bool
) -> Iterator[Piece]:
    """Yield what lies from start to before the end, that of the last link included."""
    for section, (bottom, top) in zip(robot.sections, pairwise(ends), strict=True):
        if max(bottom, start) < min(top, end):
            whole = Piece(bottom, top, section.backbone_mass, section.diameters[0])
            yield whole.between(start, end)
        for disk in section.disks:
            height = min(bottom + disk.position * section.length, top)
            if start <= height < end or (last and height == end):
                yield Piece(height, height, disk.mass, disk.diameter)


def _as_body(piece: Piece, start: float) -> tuple[float, FloatArray, FloatArray]:
    """Return mass, place and inertia: of a thin disk, or of a rod of slices that are such disks."""
    along = piece.top - piece.bottom
    axial = piece.mass * piece.diameter**2 / 8.0
    across = axial / 2.0 + piece.mass * along**2 / 12.0
    place = np.array([0.0, 0.0, 0.5 * (piece.bottom + piece.top) - start])
    return piece.mass, place, np.diag([across, across, axial])
