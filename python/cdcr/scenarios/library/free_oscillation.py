"""The released robot: with and without damping, and what integrators add (Fig. 8)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from cdcr.robots import amouri2020
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, run_metrics
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.free_oscillation import (
    DAMPING,
    LOOSE,
    START,
    amplitude,
    linear_settling_time,
    settling_time,
    variants,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    others = variants(float(run.t[-1]))
    start, end = np.rad2deg(amplitude(run)[[0, -1]])
    linear = linear_settling_time(DAMPING)
    found = [
        *run_metrics(scenario, run),
        Metric("amplitude_start_deg", "amplitude at the start", float(start), "deg"),
        Metric("amplitude_end_deg", "amplitude at the end", float(end), "deg"),
        Metric("settling_linear_s", "settles to 2 % with damping, linearised", linear, "s"),
    ]
    settled = settling_time(others["damped"])
    if math.isfinite(settled):
        found.append(Metric("settling_s", "settles to 2 % with damping", settled, "s"))
    for name in LOOSE:
        key = name.replace(", ", "_").replace(" ", "_")
        left = float(np.rad2deg(amplitude(others[name])[-1]))
        found.append(Metric(f"end_{key}_deg", f"amplitude at the end, {name}", left, "deg"))
    return tuple(found)


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.free_oscillation import oscillation_figure

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
    source=paper_source("section 5.1 and Fig. 8"),
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
    summarize=_summarize,
    plot=_plot,
)
