"""Axes in space that show a robot to scale and fill the picture."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import Formatter, MaxNLocator, ScalarFormatter
from mpl_toolkits.mplot3d import proj3d  # type: ignore[import-untyped]

from cdcr.base.arrays import FloatArray
from cdcr.plotting.style import LIGHT_GREY

# Of three cables, the first along X, none hides another.
VIEW = {"elev": 24.0, "azim": -74.0}  # [deg]
UNITS = {"km": 1e3, "m": 1.0, "mm": 1e-3, "um": 1e-6, "nm": 1e-9}  # of lengths [m]
NEAR, FAR = 1e-2, 1e4  # where metres begin and end [m]
MAX_TICKS = 7  # along the longest side
FORESHORTENED = 0.6  # the y axis, in this view
SLENDEREST = 0.3  # shortest side of the box over its longest: room for the numbers
LABEL_OFFSET, TICK_OFFSET = 29.0, 11.5  # of a cube's labels and numbers [pt]
ASIDE = 5.0  # farther off stands the label of y, whose numbers lie towards it [pt]
NUMBER = (0.28, 0.17)  # room that one needs [in]
LABELS = (0.55, 0.8, 0.9, 0.2)  # room left, below, right, above the box for its labels [in]


def add_axes(figure: Figure) -> Any:
    """Add Axes3D with a parallel projection, labelled in metres."""
    axes: Any = figure.add_axes((0.0, 0.0, 1.0, 1.0), projection="3d", proj_type="ortho")
    axes.view_init(**VIEW)
    axes.computed_zorder = False
    axes.patch.set_visible(False)  # it reaches over neighbours
    label(axes)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.pane.fill = False
        # An outline, without which the lines of the grid end as if cut off.
        axis.pane.set(closed=True, edgecolor=LIGHT_GREY, linewidth=0.6, alpha=1.0)
    return axes


def label(axes: Any) -> None:
    """Label what has no label yet of Axes3D, in metres."""
    for axis, name in zip((axes.xaxis, axes.yaxis, axes.zaxis), "xyz", strict=True):
        if not axis.get_label_text():
            axis.set_label_text(f"{name} [m]")


def _choose_units(axes: Any) -> None:
    """Give what `label` has labelled mm, um or km where metres would need a power of ten."""
    largest = float(np.max(np.abs(_limits(axes))))
    small = next((one for one in ("mm", "um") if largest >= UNITS[one]), "nm")
    unit = "km" if largest >= FAR else "m" if largest >= NEAR else small
    labels = {f"{name} [{one}]" for name in "xyz" for one in UNITS}
    for axis, name in zip((axes.xaxis, axes.yaxis, axes.zaxis), "xyz", strict=True):
        if axis.get_label_text() in labels:
            axis.set_label_text(f"{name} [{unit}]")
            axis.set_major_formatter(ScalarFormatter() if unit == "m" else _Scaled(UNITS[unit]))


class _Scaled(Formatter):
    """Numbers in another unit than metres; unlike a function it pickles, and so do figures."""

    def __init__(self, unit: float) -> None:
        self.unit = unit

    def __call__(self, x: float, pos: int | None = None) -> str:
        """Return a number as it is shown."""
        return f"{x / self.unit:.6g}".replace("-", "\N{MINUS SIGN}")


def show_points(axes: Any, points: FloatArray) -> None:
    """Widen Axes3D to show points (P, 3) [m], with the same scale in all directions."""
    low, high = points.min(axis=0), points.max(axis=0)
    if axes.has_data():
        shown = _limits(axes)
        low, high = np.minimum(low, shown[:, 0]), np.maximum(high, shown[:, 1])
    size = high - low
    missing = np.maximum(SLENDEREST * size.max() - size, 0.0)
    low, high = low - missing / 2, high + missing / 2
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    _number_axes(axes, low, high)


def _number_axes(axes: Any, low: FloatArray, high: FloatArray) -> None:
    """Give the box its proportions, and its axes as many numbers as have room."""
    size = high - low
    axes.set_box_aspect(tuple(size))  # it would write into an array
    for k, axis in enumerate((axes.xaxis, axes.yaxis, axes.zaxis)):
        room = MAX_TICKS * size[k] / size.max() * (FORESHORTENED if k == 1 else 1.0)
        ticks = MaxNLocator(max(2, round(room)), steps=[1, 2, 5, 10]).tick_values(low[k], high[k])
        corner = low[k] + 0.15 * size[k] * (k == 1)  # where x and y meet, x is numbered
        axis.set_ticks(ticks[(ticks >= corner) & (ticks <= high[k])])
    _choose_units(axes)
    keep_off(axes)


def keep_off(axes: Any, letters: float = 1.0) -> None:
    """Set how far labels and numbers stand off, for letters that many times as large."""
    size = np.ptp(_limits(axes), axis=1)
    cube = size / np.sqrt(np.mean(size**2))  # 1 for a cube
    for k, axis in enumerate((axes.xaxis, axes.yaxis, axes.zaxis)):
        # Matplotlib keeps labels off an axis by shares of the other two sides: even that out.
        away = np.sqrt(np.mean(np.delete(cube, k) ** 2)) / letters
        axis.labelpad = LABEL_OFFSET / away - 21.0 + ASIDE * letters * (k == 1)
        axis.set_tick_params(pad=TICK_OFFSET / away - 8.0)


def towards_viewer(axes: Any) -> FloatArray:
    """Return the direction (3,) in which Axes3D is looked at from."""
    elev, azim = np.deg2rad([axes.elev, axes.azim])
    return np.array([np.cos(elev) * np.cos(azim), np.cos(elev) * np.sin(azim), np.sin(elev)])


def paper_directions(axes: Any) -> FloatArray:
    """Return the directions (2, 3) that Axes3D shows from left to right and upwards."""
    azim = np.deg2rad(axes.azim)
    across = np.array([-np.sin(azim), np.cos(azim), 0.0])
    return np.stack([across, np.cross(towards_viewer(axes), across)])


def fit(axes: Any, room: FloatArray, letters: float = 1.0) -> tuple[float, FloatArray]:
    """Return the scale at which Axes3D fills a room (width, height) and the size it takes [in].

    Matplotlib draws Axes3D into a square; the scale is the side of that square. `letters` is how
    many times as large as usual the letters are.
    """
    corners = np.array(list(product(*_limits(axes))))
    x, y, _ = proj3d.proj_transform(*corners.T, axes.get_proj())
    box = np.array([np.ptp(x), np.ptp(y)]) / axes.viewLim.width
    left, below, right, above = letters * np.array(LABELS)
    labels = np.array([left + right, below + above])
    scale = float(np.min((room - labels) / box))
    return scale, scale * box + labels


def place(axes: Any, scale: float, room: FloatArray, letters: float = 1.0) -> None:
    """Put Axes3D into the middle of a room (width, height) [in] at the left of its figure."""
    paper = axes.figure.get_size_inches()
    left, below, right, above = letters * np.array(LABELS)
    center = np.array([room[0] + left - right, room[1] + below - above]) / 2
    # The middle of the box has the coordinates (0, 0) of the square.
    corner = center + scale * axes.viewLim.min / axes.viewLim.size
    axes.set_position((*(corner / paper), *(scale / paper)))
    _thin_numbers(axes, scale, letters)


def _thin_numbers(axes: Any, scale: float, letters: float) -> None:
    """Leave out every other number of an axis on which they are too close."""
    for k, axis in enumerate((axes.xaxis, axes.yaxis, axes.zaxis)):
        ticks = np.asarray(axis.get_ticklocs())
        if len(ticks) < 3:
            continue
        points = np.zeros((2, 3))
        points[:, k] = ticks[:2]
        x, y, _ = proj3d.proj_transform(*points.T, axes.get_proj())
        apart = np.abs([x[1] - x[0], y[1] - y[0]]) * scale / axes.viewLim.width
        if np.all(apart < letters * np.array(NUMBER)):
            axis.set_ticks(ticks[::2])


def fill(axes: Any, room: FloatArray, letters: float = 1.0) -> None:
    """Let Axes3D fill a room (width, height) [in] at the left of its figure."""
    keep_off(axes, letters)
    scale, _ = fit(axes, room, letters)
    place(axes, scale, room, letters)


def _limits(axes: Any) -> FloatArray:
    """Lower and upper limit of x, y, z (3, 2) [m]."""
    return np.array([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()])
