"""What the actions of an environment ask of the cables."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray, finite
from cdcr.model.model import Model
from cdcr.robot.robot import Robot

RIGHT_ANGLE = math.pi / 2.0
# Of cables that get a length drive: their stiffness over that of the section as they feel it, and
# the time in which their damping gives as much force as their stretch.
STIFFER, DAMPING_TIME = 20.0, 2e-3  # [1], [s]


class Drive:
    """Turns actions, -1 to 1 for each cable, into commands.

    Parameters
    ----------
    robot : Robot
        The robot as described.
    by_length : bool
        Whether actions are lengths; cables driven by tension get a spring and damper then.
    limit : float or (num_cables,) array_like, optional
        Largest tension [N], or largest change of length to either side [m].
    """

    def __init__(self, robot: Robot, by_length: bool, limit: ArrayLike | None) -> None:
        self.by_length = by_length
        self.robot = _driven_by_length(robot) if by_length else robot
        cables = self.robot.all_cables
        if not cables:
            raise ValueError("an environment needs cables, and this robot has none")
        if not by_length and any(cable.length_driven for cable in cables):
            raise ValueError(
                "action must be 'length' for a robot whose cables are driven by length, "
                "got 'tension'"
            )
        self._rest = Model(self.robot).rest_command()
        self._limit = self._usual_limit() if limit is None else self._checked(limit)

    def share(self, action: ArrayLike) -> FloatArray:
        """Return actions (..., num_cables), clipped, as shares of the largest command."""
        clipped = np.maximum(np.minimum(np.asarray(action, dtype=np.float64), 1.0), -1.0)
        return np.asarray(clipped if self.by_length else 0.5 + 0.5 * clipped)

    def command(self, share: FloatArray) -> FloatArray:
        """Return the commands (..., num_cables) of such shares: [N], or [m]."""
        asked = self._limit * share
        return np.asarray(self._rest - asked if self.by_length else asked)

    def _usual_limit(self) -> FloatArray:
        """Return what bends each last section by 90 degrees, over the number of sections."""
        sections = self.robot.sections
        cables = self.robot.all_cables
        angle = RIGHT_ANGLE / len(sections)
        if self.by_length:
            return np.array([angle * cable.farthest for cable in cables])
        return np.array(
            [angle * sections[one.end_section].stiffness / one.farthest for one in cables]
        )

    def _checked(self, limit: ArrayLike) -> FloatArray:
        unit = "m" if self.by_length else "N"
        given = finite(limit, "limit")
        cables = self.robot.num_cables
        if given.shape not in ((), (cables,)) or np.min(given) <= 0.0:
            raise ValueError(
                f"limit must be one number > 0 {unit} or {cables} of them, got {given.tolist()}"
            )
        limits = np.broadcast_to(given, cables)
        too_far = np.flatnonzero(limits > self._rest)
        if self.by_length and too_far.size:
            j = too_far[0]
            raise ValueError(
                f"limit must be at most {self._rest[j]:g} m for cable {j + 1}, its length on the "
                f"straight robot, got {limits[j]:g} m"
            )
        return limits


def _driven_by_length(robot: Robot) -> Robot:
    """Return the robot with a length drive at every cable that has none."""

    def stiffness(section: int, radius: float) -> float:
        return STIFFER * robot.sections[section].stiffness / radius**2

    sections = []
    for i, section in enumerate(robot.sections):
        if section.cable_angles and section.cable_stiffness == 0.0:
            k = stiffness(i, section.cable_radius)
            section = replace(section, cable_stiffness=k, cable_damping=k * DAMPING_TIME)
        sections.append(section)
    cables = []
    for cable in robot.cables:
        if not cable.length_driven:
            k = stiffness(cable.end_section, cable.farthest)
            cable = replace(cable, stiffness=k, damping=k * DAMPING_TIME)
        cables.append(cable)
    return replace(robot, sections=tuple(sections), cables=tuple(cables))
