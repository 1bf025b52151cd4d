"""The picture of two pulled cables: the path of the tip, tensions, and tip over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.plotting import panels
from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures import workspace
from cdcr.scenarios.figures.drawing import name_point, note, share_time
from cdcr.scenarios.studies.two_cables import RESTS, settled

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the tip in space, and over time beside its settled positions."""
    rest = settled(run)
    tips = run.model.tips(rest)
    with style():
        figure = workspace.new_figure(scenario.title)
        _draw_paths(figure, run, tips)
        tension, *tip = workspace.add_panels(figure, [1.0, 1.0, 1.0, 1.0])
        panels.plot_tension(tension, run)
        for k, (axes, name) in enumerate(zip(tip, "xyz", strict=True)):
            axes.plot(run.t, run.tip[:, k], color=COLORS[0], label="moving")
            axes.plot(run.t, tips[:, k], color=BLACK, ls="--", linewidth=1.2, label="settled")
            axes.set_ylabel(f"tip {name} [m]")
            axes.margins(y=0.12)
        panels.legend_above(tip[0])
        note(tension, "chosen by us")
        share_time(figure, [tension, *tip], run)
    return figure


def _draw_paths(figure: StyledFigure, run: Trajectory, settled_tips: FloatArray) -> None:
    """Draw the tip from above, where the swings about the settled path do not hide each other."""
    axes = figure.add_axes((0.07, 0.11, 0.4, 0.76))
    axes.set_aspect("equal", adjustable="datalim")
    axes.plot(*run.tip[:, :2].T, color=COLORS[0], linewidth=0.8, alpha=0.7, label="path of the tip")
    axes.plot(*settled_tips[:, :2].T, color=BLACK, ls="--", label="settled")
    axes.set(xlabel="tip x [m]", ylabel="tip y [m]")
    for name, time in RESTS.items():
        if time <= run.t[-1]:
            x, y, _ = settled_tips[np.searchsorted(run.t, time)]
            axes.plot(x, y, "o", color=BLACK, markersize=5, zorder=5)
            name_point(axes, name, (x, y), (0, 10), ha="center")
    panels.legend_above(axes)
    note(axes, "seen from above")
