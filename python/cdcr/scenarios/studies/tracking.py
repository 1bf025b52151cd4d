"""Inverse dynamics along a path of the paper, and a run under its tensions (Figs. 12, 13)."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, cast

import numpy as np

from cdcr.base.arrays import FloatArray, even_times
from cdcr.motion.inverse import InverseRun
from cdcr.motion.reference import Reference
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.file.tracking import TrackedMotion
    from cdcr.scenarios.scenario import Scenario

STEP = 0.2  # between the tensions, as in the paper [s]
FINE_STEP = 1e-3  # the same, for comparison [s]


def _motion(scenario: Scenario) -> TrackedMotion:
    return cast("TrackedMotion", scenario.input_source)


def asked(scenario: Scenario, run: Trajectory) -> Reference:
    """Return the motion that a run was to follow."""
    return _motion(scenario).reference(run.t)


def inverse(scenario: Scenario, run: Trajectory, step: float) -> InverseRun:
    """Return the tensions along the motion, every step [s]."""
    return _motion(scenario).inverse(run.model, even_times(float(run.t[-1]), step))


def fine_run(scenario: Scenario, run: Trajectory) -> Trajectory:
    """Return the run again, under tensions that are sampled finely."""
    finely = replace(_motion(scenario), step=FINE_STEP)
    return replace(scenario, input_source=finely).simulate(
        t_end=float(run.t[-1]), num_samples=len(run)
    )


def error(scenario: Scenario, run: Trajectory) -> FloatArray:
    """Return how far a run is from the motion (N,), as a length of bending vectors [rad]."""
    distance: FloatArray = np.linalg.norm(run.q - asked(scenario, run).q, axis=1)
    return distance


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return the tensions needed, and how well they lead the robot."""
    sampled = inverse(scenario, run, STEP).tension
    fine = inverse(scenario, run, FINE_STEP).tension
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
    coarse = float(np.rad2deg(error(scenario, run).max()))
    small = float(error(scenario, fine_run(scenario, run)).max())
    return (
        *found,
        Metric("error_deg", f"path error, every {STEP:g} s", coarse, "deg"),
        Metric("error_fine_rad", f"path error, every {FINE_STEP:g} s", small, "rad"),
    )
