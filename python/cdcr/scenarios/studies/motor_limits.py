"""A PID loop whose motors are too slow, with and without anti-windup."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.model.coordinates import bending
from cdcr.model.model import Model
from cdcr.robots import amouri2020
from cdcr.runs.loop import Loop
from cdcr.runs.parts import Actuator
from cdcr.runs.pid import Pid
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, run_metrics

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

TARGET = 20.0  # theta [deg]
STRONGEST, FASTEST = 7.0, 5.0  # of the motors [N], [N/s]
KP, KI, KD = 0.8, 4.0, 0.1  # [N m/rad], [N m/(rad s)], [N m s/rad]
STEP = 1e-3  # [s]
NAMES = ("limits, anti-windup", "limits, no anti-windup", "no limits")


@lru_cache(maxsize=1)
def runs(t_end: float) -> dict[str, Trajectory]:
    """Return the three loops, by name."""
    model = Model(amouri2020(damping=0.05))
    found = {}
    for name in NAMES:
        limited = name != NAMES[2]
        limits: dict[str, Any] = {}
        if limited:
            limits = {"max_tension": STRONGEST, "max_rate": FASTEST}
        pid = Pid(
            model,
            kp=KP,
            ki=KI,
            kd=KD,
            period=2e-3,
            feed_forward=False,
            anti_windup=name != NAMES[1],
            **limits,
        )
        pid.reference = bending(np.deg2rad(TARGET), 0.0)
        motors = Actuator(max_command=STRONGEST, max_rate=FASTEST) if limited else ()
        loop = Loop(model, pid, step=STEP, actuators=motors)
        loop.reset([0.0, 0.0], [0.0, 0.0])
        found[name] = loop.run(round(t_end / STEP) * STEP, record_every=5).trajectory
    return found


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return what every run shows, and how far each loop goes beyond its goal."""
    keys = ("limits_anti_windup", "limits", "no_limits")
    found = runs(float(run.t[-1]))
    over = {name: float(np.rad2deg(one.theta).max()) - TARGET for name, one in found.items()}
    return (
        *run_metrics(scenario, run),
        *(
            Metric(f"overshoot_{key}_deg", f"{name}: overshoot", over[name], "deg")
            for key, name in zip(keys, NAMES, strict=True)
        ),
    )
