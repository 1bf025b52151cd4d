"""Tensions on cables 1 and 2 (Fig. 10)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cdcr._coordinates import polar
from cdcr._simulate import TensionTable
from cdcr._trajectory import Trajectory
from cdcr.robots import amouri2020
from cdcr.scenarios._findings import Finding
from cdcr.scenarios._paper import source
from cdcr.scenarios._scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FULL = 5.0  # [N]
# When cable 1 and cable 2 are pulled: ramps of one second between rests of two [s], [N].
T = (0.0, 1.0, 2.0, 4.0, 5.0, 7.0, 8.0, 10.0, 11.0, 12.0)
CABLE_1 = (0.0, 0.0, FULL, FULL, FULL, FULL, 0.0, 0.0, 0.0, 0.0)
CABLE_2 = (0.0, 0.0, 0.0, 0.0, FULL, FULL, FULL, FULL, 0.0, 0.0)
RESTS = {"cable 1": 3.0, "cables 1 and 2": 6.0, "cable 2": 9.0}  # times between ramps [s]


def settled(run: Trajectory) -> NDArray[np.float64]:
    """Return the bending vectors of rest (N, 2) under the tensions of each time [rad]."""
    return np.array([run.model.equilibrium(tension) for tension in run.tension])


def _tell(scenario: Scenario, run: Trajectory) -> tuple[Finding, ...]:
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
            Finding(f"{key}_theta_deg", f"{label}: theta", float(theta), "deg"),
            Finding(f"{key}_phi_deg", f"{label}: phi", float(phi), "deg"),
        ]
        found += [
            Finding(f"{key}_{axis}_m", f"{label}: tip {axis}", float(value), "m")
            for axis, value in zip("xyz", tip, strict=True)
        ]
    return tuple(found)


def _draw(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios._two_cables_figure import two_cables_figure

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
    source=source("section 5.2 and Fig. 10") + "; tensions ours",
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
    tell=_tell,
    draw=_draw,
)
