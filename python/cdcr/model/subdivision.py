"""Wrenches on a robot as those on its subdivided one."""

from __future__ import annotations

from dataclasses import replace

from cdcr.base.check import require_kind
from cdcr.model.wrench import Wrench
from cdcr.robot.parts import Parts, part_counts
from cdcr.robot.robot import Robot


def subdivide_wrench(robot: Robot, parts: Parts, wrench: Wrench) -> Wrench:
    """Return a wrench that acts on the same place of a subdivided robot.

    Parameters
    ----------
    robot : Robot
        The robot of n sections, not yet subdivided.
    parts : int or sequence of int
        As in ``robot.subdivide``.
    wrench : Wrench
        On the whole robot.

    Returns
    -------
    Wrench
        On the part that holds the place, at its fraction; at a border on the part before it.

    Raises
    ------
    TypeError
        For a robot or a wrench that is none.
    ValueError
        For wrong `parts`, or a section that the robot has not.

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.amouri2020()
    >>> moved = cdcr.subdivide_wrench(robot, 4, cdcr.Wrench(section=0, fraction=0.625))
    >>> moved.section, moved.fraction
    (2, 0.5)
    """
    require_kind("robot", robot, Robot)
    require_kind("wrench", wrench, Wrench)
    counts = part_counts(len(robot.sections), parts)
    if wrench.section >= len(counts):
        raise ValueError(
            f"the section of the wrench must be 0 to {len(counts) - 1}, got {wrench.section}"
        )
    along = wrench.fraction * counts[wrench.section]
    part = min(max(int(-(-along // 1)) - 1, 0), counts[wrench.section] - 1)
    return replace(
        wrench, section=sum(counts[: wrench.section]) + part, fraction=min(along - part, 1.0)
    )
