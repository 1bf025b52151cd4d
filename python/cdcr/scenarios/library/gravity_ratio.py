"""What gravity does to the robot (Fig. 7)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cdcr._core import taylor_range
from cdcr.robots import amouri2020
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.gravity_ratio import (
    TENSION,
    WAYS,
    energy_ratio,
    linear_theta_deg,
    stiffness,
    theta_deg,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    start = 1.0 - stiffness("upright") / stiffness("no gravity")
    end = -float(energy_ratio(taylor_range, "upright")[0])
    found = [
        Metric("ratio_0", "gravitational over elastic energy at theta -> 0", 100.0 * start, "%"),
        Metric("ratio_end", "the same at theta = 3 pi/5", 100.0 * end, "%"),
    ]
    for way in WAYS:
        key, label = way.replace(" ", "_"), f"theta at {TENSION:g} N, {way}"
        linear = linear_theta_deg(TENSION, way)
        found += [
            Metric(f"theta_{key}_deg", label, theta_deg(TENSION, way), "deg"),
            Metric(f"theta_{key}_linear_deg", f"{label}, linearised", linear, "deg"),
        ]
    return tuple(found)


def _plot(scenario: Scenario, run: None) -> Figure:
    from cdcr.scenarios.figures.gravity_ratio import gravity_figure

    return gravity_figure(scenario.title)


SCENARIO = Scenario(
    name="gravity-ratio",
    title="Gravitational over elastic energy, and what gravity does to the equilibrium at 5 N",
    description=(
        "The paper neglects gravity, finding its energy below 0.27 % of the elastic one. With the "
        "masses of Table 1 and g = 9.81 m/s^2 it is 23.8 % near straight and 21.0 % at 3 pi/5, "
        "so 0.27 was perhaps a ratio, read as per cent. Under 5 N on cable 1 the robot bends by "
        "14.98 deg without gravity, about 20 deg standing upright and 12 deg hanging."
    ),
    source=paper_source("section 4.2 and Fig. 7"),
    paper_figure=7,
    robot=amouri2020(),
    summarize=_summarize,
    plot=_plot,
)
