"""Inverse dynamics along a circle (Fig. 12)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from cdcr.robots import amouri2020
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.tracking import STEP, Sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CIRCLE = Sweep(theta=math.pi / 12.0, theta_rate=0.0, phi=0.0, phi_rate=math.pi / 5.0)


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.tracking import tracking_figure

    return tracking_figure(scenario.title, CIRCLE, run, shapes=1)


SCENARIO = Scenario(
    name="circle-tracking",
    title="A circle: θ = π/12, φ = π t/5",
    description=(
        "The tip goes round a circle in 10 s. Inverse dynamics gives the least non-negative "
        "tensions of all three cables, since phi passes through every sector: 4.984 N on cable 1 "
        "at the start, and up to 5.754 N on each at the paper's samples, every 0.2 s. The sampled "
        "tensions, joined by lines, are then fed to the robot: without feedback or damping "
        "it follows the circle to 0.05 deg."
    ),
    source=paper_source("section 5.3 and Fig. 12"),
    paper_figure=12,
    robot=amouri2020(),
    q0=CIRCLE.start()[0],
    qd0=CIRCLE.start()[1],
    tension=CIRCLE.table(STEP),
    t_end=10.0,
    num_samples=1001,
    method="dopri5",
    rtol=1e-10,
    atol=1e-12,
    summarize=CIRCLE.summarize,
    plot=_plot,
)
