"""A cable with friction, pulled and released: the way back is not the way there."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cdcr._robot import Robot
from cdcr._simulate import TensionTable
from cdcr._trajectory import Trajectory
from cdcr.robots import amouri2020
from cdcr.scenarios._findings import Finding
from cdcr.scenarios._integral import integral
from cdcr.scenarios._paper import source
from cdcr.scenarios._scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

FRICTION = 0.25  # Coulomb's coefficient in all holes
SLIDING_SPEED = 5e-6  # a thousandth of that of the pulled cable [m/s]
DAMPING = 6e-3  # [N m s/rad]
FULL = 15.0  # largest tension of cable 1 [N]
RAMP = 20.0  # time to pull, and to release [s]
CYCLES = 2
END = 2 * RAMP * CYCLES  # [s]
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
    return run.model.tensions_along(run.q, run.qd, run.tension)[:, -1, 0]


def friction_power(run: Trajectory) -> FloatArray:
    """Return what friction turns into heat at each time (N,) [W]."""
    return np.asarray(run.model.friction_power(run.q, run.qd, run.tension))


def pulled(run: Trajectory) -> FloatArray:
    """Return how much of cable 1 has been pulled out of the robot at each time (N,) [m]."""
    lengths = run.model.cable_lengths(run.q)[:, 0]
    return np.asarray(lengths[0] - lengths)


@lru_cache(maxsize=2)
def frictionless(t_end: float) -> Trajectory:
    """Return the run without friction."""
    return replace(SCENARIO, robot=robot(0.0)).simulate(t_end=t_end)


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


def _tell(scenario: Scenario, run: Trajectory) -> tuple[Finding, ...]:
    loop = float(integral(run.tension[:, 0], pulled(run)))
    damped = DAMPING * float(integral(np.sum(run.qd**2, axis=1), run.t))
    by_loop = loop - damped - float(run.energy[-1] - run.energy[0])
    by_power = float(integral(friction_power(run), run.t))
    found = [
        Finding("loop_J", "work of the cable: area of the loops", loop, "J"),
        Finding("damping_J", "of it, to damping", damped, "J"),
        Finding("friction_loop_J", "to friction, by the loops", by_loop, "J"),
        Finding("friction_power_J", "to friction, by its power over time", by_power, "J"),
        Finding("difference", "relative difference of the two", by_power / by_loop - 1.0, ""),
    ]
    band = dead_band(run)
    if band is not None:
        fallen, theta = band
        expected = FULL * -np.expm1(-FRICTION * theta)
        found += [
            Finding("dead_band_N", "tension falls before the cable slides back", fallen, "N"),
            Finding("dead_band_expected_N", "the same, F (1 - exp(-mu theta))", expected, "N"),
        ]
    if run.t[-1] >= RAMP / 2.0:
        k = int(np.searchsorted(run.t, RAMP / 2.0))
        ratio = float(beyond(run)[k] / run.tension[k, 0])
        capstan = float(np.exp(-FRICTION * run.theta[k, 0]))
        found += [
            Finding("ratio", "tension beyond the section over that at the base", ratio, ""),
            Finding("capstan", "the same at full sliding, exp(-mu theta)", capstan, ""),
        ]
    return tuple(found)


def _draw(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios._pull_release_figure import pull_release_figure

    return pull_release_figure(scenario.title, run)


SCENARIO = Scenario(
    name="pull-release",
    title="Cable 1 pulled to 15 N and released, twice, with and without friction",
    description=(
        "The robot of Table 1, whose cables rub in the holes of the disks (mu = 0.25), has cable 1 "
        "pulled slowly to 15 N and released. Friction keeps tension from the far end while the "
        "cable is pulled and keeps it there while it is let out, so the tip lags: the tension must "
        "fall by the dead band before the tip comes back. The area of the loop is what friction "
        "takes, and a little damping."
    ),
    source=source("Table 1") + "; friction, damping and tensions ours",
    robot=robot(FRICTION),
    q0=(0.0, 0.0),
    qd0=(0.0, 0.0),
    tension=tension(),
    t_end=END,
    num_samples=8001,
    method="bdf",
    rtol=1e-8,
    atol=1e-10,
    tell=_tell,
    draw=_draw,
)
