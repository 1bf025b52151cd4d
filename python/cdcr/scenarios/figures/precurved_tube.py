"""The picture of a tube that is curved at rest: shapes, its angle, and what moves its tip."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting import space
from cdcr.plotting.robot3d import RobotArtists, show_robot
from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.scenarios.figures.drawing import legend_over, note
from cdcr.scenarios.figures.workspace import add_panels, new_figure
from cdcr.scenarios.studies import precurved_tube as study

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (12.4, 6.8)  # of the picture [in]
ROOM = np.array([6.0, 6.1])  # of the tube in space, left [in]
VIEW = {"elev": 28.0, "azim": -42.0}  # shows what is out of the plane [deg]


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw the tube at rest, straightened and loaded, and both over what does it."""
    with style():
        figure = new_figure(scenario.title, SIZE)
        _draw_tube(figure, scenario)
        theta, moved = add_panels(figure, [1.0, 1.3], left=0.58, hspace=0.42)
        _draw_angle(theta, scenario)
        _draw_loaded(moved, scenario)
        figure.align_ylabels([theta, moved])
    return figure


def _draw_tube(figure: StyledFigure, scenario: Scenario) -> None:
    axes, model = space.add_axes(figure), scenario.model
    axes.view_init(**VIEW)
    shapes = {
        "at rest": model.rest_shape,
        f"{study.TENSIONS[-1]:g} N on the cable": study.straightened(scenario)[-1],
        f"{study.LOADS[-1]:g} N on the tip": study.loaded(scenario)[-1],
    }
    show_robot(axes, model, shapes.values())
    for k, ((name, q), color) in enumerate(
        zip(shapes.items(), (BLACK, COLORS[0], COLORS[1]), strict=True)
    ):
        robot = RobotArtists(axes, model, q, layer=3.0 + k)
        robot.backbones[0].set(color=color, label=name)
        for line in (*robot.cables, *robot.marks):
            line.set(color=color, linewidth=1.0)
    space.fill(axes, ROOM)
    legend_over(figure, axes, ROOM, 0.93, ncols=3)


def _draw_angle(axes: Axes, scenario: Scenario) -> None:
    angles = np.rad2deg(study.straightened(scenario)[:, 0])
    axes.plot(study.TENSIONS, angles, color=COLORS[0], marker="o", markersize=5)
    axes.set_xlabel("tension of the cable [N]")
    axes.set_ylabel(r"bending angle $\theta$ [deg]")
    axes.set_ylim(bottom=0.0)


def _draw_loaded(axes: Axes, scenario: Scenario) -> None:
    shapes = study.loaded(scenario)
    column = scenario.model.coordinate_names.index("t1")
    moved = 1e3 * scenario.model.tips(shapes)[:, 1]
    axes.plot(study.LOADS, moved, color=COLORS[1], marker="^", markersize=5, label="tip moved [mm]")
    exact = 1e3 * study.timoshenko(scenario) * study.LOADS
    axes.plot(study.LOADS, exact, color=BLACK, linestyle="--", label="Timoshenko [mm]")
    twist = np.rad2deg(shapes[:, column])
    axes.plot(study.LOADS, twist, color=COLORS[2], marker="s", markersize=5, label="twist [deg]")
    axes.set_xlabel("force on the tip, out of the plane [N]")
    axes.set_ylabel("displacement [mm], twist [deg]")
    axes.legend(loc="upper left")
    note(axes, "Timoshenko: small displacements")
