"""A fit in pictures: measured beside predicted, what is left over, correlation, paths."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from cdcr.base.arrays import FloatArray
from cdcr.plotting.panels import legend_above
from cdcr.plotting.style import ALARM, BLACK, COLORS, GREY, StyledFigure, style

MAX_CHANNELS = 4  # a row each; the others are in the table
_AXES = "xyz"
_SHOWN = {"m": ("mm", 1e3), "rad": ("deg", 180.0 / np.pi), "N": ("N", 1.0), "Hz": ("Hz", 1.0)}


def plot_identified(fit: Mapping[str, Any]) -> StyledFigure:
    """Draw a fit, as `Identified.plot` does.

    Parameters
    ----------
    fit : mapping
        ``channels``, each with name, unit, along (times or None), measured, left (model less
        measurement) and rms; ``names`` and ``correlation`` of the estimates.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr.plotting
    >>> tip = {"name": "tip", "unit": "m", "along": None, "measured": np.zeros((3, 3)),
    ...        "left": np.full((3, 3), 1e-3), "rms": 0.0017}
    >>> fit = {"channels": [tip], "names": ["a", "b"], "correlation": np.eye(2)}
    >>> cdcr.plotting.plot_identified(fit).axes[1].get_ylabel()
    'left over [mm]'
    """
    told: Any = fit
    if not isinstance(told, Mapping) or not told.keys() >= {"channels", "names", "correlation"}:
        needed = "fit must be a mapping with channels, names and correlation (see Identified.plot)"
        raise TypeError(f"{needed}, got {type(fit).__name__}")
    channels = fit["channels"][:MAX_CHANNELS]
    place = next((one for one in channels if one["unit"] == "m" and _is_place(one)), None)
    rows = len(channels) + (place is not None)
    with style():
        figure = StyledFigure(figsize=(13.0, 0.6 + 3.2 * rows), layout="constrained")
        grid = figure.add_gridspec(rows, 3, width_ratios=(1.3, 1.0, 0.9))
        for row, channel in enumerate(channels):
            unit, factor = _SHOWN.get(channel["unit"], (channel["unit"] or "1", 1.0))
            _track(figure.add_subplot(grid[row, 0]), channel, unit, factor)
            _left(figure.add_subplot(grid[row, 1]), channel, unit, factor)
        _correlation(figure, figure.add_subplot(grid[0, 2]), fit["names"], fit["correlation"])
        if place is not None:
            for column, axes in enumerate(((0, 1), (0, 2), (1, 2))):
                _path(figure.add_subplot(grid[-1, column]), place, *axes)
    return figure


def _is_place(channel: Mapping[str, Any]) -> bool:
    return bool(channel["name"].split(": ")[-1].startswith(("tip", "marker")))


def _path(axes: Axes, channel: Mapping[str, Any], first: int, second: int) -> None:
    """Draw where a place was seen and where the model has it, in a plane."""
    measured = 1e3 * channel["measured"]
    model = measured + 1e3 * channel["left"]
    moving = channel["along"] is not None
    axes.plot(measured[:, first], measured[:, second], "o", color=COLORS[0], alpha=0.5,
              markersize=3, label="measured")  # fmt: skip
    axes.plot(model[:, first], model[:, second], "-" if moving else "+", color=BLACK,
              linewidth=0.8, markersize=4, label="model")  # fmt: skip
    axes.set_xlabel(f"{channel['name']} {_AXES[first]} [mm]")
    axes.set_ylabel(f"{_AXES[second]} [mm]")
    axes.set_aspect("equal", adjustable="datalim")
    legend_above(axes)


def _track(axes: Axes, channel: Mapping[str, Any], unit: str, factor: float) -> None:
    """Draw what was measured and what the model says, over time or row by row."""
    measured, left = channel["measured"] * factor, channel["left"] * factor
    along = np.arange(1, len(measured) + 1) if channel["along"] is None else channel["along"]
    few = len(measured) < 200
    model = "-" if channel["along"] is not None else "+" if few else ""
    for k in range(min(measured.shape[1], len(COLORS))):
        label = _AXES[k] if measured.shape[1] == 3 else f"{k + 1}"
        axes.plot(along, measured[:, k], "o" if few else ".", color=COLORS[k], alpha=0.5,
                  markersize=4 if few else 2, label=label)  # fmt: skip
        axes.plot(along, measured[:, k] + left[:, k], model or ",", color=BLACK, linewidth=0.8)
    _name_rows(axes, channel)
    axes.set_ylabel(f"{channel['name']} [{unit}]")
    axes.set_title("model in black", fontsize=10, loc="left")
    legend_above(axes)


def _name_rows(axes: Axes, channel: Mapping[str, Any]) -> None:
    axes.set_xlabel("row" if channel["along"] is None else "time [s]")
    if channel["along"] is None:
        axes.set_xlim(0, len(channel["measured"]) + 1)
        axes.xaxis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1))


def _left(axes: Axes, channel: Mapping[str, Any], unit: str, factor: float) -> None:
    """Draw how often what is left over is how large."""
    left = channel["left"] * factor
    values = left[np.isfinite(left)]
    reach = float(np.max(np.abs(values), initial=0.0)) or 1.0
    along = np.arange(1, len(left) + 1) if channel["along"] is None else channel["along"]
    for k in range(min(left.shape[1], len(COLORS))):
        axes.plot(along, left[:, k], ".", color=COLORS[k], markersize=3)
    axes.axhline(0.0, color=GREY, linewidth=0.8)
    axes.set_ylim(-1.1 * reach, 1.1 * reach)
    _name_rows(axes, channel)
    axes.set_ylabel(f"left over [{unit}]")
    axes.set_title(f"RMS {channel['rms'] * factor:.3g} {unit}", fontsize=10, loc="left")


def _correlation(
    figure: StyledFigure, axes: Axes, names: list[str], correlation: FloatArray
) -> None:
    """Draw the correlation of the estimates, blue against, red along with one another."""
    picture = axes.imshow(correlation, vmin=-1.0, vmax=1.0, cmap="RdBu_r")
    places = np.arange(len(names))
    axes.set_xticks(places, [f"{k + 1}" for k in places])
    axes.set_yticks(places, [f"{name}  {k + 1}" for k, name in enumerate(names)], fontsize=8)
    axes.grid(visible=False)
    axes.set_title("correlation of the estimates", fontsize=10, loc="left")
    for i, k in np.argwhere(~np.isfinite(correlation)):
        axes.text(k, i, "?", ha="center", va="center", color=ALARM, fontsize=8)
    figure.colorbar(picture, ax=axes, shrink=0.8)
