"""The picture of three sections driven in turn: shapes, bending and tensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting import panels
from cdcr.plotting.style import BLACK, StyledFigure, style
from cdcr.scenarios.figures.drawing import note, share_time
from cdcr.scenarios.figures.sections import PLACE, SIZE, draw_bending, draw_robot
from cdcr.scenarios.figures.workspace import add_panels, new_figure
from cdcr.scenarios.studies.three_sections import ends, goals

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory
    from cdcr.scenarios.scenario import Scenario


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the robot at the end of each phase, how its sections bend, and its tensions."""
    last = [sample for _, sample in ends(scenario, run)] or [len(run) - 1]
    names = [f"{k + 1} driven" for k in range(len(last))]
    with style():
        figure = new_figure(scenario.title, SIZE)
        states = np.concatenate([[run.q[0]], run.q[last]])
        draw_robot(figure, run, states, ["straight", *names], np.ones(len(states)))
        heights = [1.4, 1.4, *[1.0] * run.model.num_sections]
        bend_x, bend_y, *pulls = charts = add_panels(figure, heights, **PLACE)
        for axes, k, name in ((bend_x, 0, "x"), (bend_y, 1, "y")):
            draw_bending(axes, run, k)
            _draw_goals(axes, scenario, run, k)
            axes.set_ylabel(f"bending to {name} [deg]", fontsize=9.5)
        note(bend_x, "of each section, in the frame of its base; dashed: asked for")
        for i, axes in enumerate(pulls):
            _draw_tensions(axes, run, i)
        share_time(figure, charts, run)
    return figure


def _draw_goals(axes: Axes, scenario: Scenario, run: Trajectory, component: int) -> None:
    """Draw where the section that is driven should come to rest."""
    start, shapes = 0.0, goals(scenario)
    for k, last in ends(scenario, run):
        asked = np.rad2deg(shapes[k, 2 * k + component])
        edges, start = [start, run.t[last]], run.t[last]
        axes.plot(edges, [asked, asked], color=BLACK, linewidth=0.9, dashes=(6, 4))


def _draw_tensions(axes: Axes, run: Trajectory, section: int) -> None:
    """Draw the tensions of the cables that end at a section."""
    model = run.model
    looks = panels.cable_looks(model, len(run))
    for j, cable in enumerate(model.robot.all_cables):
        if cable.end_section == section:
            label = f"cable {j + 1}"
            values = run.tension[:, j]
            axes.plot(run.t, values, label=label, **looks[j])
    axes.set_ylim(-0.05 * run.tension.max(), 1.08 * run.tension.max())
    axes.set_ylabel("tension [N]")
    note(axes, f"cables that end at section {section + 1}")
    panels.legend_above(axes)
