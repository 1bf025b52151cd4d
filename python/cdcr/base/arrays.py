"""Arrays of finite numbers, or a sentence that names what is not."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def finite(value: ArrayLike, name: str) -> FloatArray:
    """Return a value as an array, or refuse it by its name."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise ValueError(f"{name} must be numbers, got {value!r}") from None
    if not np.isfinite(array).all():
        raise ValueError(f"{name} must be finite, got {value!r}")
    return array


def read_only(array: FloatArray) -> FloatArray:
    """Return an array after nobody can write to it any more."""
    array.setflags(write=False)
    return array


def even_times(end: float, step: float) -> FloatArray:
    """Return times from 0 to the end [s], as near to that step as they divide it evenly."""
    return np.linspace(0.0, end, max(1, round(end / step)) + 1)
