"""Classes whose values are given by name, and the sentence for calls that give them otherwise."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Mapping, Sequence
from inspect import Parameter
from typing import Any, TypeVar

from cdcr.base.check import format_value, nearest

Class = TypeVar("Class", bound=type)
_KNOWN: dict[str, dict[str, list[str]]] = {}  # by room, keywords of each class


def by_keyword(cls: Class) -> Class:
    """Let a class, whose `__init__` takes keywords, say which where a call does not fit them."""
    init: Any = cls.__init__  # type: ignore[misc]
    parameters = list(inspect.signature(init).parameters.values())[1:]
    room = _KNOWN.setdefault(cls.__module__.rpartition(".")[0], {})
    room[cls.__name__] = [one.name for one in parameters]

    @functools.wraps(init)
    def wrapped(self: Any, *args: Any, **kwargs: Any) -> None:
        try:
            init(self, *args, **kwargs)
        except TypeError:
            told = _misfit(cls.__name__, room, parameters, args, kwargs)
            if told is None:
                raise
            raise TypeError(told) from None

    cls.__init__ = wrapped  # type: ignore[misc]
    return cls


def _misfit(
    name: str,
    room: Mapping[str, Sequence[str]],
    parameters: Sequence[Parameter],
    args: Sequence[Any],
    kwargs: Mapping[str, Any],
) -> str | None:
    """Return what in a call does not fit the parameters, or None where all does."""
    known = [one.name for one in parameters]
    by_place = [one.name for one in parameters if one.kind is not Parameter.KEYWORD_ONLY]
    needed = [one.name for one in parameters if one.default is Parameter.empty]
    told = f"Known: {', '.join(known)}"
    if len(args) > len(by_place):
        extra = args[len(by_place)]
        example = ", ".join(one if one in by_place else f"{one}=..." for one in needed)
        all_but = f" but {' and '.join(by_place)}" if by_place else ""
        return (
            f"{name} takes all{all_but} by keyword, as in {name}({example}), "
            f"got {format_value(extra)} without one. {told}"
        )
    for one in kwargs:
        if one not in known:
            others = [other for other, theirs in room.items() if one in theirs]
            hint = f" {' and '.join(others)} can have it." if others else nearest(one, known)
            return f"{name} has no keyword {one!r}.{hint} {told}"
    missing = [one for one in needed[len(args) :] if one not in kwargs]
    return f"{name} lacks {', '.join(missing)}" if missing else None
