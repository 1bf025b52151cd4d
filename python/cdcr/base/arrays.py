"""Arrays of finite numbers, or a sentence that names what is not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def finite(value: ArrayLike, name: str) -> FloatArray:
    """Return a value as an array, or refuse it by its name."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name} must be numbers, got {value!r}") from None
    if not np.isfinite(array).all():
        raise ValueError(f"{name} must be finite, got {value!r}")
    return array


def read_only(array: FloatArray) -> FloatArray:
    """Return an array after nobody can write to it any more."""
    array.setflags(write=False)
    return array


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


def even_times(end: float, step: float) -> FloatArray:
    """Return times from 0 to the end [s], as near to that step as they divide it evenly."""
    return np.linspace(0.0, end, max(1, round(end / step)) + 1)
