"""A cable with friction, pulled and released: the way back is not the way there."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.studies.energy import integral

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

FULL = 15.0  # largest tension of cable 1 [N]
RAMP = 20.0  # time to pull, and to release [s]
SLIDES = 0.95  # share of the friction at full sliding from which a cable counts as sliding


def coefficients(run: Trajectory) -> tuple[float, float]:
    """Return Coulomb's coefficient in all holes, and the damping [N m s/rad]."""
    (section,) = run.model.robot.sections
    return section.cable_friction, section.damping


def beyond(run: Trajectory) -> FloatArray:
    """Return the tension of cable 1 where it ends, beyond the section (N,) [N]."""
    return run.model.tensions_along(run.q, run.qd, run.tension)[:, -1, 0]


def friction_power(run: Trajectory) -> FloatArray:
    """Return what friction turns into heat at each time (N,) [W]."""
    return np.asarray(run.model.friction_power(run.q, run.qd, run.tension))


def pulled(run: Trajectory) -> FloatArray:
    """Return how much of cable 1 has been pulled out of the robot at each time (N,) [m]."""
    lengths = run.model.cable_lengths(run.q)[:, 0]
    return np.asarray(lengths[0] - lengths)


@lru_cache(maxsize=2)
def frictionless(scenario: Scenario, t_end: float) -> Trajectory:
    """Return the run without friction."""
    sections = tuple(replace(one, cable_friction=0.0) for one in scenario.robot.sections)
    return replace(scenario, robot=replace(scenario.robot, sections=sections)).simulate(t_end=t_end)


def dead_band(run: Trajectory) -> tuple[float, float] | None:
    """Return how far the tension falls until the cable slides back [N], and theta there [rad].

    None where the run ends before that.
    """
    full, _ = coefficients(run)
    with np.errstate(divide="ignore", invalid="ignore"):
        friction = np.log(beyond(run) / run.tension[:, 0]) / (full * np.abs(run.theta[:, 0]))
    back = np.flatnonzero((run.t > RAMP) & (friction >= SLIDES))
    if not back.size:
        return None
    k = back[0]
    return FULL - float(run.tension[k, 0]), abs(float(run.theta[k, 0]))


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return where the work of the cable goes, the dead band, and the capstan's ratio."""
    friction, damping = coefficients(run)
    loop = float(integral(run.tension[:, 0], pulled(run)))
    damped = damping * float(integral(np.sum(run.qd**2, axis=1), run.t))
    by_loop = loop - damped - float(run.energy[-1] - run.energy[0])
    by_power = float(integral(friction_power(run), run.t))
    found = [
        Metric("loop_J", "work of the cable: area of the loops", loop, "J"),
        Metric("damping_J", "of it, to damping", damped, "J"),
        Metric("friction_loop_J", "to friction, by the loops", by_loop, "J"),
        Metric("friction_power_J", "to friction, by its power over time", by_power, "J"),
        Metric("difference", "relative difference of the two", by_power / by_loop - 1.0, ""),
    ]
    band = dead_band(run)
    if band is not None:
        fallen, theta = band
        expected = FULL * -np.expm1(-friction * theta)
        found += [
            Metric("dead_band_N", "tension falls before the cable slides back", fallen, "N"),
            Metric("dead_band_expected_N", "the same, F (1 - exp(-mu theta))", expected, "N"),
        ]
    if run.t[-1] >= RAMP / 2.0:
        k = int(np.searchsorted(run.t, RAMP / 2.0))
        ratio = float(beyond(run)[k] / run.tension[k, 0])
        capstan = float(np.exp(-friction * run.theta[k, 0]))
        found += [
            Metric("ratio", "tension beyond the section over that at the base", ratio, ""),
            Metric("capstan", "the same at full sliding, exp(-mu theta)", capstan, ""),
        ]
    return tuple(found)
