"""The honest alternative: SciPy's solve_ivp and a NumPy right-hand side of the same equations.

Written from the equations of motion of one section without using cdcr's own polynomials, so it is
also a check of them. The inertia functions are computed once, by sums over the disks and
quadrature along the rod, and turned into polynomials in sigma = theta^2; a call costs one small
matrix product.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import Chebyshev, Polynomial
from scipy.integrate import solve_ivp

if TYPE_CHECKING:
    from numpy.typing import NDArray

    import cdcr

    Array = NDArray[np.float64]

DEGREE = 14  # the interpolation error is then rounding error up to LARGEST_SIGMA
LARGEST_SIGMA = 1.2  # enough for a free oscillation from pi/4
NODES, WEIGHTS = (np.polynomial.legendre.leggauss(24)[i] for i in (0, 1))


def inertia(section: cdcr.Section, sigma: float) -> tuple[float, float]:
    """M11 = m_theta_theta and a = m_phi_phi / theta^2 of one section, for theta^2 = sigma > 0."""
    theta = np.sqrt(sigma)
    disks = np.arange(1, section.num_disks + 1) / section.num_disks
    x = np.concatenate((disks, (NODES + 1.0) / 2.0))
    rod = section.backbone_mass * WEIGHTS / 2.0
    mass = np.concatenate((np.full(section.num_disks, section.disk_mass), rod))
    diameter = np.where(
        np.arange(x.size) < disks.size, section.disk_diameter, section.backbone_diameter
    )
    transverse = mass * diameter**2 / 16.0
    # r = l integral of (sin(s theta), cos(s theta)) over s from 0 to x, and its derivative: by
    # quadrature, for the closed forms lose digits at small angles.
    s = np.outer(x, (NODES + 1.0) / 2.0)
    ds = np.outer(x, WEIGHTS / 2.0)
    r = section.length * (np.sin(s * theta) * ds).sum(axis=1)
    slope_x = section.length * (s * np.cos(s * theta) * ds).sum(axis=1)
    slope_z = section.length * (s * np.sin(s * theta) * ds).sum(axis=1)
    y = x * theta
    along = mass * (slope_x**2 + slope_z**2) + transverse * x**2
    turn = np.sin(y) ** 2 + 2.0 * (1.0 - np.cos(y)) ** 2  # about the transverse and own axes
    across = mass * r**2 + transverse * turn
    return float(along.sum()), float(across.sum() / sigma)


class RightHandSide:
    """y' = f(t, y) of y = (q, qd) for one section without gravity and tension."""

    def __init__(self, table: Array, stiffness: float, damping: float = 0.0) -> None:
        self.table = table  # of a, b and their slopes: a row of coefficients each, constant first
        self.powers = np.arange(table.shape[1])
        self.stiffness = stiffness
        self.damping = damping

    @classmethod
    def of(cls, section: cdcr.Section) -> RightHandSide:
        """Make the table of a section."""

        def interpolated(value: int) -> Polynomial:
            function = np.vectorize(lambda sigma: inertia(section, sigma)[value])
            fit = Chebyshev.interpolate(function, DEGREE, domain=[0.0, LARGEST_SIGMA])
            polynomial: Polynomial = fit.convert(kind=Polynomial)
            return polynomial

        a = interpolated(1)
        # b = (M11 - a)/sigma: both agree at 0, so the coefficient dropped is rounding.
        b = Polynomial((interpolated(0) - a).coef[1:])
        table = np.zeros((4, DEGREE + 1))
        for row, polynomial in zip(table, (a, b, a.deriv(), b.deriv()), strict=True):
            row[: polynomial.coef.size] = polynomial.coef
        return cls(table, section.stiffness, section.damping)

    def __call__(self, t: float, state: Array) -> tuple[float, float, float, float]:
        """Plain floats around one matrix product: quicker than small NumPy vectors."""
        x, y, xd, yd = state.tolist()
        sigma = x * x + y * y
        a, b, da, db = (self.table @ sigma**self.powers).tolist()
        p = x * xd + y * yd
        on_qd = 2.0 * da * p + self.damping
        on_q = db * p * p + (b - da) * (xd * xd + yd * yd) + self.stiffness
        force_x, force_y = -on_qd * xd - on_q * x, -on_qd * yd - on_q * y
        along = b * (x * force_x + y * force_y) / (a + b * sigma)
        return xd, yd, (force_x - along * x) / a, (force_y - along * y) / a


def solve(section: cdcr.Section, q0: Array, times: Array, method: str, rtol: float) -> Array:
    """Bending vectors (N, 2) of a free run from rest at q0; atol is rtol/100, as cdcr's."""
    answer = solve_ivp(
        RightHandSide.of(section),
        (times[0], times[-1]),
        np.concatenate((q0, np.zeros(2))),
        method=method,
        t_eval=times,
        rtol=rtol,
        atol=rtol * 1e-2,
    )
    if not answer.success:
        raise RuntimeError(f"{method} at rtol {rtol}: {answer.message}")
    return np.asarray(answer.y[:2].T)
