"""The paper's circle under three controllers that know the robot."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr._core import ReferencePath, TrackingController
from cdcr.base.arrays import FloatArray
from cdcr.control import lqr
from cdcr.model.model import Model
from cdcr.robots import amouri2020
from cdcr.runs.controllers import ComputedTorque, StateFeedback
from cdcr.runs.loop import Loop
from cdcr.runs.pid import Pid
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, run_metrics

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

THETA = math.pi / 12  # of the circle [rad]
ROUND = 10.0  # once round [s]
STEP = 1e-3  # [s]
START = math.radians(10.0)  # theta at the start [rad]
LEAST = 1.0  # tension of every cable [N]
LATE = 0.5  # share of the run after which errors of the start have gone
NAMES = ("computed torque", "regulator (LQR)", "PID loop")


def path() -> ReferencePath:
    """Return the circle in bending vectors."""
    return ReferencePath.circle([0, 0], [THETA, 0], [0, THETA], 1.0, ROUND, False)


def controllers(model: Model) -> dict[str, TrackingController]:
    """Return the three, by name."""
    limits: dict[str, Any] = {"min_tension": LEAST}
    gain = lqr(model, [0, 0], [LEAST] * 3, Q=[100, 100, 1, 1], R=0.01, period=STEP)
    made = (
        ComputedTorque(model, kp=64.0, kd=16.0, **limits),
        StateFeedback(model, gain=gain, **limits),
        Pid(model, kp=2.0, ki=4.0, kd=0.1, **limits),
    )
    return dict(zip(NAMES, made, strict=True))


@lru_cache(maxsize=1)
def errors(t_end: float) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Return times and the distance from the circle [rad] of each controller."""
    model = Model(amouri2020())
    found = {}
    for name, controller in controllers(model).items():
        controller.path = path()
        loop = Loop(model, controller, step=STEP)
        loop.reset([START, 0.0], [0.0, 0.0])
        run = loop.run(round(t_end / STEP) * STEP, record_every=10).trajectory
        found[name] = distance(run)
    return run.t, found


def distance(run: Trajectory) -> FloatArray:
    """Return the distance from the circle at each sample [rad]."""
    wanted = np.array([path().evaluate(t)[0] for t in run.t])
    return np.asarray(np.linalg.norm(run.q - wanted, axis=1))


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return what every run shows, and the largest error of each controller in the second half."""
    t, found = errors(float(run.t[-1]))
    late = t >= LATE * t[-1]
    keys = ("computed_torque", "lqr", "pid")
    return (
        *run_metrics(scenario, run),
        *(
            Metric(
                f"error_{key}_rad",
                f"{name}: largest error in the second half",
                float(found[name][late].max()),
                "rad",
            )
            for key, name in zip(keys, NAMES, strict=True)
        ),
    )
