"""Tensions on cables 1 and 2 (Fig. 10)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.coordinates import polar
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

FULL = 5.0  # of a pulled cable [N]
RESTS = {"cable 1": 3.0, "cables 1 and 2": 6.0, "cable 2": 9.0}  # times between ramps [s]


def settled(run: Trajectory) -> FloatArray:
    """Return the bending vectors of rest (N, 2) under the tensions of each time [rad]."""
    return np.array([run.model.equilibrium(tension) for tension in run.tension])


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return where the robot settles under each of the pulls."""
    found = []
    for name, tension in (
        ("cable 1", (FULL, 0.0, 0.0)),
        ("cables 1 and 2", (FULL, FULL, 0.0)),
        ("cable 2", (0.0, FULL, 0.0)),
    ):
        q = run.model.equilibrium(tension)
        theta, phi = np.rad2deg(polar(q))
        key, tip = name.replace(" ", "_"), run.model.tip(q)[1]
        label = f"{FULL:g} N on {name}, settled"
        found += [
            Metric(f"{key}_theta_deg", f"{label}: theta", float(theta), "deg"),
            Metric(f"{key}_phi_deg", f"{label}: phi", float(phi), "deg"),
        ]
        found += [
            Metric(f"{key}_{axis}_m", f"{label}: tip {axis}", float(value), "m")
            for axis, value in zip("xyz", tip, strict=True)
        ]
    return tuple(found)
