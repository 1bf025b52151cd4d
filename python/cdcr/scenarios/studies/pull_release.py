"""A cable with friction, pulled and released: the way back is not the way there."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cdcr.model.model import Model
from cdcr.robot.robot import Robot
from cdcr.robots import amouri2020
from cdcr.runs.command import TensionTable
from cdcr.runs.simulate import simulate
from cdcr.runs.trajectory import Trajectory

FloatArray = NDArray[np.float64]

FRICTION = 0.25  # Coulomb's coefficient in all holes
SLIDING_SPEED = 5e-6  # a thousandth of that of the pulled cable [m/s]
DAMPING = 6e-3  # [N m s/rad]
FULL = 15.0  # largest tension of cable 1 [N]
RAMP = 20.0  # time to pull, and to release [s]
CYCLES = 2
END = 2 * RAMP * CYCLES  # [s]
STEP = 0.01  # between samples [s]
OPTIONS: dict[str, Any] = {"method": "bdf", "rtol": 1e-8, "atol": 1e-10}
ROWS = 200  # of the table of tensions, in each ramp
SLIDES = 0.95  # share of the friction at full sliding from which a cable counts as sliding


def robot(friction: float) -> Robot:
    """Return the robot of Table 1 with friction in the holes of its cables, and damping."""
    plain = amouri2020(damping=DAMPING)
    section = replace(plain.sections[0], cable_friction=friction)
    return replace(plain, sections=(section,), sliding_speed=SLIDING_SPEED)


def tension() -> TensionTable:
    """Return the tensions: cable 1 is pulled and released smoothly, again and again."""
    t = np.linspace(0.0, END, 2 * CYCLES * ROWS + 1)
    pulled = FULL / 2.0 * (1.0 - np.cos(np.pi * t / RAMP))
    return TensionTable(t, np.stack([pulled, 0.0 * t, 0.0 * t], axis=1))


def beyond(run: Trajectory) -> FloatArray:
    """Return the tension of cable 1 where it ends, beyond the section (N,) [N]."""
    states = zip(run.q, run.qd, run.tension, strict=True)
    return np.array([run.model.tensions_along(*state)[-1, 0] for state in states])


def friction_power(run: Trajectory) -> FloatArray:
    """Return what friction turns into heat at each time (N,) [W]."""
    states = zip(run.q, run.qd, run.tension, strict=True)
    return np.array([run.model.friction_power(*state) for state in states])


def pulled(run: Trajectory) -> FloatArray:
    """Return how much of cable 1 has been pulled out of the robot at each time (N,) [m]."""
    lengths = np.array([run.model.cable_lengths(q)[0] for q in run.q])
    return np.asarray(lengths[0] - lengths)


@lru_cache(maxsize=2)
def frictionless(t_end: float) -> Trajectory:
    """Return the run without friction."""
    t = np.linspace(0.0, t_end, 1 + round(t_end / STEP))
    rest = (0.0, 0.0)
    return simulate(Model(robot(0.0)), rest, rest, t=t, tension=tension(), **OPTIONS)


def dead_band(run: Trajectory) -> tuple[float, float] | None:
    """Return how far the tension falls until the cable slides back [N], and theta there [rad].

    None where the run ends before that.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        friction = np.log(beyond(run) / run.tension[:, 0]) / (FRICTION * np.abs(run.theta[:, 0]))
    back = np.flatnonzero((run.t > RAMP) & (friction >= SLIDES))
    if not back.size:
        return None
    k = back[0]
    return FULL - float(run.tension[k, 0]), abs(float(run.theta[k, 0]))
