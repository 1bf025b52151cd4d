"""What the pictures of scenarios have in common."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cdcr._core import taylor_range
from cdcr.base.arrays import FloatArray
from cdcr.plotting import panels
from cdcr.plotting.legend import FittingLegend, legend_of
from cdcr.plotting.style import StyledFigure

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory

RANGE_DEG = float(np.rad2deg(taylor_range))
NUM_ANGLES = 302  # even, so that none is zero, where some factors vanish


def bending_angles() -> Any:
    """Return bending angles (302,) over the paper's range, without zero [rad]."""
    return np.linspace(-taylor_range, taylor_range, NUM_ANGLES)


def new_figure(title: str, size: tuple[float, float]) -> StyledFigure:
    """Return an empty figure with its title; draw into it within ``style()``."""
    figure = StyledFigure(figsize=size, layout="constrained")
    figure.suptitle(title, x=0.012, ha="left", fontsize=13)
    return figure


def show_angle(axes: Axes, *, named: bool = True) -> None:
    """Let the paper's range of theta fill the horizontal axis [deg]."""
    axes.set_xlim(-RANGE_DEG, RANGE_DEG)
    axes.set_xticks(np.arange(-90, 91, 45))
    axes.tick_params(labelbottom=named)
    if named:
        axes.set_xlabel(r"bending angle $\theta$ [deg]")


def legend_below(figure: StyledFigure, axes: Axes, ncols: int = 4) -> None:
    """Put the legend of one panel under the whole figure."""
    handles, labels = axes.get_legend_handles_labels()
    look = {"loc": "outside lower center", "handlelength": 2.6}
    FittingLegend(figure, partial(figure.legend, handles, labels, **look), ncols)


def legend_over(
    figure: StyledFigure, axes: Any, room: FloatArray, height: float, *, ncols: int = 2, **look: Any
) -> None:
    """Put the legend of Axes3D over the middle of its room [in], at a share of the height."""
    share = room[0] / figure.get_figwidth()
    look |= {"loc": "upper center", "bbox_to_anchor": (share / 2.0, height)}
    FittingLegend(figure, partial(legend_of, figure, axes, **look), ncols, share)


def share_time(figure: Figure, charts: Sequence[Axes], run: Trajectory) -> None:
    """Give panels, one above the other, one axis of time."""
    for axes in charts:
        panels.show_time(axes, run, named=axes is charts[-1])
    figure.align_ylabels(charts)


def name_point(
    axes: Axes, text: str, point: tuple[float, float], offset: tuple[float, float], **look: Any
) -> None:
    """Write a name beside a point, so far from it [pt]."""
    look = {"va": "center"} | look
    axes.annotate(text, point, xytext=offset, textcoords="offset points", **look)


def note(axes: Axes, text: str) -> None:
    """Write a remark over a panel, at its left."""
    axes.set_title(text, loc="left", fontsize=9.5)
