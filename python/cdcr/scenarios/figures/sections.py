"""What pictures of robots of several sections have in common: the robot beside panels over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from cdcr.base.arrays import FloatArray
from cdcr.plotting import panels, space
from cdcr.plotting.robot3d import RobotArtists, section_colors, show_robot
from cdcr.plotting.style import BLACK, GREY, StyledFigure
from cdcr.scenarios.figures.drawing import legend_over

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory

SIZE = (12.4, 8.0)  # of the picture [in]
ROOM = np.array([5.9, 7.0])  # of the robot in space, left [in]
BEYOND = 0.045  # from a tip to the name of the shape [m]
PLACE = {"left": 0.545, "bottom": 0.075, "top": 0.91, "hspace": 0.42}  # of the panels
SLANTED = 0.3  # a name beside a tip starts or ends there, one above or below is centred


def draw_robot(
    figure: StyledFigure,
    run: Trajectory,
    states: FloatArray,
    names: Sequence[str],
    fading: FloatArray,
    fallen: str = "",
) -> None:
    """Draw the robot at states (M, 2n), each named at its tip, and the path of the tip."""
    axes = space.add_axes(figure)
    model = run.model
    show_robot(axes, model, states, run.tip)
    axes.plot(*run.tip.T, color=GREY, linewidth=0.9, linestyle=":", label="path of the tip")
    for k, (q, alpha) in enumerate(zip(states, fading, strict=True)):
        robot = RobotArtists(axes, model, q, alpha=float(alpha), layer=3.0 + k)
    robot.name_cables()
    space.fill(axes, ROOM)
    if fallen:
        axes.plot(*run.tip[:1].T, "o", color=BLACK, markersize=9, zorder=25, label=f"{fallen}, 0 s")
    for q, name in zip(states, names, strict=True):
        _name_shape(axes, *model.tip(q), name)
    count = len(axes.get_legend_handles_labels()[0])
    legend_over(figure, axes, ROOM, 0.95, ncols=count, handlelength=1.4, columnspacing=1.2)


def _name_shape(axes: Any, R: FloatArray, p: FloatArray, name: str) -> None:
    """Write a name beyond the tip of a shape."""
    paper = space.paper_directions(axes)
    across, _ = away = paper @ R[:, 2] / np.linalg.norm(paper @ R[:, 2])
    side = "center" if abs(across) < SLANTED else "left" if across > 0.0 else "right"
    place = p + BEYOND * away @ paper
    axes.text(*place, name, fontsize=9.5, color=BLACK, ha=side, va="center", zorder=30)


def draw_bending(axes: Axes, run: Trajectory, component: int) -> None:
    """Draw a component of the bending vectors over time."""
    for i, color in enumerate(section_colors(run.model)):
        column = 2 * i + component
        axes.plot(run.t, np.rad2deg(run.q[:, column]), color=color, label=f"section {i + 1}")
    panels.keep_span(axes, panels.MIN_ANGLE)
