"""The paper's PID loop with each reading of its gains (Fig. 14)."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from cdcr.model.model import Model
from cdcr.robots import amouri2020
from cdcr.runs.pid import Pid
from cdcr.runs.simulate import simulate
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, settling_time

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

KP, KI, KD = 2.8, 0.004, 0.38  # section 5.4, without units there
TARGET = 15.53  # theta of the paper's Fig. 9 [deg]
BAND = 0.02  # of the target, within which it has settled
PERIOD = 1e-3  # of the controller [s]

_RADIUS = amouri2020().sections[0].cable_radius
# What the gains may act on and give, by name, and their scale to [N m/rad].
READINGS = {
    "radians": ("error in rad, output a tension", _RADIUS),
    "degrees": ("error in deg, output a tension", _RADIUS * 180.0 / math.pi),
    "moment": ("error in rad, output a moment", 1.0),
}


class Loop(NamedTuple):
    """One way to close the loop. An unlimited tension may push, which no cable can."""

    reading: str
    feed_forward: bool
    limited: bool

    @property
    def key(self) -> str:
        """Name for machines."""
        ends = ["forward" if self.feed_forward else "plain"]
        return "_".join([self.reading, *ends, *([] if self.limited else ["unlimited"])])

    @property
    def label(self) -> str:
        """Name for people, without the reading."""
        how = "with feed-forward" if self.feed_forward else "PID alone"
        return f"{how}, {'tension ≥ 0' if self.limited else 'no limit'}"

    def controller(self, model: Model) -> Pid:
        """Return the controller, which pulls cable 1 alone."""
        scale = READINGS[self.reading][1]
        pid = Pid(
            model,
            kp=KP * scale,
            ki=KI * scale,
            kd=KD * scale,
            period=PERIOD,
            feed_forward=self.feed_forward,
            min_tension=0.0 if self.limited else -math.inf,
            cables=[0],
        )
        pid.reference = [math.radians(TARGET), 0.0]
        return pid


LOOPS = tuple(
    Loop(reading, feed_forward, limited)
    for reading in READINGS
    for feed_forward in (False, True)
    for limited in (False, True)
)
RECOMMENDED = Loop("degrees", feed_forward=True, limited=True)


@lru_cache(maxsize=2)
def runs(t_end: float) -> dict[Loop, Trajectory]:
    """Return the run of every loop, sampled as often as the controller."""
    t = np.linspace(0.0, t_end, max(1, round(t_end / PERIOD)) + 1)
    model, rest = Model(amouri2020()), (0.0, 0.0)
    return {
        loop: simulate(
            model, rest, rest, t=t, controller=loop.controller(model), method="dopri5", rtol=1e-9
        )
        for loop in LOOPS
    }


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return where each loop ends, how far and how hard it goes, and when it has settled."""
    found = []
    for loop, other in runs(float(run.t[-1])).items():
        theta = np.rad2deg(other.theta[:, 0])
        mark = ", recommended" if loop == RECOMMENDED else ""
        label = f"{loop.reading}, {loop.label}{mark}"
        lowest = float(other.tension[:, 0].min())
        found += [
            Metric(f"{loop.key}_end_deg", f"{label}: theta at the end", float(theta[-1]), "deg"),
            Metric(f"{loop.key}_peak_deg", f"{label}: largest theta", float(theta.max()), "deg"),
            Metric(f"{loop.key}_min_N", f"{label}: smallest tension", lowest, "N"),
        ]
        settled = settling_time(other.t, np.abs(theta - TARGET), BAND * TARGET)
        if settled is not None:
            found.append(Metric(f"{loop.key}_settling_s", f"{label}: within 2 %", settled, "s"))
    return tuple(found)
