"""The paper's PID loop (Fig. 14)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cdcr.robots import amouri2020
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.pid import RECOMMENDED, summarize

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.pid import pid_figure

    return pid_figure(scenario.title, run)


SCENARIO = Scenario(
    name="pid",
    title="A PID loop brings the robot to 15.53 deg: three readings of its gains",
    description=(
        "The straight robot is to bend to 15.53 deg, the result of the paper's Fig. 9, by cable 1 "
        "alone. The paper gives Kp = 2.8, KI = 0.004 and KD = 0.38 without units. With the error "
        "in rad and a tension as output it reaches 2 deg; with the error in degrees 13.9 deg and "
        "with a moment as output 13.8 deg, both after an instant in which the cable would have to "
        "push. Recommended: the error in degrees, the static tension fed forward, and no tension "
        "below zero: 15.53 deg within half a second. That loop is the run whose data are written."
    ),
    source=paper_source("section 5.4 and Fig. 14"),
    paper_figure=14,
    robot=amouri2020(),
    q0=(0.0, 0.0),
    qd0=(0.0, 0.0),
    controller=RECOMMENDED.controller,
    t_end=20.0,
    num_samples=2001,
    method="dopri5",
    rtol=1e-9,
    summarize=summarize,
    plot=_plot,
)
