"""What the four scenarios of inertia factors have in common (Figs. 2 to 5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr._core import taylor_range
from cdcr.robots import amouri2020
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.factors import kinds, taylor_error, value

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def factor_scenario(
    *, name: str, number: int, pair: tuple[str, str], title: str, description: str, remarks: str
) -> Scenario:
    """Return the scenario of two factors, H1 and H2 say, that the paper has in one figure."""

    def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
        return tuple(found for factor in pair for found in _metrics(factor))

    def plot(scenario: Scenario, run: None) -> Figure:
        from cdcr.scenarios.figures.factors import factor_figure

        return factor_figure(scenario.title, pair, remarks)

    return Scenario(
        name=name,
        title=title,
        description=description,
        source=paper_source(f"Fig. {number}"),
        paper_figure=number,
        robot=amouri2020(),
        summarize=summarize,
        plot=plot,
    )


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
