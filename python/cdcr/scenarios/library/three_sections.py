"""Each section of a robot of three driven in turn, the others held straight."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from cdcr.model.coordinates import polar
from cdcr.robots import three_sections
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario
from cdcr.scenarios.studies.energy import energy_gap
from cdcr.scenarios.studies.sections import HANGING
from cdcr.scenarios.studies.three_sections import (
    BENT,
    DAMPING,
    PHASE,
    STEP,
    ends,
    goals,
    own_cables_alone,
    tensions,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    model = run.model
    straight = model.tip(np.zeros(model.num_coordinates))[1]
    found = []
    for k, last in ends(run):
        key, at = f"section_{k + 1}", f"section {k + 1} driven"
        moved = 1e3 * float(np.linalg.norm(run.tip[last] - straight))
        error = float(np.rad2deg(np.max(np.abs(run.q[last] - goals()[k]))))
        held = run.tension[last]
        found += [
            Metric(f"{key}_tip_mm", f"{at}: tip from the straight robot's", moved, "mm"),
            Metric(f"{key}_error_deg", f"{at}: bending off the goal, end", error, "deg"),
            Metric(f"{key}_tension_N", f"{at}: largest tension", float(held.max()), "N"),
        ]
        angles = np.rad2deg(polar(own_cables_alone(model, k))[0])
        for i in range(k):
            name, label = f"{key}_alone_{i + 1}_deg", f"its cables alone would bend section {i + 1}"
            found.append(Metric(name, f"{at}: {label} by", float(angles[i]), "deg"))
    gap = Metric("energy_gap", "relative gap of the energy balance", energy_gap(run), "")
    return (*found, gap)


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.sections import three_sections_figure

    return three_sections_figure(scenario.title, run)


SCENARIO = Scenario(
    name="three-sections",
    title="Three sections driven in turn",
    description=(
        "A robot of three sections hangs straight down. Every five seconds another section is bent "
        "by 60 or 90 deg within a second, and the others are held straight. The cables of a "
        "section run through all sections before it and bend them too, as does the weight that "
        "hangs on them: other cables must pull against that. The tensions are the least that hold "
        "each shape, found by inverse dynamics at rest."
    ),
    source="example design of this project, robot three_sections hanging down",
    robot=replace(
        three_sections(gravity=(0.0, 0.0, -9.81), damping=DAMPING), base_orientation=HANGING
    ),
    q0=(0.0,) * 6,
    qd0=(0.0,) * 6,
    tension=tensions,
    t_end=PHASE * len(BENT),
    num_samples=round(PHASE * len(BENT) / STEP) + 1,
    method="dopri5",
    rtol=1e-10,
    atol=1e-12,
    summarize=_summarize,
    plot=_plot,
)
