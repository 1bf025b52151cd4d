"""The paper's inertia factors: derived, printed and cut (Figs. 2 to 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr._core import taylor_range
from cdcr.base.arrays import FloatArray
from cdcr.paper import factors
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SAME = 1e-9  # relative; closer than this, printed and derived are one

# The two factors of each scenario, and what its picture says of them.
FACTORS = {
    "factors-backbone": (("H1", "H2"), "eqs. (10) to (13) hold"),
    "factors-backbone-rotation": (("H3", "H4"), r"eq. (25): $H_3$ is 1/3, the printed one varies"),
    "factors-disks": (("H5", "H6"), "eqs. (27), (28) print half of what (15) needs"),
    "factors-disks-rotation": (("H7", "H8"), r"eq. (29): $H_7$ is 77/20, the printed one varies"),
}


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


def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    """Return the factors at both ends of the paper's range, and the errors of Taylor there."""
    pair, _ = FACTORS[scenario.name]
    return tuple(found for factor in pair for found in _metrics(factor))


def _metrics(factor: str) -> tuple[Metric, ...]:
    ends = np.array([0.0, taylor_range])
    found = []
    for kind in kinds(factor):
        word = "derived" if kind == "exact" else "printed"
        start, end = value(factor, ends, kind)
        error = float(taylor_error(factor, ends[1:], kind)[0])
        key = f"{factor}_{word}"
        found += [
            Metric(f"{key}_0", f"{factor}, {word}, at theta = 0", float(start), ""),
            Metric(f"{key}_end", f"{factor}, {word}, at theta = 3 pi/5", float(end), ""),
            Metric(f"{key}_error", f"{factor}, {word}: error of Taylor there", error, "%"),
        ]
    return tuple(found)
