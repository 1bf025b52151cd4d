"""Bad field values are refused with one clear sentence each."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Collection, Iterable, Mapping, Set
from contextlib import suppress
from difflib import get_close_matches
from numbers import Integral, Real
from typing import Any

_C_INT = 2**31 - 1  # largest count that the core can be told


def shown(value: object) -> str:
    """Return a value as a refusal prints it: short, with its type."""
    return f"{reprlib.repr(value)} ({type(value).__name__})"


def nearest(word: str, known: Iterable[str]) -> str:
    """Return ' Did you mean X?' for the known word most like `word`, or nothing."""
    close = get_close_matches(word, known, n=1)
    return f" Did you mean {close[0]!r}?" if close else ""


class Check:
    """Makes plain Python values of given ones, and keeps a sentence for each it cannot take.

    A stand-in (NaN, 0, nothing) is returned for a refused value, so that all fields of an object
    are looked at before `done` raises.
    """

    def __init__(self) -> None:
        self.sentences: list[str] = []

    def refuse(self, item: str, wanted: str, value: object) -> None:
        """Keep the sentence '`item` must be `wanted`, got `value`'."""
        self.sentences.append(f"{item} must be {wanted}, got {shown(value)}")

    def number(self, item: str, value: object, wanted: str, above: float | None = None) -> float:
        """Return any real number, NumPy scalars included, as a float; a bool is no number.

        Where it must be `above` a limit, it must be finite too.
        """
        if isinstance(value, Real) and not isinstance(value, bool):
            with suppress(OverflowError):
                number = float(value)
                if above is None or above < number < math.inf:
                    return number
        self.refuse(item, wanted, value)
        return math.nan

    def whole(
        self, item: str, value: object, wanted: str, low: int = -_C_INT, high: int = _C_INT
    ) -> int:
        """Return any whole number from `low` to `high`, NumPy scalars included, as an int."""
        if isinstance(value, Integral) and not isinstance(value, bool):
            count = int(value)
            if low <= count <= high:
                return count
        self.refuse(item, wanted, value)
        return 0

    def items(self, item: str, value: object, wanted: str) -> tuple[Any, ...]:
        """Return any ordered collection (list, tuple, array of one dimension) as a tuple."""
        unordered = isinstance(value, (str, bytes, bytearray, Mapping, Set))
        if not unordered and isinstance(value, Collection) and getattr(value, "ndim", 1) == 1:
            return tuple(value)
        self.refuse(item, wanted, value)
        return ()

    def numbers(self, item: str, value: object, wanted: str, each: str) -> tuple[float, ...]:
        """Return any sequence of real numbers as a tuple of floats."""
        values = self.items(item, value, wanted)
        return tuple(self.number(f"{item}[{i}]", one, each) for i, one in enumerate(values))

    def done(self, violations: Iterable[str] = ()) -> None:
        """Raise a ValueError with all sentences, one a line, where there are any."""
        self.sentences += violations
        if self.sentences:
            raise ValueError("\n".join(self.sentences))
