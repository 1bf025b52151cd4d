"""A cable with friction, pulled and released: the way back is not the way there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.energy import integral
from cdcr.scenarios.studies.pull_release import (
    DAMPING,
    END,
    FRICTION,
    FULL,
    OPTIONS,
    RAMP,
    STEP,
    beyond,
    dead_band,
    friction_power,
    pulled,
    robot,
    tension,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    loop = float(integral(run.tension[:, 0], pulled(run)))
    damped = DAMPING * float(integral(np.sum(run.qd**2, axis=1), run.t))
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
        expected = FULL * -np.expm1(-FRICTION * theta)
        found += [
            Metric("dead_band_N", "tension falls before the cable slides back", fallen, "N"),
            Metric("dead_band_expected_N", "the same, F (1 - exp(-mu theta))", expected, "N"),
        ]
    if run.t[-1] >= RAMP / 2.0:
        k = int(np.searchsorted(run.t, RAMP / 2.0))
        ratio = float(beyond(run)[k] / run.tension[k, 0])
        capstan = float(np.exp(-FRICTION * run.theta[k, 0]))
        found += [
            Metric("ratio", "tension beyond the section over that at the base", ratio, ""),
            Metric("capstan", "the same at full sliding, exp(-mu theta)", capstan, ""),
        ]
    return tuple(found)


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.pull_release import pull_release_figure

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
    source=paper_source("Table 1") + "; friction, damping and tensions ours",
    robot=robot(FRICTION),
    q0=(0.0, 0.0),
    qd0=(0.0, 0.0),
    tension=tension(),
    t_end=END,
    num_samples=round(END / STEP) + 1,
    **OPTIONS,
    summarize=_summarize,
    plot=_plot,
)
