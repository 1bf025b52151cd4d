"""The picture of three controllers on one circle: their errors, and where the run goes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures.drawing import legend_below, new_figure, note
from cdcr.scenarios.studies.circle_control import errors, path

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (11.0, 5.2)  # [in]
SMALLEST = 1e-8  # error that is drawn [rad]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the errors of all three, and the bending vectors of the run."""
    t, found = errors(float(run.t[-1]))
    with style():
        figure = new_figure(scenario.title, SIZE)
        plane, error = figure.subplots(1, 2, width_ratios=(1.0, 1.7))
        wanted = np.rad2deg([path().evaluate(time)[0] for time in run.t])
        plane.plot(*wanted.T, color=BLACK, linewidth=4.0, alpha=0.25)
        plane.plot(*np.rad2deg(run.q).T, color=COLORS[0], linewidth=1.4)
        plane.set_aspect("equal")
        plane.set(xlabel=r"$q_x$ [deg]", ylabel=r"$q_y$ [deg]")
        note(plane, "wide: asked for; line: computed torque")
        for color, (name, values) in zip(COLORS, found.items(), strict=False):
            error.plot(t, np.maximum(values, SMALLEST), color=color, label=name)
        error.set_yscale("log")
        error.set(xlabel="time [s]", ylabel="error [rad]", xlim=(0.0, t[-1]))
        note(error, "distance from the circle")
        legend_below(figure, error)
    return figure
