"""The picture of two inertia factors and of the errors of their Taylor polynomials."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting.panels import keep_span
from cdcr.plotting.style import COLORS, StyledFigure, style
from cdcr.scenarios.figures.drawing import (
    bending_angles,
    legend_below,
    new_figure,
    note,
    show_angle,
)
from cdcr.scenarios.studies.factors import FACTORS, cut, kinds, taylor_error, value

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (10.4, 6.8)  # [in]
MIN_ERROR = 0.02  # smallest span of an error shown, so that rounding noise fills no panel [%]
# Colour, and what kind is called in the legend.
DERIVED, PRINTED = (COLORS[0], "derived from eqs. (1) to (4)"), (COLORS[1], "as printed")
WIDE = 3.4  # line under the dashes of its own Taylor polynomial


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw two factors over theta at the left, the errors of their Taylor polynomials beside."""
    pair, remarks = FACTORS[scenario.name]
    with style():
        figure = new_figure(scenario.title, SIZE)
        panels = figure.subplots(2, 2, sharex=True)
        for row, factor in enumerate(pair):
            _draw_values(panels[row, 0], factor)
            _draw_errors(panels[row, 1], factor)
            for axes in panels[row]:
                show_angle(axes, named=row == 1)
        figure.align_ylabels()
        fullest = max(panels[:, 0], key=lambda axes: len(axes.get_lines()))
        legend_below(figure, fullest, ncols=4)
        note(panels[0, 0], remarks)
        note(panels[0, 1], r"error of the factor cut after $\theta^4$")
    return figure


def _draw_values(axes: Axes, factor: str) -> None:
    theta = bending_angles()
    for kind in kinds(factor):
        color, word = DERIVED if kind == "exact" else PRINTED
        whole, series = value(factor, theta, kind), value(factor, theta, cut(kind))
        angle = np.rad2deg(theta)
        axes.plot(angle, whole, color=color, linewidth=WIDE, alpha=0.45, label=word)
        axes.plot(angle, series, color=color, linestyle="--", label=rf"{word}, to $\theta^4$")
    axes.set_ylabel(f"$H_{factor[1:]}$ [1]")
    keep_span(axes, 0.02 * float(np.max(np.abs(axes.get_ylim()))))


def _draw_errors(axes: Axes, factor: str) -> None:
    theta = bending_angles()
    for kind in kinds(factor):
        color, _ = DERIVED if kind == "exact" else PRINTED
        dashes = "-" if kind == "exact" else "--"  # they often coincide
        error = taylor_error(factor, theta, kind)
        axes.plot(np.rad2deg(theta), error, color=color, linestyle=dashes)
    axes.set_ylabel(rf"error of $\bar H_{factor[1:]}$ [%]")
    keep_span(axes, MIN_ERROR)
