"""A robot of several sections that swings to rest once it is let go or its payload falls off."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, settling_time
from cdcr.scenarios.studies.energy import dissipated, energy_gap, fine_run

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SETTLED = 0.02  # share of the first distance


def distance(run: Trajectory, q: FloatArray) -> FloatArray:
    """Return how far the tip is (N,) from where it is at q (d,) [m]."""
    away: FloatArray = np.linalg.norm(run.tip - run.model.tip(q)[1], axis=1)
    return away


def at_rest(run: Trajectory) -> FloatArray:
    """Return q (d,) where a run under constant tensions comes to rest [rad]."""
    return run.model.equilibrium(run.command[0])


def lift(run: Trajectory) -> float:
    """Return the first acceleration of the tip upwards [m/s^2]."""
    model = run.model
    start = model.forward_dynamics(run.q[0], run.qd[0], run.tension[0])
    return float((model.tip_jacobian(run.q[0]) @ start)[2])


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return how the tip leaves, swings and settles, and where the energy goes."""
    rest = at_rest(run)
    away = distance(run, rest)
    x, _, z = run.model.tip(rest)[1]
    fine = fine_run(scenario, run)
    loss = float(dissipated(fine)[-1])
    found = []
    if run.tension.any():  # held until now, by the cables
        label = "the tip's first acceleration upwards"
        found.append(Metric("lift_m_s2", label, lift(run), "m/s^2"))
    found += [
        Metric("start_distance_mm", "tip from where it comes to rest, start", 1e3 * away[0], "mm"),
        Metric("end_distance_mm", "the same, end", 1e3 * float(away[-1]), "mm"),
        Metric("rest_x_m", "tip at rest: x", float(x), "m"),
        Metric("rest_z_m", "tip at rest: z", float(z), "m"),
        Metric("highest_m", "highest place of the tip", float(run.tip[:, 2].max()), "m"),
        Metric("lowest_m", "lowest place of the tip", float(run.tip[:, 2].min()), "m"),
    ]
    settled = settling_time(run.t, away, SETTLED * away[0])
    if settled is not None:
        label = f"within {100 * SETTLED:g} % of the first distance from"
        found.append(Metric("settling_s", label, settled, "s"))
    return (
        *found,
        Metric("dissipated_mJ", "energy taken by damping", 1e3 * loss, "mJ"),
        Metric("energy_gap", "relative gap of the energy balance", energy_gap(fine), ""),
    )
