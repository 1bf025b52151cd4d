"""Robots as tables and lists of plain numbers, which can be changed, and back."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from cdcr import _core
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

_PARTS: dict[str, Any] = {"sections": _core.Section, "cables": _core.Cable}


def plain_robot(robot: Robot) -> dict[str, Any]:
    """Return the fields of a robot as tables and lists of numbers, which can be changed."""
    return {item.name: _as_lists(getattr(robot, item.name)) for item in fields(robot)}


def core_robot(table: dict[str, Any]) -> _core.Robot:
    """Return the robot that such a table describes, as the core has it."""
    parts = {name: [kind(**one) for one in table[name]] for name, kind in _PARTS.items()}
    return _core.Robot(**table | parts)


def _as_lists(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_as_lists(one) for one in value]
    if isinstance(value, (Section, Cable)):
        return {item.name: _as_lists(getattr(value, item.name)) for item in fields(value)}
    return value
