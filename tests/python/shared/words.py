"""The words that a picture shows, and where."""

from typing import Any

import pytest
from matplotlib.text import Text

OUTSIDE = 1.5  # that a word may stick out: boxes are as high as the tallest letters [pt]


def words(figure: Any) -> list[tuple[str, Any]]:
    """All words that are drawn in a picture, and the boxes they take."""
    drawn: list[tuple[str, Any]] = []
    draw = Text.draw

    def remember(self: Text, renderer: Any) -> None:
        if self.get_visible() and self.get_text():
            drawn.append((self.get_text(), Text.get_window_extent(self, renderer)))
        draw(self, renderer)

    figure.canvas.draw()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Text, "draw", remember)
        figure.canvas.draw()
    return drawn


def words_outside(figure: Any) -> list[str]:
    """Words that the edge of a picture cuts."""
    width, height = figure.bbox.size
    far = OUTSIDE * figure.dpi / 72.0
    found = words(figure)
    assert found
    return [
        word for word, box in found if min(box.x0, box.y0, width - box.x1, height - box.y1) < -far
    ]
