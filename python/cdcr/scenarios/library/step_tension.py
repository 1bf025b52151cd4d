"""The paper's first forward dynamic response (Fig. 9)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cdcr.robots import amouri2020
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.scenario import Scenario, paper_source

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAPER_THETA = 15.53  # where the paper's robot settles [deg]


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.plotting.style import ALARM
    from cdcr.scenarios.figures.run import run_figure

    figure = run_figure(scenario, run)
    _, theta, *_ = figure.axes
    theta.axhline(PAPER_THETA, color=ALARM, linewidth=1.3, linestyle=":")
    told = theta.get_title(loc="left")
    theta.set_title(f"{told}; dotted: the paper's {PAPER_THETA} deg", loc="left", fontsize=9.5)
    return figure


SCENARIO = Scenario(
    name="step-tension",
    title="5 N on cable 1 of the straight robot at rest",
    description=(
        "The robot of Table 1 stands straight and at rest; from t = 0 on, cable 1 pulls with 5 N. "
        "The equations of the paper have no damping, so the robot swings about its static "
        "equilibrium of 14.98 deg for ever, between straight and twice that angle. In the paper's "
        "Fig. 9 it settles, at 15.53 deg, which these equations cannot give. phi stays 0."
    ),
    source=paper_source("section 5.2 and Fig. 9"),
    paper_figure=9,
    robot=amouri2020(),
    q0=(0.0, 0.0),
    qd0=(0.0, 0.0),
    tension=(5.0, 0.0, 0.0),
    t_end=10.0,
    num_samples=1001,
    plot=_plot,
)
