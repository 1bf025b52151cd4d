"""Where the solids of a picture stand: unit cylinders, placed and turned, and lines."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cdcr.base.arrays import FloatArray
from cdcr.base.rotations import quaternions
from cdcr.plotting.geometry import PIECES, RobotShape, base_frame, robot_shape, twists
from cdcr.view.live import LiveModel

STRIDE = 2  # pieces of the backbone's outline that one cylinder spans
SIDES = 24  # of a cylinder
SLENDER, THIN = 1 / 250, 1 / 200  # least radius of a backbone, thickness of a disk, over length
OVERLAP = 1.03  # of cylinders, for where they bend
KNOB, STANDING_OUT = 0.09, 2.2  # radius of a mark over that of its disk, thickness likewise


class Poses(NamedTuple):
    """Frames of several solids."""

    wxyz: FloatArray  # (K, 4) unit quaternions
    position: FloatArray  # (K, 3) [m]


class Placement(NamedTuple):
    """A robot in one state."""

    backbone: Poses  # of cylinders along z, centred
    lengths: FloatArray  # (K,) of these cylinders [m]
    disks: Poses
    marks: Poses  # at the rims of disks of sections that twist
    cables: FloatArray  # (S, 2, 3) straight pieces [m]
    frames: Poses  # of the base, of the end of each section, and of the tool in place of the last
    tool: FloatArray  # (0 or 1, 2, 3) line from the backbone to the tool [m]
    tip: FloatArray  # (3,) [m]


class Sizes(NamedTuple):
    """What does not change as a robot moves."""

    backbone: FloatArray  # (K, 3) radius, radius, length of each cylinder [m]
    backbone_section: NDArray[np.int64]  # (K,)
    disks: FloatArray  # (D, 3) likewise
    marks: FloatArray  # (M, 3) likewise, of knobs that stand out of the disks
    stretches: bool  # whether the lengths of cylinders change
    pieces: NDArray[np.int64]  # (S,) cable that each piece is of
    disk_place: list[tuple[int, float]]  # section and fraction of each disk


def sizes(model: LiveModel) -> Sizes:
    """Return sizes and owners of the solids of a robot."""
    robot = model.robot
    per_section = PIECES // STRIDE
    backbone = [
        (radius, radius, OVERLAP * section.length / per_section)
        for section in robot.sections
        for radius in _radii(section.diameters, robot.length * SLENDER, per_section)
    ]
    thick = robot.length * THIN
    places = [
        (i, disk) for i, s in enumerate(robot.sections) for disk in sorted(s.disks) if disk.diameter
    ]
    marked = [
        (KNOB * disk.diameter / 2, KNOB * disk.diameter / 2, STANDING_OUT * thick)
        for i, disk in places
        if twists(robot.sections[i])
    ]
    shape = robot_shape(model, np.zeros(model.num_coordinates))
    return Sizes(
        np.array(backbone),
        np.repeat(np.arange(len(robot.sections)), per_section),
        np.array([(d.diameter / 2, d.diameter / 2, thick) for _, d in places]).reshape(-1, 3),
        np.array(marked).reshape(-1, 3),
        any(section.stretch_order is not None for section in robot.sections),
        np.repeat(np.arange(len(shape.cables)), [len(cable) - 1 for cable in shape.cables]),
        [(i, disk.position) for i, disk in places],
    )


def _radii(diameters: tuple[float, float], least: float, count: int) -> FloatArray:
    """Return the radius of each cylinder of a taper, none of which is too thin to be seen [m]."""
    base, tip = diameters
    middle = (np.arange(count) + 0.5) / count
    radius = (base + middle * (tip - base)) / 2
    return np.asarray(radius * max(1.0, 2 * least / max(base, tip)))


def place(model: LiveModel, q: FloatArray) -> Placement:
    """Return where everything is at q (d,)."""
    shape = robot_shape(model, q)
    line = shape.backbone[::STRIDE]
    ends = [model.pose(q, i, 1.0) for i in range(model.num_sections - 1)]
    frames = [base_frame(model.robot), *ends, model.tip(q)]
    pieces = [np.stack([cable[:-1], cable[1:]], axis=1) for cable in shape.cables]
    between = np.diff(line, axis=0)
    return Placement(
        Poses(along(between), (line[:-1] + line[1:]) / 2),
        np.linalg.norm(between, axis=1),
        _disks(shape.disks),
        _marks(shape),
        np.concatenate(pieces) if pieces else np.zeros((0, 2, 3)),
        Poses(quaternions(np.array([R for R, _ in frames])), np.array([p for _, p in frames])),
        np.array(shape.tool).reshape(-1, 2, 3),
        frames[-1][1],
    )


def _marks(shape: RobotShape) -> Poses:
    """Return where the knobs on the rims of disks are, of those that have a width and turn."""
    turning = [rim for rim, turns in zip(shape.disks, shape.turning, strict=True) if turns]
    disks = _disks(turning)
    wide = [line for line in shape.marks if np.ptp(line, axis=0).any()]
    arms = np.array([rim - center for center, rim in wide]).reshape(-1, 3)
    return disks._replace(position=disks.position + (1.0 - KNOB) * arms)


def _disks(rims: list[FloatArray]) -> Poses:
    """Return where disks are, of those that have a width."""
    rims = [rim for rim in rims if np.ptp(rim, axis=0).any()]
    if not rims:
        return Poses(np.zeros((0, 4)), np.zeros((0, 3)))
    rim = np.array(rims)
    center = rim.mean(axis=1)
    quarter = rim.shape[1] // 4
    return Poses(along(np.cross(rim[:, 0] - center, rim[:, quarter] - center)), center)


def along(directions: FloatArray) -> FloatArray:
    """Return the quaternions (K, 4) that turn z to directions (K, 3) by the shortest way."""
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    x, y, z = unit.T
    turned = np.stack([1.0 + z, -y, x, np.zeros_like(z)], axis=1)
    turned[z < -1.0 + 1e-12] = (0.0, 1.0, 0.0, 0.0)  # straight back: about x
    return np.asarray(turned / np.linalg.norm(turned, axis=1, keepdims=True))


def cylinder() -> tuple[FloatArray, NDArray[np.uint32]]:
    """Return vertices (V, 3) and faces (F, 3) of a cylinder of radius and height 1 about z."""
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)
    ring = np.stack([np.cos(angle), np.sin(angle), np.full(SIDES, -0.5)], axis=1)
    top = ring + np.array([0.0, 0.0, 1.0])
    # The rims stand twice: their edges are to look sharp.
    vertices = np.concatenate([ring, top, ring, top])
    k = np.arange(SIDES)
    after = (k + 1) % SIDES
    side = np.concatenate(
        [np.stack([k, after, after + SIDES], 1), np.stack([k, after + SIDES, k + SIDES], 1)]
    )
    fan = np.stack([np.zeros(SIDES - 2, int), k[1:-1], k[2:]], 1)
    faces = np.concatenate([side, fan[:, ::-1] + 2 * SIDES, fan + 3 * SIDES])
    return vertices, faces.astype(np.uint32)
