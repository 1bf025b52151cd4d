"""The JSON schema of robot files, from the fields of the descriptions."""

from __future__ import annotations

import re
from dataclasses import MISSING, Field, fields
from typing import Any

from cdcr.files.json_schema import Schema, document, one_of_keys, table_schema
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.schema import table_of
from cdcr.robot.section import Section

_BOUNDS = {">": "exclusiveMinimum", ">=": "minimum"}


def robot_file_schema() -> Schema:
    """Return what a robot file may hold, as JSON schema."""
    return document("A cable-driven continuum robot (cdcr)", robot_schema())


def robot_schema() -> Schema:
    """Return what the table of a robot may hold, as JSON schema."""
    sections = {"type": "array", "items": section_schema(), "minItems": 1, "maxItems": 32}
    cables = {"type": "array", "items": _cable_schema(), "maxItems": 64}
    robot = table_schema(table_of(Robot), sections=sections, cables=cables)
    return _with_limits(robot, Robot)


def changes_schema() -> Schema:
    """Return what changes a robot that is known by name may hold."""
    return _with_limits(table_schema(table_of(Robot, partial=True)), Robot)


def section_schema(*, partial: bool = False) -> Schema:
    """Return what the table of a section may hold, or of changes to one."""
    section = _with_limits(table_schema(table_of(Section, partial=partial)), Section)
    return section | one_of_keys(("cable_angles", "cable_angles_deg"))


def _cable_schema() -> Schema:
    cable = _with_limits(table_schema(table_of(Cable)), Cable)
    angles = ({"required": ["angle"]}, {"required": ["angle_deg"]})
    return cable | {"oneOf": list(angles)}


def _with_limits(schema: Schema, kind: type[Any]) -> Schema:
    """Add ranges and defaults, which the library knows and the types of the keys do not."""
    for item in fields(kind):
        for suffix in ("", "_deg"):
            key = schema["properties"].get(f"{item.name}{suffix}")
            if key is not None:
                key |= _limits(item)
                if item.default == 0 and "exclusiveMinimum" in key:  # it stands for none
                    key["minimum"] = key.pop("exclusiveMinimum")
                if item.default is not MISSING and item.default is not None and not suffix:
                    counted_from_1 = item.metadata["kind"] == "section"
                    key["default"] = item.default + 1 if counted_from_1 else item.default
    return schema


def _limits(item: Field[Any]) -> Schema:
    requirement, each = item.metadata["requirement"], item.metadata["each"]
    if span := re.match(r"a whole number (\d+) to (\d+)", requirement):
        return {"minimum": int(span[1]), "maximum": int(span[2])}
    if span := re.match(r"a sequence of (\d+) to (\d+) numbers", requirement):
        items = {"type": "number"} | _bound(each)
        return {"items": items, "minItems": int(span[1]), "maxItems": int(span[2])}
    return _bound(requirement)


def _bound(requirement: str) -> Schema:
    """Return the bounds of a number that must be so."""
    if span := re.match(r"a number (>=?) 0\b", requirement):
        return {_BOUNDS[span[1]]: 0}
    return {"minimum": 0, "maximum": 1} if requirement.startswith("a number 0 to 1") else {}
