"""Bad field values are refused with one clear sentence each."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Collection, Iterable, Mapping, Set
from contextlib import suppress
from dataclasses import fields
from numbers import Integral, Real
from typing import Any, TypeGuard

import numpy as np

from cdcr import _core

MAX_INT = 2**31 - 1  # largest count that the core can be told
MOST_SENTENCES = 20  # of one refusal; of more faults the number is told
_IN_WORDS = {3: "three", 4: "four"}
NO_NUMBERS = (bool, np.bool_, np.timedelta64)  # though Python and NumPy count some among these


def short(value: object) -> str:
    """Return a value as a refusal prints it, in some thirty characters whatever its size."""
    return reprlib.repr(value)


def format_value(value: object) -> str:
    """Return a value as a refusal prints it: short, with its type."""
    return f"{short(value)} ({type(value).__name__})"


def nearest(word: str, known: Iterable[str]) -> str:
    """Return ' Did you mean X?' for the known word most like `word`, or nothing."""
    from difflib import get_close_matches

    close = get_close_matches(word, known, n=1)
    return f" Did you mean {close[0]!r}?" if close else ""


def one_of(value: object, names: Collection[str]) -> bool:
    """Whether a value, of any type at all, is one of some names."""
    return isinstance(value, str) and value in names


def require_kind(item: str, value: object, kind: type) -> None:
    """Refuse what is no instance of a public class: 'model must be a cdcr.Model, got NoneType'."""
    if not isinstance(value, kind):
        raise TypeError(f"{item} must be a cdcr.{kind.__name__}, got {type(value).__name__}")


def require_truth(item: str, value: object) -> None:
    """Refuse what is neither True nor False, of Python or of NumPy: arrays, 1, names."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{item} must be True or False, got {format_value(value)}")


def is_iterable(value: object) -> TypeGuard[Iterable[Any]]:
    """Whether a value can be gone through, which an array without dimensions cannot."""
    return isinstance(value, Iterable) and getattr(value, "ndim", 1) != 0


def as_tuple(item: str, value: object, wanted: str) -> tuple[Any, ...]:
    """Return what can be gone through as a tuple, or refuse what cannot, and text."""
    if is_iterable(value) and not isinstance(value, (str, bytes)):
        return tuple(value)
    raise TypeError(f"{item} must be {wanted}, got {format_value(value)}")


def require_like(item: str, value: object, name: str, *members: str) -> None:
    """Refuse what lacks members of a public class that cannot be seen from here."""
    if not all(hasattr(value, member) for member in members):
        raise TypeError(f"{item} must be a cdcr.{name}, got {type(value).__name__}")


def known_name(noun: str, name: object, known: Collection[str]) -> str:
    """Return the known name that is meant, dashes for underscores or not, or say which these are.

    Raises
    ------
    ValueError
        Where it is none of them.
    """
    if not isinstance(name, str):
        article = "an" if noun[0] in "aeiou" else "a"
        told = f"the name of {article} {noun} must be a string, got {format_value(name)}."
        raise ValueError(f"{told} Known: {', '.join(known)}")
    for one in known:
        if one.replace("_", "-") == name.replace("_", "-"):
            return one
    told = f"there is no {noun} {name!r}.{nearest(name, known)}"
    raise ValueError(f"{told} Known: {', '.join(known)}")


def count(number: int, noun: str) -> str:
    """Return a number with its noun: '1 section', '2 sections'."""
    return f"{number} {noun}" + ("" if number == 1 else "s")


def entry(item: str, i: int) -> str:
    """Name a section or a cable of a robot from 1: 'section 1', 'cable 1 of cables'."""
    return f"{item.removesuffix('s')} {i + 1}" + ("" if item == "sections" else f" of {item}")


class Check:
    """Makes plain Python values of given ones, and keeps a sentence for each it cannot take.

    A stand-in (NaN, 0, nothing) is returned for a refused value, so that all fields of an object
    are looked at before `done` raises.
    """

    def __init__(self) -> None:
        self.sentences: list[str] = []

    def refuse(self, item: str, requirement: str, value: object) -> None:
        """Keep the sentence '`item` must be `requirement`, got `value`'."""
        self.sentences.append(f"{item} must be {requirement}, got {format_value(value)}")

    def number(
        self, item: str, value: object, requirement: str, above: float | None = None
    ) -> float:
        """Return any real number, NumPy scalars included, as a float; no bool, no duration.

        Where it must be `above` a limit, it must be finite too.
        """
        plain = type(value) in (float, int)  # most are, and are told at a tenth of the time
        if plain or (isinstance(value, Real) and not isinstance(value, NO_NUMBERS)):
            with suppress(OverflowError):
                number = float(value)  # type: ignore[arg-type]
                if above is None or above < number < math.inf:
                    return number
        self.refuse(item, requirement, value)
        return math.nan

    def whole(
        self, item: str, value: object, requirement: str, low: int = -MAX_INT, high: int = MAX_INT
    ) -> int:
        """Return any whole number from `low` to `high`, NumPy scalars included, as an int."""
        if isinstance(value, Integral) and not isinstance(value, NO_NUMBERS):
            count = int(value)
            if low <= count <= high:
                return count
            told = str(high) in requirement or " to " in requirement
            if count > high and not told:
                requirement = f"{requirement} and at most {high}"
        self.refuse(item, requirement, value)
        return 0

    def items(self, item: str, value: object, requirement: str) -> tuple[Any, ...]:
        """Return any ordered collection (list, tuple, array of one dimension) as a tuple."""
        unordered = isinstance(value, (str, bytes, bytearray, Mapping, Set))
        if not unordered and isinstance(value, Collection) and getattr(value, "ndim", 1) == 1:
            return tuple(value)
        self.refuse(item, requirement, value)
        return ()

    def numbers(self, item: str, value: object, requirement: str, each: str) -> tuple[float, ...]:
        """Return any sequence of real numbers as a tuple of floats."""
        values = self.items(item, value, requirement)
        return tuple(self.number(f"{item}[{i}]", one, each) for i, one in enumerate(values))

    def vector(
        self, item: str, value: object, requirement: str, each: str, size: int = 3
    ) -> tuple[float, ...]:
        """Return any sequence of so many numbers as a tuple."""
        before = len(self.sentences)
        found = self.numbers(item, value, requirement, each)
        if len(found) != size and len(self.sentences) == before:
            self.refuse(item, requirement, value)
        return found

    def matrix(
        self, item: str, value: object, requirement: str, size: int = 3
    ) -> tuple[tuple[float, ...], ...]:
        """Return so many rows of so many numbers, in sequences or an array, as tuples."""
        rows = list(value) if isinstance(value, np.ndarray) and value.ndim == 2 else value
        before = len(self.sentences)
        row_requirement = f"{_IN_WORDS[size]} numbers"
        found = tuple(
            self.vector(f"{item}[{i}]", row, row_requirement, "a number", size)
            for i, row in enumerate(self.items(item, rows, requirement))
        )
        if len(found) != size and len(self.sentences) == before:
            self.refuse(item, requirement, value)
        return found

    def things(self, item: str, value: object, requirement: str, kind: type) -> tuple[Any, ...]:
        """Return any sequence of things of one kind as a tuple."""
        found = self.items(item, value, requirement)
        for i, thing in enumerate(found):
            if not isinstance(thing, kind):
                self.refuse(entry(item, i), f"a cdcr.{kind.__name__}", thing)
        return found

    def keep(self, description: Any) -> None:
        """Keep every field of a frozen description as plain values, by the kind of its quantity."""
        for item in fields(description):
            plain = self._plain(item.name, getattr(description, item.name), item.metadata)
            object.__setattr__(description, item.name, plain)
        self.done()

    def _plain(self, item: str, value: object, about: Mapping[str, Any]) -> object:
        kind, requirement = about["kind"], about["requirement"]
        if isinstance(kind, type):
            return self.things(item, value, requirement, kind)
        if kind in ("number or none", "whole or none", "order") and value is None:
            return None
        if kind == "order":
            return self.whole(item, value, requirement, 0, _core.max_order)
        if kind in ("whole", "whole or none", "section"):
            return self.whole(item, value, requirement)
        if kind == "numbers":
            return self.numbers(item, value, requirement, about["each"])
        if kind == "vector":
            return self.vector(item, value, requirement, about["each"])
        if kind == "matrix":
            return self.matrix(item, value, requirement)
        if kind == "transform":
            return self.matrix(item, value, requirement, size=4)
        if kind == "pair":
            return self.vector(item, value, requirement, about["each"], size=2)
        if kind in ("number or pair", "route") and not isinstance(value, Real):
            return self._ends(item, value, requirement, about["each"], many=kind == "route")
        return self.number(item, value, requirement)

    def _ends(
        self, item: str, value: object, requirement: str, each: str, *, many: bool
    ) -> tuple[Any, ...]:
        """Return a (base, tip) pair, or `many` of them, of which one may stand by itself."""
        before = len(self.sentences)
        rows = list(value) if many and isinstance(value, np.ndarray) and value.ndim == 2 else value
        values = self.items(item, rows, requirement)
        if len(self.sentences) > before:
            return ()
        if values and all(isinstance(one, Real) for one in values):
            pair = self.vector(item, value, requirement, each, size=2)
            return (pair,) if many and len(pair) == 2 else pair
        if not many or not values:
            self.refuse(item, requirement, value)
            return ()
        return tuple(
            self.vector(f"{item}[{i}]", one, "two numbers, base and tip", each, size=2)
            for i, one in enumerate(values)
        )

    def done(self, violations: Iterable[str] = ()) -> None:
        """Raise a ValueError with all sentences, one a line, where there are any."""
        self.sentences += violations
        if self.sentences:
            told, more = self.sentences[:MOST_SENTENCES], len(self.sentences) - MOST_SENTENCES
            if more > 0:
                told.append(f"and {count(more, 'more value')} must be other than given")
            raise ValueError("\n".join(told))
