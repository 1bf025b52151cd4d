"""A picture with the surface that the tip moves on at the left, and panels over time beside."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from cdcr._core import taylor_range
from cdcr.base.arrays import FloatArray
from cdcr.model.coordinates import bending
from cdcr.model.model import Model
from cdcr.plotting import space
from cdcr.plotting.robot3d import RobotArtists, show_robot
from cdcr.plotting.style import GREY, StyledFigure
from cdcr.scenarios.figures.drawing import legend_over

SIZE = (12.4, 7.2)  # of the picture [in]
ROOM = np.array([6.2, 6.5])  # of the surface, at the left [in]
CALM = 0.16  # opacity of the surface
FAINTEST = 0.35  # opacity of the earliest of several shapes
SHARE = 2.0  # of the surface's edge, over the largest bending angle of the path
LEAST = np.pi / 4.0  # bending angle of the edge [rad]


def new_figure(title: str, size: tuple[float, float] = SIZE) -> StyledFigure:
    """Return an empty figure with its title; draw into it within ``style()``."""
    figure = StyledFigure(figsize=size)
    figure.suptitle(title, x=0.02, y=0.985, ha="left", va="top", fontsize=13)
    return figure


def add_surface(figure: StyledFigure, model: Model, states: FloatArray, largest: float) -> Any:
    """Add Axes3D with the surface of tips well round a path that bends by up to `largest` [rad].

    The robot is drawn at `states` (M, 2) [rad], the earlier the fainter.
    """
    edge = max(largest, LEAST, min(SHARE * largest, taylor_range))
    theta = np.linspace(0.0, edge, 37)
    phi = np.linspace(0.0, 2.0 * np.pi, 49)
    q = bending(*np.meshgrid(theta, phi, indexing="ij")).reshape(-1, 2)
    tips = model.tips(q).reshape(theta.size, phi.size, 3)
    axes = space.add_axes(figure)
    show_robot(axes, model, states, tips.reshape(-1, 3))
    axes.plot_surface(*tips.transpose(2, 0, 1), color=GREY, alpha=CALM, linewidth=0, zorder=0)
    for line in (*tips[::6], *tips[:, ::6].swapaxes(0, 1)):
        axes.plot(*line.T, color=GREY, linewidth=0.5, alpha=0.55, zorder=0.5)
    fading = np.linspace(1.0, FAINTEST, len(states))[::-1]
    for k, (q_k, alpha) in enumerate(zip(states, fading, strict=True)):
        RobotArtists(axes, model, q_k, alpha=alpha, layer=3.0 + k)
    return axes


def finish_surface(figure: StyledFigure, axes: Any) -> None:
    """Give the surface its place, and its legend below it."""
    space.fill(axes, ROOM)
    legend_over(figure, axes, ROOM, 0.945)


def add_panels(figure: StyledFigure, heights: list[float], **place: float) -> list[Axes]:
    """Add panels over time at the right, one above the other; `place` is of their grid."""
    usual = {"left": 0.555, "right": 0.98, "bottom": 0.09, "top": 0.9, "hspace": 0.4}
    grid = figure.add_gridspec(len(heights), 1, height_ratios=heights, **(usual | place))
    return [figure.add_subplot(grid[row]) for row in range(len(heights))]
