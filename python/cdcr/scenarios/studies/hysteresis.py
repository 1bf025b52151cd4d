"""Friction that remembers: loops within loops, and no creep."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from cdcr.model.quasi_static import QuasiStatic, quasi_static
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.studies.energy import integral

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

HELD = 52.5  # from here on the tension is held [s]
SETTLED = 54.5  # from here on a robot that does not creep is at rest [s]
SAMPLES = 400  # of the same way without time


@lru_cache(maxsize=2)
def forgetting(scenario: Scenario, t_end: float) -> Trajectory:
    """Return the run with the friction of the sliding speed, without memory."""
    robot = replace(scenario.robot, presliding_stiffness=0.0)
    return replace(scenario, robot=robot).simulate(t_end=t_end)


def slowly(run: Trajectory) -> QuasiStatic:
    """Return the same way, followed without time."""
    every = max(1, len(run) // SAMPLES)
    return quasi_static(run.model, run.command[::every])


def creep(run: Trajectory) -> float:
    """Return how far the robot moves once it should have settled [deg]."""
    held = np.degrees(run.theta[run.t >= SETTLED, 0])
    return float(np.ptp(held)) if held.size else 0.0


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return the heat, the creep of both laws, and how far the run is from one without time."""
    lengths = run.model.cable_lengths(run.q)[:, 0]
    work = -float(integral(run.tension[:, 0], lengths))
    heat = float(integral(run.friction_power, run.t))
    still = slowly(run)
    every = max(1, len(run) // SAMPLES)
    behind = np.degrees(np.max(np.abs(still.q[:, 0] - run.q[::every][: len(still), 0])))
    return (
        Metric("work_J", "work of the cable", work, "J"),
        Metric("friction_J", "heat of friction", heat, "J"),
        Metric("creep_deg", "creep while held, with memory", creep(run), "deg"),
        Metric("creep_forgetting_deg", "the same without memory",
               creep(forgetting(scenario, float(run.t[-1]))), "deg"),
        Metric("behind_deg", "largest distance from the way without time", float(behind), "deg"),
    )  # fmt: skip
