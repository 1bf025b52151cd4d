"""Words of a picture, and letters small enough that all of them have room."""

from __future__ import annotations

from typing import Any

from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from cdcr.plotting import space
from cdcr.plotting.legend import redraw_above

STEP = 0.85  # from one size of letters to the next that is tried
MAX_COLUMNS = 9  # of a legend over a panel
TOUCH = 2.0  # by which the boxes of two words may overlap [dots]


class _Reader(RendererAgg):
    """Keeps the words that are drawn, and the boxes they take [dots]."""

    def __init__(self, figure: Figure) -> None:
        width, height = figure.bbox.size
        super().__init__(width, height, figure.dpi)  # type: ignore[no-untyped-call]
        self.words: list[tuple[str, Bbox]] = []

    def draw_text(
        self, gc: Any, x: Any, y: Any, s: Any, prop: Any, angle: Any, ismath: Any = False,
        mtext: Any = None,
    ) -> None:  # fmt: skip
        draw: Any = super().draw_text
        draw(gc, x, y, s, prop, angle, ismath, mtext)
        if mtext is not None and s.strip():
            self.words.append((s, Text.get_window_extent(mtext, self)))


def words(figure: Figure) -> list[tuple[str, Bbox]]:
    """Return the words that a picture shows, each with the box that it takes [dots]."""
    figure.canvas.draw()  # settles layout and ticks
    reader = _Reader(figure)
    figure.draw(reader)
    return reader.words


def have_room(figure: Figure) -> bool:
    """Return whether all words lie inside a picture, and none on another."""
    boxes = [box for _, box in words(figure)]
    width, height = figure.bbox.size
    for k, box in enumerate(boxes):
        if min(box.x0, box.y0, width - box.x1, height - box.y1) < -TOUCH / 2.0:
            return False
        small = box.padded(-TOUCH / 2.0)
        if any(small.overlaps(other.padded(-TOUCH / 2.0)) for other in boxes[:k]):
            return False
    return True


def shrink_letters(figure: Figure, factor: float) -> None:
    """Make all letters of a figure so many times as large."""
    figure.canvas.draw()  # settles ticks and layout
    for text in figure.findobj(Text):
        text.set_fontsize(factor * float(text.get_fontsize()))


def arrange(figure: Figure) -> None:
    """Let everything find its place anew that has asked for it."""
    for place in getattr(figure, "arrangements", ()):
        place()


def find_room(figure: Figure, least: float, letters: float) -> None:
    """Make the letters of a figure smaller until all words have room, down to a least factor.

    They are `letters` times as large as usual before.
    """
    # A layout that Matplotlib finds may suit larger letters; one in shares of the paper does not.
    step = STEP if letters < 1.0 or figure.get_layout_engine() else least
    factor = 1.0
    while factor > least and not have_room(figure):
        step = max(step, least / factor)
        factor *= step
        shrink_letters(figure, step)
        for axes in figure.axes:
            if axes.name == "3d":
                space.keep_off(axes, letters * factor)
            elif legend := axes.get_legend():
                names = legend.get_texts()
                redraw_above(axes, float(names[0].get_fontsize()), min(len(names), MAX_COLUMNS))
        arrange(figure)
