"""The robot of a scenario file: a name, a robot file, a table, or a known robot with changes.

[robot]
name = "three_sections"
gravity = [0.0, 0.0, -9.81]     # fields of the robot
[robot.each_section]
damping = 6e-3                  # fields of all its sections
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from cdcr import robots
from cdcr.files.refusals import named_by
from cdcr.files.toml import refuse, schema_errors
from cdcr.robot.file import doubled, in_radians, robot_from_table
from cdcr.robot.robot import Robot
from cdcr.scenarios.file.values import error_prefix


def read_robot(value: str | dict[str, Any], file: Path) -> Robot:
    """Return the robot of a scenario file, or refuse it with file, key and value."""
    if isinstance(value, str):
        if value.endswith(".toml"):
            with named_by(f"{file}, robot"):
                return Robot.load(file.parent / value)
        with error_prefix(f"{file}, robot"):
            return robots.get(value)
    where = f"{file}, [robot]"
    return _changed(value, where) if "name" in value else robot_from_table(Robot, value, where)


def _changed(table: dict[str, Any], where: str) -> Robot:
    from cdcr.scenarios.file.schema import SECTION_CHANGES, RobotChanges

    each = table.get("each_section", {})
    refuse(where, schema_errors(RobotChanges, table))
    refuse(where, schema_errors(SECTION_CHANGES, each, "each_section"))
    refuse(where, doubled(each, "each_section", "cable_angles"))
    changes = {key: value for key, value in table.items() if key not in ("name", "each_section")}
    with error_prefix(where):
        robot = robots.get(table["name"])
    with error_prefix(f"{where}, each_section"):
        sections = tuple(replace(section, **in_radians(each)) for section in robot.sections)
    with error_prefix(where):
        return replace(robot, sections=sections, **changes)
