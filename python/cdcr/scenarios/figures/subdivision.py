"""The picture of a subdivided robot: its frequencies, how they converge, and its response."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.base.check import count
from cdcr.plotting import panels
from cdcr.plotting.style import BLACK, COLORS, GREY, StyledFigure, style
from cdcr.scenarios.figures.drawing import name_point, new_figure, note
from cdcr.scenarios.studies import subdivision as study

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

MARKS = ("o", "s", "^")


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw frequencies and their errors over the number of parts, and step responses."""
    with style():
        figure = new_figure(scenario.title, (12.4, 7.6))
        grid = figure.add_gridspec(2, 2, height_ratios=[1.15, 1.0])
        _draw_frequencies(figure.add_subplot(grid[0, 0]))
        _draw_convergence(figure.add_subplot(grid[0, 1]))
        _draw_responses(figure.add_subplot(grid[1, :]))
    return figure


def _of_mode(mode: int) -> tuple[tuple[int, ...], list[float], list[float]]:
    """Return numbers of parts that have a mode, its frequencies [Hz] and their excess [%]."""
    counts = study.COUNTS[mode:]
    hertz = [study.frequencies(parts)[mode] / (2.0 * np.pi) for parts in counts]
    return counts, hertz, [100.0 * study.excess(parts)[mode] for parts in counts]


def _draw_frequencies(axes: Axes) -> None:
    for mode, (color, mark) in enumerate(zip(COLORS[: study.SHOWN], MARKS, strict=True)):
        counts, hertz, _ = _of_mode(mode)
        limit = study.beam()[mode] / (2.0 * np.pi)
        axes.plot(counts, hertz, color=color, marker=mark, markersize=5)
        axes.axhline(limit, color=color, linestyle="--", linewidth=1.0)
        name, side = f"mode {mode + 1}\n{limit:.3g} Hz", axes.get_yaxis_transform()
        name_point(axes, name, (1.0, limit), (6, 0), xycoords=side, color=color)
    axes.set_yscale("log")
    ticks = [1, 2, 5, 10, 20, 50]
    axes.set_yticks(ticks, [str(tick) for tick in ticks])
    axes.minorticks_off()
    axes.set_xticks(study.COUNTS)
    axes.set_xlabel("number of parts")
    axes.set_ylabel("natural frequency [Hz]")
    note(axes, "dashed: the beam")


def _draw_convergence(axes: Axes) -> None:
    for mode, (color, mark) in enumerate(zip(COLORS[: study.SHOWN], MARKS, strict=True)):
        counts, _, percent = _of_mode(mode)
        axes.plot(counts, percent, color=color, marker=mark, markersize=5)
        name = f"mode {mode + 1}:\norder {study.order(mode):.2f}"
        name_point(axes, name, (counts[-1], percent[-1]), (8, 0), color=color)
    start, end = study.COUNTS[1], study.COUNTS[-1]
    first = 100.0 * study.excess(start)[0] / 2.0
    axes.plot([start, end], [first, first * (start / end) ** 2], color=GREY, linestyle=":")
    name_point(axes, "order 2", (start, first), (-4, 0), ha="right", color=GREY)
    axes.set(xscale="log", yscale="log")
    axes.set_xticks(study.COUNTS, [str(parts) for parts in study.COUNTS])
    ticks = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50]
    axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlim(0.93, 15.0)
    axes.set_xlabel("number of parts")
    axes.set_ylabel("frequency too high by [%]")


def _draw_responses(axes: Axes) -> None:
    runs = study.responses()
    for (parts, run), color in zip(
        runs.items(), (*COLORS[1 : study.SHOWN + 1], BLACK), strict=True
    ):
        dashes = "--" if parts == study.STEPS[-1] else "-"
        name, x = count(parts, "part"), 1e3 * run.tip[:, 0]
        axes.plot(run.t, x, color=color, linestyle=dashes, label=name)
    panels.legend_above(axes)
    axes.set_ylabel("tip displacement x [mm]")
    note(
        axes,
        f"{study.TENSION:g} N on cable 1 from t = 0; damping {1e3 * study.DAMPING:g} mN m s/rad",
    )
    panels.show_time(axes, next(iter(runs.values())), named=True)
