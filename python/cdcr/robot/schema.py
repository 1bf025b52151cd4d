"""What a robot file may hold: keys and types, from the fields of the descriptions.

Ranges are checked by the C++ library.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import MISSING, Field, fields
from functools import cache
from typing import Annotated, Any, Literal

import pydantic

from cdcr import _core

_Int = Annotated[int, pydantic.Field(ge=-(2**31), lt=2**31)]  # what the core can be told
_Three = Annotated[list[float], pydantic.Field(min_length=3, max_length=3)]
_Rows = Annotated[list[_Three], pydantic.Field(min_length=3, max_length=3)]
_Four = Annotated[list[float], pydantic.Field(min_length=4, max_length=4)]
_FourRows = Annotated[list[_Four], pydantic.Field(min_length=4, max_length=4)]
_Pair = Annotated[list[float], pydantic.Field(min_length=2, max_length=2)]
_TYPES: dict[str, Any] = {
    "number": float,
    "number or none": float,
    "whole": _Int,
    "order": Annotated[int, pydantic.Field(ge=0, le=_core.max_order)] | Literal["locked"],
    "whole or none": _Int,
    "number or pair": float | _Pair,
    "pair": _Pair,
    "route": float | Annotated[list[_Pair], pydantic.Field(min_length=1)] | _Pair,
    "section": Annotated[_Int, pydantic.Field(ge=1)],
    "numbers": list[float],
    "vector": _Three,
    "matrix": _Rows,
    "transform": _FourRows,
}
_ARRAYS = {
    "pair": "2 numbers",
    "vector": "3 numbers",
    "matrix": "3 rows of 3 numbers",
    "transform": "4 rows of 4 numbers",
}


@cache
def table_of(kind: type[Any], *, partial: bool = False) -> type[pydantic.BaseModel]:
    """Return what the table of a Robot, a Section or a Cable may hold.

    A key may be left out where the field has a default, which then holds; every key of a `partial`
    table, which changes what there is, and has no tables of sections and cables in it. Angles may
    be in degrees, under keys that say so.
    """
    keys = {key: value for item in fields(kind) for key, value in _keys(item, partial)}
    config = pydantic.ConfigDict(extra="forbid", strict=True)
    return pydantic.create_model(f"{kind.__name__}Table", __config__=config, **keys)


def _keys(item: Field[Any], partial: bool) -> Iterator[tuple[str, Any]]:
    kind, unit = item.metadata["kind"], item.metadata["unit"]
    given = ... if item.default is MISSING and unit != "rad" and not partial else None
    if isinstance(kind, type):
        if partial:
            return
        table = f"one [[{item.name}]] table for each {item.name.removesuffix('s')}"
        about = pydantic.Field(given, description=table, title=_about(item))
        yield item.name, (list[Any], about)
        return
    for suffix, name in (("", unit), ("_deg", "deg")) if unit == "rad" else (("", unit),):
        about = pydantic.Field(given, description=_requirement(item, name), title=_about(item))
        yield f"{item.name}{suffix}", (_TYPES[kind], about)


def _about(item: Field[Any]) -> str:
    return f"{item.name.replace('_', ' ')}, {item.metadata['about']}"


def _requirement(item: Field[Any], unit: str) -> str:
    """Return what a value must be, in the words of TOML."""
    if item.metadata["kind"] in _ARRAYS:
        return f"an array of {_ARRAYS[item.metadata['kind']]}" + (f" [{unit}]" if unit else "")
    if item.metadata["kind"] == "section":
        return "the number of a section, from 1"
    words = str(item.metadata["requirement"]).removesuffix(", or None")
    words = words.replace("None to lock it", '"locked"').replace("(base, tip)", "[base, tip]")
    # "numbers in kg" and "a number of rad" are "numbers [kg]" and "a number [rad]" there.
    return re.sub(r"(numbers?) (in|of) [^\s,]+(?=,|$)", rf"\1 [{unit}]", words).replace(
        "a sequence", "an array"
    )
