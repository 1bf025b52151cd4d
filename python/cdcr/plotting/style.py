"""The look of every figure: one style, colours that colour-blind readers can tell apart."""

from __future__ import annotations

import io
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

import matplotlib as mpl
import matplotlib.style
import numpy as np
from cycler import cycler
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

# Okabe and Ito, without black and without the yellow that is hard to see on white.
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
BLACK, GREY, LIGHT_GREY = "#222222", "#777777", "#D9D9D9"
NARROW, PRINTED = 12.0 / 2.54, 300  # pictures narrower than that [in] are for print, so fine [dpi]
ALARM, DISK = "#B3261E", "#B8C4CE"

STYLE: dict[str, Any] = {
    "axes.prop_cycle": cycler(color=COLORS),
    "axes.edgecolor": GREY,
    "axes.labelcolor": BLACK,
    "axes.labelsize": 10.5,
    "axes.linewidth": 0.8,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-4, 5),
    "axes.formatter.use_mathtext": True,
    "figure.constrained_layout.h_pad": 0.06,
    "figure.constrained_layout.w_pad": 0.1,
    "figure.dpi": 100,
    "font.size": 10,
    "grid.color": LIGHT_GREY,
    "grid.linewidth": 0.6,
    "legend.fontsize": 9.5,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
    "lines.solid_capstyle": "round",
    "pdf.fonttype": 42,  # text stays text
    "savefig.dpi": 150,
    "svg.fonttype": "none",
    "svg.hashsalt": "cdcr",  # the same picture is the same file
    "xtick.color": GREY,
    "xtick.labelcolor": BLACK,
    "xtick.labelsize": 9.5,
    "ytick.color": GREY,
    "ytick.labelcolor": BLACK,
    "ytick.labelsize": 9.5,
}


def style() -> AbstractContextManager[None]:
    """Return a context in which Matplotlib draws in our style, whatever the caller's settings."""
    return mpl.style.context(STYLE, after_reset=True)


class StyledFigure(Figure):
    """A figure without a window that is also saved in our style."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        """Take the arguments of Figure."""
        super().__init__(*args, **kwargs)
        FigureCanvasAgg(self)
        # What draws anew for a column of a width [in], where moving panels is not enough.
        self.narrow: Callable[[float], None] | None = None
        # What finds places for names, after panels have moved.
        self.arrangements: list[Callable[[], None]] = []

    def savefig(self, *args: Any, **kwargs: Any) -> None:
        """Save the picture; the arguments are those of Figure.savefig."""
        if self.get_figwidth() < NARROW:
            kwargs.setdefault("dpi", PRINTED)
        with style():
            super().savefig(*args, **kwargs)

    def _repr_png_(self) -> bytes:
        """Return the picture as a notebook shows it."""
        png = io.BytesIO()
        self.savefig(png, format="png")
        return png.getvalue()


def line_colors(count: int) -> list[Any]:
    """One colour for each of `count` lines; an ordered scale where there are too many to name."""
    if count <= len(COLORS):
        return list(COLORS[:count])
    return list(mpl.colormaps["viridis"](np.linspace(0.0, 0.9, count)))
