"""The picture of M11 and M22 and of the errors of their Taylor polynomials."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.plotting.style import ALARM, COLORS, StyledFigure, style
from cdcr.scenarios.figures.drawing import (
    bending_angles,
    legend_below,
    new_figure,
    note,
    show_angle,
)
from cdcr.scenarios.studies.kinetic_energy_terms import CLAIM, taylor_errors, terms

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (10.4, 6.8)  # [in]
LINES = {
    "derived": (COLORS[0], "-", "derived from eqs. (1) to (4)"),
    "printed": (COLORS[1], "--", "eq. (21) as printed"),
}


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw M11 and M22 over theta at the left, the errors of their Taylor polynomials beside."""
    theta = bending_angles()
    angle = np.rad2deg(theta)
    with style():
        figure = new_figure(scenario.title, SIZE)
        panels = figure.subplots(2, 2, sharex=True)
        for row, (values, errors) in enumerate(panels):
            for way, (color, dashes, word) in LINES.items():
                whole, series = (1e3 * both[row] for both in terms(theta, scenario.robot, way))
                values.plot(angle, whole, color=color, linewidth=3.4, alpha=0.45, label=word)
                cut = rf"{word}, to $\theta^4$"
                values.plot(angle, series, color=color, linestyle="--", label=cut)
                error = taylor_errors(theta, scenario.robot, way)[row]
                errors.plot(angle, error, color=color, linestyle=dashes)
            for sign in (1.0, -1.0)[: row + 1]:
                errors.axhline(sign * CLAIM, color=ALARM, linewidth=1.1, linestyle=":")
            values.set_ylabel(f"$M_{{{row + 1}{row + 1}}}$ [$10^{{-3}}$ kg m$^2$]")
            errors.set_ylabel(f"error of $M_{{{row + 1}{row + 1}}}$ [%]")
            show_angle(values, named=row == 1)
            show_angle(errors, named=row == 1)
        note(panels[0, 0], r"inertia of $\dot\theta$")
        note(panels[1, 0], r"inertia of $\dot\varphi$")
        note(panels[0, 1], rf"error of the terms cut after $\theta^4$; dotted: {CLAIM} %")
        figure.align_ylabels()
        legend_below(figure, panels[0, 0])
    return figure
