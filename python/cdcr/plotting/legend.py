"""The legend of a robot in space, with samples of whole shapes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D


class ShapeSample(Line2D):
    """What a legend shows of a whole shape: a piece of each section, as faint as the shape."""

    def __init__(self, colors: Sequence[Any], alpha: float, label: str) -> None:
        super().__init__([], [], color=colors[0], linewidth=2.4, alpha=alpha, label=label)
        self.pieces = tuple(
            Line2D([], [], color=color, linewidth=2.4, alpha=alpha, solid_capstyle="butt")
            for color in colors
        )


class _SampleHandler(HandlerTuple):
    """Draws the pieces of a sample end to end."""

    def create_artists(self, legend: Any, orig_handle: Any, *where: Any) -> Any:
        return super().create_artists(legend, orig_handle.pieces, *where)


def legend_of(figure: Figure, axes: Any, **look: Any) -> Legend:
    """Add the legend of Axes3D to a figure; `look` goes to `Figure.legend`."""
    handles, labels = axes.get_legend_handles_labels()
    handlers = {ShapeSample: _SampleHandler(ndivide=None, pad=0.0)}
    return figure.legend(handles, labels, handler_map=handlers, **look)
