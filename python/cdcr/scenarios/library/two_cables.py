"""Tensions on cables 1 and 2 (Fig. 10)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.model.coordinates import polar
from cdcr.robots import amouri2020
from cdcr.runs.command import TensionTable
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario, paper_source
from cdcr.scenarios.studies.two_cables import CABLE_1, CABLE_2, FULL, T

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    found = []
    for name, tension in (
        ("cable 1", (FULL, 0.0, 0.0)),
        ("cables 1 and 2", (FULL, FULL, 0.0)),
        ("cable 2", (0.0, FULL, 0.0)),
    ):
        q = run.model.equilibrium(tension)
        theta, phi = np.rad2deg(polar(q))
        key, tip = name.replace(" ", "_"), run.model.tip(q)[1]
        label = f"{FULL:g} N on {name}, settled"
        found += [
            Metric(f"{key}_theta_deg", f"{label}: theta", float(theta), "deg"),
            Metric(f"{key}_phi_deg", f"{label}: phi", float(phi), "deg"),
        ]
        found += [
            Metric(f"{key}_{axis}_m", f"{label}: tip {axis}", float(value), "m")
            for axis, value in zip("xyz", tip, strict=True)
        ]
    return tuple(found)


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.two_cables import two_cables_figure

    return two_cables_figure(scenario.title, run)


SCENARIO = Scenario(
    name="two-cables",
    title="Cable 1, then both, then cable 2 (a profile of our own)",
    description=(
        "The tensions of the paper's Fig. 10(a) are not in its text, so this profile is ours: "
        "cable 1 is pulled to 5 N, then cable 2, then cable 1 is let go, then cable 2, each within "
        "a second. The tip follows its settled positions, which are what the paper shows, and "
        "swings about them, since nothing damps it."
    ),
    source=paper_source("section 5.2 and Fig. 10") + "; tensions ours",
    paper_figure=10,
    robot=amouri2020(),
    q0=(0.0, 0.0),
    qd0=(0.0, 0.0),
    tension=TensionTable(T, np.stack([CABLE_1, CABLE_2, np.zeros(len(T))], axis=1)),
    t_end=12.0,
    num_samples=1201,
    method="dopri5",
    rtol=1e-9,
    atol=1e-11,
    summarize=_summarize,
    plot=_plot,
)
