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

COMPARED = 2  # modes, by coordinates and by time
MARKS = ("o", "s", "^")


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw frequencies and errors over parts, errors over coordinates and time, responses."""
    with style():
        figure = new_figure(scenario.title, (12.4, 10.6))
        grid = figure.add_gridspec(3, 2, height_ratios=[1.15, 1.0, 0.9])
        _draw_frequencies(figure.add_subplot(grid[0, 0]))
        _draw_convergence(figure.add_subplot(grid[0, 1]))
        by_size, by_time = figure.add_subplot(grid[1, 0]), figure.add_subplot(grid[1, 1])
        _compare(by_size, "number of coordinates", _coordinates())
        times = study.processor_times()
        spans = [[1e3 * span for span in times[kind].values()] for kind in ("parts", "orders")]
        _compare(by_time, f"processor time of {study.END:g} s of motion [ms]", spans)
        by_size.set_xticks(sizes := [2, 4, 8, 16, 32], [str(size) for size in sizes])
        note(by_size, "full: parts, dashed: orders of bending")
        _draw_responses(figure.add_subplot(grid[2, :]))
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


def _coordinates() -> list[list[float]]:
    """Return the numbers of coordinates of the parts and of the orders compared."""
    return [[2.0 * parts for parts in study.PARTS], [2.0 * (k + 1) for k in study.ORDERS]]


def _compare(axes: Axes, name: str, places: list[list[float]]) -> None:
    """Draw the errors of the first two modes by parts and by orders, over what they cost."""
    parts = [study.excess(count) for count in study.PARTS]
    orders = [study.order_excess(k) for k in study.ORDERS]
    for mode, (color, mark) in enumerate(zip(COLORS[:COMPARED], MARKS, strict=False)):
        for found, place, dashes in zip((parts, orders), places, ("-", "--"), strict=True):
            points = [
                (x, 100.0 * one[mode])
                for x, one in zip(place, found, strict=True)
                if len(one) > mode
            ]
            axes.plot(*zip(*points, strict=True), color=color, marker=mark, ls=dashes, markersize=5)
    for k, x in zip(study.ORDERS, places[1], strict=True):
        name_point(axes, f"order {k}", (x, 100.0 * orders[k - 1][0]), (-8, -3), ha="right")
    last = study.PARTS[-1]
    point = (places[0][-1], 100.0 * parts[-1][0])
    name_point(axes, f"{last} parts", point, (0, -11), ha="center", va="top")
    axes.set(xscale="log", yscale="log", xlabel=name, ylabel="frequency too high by [%]")
    axes.margins(x=0.12)
    axes.minorticks_off()


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
