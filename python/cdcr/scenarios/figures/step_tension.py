"""The picture of a step of tension: that of every run, and where the paper's robot settles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cdcr.plotting.style import ALARM, StyledFigure
from cdcr.scenarios.figures.drawing import note
from cdcr.scenarios.figures.run import run_figure

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory
    from cdcr.scenarios.scenario import Scenario

PAPER_THETA = 15.53  # where the paper's robot settles [deg]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the run, and the bending angle of the paper's robot."""
    figure = run_figure(scenario, run)
    _, theta, *_ = figure.axes
    theta.axhline(PAPER_THETA, color=ALARM, linewidth=1.3, linestyle=":")
    told = theta.get_title(loc="left")
    note(theta, f"{told}; dotted: the paper's {PAPER_THETA} deg")
    return figure
