"""The picture of a run: the robot in space beside its angles and tensions over time."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.base.arrays import FloatArray
from cdcr.plotting import panels, plot_run_robot, space
from cdcr.plotting.legend import FittingLegend, legend_of
from cdcr.plotting.style import BLACK, StyledFigure, line_colors, style
from cdcr.scenarios.figures.drawing import note, share_time
from cdcr.scenarios.figures.workspace import add_panels, new_figure
from cdcr.scenarios.metrics import static_theta, swing_times

if TYPE_CHECKING:
    from cdcr.model.wrench import Wrench
    from cdcr.runs.trajectory import Trajectory
    from cdcr.scenarios.scenario import Scenario

SIZE = (12.4, 6.8)  # of the picture [in]
ROBOT_ROOM = np.array([4.3, 6.4])  # of the robot in space, left [in]
MIN_SPAN = 10.0  # of the orientation angle, so that rounding noise fills no panel [deg]
NUM_SHAPES = 5  # of the robot in space
STILL = 0.01  # orientation angles that move less need no panel [deg]


def run_figure(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the robot at several times of a run, its angles and its tensions."""
    times = swing_times(run, NUM_SHAPES)
    with style():
        figure = new_figure(scenario.title, SIZE)
        _draw_robot(figure, run, times)
        _draw_panels(figure, run, scenario.wrenches)
    return figure


def _draw_robot(figure: StyledFigure, run: Trajectory, times: FloatArray) -> None:
    axes = space.add_axes(figure)
    plot_run_robot(run, times, ax=axes)
    space.fill(axes, ROBOT_ROOM)
    beside = (ROBOT_ROOM[0] / SIZE[0], 0.5)
    look = {"loc": "center left", "bbox_to_anchor": beside, "handlelength": 1.4}
    FittingLegend(figure, partial(legend_of, figure, axes, **look), ncols=1)


def _draw_panels(figure: StyledFigure, run: Trajectory, wrenches: Sequence[Wrench]) -> None:
    turns = bool(np.any(np.ptp(np.rad2deg(run.phi), axis=0) > STILL))
    strains = panels.strain_panels(run.model)
    plots = [panels.plot_theta, *[_plot_phi] * turns, *strains, panels.plot_tension]
    heights = [2.0, *[1.0] * (turns + len(strains)), 1.0]
    charts = add_panels(figure, heights, left=0.525, top=0.91, hspace=0.35)
    for axes, plot in zip(charts, plots, strict=True):
        plot(axes, run)
        if plot is panels.plot_theta:
            _mark_rest(axes, static_theta(run, wrenches))
    if not turns and run.model.num_sections == 1 and run.model.num_cables <= panels.ROOMY:
        note(charts[-1], rf"$\varphi$ stays {np.rad2deg(run.phi[0, 0]):.4g} deg")
    share_time(figure, charts, run)


def _mark_rest(axes: Axes, rest: FloatArray | None) -> None:
    """Draw the bending angles of rest (n,) [deg], where there are some."""
    if rest is None:
        return
    for angle, color in zip(rest, line_colors(len(rest)), strict=True):
        axes.axhline(angle, color=BLACK if len(rest) == 1 else color, dashes=(6, 4), linewidth=1)
    angles = ", ".join(f"{angle:.2f}" for angle in rest)
    told = f"dashed: static equilibrium, {angles} deg" if len(rest) == 1 else "dashed: at rest"
    axes.set_title(told, loc="left", fontsize=9.5)


def _plot_phi(axes: Axes, run: Trajectory) -> None:
    phi = panels.shown_phi(run)
    for i, color in enumerate(line_colors(run.model.num_sections)):
        axes.plot(run.t, phi[:, i], color=color)
    axes.set_ylabel(r"orientation $\varphi$ [deg]")
    panels.keep_span(axes, MIN_SPAN)
