"""The picture of two pulled cables: the path of the tip, tensions, and tip over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.plotting import panels
from cdcr.plotting.geometry import states_at
from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures import workspace
from cdcr.scenarios.figures.drawing import note, share_time
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
    times = [time for time in RESTS.values() if time <= run.t[-1]]
    shown = states_at(run, np.array(times or [run.t[-1]]))
    axes = workspace.add_surface(figure, run.model, shown, float(run.theta.max()))
    axes.plot(*run.tip.T, color=COLORS[0], linewidth=1.0, zorder=20, label="path of the tip")
    axes.plot(*settled_tips.T, color=BLACK, linewidth=1.6, ls="--", zorder=21, label="settled")
    workspace.finish_surface(figure, axes)
