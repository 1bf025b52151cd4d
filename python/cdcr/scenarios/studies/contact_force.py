"""A force on the tip as an observer and as a filter find it."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.runs.parts import Sensor
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, run_metrics

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

NAMES = ("momentum observer", "Kalman filter, from lengths")
LENGTHS = Sensor(kind="lengths", noise=1e-5)
FILTER: dict[str, Any] = {
    "kind": "extended-kalman",
    "options": {"period": 1e-3, "actuators": True, "force_at": (2, 1.0), "force_noise": 0.1},
}
SETTLED = 0.5  # share of the run


def truth(scenario: Scenario) -> FloatArray:
    """Return the force (3,) [N]."""
    return np.asarray(scenario.wrenches[0].force)


@lru_cache(maxsize=1)
def forces(scenario: Scenario, t_end: float) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Return times and the forces (N, 3) [N] that each finds, by name."""
    model = scenario.model
    closed: Any = scenario.input_source
    options = closed.options | {"sensors": [LENGTHS]}
    loops = closed, replace(closed, options=options, estimator=replace(closed.estimator, **FILTER))
    start, t = (scenario.start(model), scenario.qd0), scenario.times(t_end)
    found = {}
    for name, one in zip(NAMES, loops, strict=True):
        run = one.run_loop(model, *start, t, wrenches=scenario.wrenches)
        found[name] = np.stack([run.estimated[f"force_{axis}"] for axis in "xyz"], axis=1)
    return t, found


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return what every run shows, and how far each force is off."""
    t, found = forces(scenario, float(run.t[-1]))
    wanted = truth(scenario)
    metrics = [*run_metrics(scenario, run)]
    for key, name in zip(("observer", "filter"), NAMES, strict=True):
        off = np.linalg.norm(found[name][t >= SETTLED * t[-1]] - wanted, axis=1).max()
        share = float(100.0 * off / np.linalg.norm(wanted))
        metrics.append(
            Metric(f"error_{key}_percent", f"{name}: largest error, second half", share, "%")
        )
    return tuple(metrics)
