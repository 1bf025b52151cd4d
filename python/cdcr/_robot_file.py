"""Robot files: TOML with the fields of Robot and Section, units in comments."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields
from os import PathLike
from pathlib import Path
from typing import Any

from cdcr import _core
from cdcr._export import new_file
from cdcr._robot import Robot, Section
from cdcr._toml import complaints, read_toml, refuse

_HEAD = """\
# A cable-driven continuum robot. SI units and radians.
# Base frame: origin at the base, Z along the straight robot, X towards cable angle 0.
# Instead of cable_angles, cable_angles_deg may be given, in degrees.
"""


def load_robot(path: str | PathLike[str]) -> Robot:
    """Return the robot of a file; see Robot.load."""
    file = Path(path)
    return robot_from_table(read_toml(file, "robot file"), where=str(file))


def save_robot(robot: Robot, path: str | PathLike[str], *, overwrite: bool) -> None:
    """Write a robot file; see Robot.save."""
    with new_file(Path(path), overwrite=overwrite) as part:
        part.write_text(robot_text(robot), encoding="utf-8", newline="\n")


def robot_from_table(table: Mapping[str, Any], where: str) -> Robot:
    """Return the robot a TOML table describes; refusals begin with `where` it stands."""
    from cdcr._robot_schema import RobotTable, SectionTable

    refuse(where, complaints(RobotTable, table))
    found: list[str] = []
    for i, section in enumerate(table["sections"]):
        found += complaints(SectionTable, section, f"sections[{i}]")
        if "cable_angles" in section and "cable_angles_deg" in section:
            found.append(f"sections[{i}] must have cable_angles or cable_angles_deg, not both")
    refuse(where, found)

    sections = [_section_fields(section) for section in table["sections"]]
    robot = _defaults(Robot) | {**table, "sections": sections}
    core = _core.Robot(**{**robot, "sections": [_core.Section(**one) for one in sections]})
    refuse(where, core.violations())
    return Robot(**{**robot, "sections": [Section(**one) for one in sections]})


def _section_fields(table: Mapping[str, Any]) -> dict[str, Any]:
    section = _defaults(Section) | dict(table)
    if "cable_angles_deg" in section:
        section["cable_angles"] = [math.radians(a) for a in section.pop("cable_angles_deg")]
    return section


def _defaults(kind: type[Robot | Section]) -> dict[str, Any]:
    return {item.name: item.default for item in fields(kind) if item.default is not MISSING}


def robot_text(robot: Robot) -> str:
    """Return the robot as TOML; repr gives every float the digits it needs to come back exactly."""
    lines = list(_lines(robot, ("gravity", "payload")))
    for section in robot.sections:
        lines += ["", "[[sections]]", *_lines(section, [item.name for item in fields(section)])]
    return _HEAD + "\n" + "\n".join(lines) + "\n"


def _lines(thing: Robot | Section, names: list[str] | tuple[str, ...]) -> Iterator[str]:
    """Yield 'key = value  # about [unit]' with the comments in one column."""
    metadata = {item.name: item.metadata for item in fields(thing)}
    pairs = {name: f"{name} = {_toml_value(getattr(thing, name))}" for name in names}
    short = [len(pair) for pair in pairs.values() if len(pair) <= 40]
    for name, pair in pairs.items():
        about, unit = metadata[name]["about"], metadata[name]["unit"]
        comment = f"{about} [{unit}]" if unit else about
        yield f"{pair:<{max(short, default=0)}}  # {comment}"


def _toml_value(value: object) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(map(_toml_value, value))}]"
    return repr(value)
