"""The inertias M11 and M22, whole and cut after theta^4 (Fig. 6)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr._core import taylor_range
from cdcr.robots import amouri2020
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.kinetic_energy_terms import WAYS, taylor_errors, terms

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    end, robot = np.array([taylor_range]), scenario.robot
    found = []
    for way in WAYS:
        values, errors = terms(end, robot, way)[0], taylor_errors(end, robot, way)
        for term, value, error in zip(("M11", "M22"), values, errors, strict=True):
            key, label = f"{term}_{way}", f"{term}, {way}"
            found += [
                Metric(f"{key}_end", f"{label}, at 3 pi/5", 1e3 * float(value[0]), "1e-3 kg m^2"),
                Metric(f"{key}_error", f"{label}: error of Taylor", float(error[0]), "%"),
            ]
    return tuple(found)


def _plot(scenario: Scenario, run: None) -> Figure:
    from cdcr.scenarios.figures.kinetic_energy_terms import inertia_figure

    return inertia_figure(scenario.title, scenario.robot)


SCENARIO = Scenario(
    name="kinetic-energy-terms",
    title="Terms of the kinetic energy: M₁₁ and M₂₂, exact and cut after θ⁴",
    description=(
        "Twice the kinetic energy is M11 thetad^2 + M22 phid^2, eq. (21) with the factors of "
        "eq. (9) and the masses of Table 1. The paper finds Taylor polynomials good to 0.05 %: "
        "that holds, nearly, for M11 (0.056 % at 3 pi/5), but M22 is 13.8 % too small there, or "
        "12.6 % in eq. (21) as printed, which lacks the 1/3 and 1/4 of eq. (9)."
    ),
    source=paper_source("section 4.1.4 and Fig. 6"),
    paper_figure=6,
    robot=amouri2020(),
    summarize=_summarize,
    plot=_plot,
)
