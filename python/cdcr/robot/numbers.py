"""Numbers of a description, a table of fields, found by paths: sections.1.youngs_modulus."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from cdcr.base.check import nearest

Table = dict[str, Any]
Place = tuple[Any, Any]  # a table or an array, and a key or an index in it

AXES = ("x", "y", "z")
EVERY = "*"
_LONG = 64  # entries of an array that no suggestion names


def find(table: Table, path: str) -> list[Place]:
    """Return where in a table the numbers of a path stand.

    Words between dots are keys. Entries of arrays count from 1; * is all of them, and x, y, z are
    those of three.
    """
    return list(_find(table, path.split(".")))


def refuse_unknown(path: str, known: Sequence[str]) -> None:
    """Raise a ValueError for a path that leads to no number, with the nearest that does."""
    every = list(dict.fromkeys(re.sub(r"\.\d+(?=\.|$)", f".{EVERY}", one) for one in known))
    guess = nearest(path, [*known, *every])
    told = f"{guess} Known, where {EVERY} is a number from 1 or all: {', '.join(every)}"
    raise ValueError(f"there is no parameter {path!r}.{told}")


def refuse_shared(found: Mapping[str, Sequence[Place]]) -> None:
    """Raise a ValueError where two paths lead to the same number, which has one value."""
    first: dict[tuple[int, Any], str] = {}
    for path, there in found.items():
        for thing, key in there:
            other = first.setdefault((id(thing), key), path)
            if other != path:
                raise ValueError(
                    f"parameters {other!r} and {path!r} lead to the same number: give one of them"
                )


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
    if word == EVERY:
        return list(range(len(thing)))
    if word in AXES and len(thing) == len(AXES) and all(map(_is_number, thing)):
        return [AXES.index(word)]
    is_index = word.isascii() and word.isdigit() and 1 <= int(word) <= len(thing)
    return [int(word) - 1] if is_index else []


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def paths(thing: Any) -> Iterator[str]:
    """Yield the paths of all numbers in a table."""
    named = isinstance(thing, dict)
    for key, value in thing.items() if named else enumerate(thing[:_LONG], 1):
        if _is_number(value):
            yield str(key)
        elif isinstance(value, (dict, list)) and len(value) <= _LONG:
            yield from (f"{key}.{rest}" for rest in paths(value))


def put(found: Sequence[Place], value: float) -> None:
    """Write a number at places; a whole one stays whole where it replaces one."""
    for thing, key in found:
        whole = isinstance(thing[key], int) and float(value).is_integer()
        thing[key] = int(value) if whole else float(value)
