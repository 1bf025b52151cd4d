"""Arrays of finite numbers, or a sentence that names what is not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from cdcr import _core
from cdcr._core import finite
from cdcr.base.check import format_value

MAX_SAMPLES = 10_000_000  # about a gigabyte of trajectory

__all__ = [
    "MAX_SAMPLES",
    "FloatArray",
    "check_step",
    "even_times",
    "finite",
    "numbers",
    "read_only",
]

FloatArray = NDArray[np.float64]


def read_only(array: FloatArray) -> FloatArray:
    """Return an array after nobody can write to it any more."""
    array.setflags(write=False)
    return array


def numbers(value: object, told: str) -> FloatArray:
    """Return an array of numbers, NaN and infinite ones too, or refuse what `finite` does.

    Truth values are refused as well; `told` begins the sentence: 'tip must be an array'.
    """
    try:
        array = _core.numbers(value, "it")
    except ValueError:
        raise ValueError(f"{told}, got {format_value(value)}") from None
    if np.asarray(value).dtype.kind == "b":
        raise ValueError(f"{told}, got {format_value(value)}")
    return np.array(array)


class ReadOnlyArrays:
    """A dataclass whose arrays stay read-only in pickles and copies; they hold the fields alone."""

    def __getstate__(self) -> dict[str, object]:
        """Return the fields, without what was worked out from them."""
        return {item.name: getattr(self, item.name) for item in fields(cast("Any", self))}

    def __setstate__(self, state: Mapping[str, object]) -> None:
        """Take the fields, and keep others from writing to the arrays."""
        self.__dict__.update(state)
        for value in state.values():
            if isinstance(value, np.ndarray):
                read_only(value)


def check_step(end: float, step: float) -> None:
    """Refuse a step that makes more samples than a run may have."""
    least = end / MAX_SAMPLES
    if step < least:
        raise ValueError(f"step must be at least {least:g} s in a run of {end:g} s, got {step:g} s")


def even_times(end: float, step: float) -> FloatArray:
    """Return times from 0 to the end [s], as near to that step as they divide it evenly."""
    check_step(end, step)
    return np.linspace(0.0, end, max(1, round(end / step)) + 1)
