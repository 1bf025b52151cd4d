"""A quadratic programme within bounds, solved again and again by PIQP."""

from __future__ import annotations

from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.extras import require

# Tolerances by which tensions of some newtons are good to some hundredths of one.
ENOUGH = {
    **{"eps_abs": 1e-4, "eps_rel": 1e-4, "eps_duality_gap_abs": 1e-3, "eps_duality_gap_rel": 1e-4},
    "preconditioner_iter": 0,  # what has weights is scaled already
}


class BoxProgramme:
    """Of x, what makes x^T P x / 2 + c^T x least with low <= x <= high.

    The solver is kept from one programme to the next, as its memory, given back and taken anew,
    would cost more than half of its time. It is not part of pickles.
    """

    def __init__(self) -> None:
        self._piqp: Any = require("piqp", "mpc")
        self._solver: Any = None
        self.iterations = 0

    def solve(
        self, P: FloatArray, c: FloatArray, low: FloatArray, high: FloatArray
    ) -> FloatArray | None:
        """Return x (n,), or None where PIQP finds none; P (n, n) is symmetric and definite."""
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
        return np.array(self._solver.result.x) if status == self._piqp.PIQP_SOLVED else None

    def __reduce__(self) -> tuple[type[BoxProgramme], tuple[()]]:
        return BoxProgramme, ()
