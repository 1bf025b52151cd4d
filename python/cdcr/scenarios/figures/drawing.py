"""What the pictures of scenarios have in common."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from cdcr._core import taylor_range
from cdcr.plotting.style import StyledFigure

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


def legend_below(figure: Any, axes: Axes, ncols: int = 4) -> None:
    """Put the legend of one panel under the whole figure."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=ncols, handlelength=2.6)


def legend_above(axes: Axes, ncols: int = 4) -> None:
    """Put the legend of a panel above it, so that it lies on no data."""
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=ncols,
        borderaxespad=0.1,
        columnspacing=1.2,
        handlelength=2.2,
    )


def note(axes: Axes, text: str) -> None:
    """Write a remark over a panel, at its left."""
    axes.set_title(text, loc="left", fontsize=9.5)
