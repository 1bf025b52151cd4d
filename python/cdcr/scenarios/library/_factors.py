"""What the four scenarios of inertia factors have in common (Figs. 2 to 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr._core import taylor_range
from cdcr.robots import amouri2020
from cdcr.scenarios.metrics import Finding
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.factors import kinds, taylor_error, value

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def factor_scenario(
    *, name: str, number: int, pair: tuple[str, str], title: str, description: str, remarks: str
) -> Scenario:
    """Return the scenario of two factors, H1 and H2 say, that the paper has in one figure."""

    def tell(scenario: Scenario, run: None) -> tuple[Finding, ...]:
        return tuple(found for factor in pair for found in _findings(factor))

    def draw(scenario: Scenario, run: None) -> Figure:
        from cdcr.scenarios.figures.factors import factor_figure

        return factor_figure(scenario.title, pair, remarks)

    return Scenario(
        name=name,
        title=title,
        description=description,
        source=paper_source(f"Fig. {number}"),
        paper_figure=number,
        robot=amouri2020(),
        tell=tell,
        draw=draw,
    )


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
