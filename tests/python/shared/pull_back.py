"""Controllers of rollouts that pull one section back to the straight shape."""

from __future__ import annotations

import numpy as np

import cdcr
from cdcr.base.arrays import FloatArray


class Spring(cdcr.Controller):
    """Pulls back, each period."""

    def __init__(self, period: float) -> None:
        super().__init__(period=period)

    def update(self, t: float, q: FloatArray, qd: FloatArray) -> FloatArray:
        return np.asarray(pull_back(t, q[None], qd[None])[0])


def pull_back(t: float, q: FloatArray, qd: FloatArray) -> FloatArray:
    safe = np.nan_to_num(q)
    return np.stack(
        [np.maximum(0.0, -safe[:, 0]), np.maximum(0.0, safe[:, 1]), 0.1 + 0 * safe[:, 0]], 1
    )
