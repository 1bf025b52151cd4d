"""Each section of a robot of three driven in turn, the others held straight."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.coordinates import polar
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.studies.energy import energy_gap

if TYPE_CHECKING:
    from cdcr.scenarios.file.tension import Hold
    from cdcr.scenarios.scenario import Scenario


def goals(scenario: Scenario) -> FloatArray:
    """Return the shape of each phase (3, 6): one section is bent, the others are straight."""
    return cast("Hold", scenario.tension).q[2::2]


def ends(scenario: Scenario, run: Trajectory) -> list[tuple[int, int]]:
    """Return each phase that the run comes to the end of, with its last sample."""
    times = enumerate(cast("Hold", scenario.tension).t[2::2])
    half = (run.t[1] - run.t[0]) / 2.0
    return [(k, int(np.searchsorted(run.t, t - half))) for k, t in times if t <= run.t[-1]]


def own_cables_alone(run: Trajectory, k: int, last: int) -> FloatArray:
    """Return q (2n,) at rest if only the cables that end at section k pulled, as at a sample."""
    own = np.array([cable.end_section == k for cable in run.model.robot.all_cables])
    return run.model.equilibrium(np.where(own, run.tension[last], 0.0))


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return how near each phase comes to its goal, and what the driven cables alone would do."""
    model = run.model
    straight = model.tip(np.zeros(model.num_coordinates))[1]
    shapes, found = goals(scenario), []
    for k, last in ends(scenario, run):
        key, at = f"section_{k + 1}", f"section {k + 1} driven"
        moved = 1e3 * float(np.linalg.norm(run.tip[last] - straight))
        error = float(np.rad2deg(np.max(np.abs(run.q[last] - shapes[k]))))
        held = run.tension[last]
        found += [
            Metric(f"{key}_tip_mm", f"{at}: tip from the straight robot's", moved, "mm"),
            Metric(f"{key}_error_deg", f"{at}: bending off the goal, end", error, "deg"),
            Metric(f"{key}_tension_N", f"{at}: largest tension", float(held.max()), "N"),
        ]
        angles = np.rad2deg(polar(own_cables_alone(run, k, last))[0])
        for i in range(k):
            name, label = f"{key}_alone_{i + 1}_deg", f"its cables alone would bend section {i + 1}"
            found.append(Metric(name, f"{at}: {label} by", float(angles[i]), "deg"))
    gap = Metric("energy_gap", "relative gap of the energy balance", energy_gap(run), "")
    return (*found, gap)
