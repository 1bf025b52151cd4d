"""The paper's inertia factors: numbers and picture of a pair of them (Figs. 2 to 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cdcr._core import taylor_range
from cdcr.paper import factors
from cdcr.robots import amouri2020
from cdcr.scenarios._findings import Finding
from cdcr.scenarios._paper import source
from cdcr.scenarios._scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

SAME = 1e-9  # relative; closer than this, printed and derived are one


def factor_scenario(
    *, name: str, number: int, pair: tuple[str, str], title: str, description: str, remarks: str
) -> Scenario:
    """Return the scenario of two factors, H1 and H2 say, that the paper has in one figure."""

    def tell(scenario: Scenario, run: None) -> tuple[Finding, ...]:
        return tuple(found for factor in pair for found in _findings(factor))

    def draw(scenario: Scenario, run: None) -> Figure:
        from cdcr.scenarios._factor_figure import factor_figure

        return factor_figure(scenario.title, pair, remarks)

    return Scenario(
        name=name,
        title=title,
        description=description,
        source=source(f"Fig. {number}"),
        paper_figure=number,
        robot=amouri2020(),
        tell=tell,
        draw=draw,
    )


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


def _findings(factor: str) -> tuple[Finding, ...]:
    ends = np.array([0.0, taylor_range])
    found = []
    for kind in kinds(factor):
        word = "derived" if kind == "exact" else "printed"
        start, end = value(factor, ends, kind)
        error = float(taylor_error(factor, ends[1:], kind)[0])
        key = f"{factor}_{word}"
        found += [
            Finding(f"{key}_0", f"{factor}, {word}, at theta = 0", float(start), ""),
            Finding(f"{key}_end", f"{factor}, {word}, at theta = 3 pi/5", float(end), ""),
            Finding(f"{key}_error", f"{factor}, {word}: error of Taylor there", error, "%"),
        ]
    return tuple(found)
