"""Tensions on cables 1 and 2 (Fig. 10)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cdcr.runs.trajectory import Trajectory

FULL = 5.0  # [N]
# When cable 1 and cable 2 are pulled: ramps of one second between rests of two [s], [N].
T = (0.0, 1.0, 2.0, 4.0, 5.0, 7.0, 8.0, 10.0, 11.0, 12.0)
CABLE_1 = (0.0, 0.0, FULL, FULL, FULL, FULL, 0.0, 0.0, 0.0, 0.0)
CABLE_2 = (0.0, 0.0, 0.0, 0.0, FULL, FULL, FULL, FULL, 0.0, 0.0)
RESTS = {"cable 1": 3.0, "cables 1 and 2": 6.0, "cable 2": 9.0}  # times between ramps [s]


def settled(run: Trajectory) -> NDArray[np.float64]:
    """Return the bending vectors of rest (N, 2) under the tensions of each time [rad]."""
    return np.array([run.model.equilibrium(tension) for tension in run.tension])
