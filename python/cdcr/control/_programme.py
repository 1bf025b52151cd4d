"""A quadratic programme within bounds, solved again and again by PIQP."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.extras import require

# Tolerances by which unknowns of some units are good to some hundredths of one.
ENOUGH = {
    **{"eps_abs": 1e-4, "eps_rel": 1e-4, "eps_duality_gap_abs": 1e-3, "eps_duality_gap_rel": 1e-4},
    "preconditioner_iter": 0,  # what has weights is scaled already
}


def unit_near(size: float) -> float:
    """Return the power of 256 near a size: 1 for usual robots, whose numbers stay as they are."""
    # Of at most 1e75, so that neither squares nor quotients of these are beyond doubles.
    return float(256.0 ** round(math.log(min(max(size, 1e-75), 1e75), 256.0)))


class BoxProgramme:
    """Of x, what makes x^T P x / 2 + c^T x least with low <= x <= high.

    The solver is kept from one programme to the next, as its memory, given back and taken anew,
    would cost more than half of its time. It is not part of pickles.

    Parameters
    ----------
    unit, cost : float
        Of x and of what is made least: PIQP's tolerances are for numbers near one.
    """

    def __init__(self, unit: float = 1.0, cost: float = 1.0) -> None:
        self._piqp: Any = require("piqp", "mpc")
        self._unit, self._cost = unit, cost
        self._solver: Any = None
        self.iterations = 0

    def solve(
        self, P: FloatArray, c: FloatArray, low: FloatArray, high: FloatArray
    ) -> FloatArray | None:
        """Return x (n,), or None where PIQP finds none; P (n, n) is symmetric and definite."""
        if (self._unit, self._cost) != (1.0, 1.0):
            P, c = P * (self._unit**2 / self._cost), c * (self._unit / self._cost)
            low, high = low / self._unit, high / self._unit
        given = {"P": P.T, "c": c, "x_l": low, "x_u": high}  # .T: by columns, as PIQP wants it
        if self._solver is None:
            self._solver = self._piqp.DenseSolver()
            for name, value in ENOUGH.items():
                setattr(self._solver.settings, name, value)
            self._solver.setup(**given)
        else:
            self._solver.update(**given)
        status = self._solver.solve()
        self.iterations = self._solver.result.info.iter
        if status != self._piqp.PIQP_SOLVED:
            return None
        return np.array(self._solver.result.x) * self._unit

    def __reduce__(self) -> tuple[type[BoxProgramme], tuple[float, float]]:
        return BoxProgramme, (self._unit, self._cost)
