"""The paper's inertia factors: derived, printed and cut (Figs. 2 to 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cdcr._core import taylor_range
from cdcr.paper import factors

if TYPE_CHECKING:
    pass

FloatArray = NDArray[np.float64]

SAME = 1e-9  # relative; closer than this, printed and derived are one


def kinds(factor: str) -> tuple[str, ...]:
    """Return the kinds to show: the derived factor, and the printed one where it differs."""
    theta = np.linspace(0.1, taylor_range, 20)
    derived, printed = value(factor, theta, "exact"), value(factor, theta, "printed")
    same = np.allclose(derived, printed, rtol=SAME, atol=0.0)
    return ("exact",) if same else ("exact", "printed")


def value(factor: str, theta: FloatArray, kind: str) -> FloatArray:
    """Return one factor at bending angles [1]."""
    found: FloatArray = np.asarray(getattr(factors(theta, kind), factor))
    return found


def cut(kind: str) -> str:
    """Return the kind that is cut after theta^4."""
    return "taylor" if kind == "exact" else "printed-taylor"


def taylor_error(factor: str, theta: FloatArray, kind: str) -> FloatArray:
    """Return the error of the factor cut after theta^4 [%]."""
    whole = value(factor, theta, kind)
    error: FloatArray = 100.0 * (value(factor, theta, cut(kind)) - whole) / whole
    return error
