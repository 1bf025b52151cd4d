"""The picture of a sweep: lines over one parameter, maps of two, parallel coordinates of more."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from cdcr.base.arrays import FloatArray
from cdcr.plotting.letters import shrink_letters
from cdcr.plotting.sizes import COLUMN, TEXT, Size, checked_size, is_narrow
from cdcr.plotting.style import COLORS, GREY, LIGHT_GREY, NARROW, StyledFigure, style
from cdcr.sweeps.indices import sobol_indices
from cdcr.sweeps.result import metric_names, parameter_names, require_sweep

if TYPE_CHECKING:
    import xarray

CMAP = "viridis"
PANEL = (5.2, 3.9)  # of one metric [in]
AXIS, LINES = 1.75, 4.6  # of parallel coordinates: width of each, height [in]
BARS = 2.6  # height of Sobol indices [in]
MOST_LINES = 2000  # that parallel coordinates draw
SPREAD = 30.0  # largest over least value from which an axis can be logarithmic
EVEN = 1e-6  # of steps, relative


def plot(result: xarray.Dataset, *, size: Size = None) -> Figure:
    """Draw a sweep: each metric over the parameters. Needs the extra ``plot``.

    Lines over one parameter, maps over a grid of two; parallel coordinates of what has more, with
    Sobol indices where the samples are "saltelli:N".

    Parameters
    ----------
    result : Dataset
        What `cdcr.sweep` returned, or a file of it.
    size : str or tuple of float, optional
        As in `cdcr.scenarios.Scenario.figure`.

    Returns
    -------
    Figure

    Raises
    ------
    ValueError
        Where `size` is none of these.
    TypeError
        For what is no sweep.

    Examples
    --------
    >>> import cdcr
    >>> damping = {"sections.1.damping": [0.005, 0.01, 0.02]}
    >>> found = cdcr.sweep("step-tension", damping, metrics="final_tip_speed", jobs=1)
    >>> cdcr.sweeps.plot(found).axes[0].get_xlabel()
    'sections.1.damping [N m s/rad]'
    """
    require_sweep(result)
    sides = checked_size(size)
    narrow = is_narrow(sides)
    with style():
        figure = StyledFigure(layout="constrained")
        if len(parameter_names(result)) == 1:
            drawn = _panels(figure, result, _draw_line, narrow)
        elif result.attrs["samples"] == "grid" and len(parameter_names(result)) == 2:
            drawn = _panels(figure, result, _draw_map, narrow)
        else:
            drawn = _parallel(figure, result, narrow)
        figure.set_size_inches(*_inches(sides, drawn))
        if narrow:
            shrink_letters(figure, TEXT)
    return figure


def _inches(sides: Any, drawn: tuple[float, float]) -> tuple[float, float]:
    """Return width and height [in] that are asked for, of a column those of what is drawn in it."""
    if sides is None:
        return drawn
    if not isinstance(sides, str):
        return sides[0], sides[1]
    return COLUMN, drawn[1] * COLUMN / drawn[0]


def _panels(figure: Figure, result: xarray.Dataset, draw: Any, narrow: bool) -> tuple[float, float]:
    """Draw a panel for each metric; return the size of the figure [in]."""
    metrics = metric_names(result)
    columns = 1 if narrow else math.ceil(math.sqrt(len(metrics)))
    rows = math.ceil(len(metrics) / columns)
    for k, name in enumerate(metrics):
        draw(figure, figure.add_subplot(rows, columns, k + 1), result, name)
    return columns * PANEL[0], rows * PANEL[1]


def label(result: xarray.Dataset, name: str) -> str:
    """Return the name of a parameter or a metric with its unit."""
    unit = result[name].attrs.get("units", "")
    return name.replace("_", " ") if unit in ("", "1") else f"{_worded(result, name)} [{unit}]"


def _worded(result: xarray.Dataset, name: str) -> str:
    """Return the words of a metric; a parameter stays as it is asked for."""
    return name if name in result.coords else name.replace("_", " ")


def _draw_line(figure: Figure, axes: Axes, result: xarray.Dataset, name: str) -> None:
    (parameter,) = parameter_names(result)
    order = np.argsort(result[parameter].values)
    x, y = result[parameter].values[order], result[name].values[order]
    axes.plot(x, y, marker="o", markersize=3.5)
    if _is_logarithmic(x):
        axes.set_xscale("log")
    axes.set(xlim=_edges(x)[[0, -1]], xlabel=label(result, parameter), ylabel=label(result, name))
    _note_missing(axes, y, "no value of")


def _draw_map(figure: Figure, axes: Axes, result: xarray.Dataset, name: str) -> None:
    down, across = parameter_names(result)
    field = result[name].sortby([down, across])
    x, y = field[across].values, field[down].values
    filled = axes.pcolormesh(_edges(x), _edges(y), field.values, cmap=CMAP, rasterized=True)
    axes.set_facecolor(LIGHT_GREY)  # which shows where there is no value
    axes.grid(visible=False)
    for values, scale in ((x, axes.set_xscale), (y, axes.set_yscale)):
        if _is_logarithmic(values):
            scale("log")
    axes.set(xlabel=label(result, across), ylabel=label(result, down))
    figure.colorbar(filled, ax=axes, label=label(result, name))
    _note_missing(axes, field.values, "grey: no value of")


def _note_missing(axes: Axes, values: FloatArray, words: str) -> None:
    missing = int(np.sum(~np.isfinite(values)))
    if missing:
        axes.set_title(f"{words} {missing} of {values.size} runs", loc="left", fontsize=9.5)


def _is_logarithmic(values: FloatArray) -> bool:
    """Whether rising values are spread evenly in their logarithms, and not by themselves."""
    if len(values) < 3 or values[0] <= 0.0 or values[-1] < SPREAD * values[0]:
        return False
    steps = np.diff(np.log(values))
    return bool(np.ptp(steps) < EVEN * steps.max())


def _edges(values: FloatArray) -> FloatArray:
    """Return the borders (n + 1,) between rising values (n,), halfway on their scale."""
    if len(values) == 1:
        reach = 0.5 * (abs(values[0]) or 1.0)
        return np.array([values[0] - reach, values[0] + reach])
    is_log = _is_logarithmic(values)
    scaled = np.log(values) if is_log else values
    middle = 0.5 * (scaled[1:] + scaled[:-1])
    found = np.concatenate([[2 * scaled[0] - middle[0]], middle, [2 * scaled[-1] - middle[-1]]])
    return np.exp(found) if is_log else found


def _parallel(figure: Figure, result: xarray.Dataset, narrow: bool) -> tuple[float, float]:
    """Draw all runs as lines over parameters and metrics; return the size of the figure [in]."""
    parameters, metrics = parameter_names(result), metric_names(result)
    names = [*parameters, *metrics]
    rows = len(metrics) if narrow else 1
    bars = rows * BARS if result.attrs["samples"] == "saltelli" else 0.0
    grid = figure.add_gridspec(2 if bars else 1, 1, height_ratios=[LINES, bars][: 2 if bars else 1])
    axes = figure.add_subplot(grid[0])
    _draw_lines(figure, axes, result, names, metrics[0])
    if narrow:
        axes.tick_params(axis="x", rotation=90)
    if bars:
        below = grid[1].subgridspec(rows, len(metrics) // rows)
        places = (below[divmod(k, below.ncols)] for k in range(len(metrics)))
        _draw_indices(figure, result, [figure.add_subplot(one) for one in places])
    return (NARROW if narrow else max(6.5, AXIS * len(names))), LINES + bars


def _draw_lines(
    figure: Figure, axes: Axes, result: xarray.Dataset, names: list[str], first: str
) -> None:
    table = result[names].to_dataframe()[names] if result.attrs["samples"] != "grid" else None
    if table is None:
        table = result[names].to_dataframe().reset_index()[names]
    values = table.to_numpy(dtype=np.float64)
    whole = values[np.all(np.isfinite(values), axis=1)]
    drawn = whole[:: max(1, -(-len(whole) // MOST_LINES))]
    low, high = (
        (drawn.min(axis=0), drawn.max(axis=0)) if len(drawn) else (np.zeros(len(names)),) * 2
    )
    span = np.where(high > low, high - low, 1.0)
    heights = np.where(high > low, (drawn - low) / span, 0.5)
    place = np.arange(len(names))
    norm = Normalize(low[names.index(first)], high[names.index(first)])
    order = np.argsort(drawn[:, names.index(first)])
    lines = [np.column_stack([place, one]) for one in heights[order]]
    drawn_lines = LineCollection(
        lines, cmap=mpl.colormaps[CMAP], norm=norm, linewidths=0.8, alpha=0.6, rasterized=True
    )
    drawn_lines.set_array(drawn[order, names.index(first)])
    axes.add_collection(drawn_lines)
    for x, least, largest in zip(place, low, high, strict=True):
        axes.axvline(float(x), color=GREY, linewidth=1.0, zorder=0)
        for y, value, side in ((0.0, least, "top"), (1.0, largest, "bottom")):
            offset = (0, -4 if side == "top" else 4)
            box = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
            look: dict[str, Any] = {"ha": "center", "va": side, "fontsize": 9, "bbox": box}
            axes.annotate(f"{value:.3g}", (x, y), offset, textcoords="offset points", **look)
    axes.set(xlim=(-0.4, len(names) - 0.6), ylim=(-0.1, 1.1), yticks=[])
    axes.set_xticks(place, [_in_lines(label(result, name)) for name in names])
    axes.tick_params(axis="x", length=0)
    axes.grid(visible=False)
    axes.spines[["left", "bottom"]].set_visible(False)
    figure.colorbar(ScalarMappable(norm, CMAP), ax=axes, label=label(result, first))
    told = [f"drawn: {len(drawn)} of {len(whole)} runs"] if len(drawn) < len(whole) else []
    missing = len(values) - len(whole)
    told += [f"left out, without a value: {missing} of {len(values)} runs"] if missing else []
    axes.set_title("; ".join(told), loc="left", fontsize=9.5)


def _in_lines(words: str) -> str:
    """Return a name with its last part and its unit in lines of their own."""
    name, bracket, unit = words.partition(" [")
    owner, dot, last = name.rpartition(".")
    lines = [f"{owner}{dot}", last, f"[{unit}" if bracket else ""]
    return "\n".join(line for line in lines if line)


def _draw_indices(figure: Figure, result: xarray.Dataset, panels: list[Axes]) -> None:
    """Draw a bar of each index of each parameter, a panel for each metric."""
    indices = sobol_indices(result)
    place = np.arange(indices.sizes["parameter"])
    for axes, name in zip(panels, indices.metric.values.tolist(), strict=True):
        one = indices.sel(metric=name)
        for shift, key, color in (
            (-0.2, "first_order", COLORS[0]),
            (0.2, "total_order", COLORS[1]),
        ):
            words = {"first_order": "by itself", "total_order": "with others"}[key]
            axes.barh(place + shift, one[key].values, 0.36, color=color, label=words)
        axes.set_yticks(place, indices.parameter.values if _is_left(axes) else [""] * len(place))
        known = bool(np.all(np.isfinite(one.first_order.values)))
        least = min(0.0, float(one.first_order.min())) if known else 0.0
        axes.set(xlim=(least, 1.05), ylim=(len(place) - 0.5, -0.5))
        told = name.replace("_", " ") + ("" if known else ": some runs have no value")
        axes.set_title(told, loc="left", fontsize=9.5)
        axes.set_xlabel("share of the variance")
        axes.grid(visible=False, axis="y")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower right", ncols=2)


def _is_left(axes: Axes) -> bool:
    place = axes.get_subplotspec()
    return place is None or place.is_first_col()
