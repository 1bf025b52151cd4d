"""The released robot: with and without damping, and what integrators add (Fig. 8)."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.robots import amouri2020
from cdcr.runs.simulate import available, simulate
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, run_metrics, settling_time

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SETTLED = 0.02  # share of the start
PAPER_TIME = 37.68  # when the paper's robot settles [s]
DAMPING = 9.12e-4  # with which this one does [N m s/rad]
# Integrators as a user might set them; 0.06 s is the paper's sample step, 1e-3 a usual default.
INTEGRATORS: dict[str, dict[str, Any]] = {
    "rk4, step 0.06 s": {"method": "rk4", "step": 0.06},
    "bdf, rtol 1e-3": {"method": "bdf", "rtol": 1e-3, "atol": 1e-6},
    "bdf, rtol 1e-4": {"method": "bdf", "rtol": 1e-4, "atol": 1e-7},
    "adams, rtol 1e-3": {"method": "adams", "rtol": 1e-3, "atol": 1e-6},
    "dopri5, rtol 1e-3": {"method": "dopri5", "rtol": 1e-3, "atol": 1e-6},
}
LOOSE = {name: told for name, told in INTEGRATORS.items() if available(told["method"])}


def linear_settling_time(damping: float) -> float:
    """Return when the envelope of small oscillations has fallen to SETTLED [s]."""
    inertia = Model(amouri2020()).mass_matrix([0.0, 0.0])[0, 0]
    return float(2.0 * inertia * math.log(1.0 / SETTLED) / damping)


def amplitude(run: Trajectory) -> FloatArray:
    """Return how far the robot would swing with its energy at each time (N,) [rad]."""
    stiffness = run.model.robot.sections[0].stiffness
    reach: FloatArray = np.sqrt(2.0 * run.energy / stiffness)
    return reach


@lru_cache(maxsize=2)
def variants(scenario: Scenario, t_end: float) -> dict[str, Trajectory]:
    """Return the damped run and those of LOOSE integrators, by name."""
    q0, qd0 = scenario.start(scenario.model), scenario.qd0
    t = np.linspace(0.0, t_end, max(2, round(t_end / 0.02) + 1))
    damped, free = Model(amouri2020(damping=DAMPING)), Model(amouri2020())
    runs = {"damped": simulate(damped, q0, qd0, t=t, method="dopri5", rtol=1e-9)}
    for name, options in LOOSE.items():
        runs[name] = simulate(free, q0, qd0, t=t, **options)
    return runs


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return how the robot swings, and what damping and loose integrators make of it."""
    others = variants(scenario, float(run.t[-1]))
    start, end = np.rad2deg(amplitude(run)[[0, -1]])
    linear = linear_settling_time(DAMPING)
    found = [
        *run_metrics(scenario, run),
        Metric("amplitude_start_deg", "amplitude at the start", float(start), "deg"),
        Metric("amplitude_end_deg", "amplitude at the end", float(end), "deg"),
        Metric("settling_linear_s", "settles to 2 % with damping, linearised", linear, "s"),
    ]
    left = amplitude(others["damped"])
    settled = settling_time(others["damped"].t, left, SETTLED * left[0])
    if settled is not None:
        found.append(Metric("settling_s", "settles to 2 % with damping", settled, "s"))
    for name in LOOSE:
        key = name.replace(", ", "_").replace(" ", "_")
        last = float(np.rad2deg(amplitude(others[name])[-1]))
        found.append(Metric(f"end_{key}_deg", f"amplitude at the end, {name}", last, "deg"))
    return tuple(found)
