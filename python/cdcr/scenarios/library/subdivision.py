"""One section cut into more and more parts: towards the beam it stands for."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.robots import amouri2020
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.subdivision import COUNTS, STEPS, beam, excess, order, responses

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    found = []
    for mode, frequency in enumerate(beam()):
        name = f"mode {mode + 1}"
        found.append(
            Metric(f"beam_{mode + 1}_rad_s", f"{name} of the beam", float(frequency), "rad/s")
        )
        for parts in COUNTS[mode:]:
            percent = 100.0 * float(excess(parts)[mode])
            label = f"{name}: too high with {parts} part{'s' if parts > 1 else ''}"
            found.append(Metric(f"excess_{mode + 1}_of_{parts}", label, percent, "%"))
        found.append(Metric(f"order_{mode + 1}", f"{name}: order of convergence", order(mode), ""))
    finest = responses()[STEPS[-1]]
    for parts, other in responses().items():
        away = 1e3 * float(np.max(np.abs(other.tip - finest.tip)))
        if parts != STEPS[-1]:
            label = f"step: tip of {parts} from that of {STEPS[-1]} parts, at most"
            found.append(Metric(f"step_{parts}_mm", label, away, "mm"))
    return tuple(found)


def _plot(scenario: Scenario, run: None) -> Figure:
    from cdcr.scenarios.figures.subdivision import subdivision_figure

    return subdivision_figure(scenario.title)


SCENARIO = Scenario(
    name="subdivision",
    title="One section cut into parts of constant curvature approaches the beam",
    description=(
        "A section of constant curvature can bend in one way only, so it vibrates 25 % faster "
        "than the beam it stands for, and has no second mode at all. Cut into parts, each of "
        "constant curvature, the robot of Table 1 comes near: two parts are 5 % off, four 1 %. "
        "The beam here is the same robot in the limit of many parts, extrapolated from 16 and 32. "
        "The responses to a step of 5 N on cable 1 are lightly damped."
    ),
    source=paper_source("Table 1") + "; parts, damping and step ours",
    robot=amouri2020(),
    summarize=_summarize,
    plot=_plot,
)
