"""Numbers of a scenario, found by paths: sections.1.youngs_modulus, gravity.z, tension.1, t_end."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import fields
from functools import cache

from cdcr.robot.cable import Cable
from cdcr.robot.numbers import AXES, EVERY, Place, Table, find, paths, refuse_unknown
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

# Tables that say how a run is computed and written, not what runs.
_MEANS = ("integrator", "output")


def places(table: Table, path: str) -> list[Place]:
    """Return where in the whole table of a scenario the numbers of a path stand.

    A path is that of a key in the file, with dots; what begins with a field of the robot stands in
    its table. Entries of arrays count from 1; * is all of them, and x, y, z are those of three.

    Raises
    ------
    ValueError
        Where it leads to no number, with the nearest that does.
    """
    words = path.split(".")
    if words[0] in _MEANS:
        raise ValueError(
            f"parameter {path!r} says how a run is computed, not what runs: set it in the file"
        )
    if words[0] in table["robot"]:
        words = ["robot", *words]
    found = find(table, ".".join(words))
    if not found:
        refuse_unknown(path, list(numbers(table)))
    return found


def numbers(table: Table) -> Iterator[str]:
    """Yield the paths of all numbers in the whole table of a scenario; those of the robot first."""
    yield from paths(table["robot"])
    rest = {key: value for key, value in table.items() if key not in ("robot", *_MEANS)}
    yield from paths(rest)


def unit(path: str) -> str:
    """Return the unit of the numbers of a path; nothing where it has none, or is not known."""
    words = path.removeprefix("robot.").split(".")
    kinds = {"sections": Section, "cables": Cable}
    kind = kinds.get(words[0], Robot)
    key = words[2 if words[0] in kinds and len(words) > 2 else 0]
    for item in fields(kind):
        if item.name == key:
            return str(item.metadata["unit"])
    named = [word for word in words if word not in (EVERY, *AXES) and not word.isdigit()]
    units = _units().get(named[-1], set())
    return next(iter(units)) if len(units) == 1 else ""


@cache
def _units() -> dict[str, set[str]]:
    """Return the units of the keys of scenario files, in all tables that have one."""
    from cdcr.scenarios.file import schema, shape_schema

    found: dict[str, set[str]] = {}
    for table in (*vars(schema).values(), *vars(shape_schema).values()):
        for key, about in getattr(table, "model_fields", {}).items():
            told = re.search(r"\[(.+?)\]", about.description or "")
            found.setdefault(key, set()).update([told[1]] if told else [])
    return found
