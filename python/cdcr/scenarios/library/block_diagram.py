"""How data flow through the library, in place of the paper's Simulink diagram (Fig. 11)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cdcr.robots import amouri2020
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario, paper_source

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    model = scenario.model
    return (
        Metric("num_coordinates", "coordinates q", model.num_coordinates, ""),
        Metric("num_cables", "cables", model.num_cables, ""),
    )


def _plot(scenario: Scenario, run: None) -> Figure:
    from cdcr.scenarios.figures.block_diagram import diagram_figure

    return diagram_figure(scenario.title)


SCENARIO = Scenario(
    name="block-diagram",
    title="How data flow: forward, inverse, and in a loop",
    description=(
        "The paper's Fig. 11 is its Simulink model. In its place, this is the flow of data in this "
        "library: tensions make the robot move (forward dynamics), a motion asks for tensions "
        "(inverse dynamics), and a controller closes the loop."
    ),
    source=paper_source("section 5.3 and Fig. 11") + "; diagram ours",
    paper_figure=11,
    robot=amouri2020(),
    summarize=_summarize,
    plot=_plot,
)
