"""The legend of a robot in space, with samples of whole shapes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D

from cdcr.plotting.style import StyledFigure


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


def redraw_above(axes: Any, fontsize: float, ncols: int) -> None:
    """Draw the legend over a panel anew, in letters of that size [pt] and close together."""
    axes.legend(
        *axes.get_legend_handles_labels(),
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=ncols,
        borderaxespad=0.1,
        fontsize=fontsize,
        columnspacing=0.7,
        handlelength=1.5,
        handletextpad=0.4,
    )


class FittingLegend:
    """A legend that belongs to a whole picture, in as many columns as its width has room for."""

    def __init__(
        self, figure: StyledFigure, draw: Callable[..., Legend], ncols: int, share: float = 1.0
    ) -> None:
        """Draw it in at most `ncols` columns, no wider than a share of the picture.

        `draw` adds it to the figure, with ``ncols`` and perhaps ``fontsize``.
        """
        self._figure, self._draw, self._ncols, self._share = figure, draw, ncols, share
        self._legend = draw(ncols=ncols)
        figure.arrangements.append(self._arrange)

    def _arrange(self) -> None:
        if self._legend not in self._figure.legends:
            return  # a column has put it elsewhere
        letters = self._legend.get_texts()[0].get_fontsize()
        for ncols in range(self._ncols, 0, -1):
            self._legend.remove()
            self._legend = self._draw(ncols=ncols, fontsize=letters)
            width = self._legend.get_window_extent().width
            if width <= self._share * self._figure.bbox.width:
                return


def legend_of(figure: Figure, axes: Any, **look: Any) -> Legend:
    """Add the legend of Axes3D to a figure; `look` goes to `Figure.legend`."""
    handles, labels = axes.get_legend_handles_labels()
    handlers = {ShapeSample: _SampleHandler(ndivide=None, pad=0.0)}
    return figure.legend(handles, labels, handler_map=handlers, **look)
