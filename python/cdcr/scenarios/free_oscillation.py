"""The released robot: with and without damping, and what integrators add (Fig. 8)."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cdcr._model import Model
from cdcr._simulate import simulate
from cdcr._trajectory import Trajectory
from cdcr.robots import amouri2020
from cdcr.scenarios._findings import Finding, findings
from cdcr.scenarios._paper import source
from cdcr.scenarios._scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

START = math.pi / 4.0  # theta at t = 0 [rad]
SETTLED = 0.02  # share of the start
PAPER_TIME = 37.68  # when the paper's robot settles [s]
DAMPING = 9.12e-4  # with which this one does [N m s/rad]
# Integrators as a user might set them; 0.06 s is the paper's sample step, 1e-3 a usual default.
LOOSE: dict[str, dict[str, Any]] = {
    "rk4, step 0.06 s": {"method": "rk4", "step": 0.06},
    "bdf, rtol 1e-3": {"method": "bdf", "rtol": 1e-3, "atol": 1e-6},
    "bdf, rtol 1e-4": {"method": "bdf", "rtol": 1e-4, "atol": 1e-7},
    "adams, rtol 1e-3": {"method": "adams", "rtol": 1e-3, "atol": 1e-6},
    "dopri5, rtol 1e-3": {"method": "dopri5", "rtol": 1e-3, "atol": 1e-6},
}


def linear_settling_time(damping: float) -> float:
    """Return when the envelope of small oscillations has fallen to SETTLED [s]."""
    inertia = Model(amouri2020()).mass_matrix([0.0, 0.0])[0, 0]
    return float(2.0 * inertia * math.log(1.0 / SETTLED) / damping)


def amplitude(run: Trajectory) -> NDArray[np.float64]:
    """Return how far the robot would swing with its energy at each time (N,) [rad]."""
    stiffness = run.model.robot.sections[0].stiffness
    reach: NDArray[np.float64] = np.sqrt(2.0 * run.energy / stiffness)
    return reach


def settling_time(run: Trajectory) -> float:
    """Return when the amplitude falls below SETTLED of the start [s]; inf if it never does."""
    outside = np.flatnonzero(amplitude(run) > SETTLED * START)
    last = int(outside[-1])
    return float(run.t[last]) if last + 1 < len(run) else math.inf


@lru_cache(maxsize=2)
def variants(t_end: float) -> dict[str, Trajectory]:
    """Return the damped run and those of LOOSE integrators, by name."""
    t = np.linspace(0.0, t_end, max(2, round(t_end / 0.02) + 1))
    damped, free = Model(amouri2020(damping=DAMPING)), Model(amouri2020())
    runs = {"damped": simulate(damped, (START, 0.0), (0.0, 0.0), t=t, method="dopri5", rtol=1e-9)}
    for name, options in LOOSE.items():
        runs[name] = simulate(free, (START, 0.0), (0.0, 0.0), t=t, **options)
    return runs


def _tell(scenario: Scenario, run: Trajectory) -> tuple[Finding, ...]:
    others = variants(float(run.t[-1]))
    start, end = np.rad2deg(amplitude(run)[[0, -1]])
    linear = linear_settling_time(DAMPING)
    found = [
        *findings(scenario, run),
        Finding("amplitude_start_deg", "amplitude at the start", float(start), "deg"),
        Finding("amplitude_end_deg", "amplitude at the end", float(end), "deg"),
        Finding("settling_linear_s", "settles to 2 % with damping, linearised", linear, "s"),
    ]
    settled = settling_time(others["damped"])
    if math.isfinite(settled):
        found.append(Finding("settling_s", "settles to 2 % with damping", settled, "s"))
    for name in LOOSE:
        key = name.replace(", ", "_").replace(" ", "_")
        left = float(np.rad2deg(amplitude(others[name])[-1]))
        found.append(Finding(f"end_{key}_deg", f"amplitude at the end, {name}", left, "deg"))
    return tuple(found)


def _draw(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios._oscillation_figure import oscillation_figure

    return oscillation_figure(scenario.title, run)


SCENARIO = Scenario(
    name="free-oscillation",
    title="Released from θ = 45° without tension",
    description=(
        "The robot of Table 1 is let go at theta = pi/4, phi = 0, with slack cables. The paper's "
        "equations have no damping, so it swings for ever with the same amplitude and a period of "
        "about 0.69 s. In the paper's Fig. 8 it settles after 37.68 s: a viscous damping of "
        "9.12e-4 N m s/rad does that (to 2 %). Integrators with loose tolerances also take energy "
        "away, or add some, but none of those drawn comes near the paper's settling: rk4 with the "
        "paper's sample step of 0.06 s still has 37 deg of amplitude after 60 s."
    ),
    source=source("section 5.1 and Fig. 8"),
    paper_figure=8,
    robot=amouri2020(),
    q0=(START, 0.0),
    qd0=(0.0, 0.0),
    tension=(0.0, 0.0, 0.0),
    t_end=60.0,
    num_samples=3001,
    method="dopri5",
    rtol=1e-10,
    atol=1e-12,
    tell=_tell,
    draw=_draw,
)
