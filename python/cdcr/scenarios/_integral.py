"""Integrals of sampled signals."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def integral(y: NDArray[np.float64], x: NDArray[np.float64]) -> Any:
    """Return the integral of samples y (N, ...) over x (N, ...) by the trapezoidal rule."""
    return 0.5 * np.sum((y[1:] + y[:-1]) * np.diff(x, axis=0), axis=0)
