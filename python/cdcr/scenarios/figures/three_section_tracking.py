"""The picture of a tip that goes round a square: its path, its error, the tensions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures.drawing import new_figure, note, share_time

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (11.0, 6.0)  # [in]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the tip from above beside what was asked for, and over time its error and tensions."""
    controller: Any = scenario.controller
    wanted = np.array([controller.path.evaluate(t)[0] for t in run.t])
    with style():
        figure = new_figure(scenario.title, SIZE)
        axes = figure.subplot_mosaic([["plane", "error"], ["plane", "tension"]])
        plane, error, tension = axes["plane"], axes["error"], axes["tension"]
        plane.plot(*(1e3 * wanted[:, :2]).T, color=BLACK, linewidth=4.0, alpha=0.25)
        plane.plot(*(1e3 * run.tip[:, :2]).T, color=COLORS[0], linewidth=1.4)
        plane.set_aspect("equal")
        plane.set(xlabel="x of the tip [mm]", ylabel="y of the tip [mm]")
        note(plane, "wide: asked for; line: the tip, from above")
        error.plot(run.t, 1e3 * controller.errors(run), color=COLORS[0])
        error.set_ylabel("error [mm]")
        tension.plot(run.t, run.tension, linewidth=1.0)
        tension.set_ylabel("tensions [N]")
        share_time(figure, [error, tension], run)
    return figure
