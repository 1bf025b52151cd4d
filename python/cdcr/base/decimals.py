"""Numbers as people write them in files and on command lines: decimal, in ASCII digits."""

from __future__ import annotations

import math
import re

_NUMBER = re.compile(r"[ \t]*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?[ \t]*")
_WHOLE = re.compile(r"[ \t]*[+-]?[0-9]{1,1000}[ \t]*")  # Python reads some 4000 digits at most
_EXACT = 2**53  # up to there every whole number is one of double precision


def number(text: str) -> float:
    """Return the number that a text holds, NaN where it holds none, infinite where too large."""
    return float(text) if _NUMBER.fullmatch(text) else math.nan


def whole(text: str) -> int | None:
    """Return the whole number that a text holds, as 1e6 too, None where it holds none."""
    if _WHOLE.fullmatch(text):
        return int(text)
    value = number(text)
    return int(value) if abs(value) < _EXACT and value.is_integer() else None
