"""The picture of an estimate: angles, true and told, and errors of three filters."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures.drawing import legend_below, new_figure, note, share_time
from cdcr.scenarios.studies.estimator import NAMES, error, runs

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (9.0, 6.6)  # [in]
LEAST = 1e-3  # error that is shown [deg]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw coordinates over their estimates, and the errors below."""
    with style():
        figure = new_figure(scenario.title, SIZE)
        angle, off = figure.subplots(2, 1, sharex=True)
        found = runs(scenario, float(run.t[-1]))
        first = found[NAMES[0]]
        for i, color in zip(range(0, 6, 2), COLORS, strict=False):
            t = first.trajectory.t
            angle.plot(t, np.rad2deg(first.trajectory.q[:, i]), color=color)
            angle.plot(t, np.rad2deg(first.told_q[:, i]), color=BLACK, linewidth=1.0, dashes=(4, 3))
        angle.set_ylabel("$q_x$ of each section [deg]")
        note(angle, "dashed: what the controller is told")
        for name, color in zip(NAMES, COLORS, strict=False):
            one, width = found[name], 4.0 if name == NAMES[0] else 1.2  # two are nearly alike
            shown = np.maximum(error(one), LEAST)
            off.semilogy(one.trajectory.t[:-1], shown, color=color, linewidth=width, label=name)
        off.set_ylabel("largest error of a coordinate [deg]")
        share_time(figure, [angle, off], run)
        legend_below(figure, off)
    return figure
