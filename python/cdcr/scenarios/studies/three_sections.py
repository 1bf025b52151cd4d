"""Each section of a robot of three driven in turn, the others held straight."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cdcr.model.model import Model
from cdcr.runs.command import TensionTable
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.studies.sections import holding

Array = NDArray[np.float64]

# What each section is bent to while the others are straight: theta, phi [rad].
BENT = np.deg2rad([(60.0, 0.0), (60.0, 120.0), (90.0, 30.0)])
RAMP, PHASE = 1.0, 5.0  # time for each change, and between the starts of two [s]
DAMPING = 8e-3  # of each bending component [N m s/rad]
STEP = 2.5e-3  # between samples [s]


def goals() -> Array:
    """Return the shape of each phase (3, 6): one section is bent, the others are straight."""
    shapes = np.zeros((len(BENT), 2 * len(BENT)))
    for k, (theta, phi) in enumerate(BENT):
        shapes[k, 2 * k : 2 * k + 2] = theta * np.cos(phi), theta * np.sin(phi)
    return shapes


def ends(run: Trajectory) -> list[tuple[int, int]]:
    """Return each phase that the run comes to the end of, with its last sample."""
    times = [(k, PHASE * (k + 1)) for k in range(len(BENT))]
    return [(k, int(np.searchsorted(run.t, t - STEP / 2))) for k, t in times if t <= run.t[-1]]


def own_cables_alone(model: Model, k: int) -> Array:
    """Return q (2n,) at rest if only the cables that end at section k pulled, as in its phase."""
    own = np.array([cable.end_section == k for cable in model.robot.all_cables])
    return model.equilibrium(np.where(own, holding(model, goals()[k]), 0.0))


def tensions(model: Model, t_end: float) -> TensionTable:
    """Return the tensions that hold each shape in its phase, joined by ramps."""
    times, rows = [0.0], [np.zeros(model.num_cables)]
    for k, goal in enumerate(goals()):
        held = holding(model, goal)
        times += [k * PHASE + RAMP, (k + 1) * PHASE]
        rows += [held, held]
    return TensionTable(times, rows)
