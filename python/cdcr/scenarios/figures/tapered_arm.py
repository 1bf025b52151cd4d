"""The picture of a tapered arm: how it curls, its curvature, and what the orders miss."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.base.arrays import FloatArray
from cdcr.plotting import space
from cdcr.plotting.geometry import robot_shape
from cdcr.plotting.robot3d import RobotArtists, show_robot
from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.scenarios.figures.drawing import legend_over, note
from cdcr.scenarios.figures.workspace import add_panels, new_figure
from cdcr.scenarios.studies import tapered_arm as study

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (12.4, 6.8)  # of the picture [in]
ROOM = np.array([6.0, 6.1])  # of the arm in space, left [in]
WIDTHS = np.linspace(6.0, 3.0, 16)  # of the backbone, base to tip [pt]


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw the arm at several tensions, curvature along it, and errors over the order."""
    with style():
        figure = new_figure(scenario.title, SIZE)
        _draw_arm(figure, scenario)
        place = {"left": 0.58, "hspace": 0.42}
        curvature, errors = add_panels(figure, [1.5, 1.0], **place)
        _draw_curvature(curvature, scenario)
        _draw_errors(errors, scenario)
        figure.align_ylabels([curvature, errors])
    return figure


def _draw_arm(figure: StyledFigure, scenario: Scenario) -> None:
    axes, model = space.add_axes(figure), scenario.model
    shapes = [model.equilibrium([tension]) for tension in (0.0, *study.TENSIONS)]
    show_robot(axes, model, shapes)
    colors = (BLACK, *COLORS)
    for k, (q, color) in enumerate(zip(shapes, colors, strict=False)):
        robot = RobotArtists(axes, model, q, layer=3.0 + k)
        tension = (0.0, *study.TENSIONS)[k]
        robot.backbones[0].set(color=color, label=f"{tension:g} N")
        for piece, width in zip(_pieces(robot_shape(model, q).backbone), WIDTHS, strict=True):
            axes.plot(*piece.T, color=color, linewidth=width, zorder=3.2 + k)
        robot.cables[0].set(color=color)
    space.fill(axes, ROOM)
    legend_over(figure, axes, ROOM, 0.93, ncols=len(shapes))


def _pieces(line: FloatArray) -> list[FloatArray]:
    """Return the pieces of a line (P, 3), one for each width."""
    ends = np.linspace(0, len(line) - 1, len(WIDTHS) + 1).astype(int)
    return [line[start : end + 1] for start, end in pairwise(ends)]


def _draw_curvature(axes: Axes, scenario: Scenario) -> None:
    place = 100.0 * study.X * scenario.robot.length
    for tension, color in zip(study.TENSIONS, COLORS, strict=False):
        found = study.curvature(scenario.model, tension)
        axes.plot(place, found, color=color, label=f"{tension:g} N")
        axes.plot(place, study.closed_form(scenario, tension), color=BLACK, linestyle="--")
    axes.set_xlabel("place along the arm [cm]")
    axes.set_ylabel("curvature [1/m]")
    axes.legend(loc="upper left", title="tension")
    note(axes, r"full: bending of order 4; dashed: $M/(E I)$")


def _draw_errors(axes: Axes, scenario: Scenario) -> None:
    errors = 1e3 * study.tip_errors(scenario)
    axes.plot(study.ORDERS, errors, color=BLACK, marker="o", markersize=5)
    axes.set_yscale("log")
    axes.set_xticks(study.ORDERS)
    axes.set_xlabel("order of bending")
    axes.set_ylabel("tip off by [mm]")
    note(axes, f"{study.TENSIONS[-1]:g} N; order 0 is one arc")
