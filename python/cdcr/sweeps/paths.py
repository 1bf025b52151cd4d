"""Numbers of a scenario, found by paths: sections.1.youngs_modulus, gravity.z, tension.1, t_end."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import fields
from functools import cache
from typing import Any

from cdcr.base.check import nearest
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

Table = dict[str, Any]
Place = tuple[Any, Any]  # a table or an array, and a key or an index in it

_AXES = ("x", "y", "z")
_LONG = 64  # entries of an array that no suggestion names
# Tables that say how a run is computed and written, not what runs.
_MEANS = ("integrator", "output")
_EVERY = "*"


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
    found = list(_find(table, words))
    if not found:
        known = list(numbers(table))
        every = list(dict.fromkeys(re.sub(r"\.\d+(?=\.|$)", f".{_EVERY}", one) for one in known))
        guess = nearest(path, [*known, *every])
        told = f"{guess} Known, where {_EVERY} is a number from 1 or all: {', '.join(every)}"
        raise ValueError(f"there is no parameter {path!r}.{told}")
    return found


def _find(thing: Any, words: Sequence[str]) -> Iterator[Place]:
    for key in _keys(thing, words[0]) if words else ():
        if len(words) > 1:
            yield from _find(thing[key], words[1:])
        elif _is_number(thing[key]):
            yield thing, key


def _keys(thing: Any, word: str) -> list[Any]:
    """Return the keys or indices in a table or an array that a word of a path means."""
    if isinstance(thing, dict):
        return [word] if word in thing else []
    if not isinstance(thing, list):
        return []
    if word == _EVERY:
        return list(range(len(thing)))
    if word in _AXES and len(thing) == len(_AXES) and all(map(_is_number, thing)):
        return [_AXES.index(word)]
    is_index = word.isascii() and word.isdigit() and 1 <= int(word) <= len(thing)
    return [int(word) - 1] if is_index else []


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def numbers(table: Table) -> Iterator[str]:
    """Yield the paths of all numbers in the whole table of a scenario; those of the robot first."""
    yield from _paths(table["robot"])
    rest = {key: value for key, value in table.items() if key not in ("robot", *_MEANS)}
    yield from _paths(rest)


def _paths(thing: Any) -> Iterator[str]:
    named = isinstance(thing, dict)
    for key, value in thing.items() if named else enumerate(thing[:_LONG], 1):
        if _is_number(value):
            yield str(key)
        elif isinstance(value, (dict, list)) and len(value) <= _LONG:
            yield from (f"{key}.{rest}" for rest in _paths(value))


def unit(path: str) -> str:
    """Return the unit of the numbers of a path; nothing where it has none, or is not known."""
    words = path.removeprefix("robot.").split(".")
    kinds = {"sections": Section, "cables": Cable}
    kind = kinds.get(words[0], Robot)
    key = words[2 if words[0] in kinds and len(words) > 2 else 0]
    for item in fields(kind):
        if item.name == key:
            return str(item.metadata["unit"])
    named = [word for word in words if word not in (_EVERY, *_AXES) and not word.isdigit()]
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


def put(found: Sequence[Place], value: float) -> None:
    """Write a number at places; a whole one stays whole where it replaces one."""
    for thing, key in found:
        whole = isinstance(thing[key], int) and float(value).is_integer()
        thing[key] = int(value) if whole else float(value)
