"""Inverse dynamics along a path of the paper, and its tensions fed back (Figs. 12 and 13)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cdcr.model.model import Model
from cdcr.motion.inverse import InverseRun, inverse_run
from cdcr.motion.reference import Reference
from cdcr.runs.command import TensionTable
from cdcr.runs.simulate import simulate
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

FloatArray = NDArray[np.float64]

STEP = 0.2  # between the tensions fed back, as in the paper [s]
FINE_STEP = 1e-3  # the same, for comparison [s]
TIGHT = {"method": "dopri5", "rtol": 1e-10, "atol": 1e-12}


class Sweep(NamedTuple):
    """A motion with constant rates of theta and phi [rad], [rad/s]."""

    theta: float
    theta_rate: float
    phi: float
    phi_rate: float

    def reference(self, t: FloatArray) -> Reference:
        """Return the motion sampled at times (N,) [s], with its exact derivatives."""
        theta, phi = self.theta + self.theta_rate * t, self.phi + self.phi_rate * t
        outwards = np.stack([np.cos(phi), np.sin(phi)])
        around = np.stack([-np.sin(phi), np.cos(phi)])
        q = theta * outwards
        qd = self.theta_rate * outwards + theta * self.phi_rate * around
        turning = 2.0 * self.theta_rate * self.phi_rate * around
        qdd = turning - theta * self.phi_rate**2 * outwards
        return Reference(t, q.T, qd.T, qdd.T)

    def start(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return q and qd at t = 0."""
        first = self.reference(np.array([0.0, 1.0]))
        return tuple(first.q[0].tolist()), tuple(first.qd[0].tolist())

    def table(self, step: float) -> Callable[[Model, float], TensionTable]:
        """Return the function that gives a scenario its tensions, a table of that step [s]."""
        return lambda model, t_end: self.inverse(model, t_end, step).to_table()

    def inverse(self, model: Model, t_end: float, step: float) -> InverseRun:
        """Return the tensions along the motion, every step [s]."""
        intervals = max(1, round(t_end / step))
        return inverse_run(model, self.reference(np.linspace(0.0, t_end, intervals + 1)))

    def fine_run(self, run: Trajectory) -> Trajectory:
        """Return the run again, fed with tensions that are sampled finely."""
        table = self.inverse(run.model, float(run.t[-1]), FINE_STEP).to_table()
        return simulate(run.model, *self.start(), t=run.t, tension=table, **TIGHT)  # type: ignore[arg-type]

    def error(self, run: Trajectory) -> FloatArray:
        """Return how far a run is from the motion (N,), as a length of bending vectors [rad]."""
        distance: FloatArray = np.linalg.norm(run.q - self.reference(run.t).q, axis=1)
        return distance

    def summarize(self, scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
        """Return the tensions needed, and how well they lead the robot."""
        t_end = float(run.t[-1])
        sampled = self.inverse(run.model, t_end, STEP).tension
        fine = self.inverse(run.model, t_end, FINE_STEP).tension
        found = []
        for j in range(run.model.num_cables):
            first, last, largest = sampled[0, j], sampled[-1, j], sampled[:, j].max()
            key, cable, peak = f"tension_{j + 1}", f"cable {j + 1}", fine[:, j].max()
            found += [
                Metric(f"{key}_start", f"{cable}, at t = 0", float(first), "N"),
                Metric(f"{key}_end", f"{cable}, at the end", float(last), "N"),
                Metric(f"{key}_max", f"{cable}, largest every {STEP:g} s", float(largest), "N"),
                Metric(f"{key}_peak", f"{cable}, largest at any time", float(peak), "N"),
            ]
        coarse, small = self.error(run).max(), self.error(self.fine_run(run)).max()
        return (
            *found,
            Metric("error_deg", f"path error, every {STEP:g} s", float(np.rad2deg(coarse)), "deg"),
            Metric("error_fine_rad", f"path error, every {FINE_STEP:g} s", float(small), "rad"),
        )
