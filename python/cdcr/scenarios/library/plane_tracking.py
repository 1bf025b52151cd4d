"""Inverse dynamics within a plane (Fig. 13)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from cdcr.robots import amouri2020
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.tracking import STEP, Sweep

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PLANE = Sweep(theta=0.0, theta_rate=math.pi / 4.0, phi=math.pi / 6.0, phi_rate=0.0)


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.tracking import tracking_figure

    return tracking_figure(scenario.title, PLANE, run, shapes=4)


SCENARIO = Scenario(
    name="plane-tracking",
    title="Bending in a plane: θ = π t/4, φ = π/6",
    description=(
        "The robot bends ever further in the plane at 30 deg to cable 1. The paper gives no end: "
        "after 2.4 s theta passes 3 pi/5, the end of the range of its Taylor factors, so the run "
        "ends there, with tensions of 41.6 N on cable 1 and 20.8 N on cable 2. Fed to the robot "
        "every 0.2 s, they lead it along the same path."
    ),
    source=paper_source("section 5.3 and Fig. 13"),
    paper_figure=13,
    robot=amouri2020(),
    q0=PLANE.start()[0],
    qd0=PLANE.start()[1],
    tension=PLANE.table(STEP),
    t_end=2.4,
    num_samples=481,
    method="dopri5",
    rtol=1e-10,
    atol=1e-12,
    summarize=PLANE.summarize,
    plot=_plot,
)
