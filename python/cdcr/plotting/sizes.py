"""Sizes of pictures: as drawn, of a journal's column, of a slide, or any other."""

from __future__ import annotations

import re
import textwrap
import warnings
from functools import partial
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.text import Annotation, Text

from cdcr.base.check import short
from cdcr.base.decimals import number
from cdcr.plotting import space
from cdcr.plotting.legend import legend_of, redraw_above
from cdcr.plotting.letters import MAX_COLUMNS, arrange, find_room, shrink_letters
from cdcr.plotting.style import NARROW, style

Size = str | tuple[float, float] | None

CM = 1.0 / 2.54  # [in]
COLUMN = 8.5 * CM  # width of a journal's column [in]
SLIDE = (33.87 * CM, 19.05 * CM)  # 16:9 [in]
SMALLEST, LARGEST = 3.0, 200.0  # of a side [cm]
# Of a narrow picture [in]: a panel, room above, below its name and without, sides, the robot, a row
# of a legend.
PANEL, ABOVE, BELOW, UNNAMED, LEFT, RIGHT, SPACE, ROW = 0.95, 0.3, 0.4, 0.12, 0.62, 0.1, 2.9, 0.14
SQUARE = 2.2  # height of a panel whose axes have one scale [in]
LETTER = 0.054  # mean width of one [in]
LONG = 26  # letters of a name with which a legend has one column
NAME = 24  # letters in a line beside a panel
TEXT = 0.7  # of the letters of a narrow picture, over those of a wide one


def checked_size(size: Any) -> tuple[float, float] | Literal["journal"] | None:
    """Return a size in inches, "journal" or None, or refuse it in one sentence.

    A size is None, "journal", "slide", "WIDTHxHEIGHT" or a pair (width, height) in cm.
    """
    if size is None:
        return None
    if isinstance(size, str) and size == "journal":
        return "journal"
    if isinstance(size, str) and size == "slide":
        return SLIDE
    told = size
    if isinstance(size, str):
        size = [number(side) for side in re.split("[x,]", size)]
    try:
        width, height = (float(side) for side in size)
    except (TypeError, ValueError):
        width = height = np.nan
    if not (SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
        raise ValueError(
            "size must be 'journal' (8.5 cm wide), 'slide' (16:9) or width and height of "
            f"{SMALLEST:g} to {LARGEST:g} cm, got {short(told)}"
        )
    return (width * CM, height * CM)


def is_narrow(sides: tuple[float, float] | Literal["journal"] | None) -> bool:
    """Return whether a checked size is that of a column."""
    return sides is not None and (isinstance(sides, str) or sides[0] < NARROW)


def resize(figure: Figure, size: Size) -> Figure:
    """Give a figure a size, as `Scenario.figure` does; return it.

    Parameters
    ----------
    figure : Figure
        It is changed.
    size : optional
        As in `Scenario.figure`: "journal", "slide" or (width, height) [cm]; None leaves it.

    Returns
    -------
    Figure
        The same.

    Raises
    ------
    ValueError
        For another size.
    TypeError
        For what is no figure.

    Warns
    -----
    UserWarning
        Where that size has no room for all of the picture.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr.plotting
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> run = cdcr.simulate(model, [0, 0], [0, 0], t=np.linspace(0, 1, 11), tension=[5, 0, 0])
    >>> cdcr.plotting.resize(run.plot(), (16, 9)).get_size_inches().round(2)
    array([6.3 , 3.54])
    """
    if not isinstance(figure, Figure):
        raise TypeError(f"figure must be a Matplotlib figure, got {type(figure).__name__}")
    sides = checked_size(size)
    if sides is None:
        return figure
    with style(), warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        narrow = is_narrow(sides)
        if narrow:
            width = COLUMN if isinstance(sides, str) else sides[0]
            (getattr(figure, "narrow", None) or partial(_stack, figure))(width)
        if not isinstance(sides, str):
            share = float(np.min(np.array(sides) / figure.get_size_inches()))
            figure.set_size_inches(*sides)
            arrange(figure)
            find_room(figure, *((0.9 * share, TEXT) if narrow else (share, 1.0)))
        if narrow and not getattr(figure, "narrow", None):
            _keep_all_inside(figure)
        arrange(figure)
    _pass_on(told, figure)
    return figure


def _pass_on(told: list[warnings.WarningMessage], figure: Figure) -> None:
    """Warn anew, of a layout that finds no room in words of our own; it is then left as it is."""
    crowded = [one for one in told if "collapsed to zero" in str(one.message)]
    for one in told:
        if one not in crowded:
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
    if crowded:
        figure.set_layout_engine("none")
        width, height = figure.get_size_inches() / CM
        told_size = f"{width:.3g} x {height:.3g} cm"
        warnings.warn(f"{told_size} has no room for all of this picture", stacklevel=3)


def _stack(figure: Figure, width: float) -> None:
    """Put robot and panels one above the other, and make the letters small."""
    shrink_letters(figure, TEXT)
    figure.set_layout_engine("none")
    letters = round((width - LEFT) / LETTER)  # of a line over a panel
    title: Text | None = getattr(figure, "_suptitle")  # noqa: B009 - unknown to its types
    lines = 0
    if title is not None:
        title.set_text(textwrap.fill(title.get_text(), round(width / LETTER * 0.73)))
        lines = title.get_text().count("\n") + 1
    spaces = [axes for axes in figure.axes if axes.name == "3d"]
    charts = [axes for axes in figure.axes if axes.name != "3d"]
    rows = sum(_rows(legend) for legend in figure.legends)
    below = [BELOW if axes.get_xlabel() else UNNAMED for axes in charts]
    above = [ABOVE + 0.1 * _retell(axes, letters) for axes in charts]
    height = 0.16 * lines + 0.1 + SPACE * len(spaces) + ROW * rows + 0.05
    tall = [SQUARE if axes.get_aspect() == 1.0 else PANEL for axes in charts]
    height += sum(above) + sum(below) + sum(tall)
    figure.set_size_inches(width, height)
    top = height - 0.16 * lines - 0.1
    if title is not None:
        title.set_position((0.02, 1.0 - 0.05 / height))
        title.set_verticalalignment("top")
    for axes in spaces:
        top -= SPACE
        room = np.array([width, SPACE])
        space.fill(axes, room, TEXT)
        box = axes.get_position()
        axes.set_position((box.x0, box.y0 + top / height, box.width, box.height))
    top -= ROW * rows
    _move_legends(figure, top / height)
    for axes, over, high, under in zip(charts, above, tall, below, strict=True):
        top -= over + high
        _place(axes, (LEFT, top, width - LEFT - RIGHT, high))
        top -= under
    _keep_all_inside(figure)


def _keep_all_inside(figure: Figure) -> None:
    """Narrow panels whose words leave the picture, and part names that lie on each other."""
    figure.canvas.draw()
    for axes in figure.axes:
        if axes.name != "3d":
            _keep_inside(axes, figure.get_figwidth())
            _part_names(axes)


def _keep_inside(axes: Any, width: float) -> None:
    """Narrow a panel, so that no word at its sides leaves the picture, `width` [in] wide."""
    extent, box = axes.get_tightbbox(), axes.get_window_extent()
    if extent is None:
        return
    dpi = axes.get_figure(root=False).dpi
    low = (box.x0 + max(0.0, 2.0 - extent.x0)) / dpi
    high = (box.x1 - max(0.0, extent.x1 + 2.0 - width * dpi)) / dpi
    _place(axes, (low, box.y0 / dpi, high - low, box.height / dpi))


def _part_names(axes: Any) -> None:
    """Move names in a panel up and down, so that none lies on another."""
    names = [text for text in axes.texts if isinstance(text, Annotation)]
    for _ in names:
        boxes = {name: Text.get_window_extent(name) for name in names}
        for below, above in pairwise(sorted(names, key=lambda name: boxes[name].y0)):
            shift = (boxes[below].y1 - boxes[above].y0) * 36.0 / axes.get_figure(root=True).dpi
            if boxes[below].overlaps(boxes[above]):
                for name, way in ((below, -shift), (above, shift)):
                    x, y = name.get_position()
                    name.set_position((x, y + way))


def _place(axes: Any, box: tuple[float, ...]) -> None:
    """Put axes into a box (left, below, width, height) of their picture [in]."""
    part = axes.get_figure(root=False)
    left, below, wide, high = box
    pixels = part.bbox
    dpi = part.dpi
    axes.set_position((
        (left * dpi - pixels.x0) / pixels.width,
        (below * dpi - pixels.y0) / pixels.height,
        wide * dpi / pixels.width,
        high * dpi / pixels.height,
    ))  # fmt: skip


def _retell(axes: Any, letters: int) -> int:
    """Put the remark of a panel above its legend, in lines that fit; return the rows it needs."""
    note, legend = axes.get_title(loc="left"), axes.get_legend()
    size = TEXT * 9.5
    told = textwrap.fill(note, letters)
    axes.set_title(told, loc="left", fontsize=size, pad=(size + 5.0) if legend else None)
    rows = 0
    if legend is not None:
        labels = axes.get_legend_handles_labels()[1]
        fits = sum(map(len, labels)) + 4 * len(labels) < letters
        told_names = [text.get_text() for text in legend.get_texts()]
        columns = len(labels) if fits else _most_columns(told_names, letters)
        redraw_above(axes, size, columns)
        rows = max(0, -(-len(told_names) // columns) - 2)
    shared = axes.get_shared_y_axes().get_siblings(axes)
    name = axes.get_ylabel() or next((one.get_ylabel() for one in shared if one.get_ylabel()), "")
    axes.tick_params(labelleft=True)
    axes.set_ylabel(_in_lines(name), fontsize=TEXT * 10.5)
    return 2 * bool(legend and note) + told.count("\n") + rows


def _most_columns(names: list[str], letters: int) -> int:
    """Return as many columns of a legend as a line has room for, its first name being longest."""
    rest = max((len(name) for name in names[1:]), default=1) + 4
    return max(1, min(MAX_COLUMNS, 1 + (letters - len(names[0]) - 4) // rest))


def _in_lines(name: str) -> str:
    """Return the name of an axis in lines that a panel has room for, its unit last."""
    words, bracket, unit = name.rpartition(" [")
    if len(name) <= 12 or not bracket:
        return name
    return f"{textwrap.fill(words, NAME) if '$' not in words else words}\n[{unit}"


def _columns(names: list[str]) -> int:
    return 1 if max(map(len, names)) > LONG else 2


def _rows(legend: Legend) -> int:
    """Return how many rows a legend needs in a narrow picture."""
    names = [text.get_text() for text in legend.get_texts()]
    return -(-len(names) // _columns(names))


def _move_legends(figure: Figure, below: float) -> None:
    """Put each legend of the figure under the robot, in columns that fit."""
    for legend in list(figure.legends):
        names = [text.get_text() for text in legend.get_texts()]
        owner = next(
            axes for axes in figure.axes if set(names) <= set(axes.get_legend_handles_labels()[1])
        )
        legend.remove()
        legend_of(
            figure,
            owner,
            loc="lower center",
            bbox_to_anchor=(0.5, below),
            ncols=_columns(names),
            fontsize=TEXT * 9.5,
            borderaxespad=0.0,
            labelspacing=0.25,
        )
