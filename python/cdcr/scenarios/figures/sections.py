"""What pictures of robots of several sections have in common: the robot beside panels over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.text import Text
from mpl_toolkits.mplot3d import proj3d  # type: ignore[import-untyped]

from cdcr.base.arrays import FloatArray
from cdcr.plotting import panels, space
from cdcr.plotting.geometry import robot_shape
from cdcr.plotting.robot3d import RobotArtists, section_colors, show_robot
from cdcr.plotting.style import BLACK, GREY, StyledFigure
from cdcr.scenarios.figures.drawing import legend_over

if TYPE_CHECKING:
    from cdcr.model.model import Model
    from cdcr.runs.trajectory import Trajectory

SIZE = (12.4, 8.0)  # of the picture [in]
ROOM = np.array([5.9, 7.0])  # of the robot in space, left [in]
PLACE = {"left": 0.545, "bottom": 0.075, "top": 0.91, "hspace": 0.42}  # of the panels
DISTANCES = (12.0, 18.0, 26.0, 36.0, 48.0)  # from a tip to the middle of its name, tried [pt]
ENOUGH = 7.0  # room that a name needs [pt]
AWAY = ((0.0, -1.0), (0.7, -0.7), (1.0, 0.0))  # from the axes x, y, z to their numbers
NUMBERS = (8.0, 16.0, 24.0, 32.0)  # how far these reach [pt]
# Points of a box, in its half sizes from the middle.
GRID = np.stack(np.meshgrid([-1, -0.5, 0, 0.5, 1], [-1, 0, 1]), axis=-1).reshape(-1, 2)


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
    name_shapes(axes, model, states, names, run.tip)
    count = len(axes.get_legend_handles_labels()[0])
    legend_over(figure, axes, ROOM, 0.95, ncols=count, handlelength=1.4, columnspacing=1.2)


def name_shapes(
    axes: Any, model: Model, states: FloatArray, names: Sequence[str], *paths: FloatArray
) -> None:
    """Write names near the tips of shapes, each where it has most room, with a line to its tip.

    Kept clear of are the shapes, the paths (M, 3), the axes with their numbers, and the other
    names. Axes3D must have its place in the figure; where that changes, places are found anew.
    """
    drawn = [robot_shape(model, q).points for q in states] + [_dense(path) for path in paths]
    drawn.append(_box(axes))
    tips = [model.tip(q)[1] for q, name in zip(states, names, strict=True) if name]
    texts = [_text_at(axes, tip, name) for tip, name in zip(tips, filter(None, names), strict=True)]

    def arrange() -> None:
        axes.apply_aspect()
        taken = np.concatenate([_on_paper(axes, np.concatenate(drawn)), _numbers(axes)])
        for text, point in zip(texts, tips, strict=True):
            tip = _on_paper(axes, point[None])[0]
            half = _half_size(text)
            offset = max(
                (distance * np.array([np.cos(turn), np.sin(turn)]) * (1.0 + half / half.sum())
                 for distance in DISTANCES for turn in np.linspace(0.0, 2.0 * np.pi, 24, False)),
                key=lambda offset: _room(tip + offset, half, taken) - 0.15 * np.hypot(*offset),
            )  # fmt: skip
            text.set_position(tuple(offset))
            taken = np.concatenate([taken, tip + offset + half * GRID])

    arrange()
    axes.figure.arrangements.append(arrange)


def _text_at(axes: Any, tip: FloatArray, name: str) -> Any:
    return axes.annotate(
        name,
        proj_xy(axes, tip),
        fontsize=9.5,
        color=BLACK,
        zorder=30,
        ha="center",
        va="center",
        xytext=(0, 0),
        textcoords="offset points",
        arrowprops={"arrowstyle": "-", "color": GREY, "linewidth": 0.7, "shrinkA": 1},
    )


def _on_paper(axes: Any, points: FloatArray) -> FloatArray:
    """Return where points (P, 3) are on the paper (P, 2) [pt]."""
    x, y, _ = proj3d.proj_transform(*points.T, axes.get_proj())
    pixels = axes.transData.transform(np.stack([x, y], axis=1))
    return np.asarray(pixels * 72.0 / axes.figure.dpi)


def _half_size(text: Any) -> FloatArray:
    """Return half the width and height of a text on the paper [pt]."""
    extent = Text.get_window_extent(text)  # without the line to its tip
    return np.array([extent.width, extent.height]) * 36.0 / float(text.figure.dpi)


def _numbers(axes: Any) -> FloatArray:
    """Return points (P, 2) where the numbers along the axes are, on the paper [pt]."""
    lines = np.split(_on_paper(axes, _box(axes)), 3)
    return np.concatenate(
        [
            line + distance * np.array(away)
            for line, away in zip(lines, AWAY, strict=True)
            for distance in NUMBERS
        ]
    )


def _room(center: FloatArray, half: FloatArray, taken: FloatArray) -> float:
    """Return how far points (P, 2) stay from a box of half sizes, at most ENOUGH [pt]."""
    away = np.maximum(np.abs(taken - center) - half, 0.0)
    return min(ENOUGH, float(np.hypot(*away.T).min()))


def _dense(path: FloatArray) -> FloatArray:
    """Return a path (M, 3) with points along its pieces too."""
    return np.concatenate([path[:-1] + s * np.diff(path, axis=0) for s in (0.0, 0.5)])


def _box(axes: Any) -> FloatArray:
    """Return points (P, 3) along the axes that carry numbers."""
    s = np.linspace(0.0, 1.0, 60)
    (x0, x1), (y0, y1), (z0, z1) = axes.get_xlim(), axes.get_ylim(), axes.get_zlim()
    one = np.ones_like(s)
    return np.concatenate([
        np.stack([x0 + (x1 - x0) * s, y0 * one, z0 * one], axis=1),
        np.stack([x1 * one, y0 + (y1 - y0) * s, z0 * one], axis=1),
        np.stack([x1 * one, y1 * one, z0 + (z1 - z0) * s], axis=1),
    ])  # fmt: skip


def proj_xy(axes: Any, point: FloatArray) -> tuple[float, float]:
    """Return where Axes3D draws a point (3,), in its flat data coordinates."""
    x, y, _ = proj3d.proj_transform(*point, axes.get_proj())
    return float(x), float(y)


def draw_bending(axes: Axes, run: Trajectory, component: int) -> None:
    """Draw a component of the bending vectors over time."""
    for i, color in enumerate(section_colors(run.model)):
        column = 2 * i + component
        axes.plot(run.t, np.rad2deg(run.q[:, column]), color=color, label=f"section {i + 1}")
    panels.keep_span(axes, panels.MIN_ANGLE)
