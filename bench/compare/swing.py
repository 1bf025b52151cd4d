"""The swing that all integrators compute: one section, undamped, out of its plane, for 10 s.

The equations are those of `scipy_reference`, written without cdcr: inertia by sums over the disks
and quadrature along the rod, as polynomials in theta^2. `Swing.rates` is plain arithmetic, so that
numba, CasADi and heyoka each make the best of it.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

Q0, QD0 = (0.8, 0.0), (0.0, 1.0)  # [rad], [rad/s]
Y0 = np.array([*Q0, *QD0])
TIMES = np.linspace(0.0, 10.0, 101)  # where it is sampled [s]


class Swing:
    """Equations of motion of the section: polynomials of its inertia, and its stiffness."""

    def __init__(self, table: Any, stiffness: float) -> None:
        self.table = np.asarray(table)  # as RightHandSide of scipy_reference has it
        self.stiffness = stiffness

    @classmethod
    def make(cls) -> Swing:
        """Compute them."""
        import scipy_reference

        import cdcr

        equations = scipy_reference.RightHandSide.of(cdcr.robots.amouri2020().sections[0])
        return cls(equations.table, equations.stiffness)

    def save(self, path: Path) -> None:
        """Keep them for another process, which then needs neither cdcr nor SciPy."""
        path.write_text(json.dumps([self.table.tolist(), self.stiffness]), encoding="utf-8")

    @classmethod
    def load(cls, path: Path) -> Swing:
        """Read what `save` wrote."""
        return cls(*json.loads(path.read_text(encoding="utf-8")))

    def rates(self) -> Callable[[Any, Any, Any, Any], tuple[Any, Any]]:
        """Return the function of (x, y, xd, yd), numbers or symbols, that gives (xdd, ydd)."""
        a_of, b_of, da_of, db_of = (tuple(map(float, row[::-1])) for row in self.table)
        degree, stiffness = len(a_of), self.stiffness  # highest power first

        def rates(x: Any, y: Any, xd: Any, yd: Any) -> tuple[Any, Any]:
            sigma = x * x + y * y
            a, b, da, db = a_of[0], b_of[0], da_of[0], db_of[0]
            for k in range(1, degree):
                a = a * sigma + a_of[k]
                b = b * sigma + b_of[k]
                da = da * sigma + da_of[k]
                db = db * sigma + db_of[k]
            p = x * xd + y * yd
            on_q = db * p * p + (b - da) * (xd * xd + yd * yd) + stiffness
            force_x, force_y = -2.0 * da * p * xd - on_q * x, -2.0 * da * p * yd - on_q * y
            along = b * (x * force_x + y * force_y) / (a + b * sigma)
            return (force_x - along * x) / a, (force_y - along * y) / a

        return rates

    def disagreement(self) -> float:
        """Largest relative difference of these accelerations from cdcr's, at 1,000 states."""
        import cdcr

        random = np.random.default_rng(1)
        q, qd = random.uniform(-0.75, 0.75, (1000, 2)), random.uniform(-5.0, 5.0, (1000, 2))
        model = cdcr.Model(cdcr.robots.amouri2020())
        ours = model.forward_dynamics(q, qd, np.zeros(3))
        theirs = np.stack(self.rates()(*q.T, *qd.T), axis=-1)
        return float(np.max(np.abs(theirs - ours).max(axis=1) / np.abs(ours).max(axis=1)))
