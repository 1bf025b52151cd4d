"""Sums over the elements of a section, of which the paper's inertia factors are made.

An element lies at fraction x of the length. With y = x theta, S = sin(y)/y, A = (1 - cos y)/y^2 and
the length taken as one, paper eqs. (1) to (4) give it

    along          (dr/dtheta)^2      = x^4 D,  D = (S - A)^2 + S'^2
    across         (dr/dphi)^2        = x^4 theta^2 A^2
    turning_theta  (t x dt/dtheta)^2  = x^2
    turning_phi    (t x dt/dphi)^2    = sin^2 y
    spin           its turn about t   = (1 - cos y)^2, which the paper's (3) and (16) lack: E7

As printed, turning_theta is (x cos^2 y + sin^2 y)^2 (E4). In this form no term cancels, so all are
good to rounding from theta = 0 on; so are the derivatives by theta given beside them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from math import factorial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from cdcr.base.arrays import FloatArray

if TYPE_CHECKING:
    from fractions import Fraction

# Points of the Gauss quadrature along the backbone: exact to rounding up to max_bending.
_NUM_POINTS = 32
# Terms of a power series in y below one: the next is under 1e-17 of the first.
_NUM_TERMS = 9


class Sums(NamedTuple):
    """The five sums, as the head of this file names them."""

    along: Any
    across: Any
    turning_theta: Any
    turning_phi: Any
    spin: Any


@dataclass(frozen=True, eq=False)
class Body:
    """Elements at fractions x with their weights, and the moments sum weight x^p exactly."""

    x: FloatArray
    weight: FloatArray
    moment: Callable[[int], Fraction]


@lru_cache(maxsize=1)
def rod() -> Body:
    """Return the backbone, whose sums are integrals over x."""
    from fractions import Fraction

    z, weight = np.polynomial.legendre.leggauss(_NUM_POINTS)
    return Body((1.0 + z) / 2.0, weight / 2.0, lambda p: Fraction(1, p + 1))


@lru_cache(maxsize=128)
def disks(num: int) -> Body:
    """Return disks at k/num, k = 1 to num."""
    from fractions import Fraction

    places = range(1, num + 1)
    return Body(
        np.array([k / num for k in places]),
        np.ones(num),
        lambda p: sum((Fraction(k, num) ** p for k in places), Fraction(0)),
    )


def sums(theta: FloatArray, body: Body, kind: str) -> tuple[Sums, Sums]:
    """Return the sums over a body, each of the shape of theta, and their derivatives by theta."""
    if kind.endswith("taylor"):
        return _polynomials(theta, _rounded_cut_sums(body, kind))
    x, weight = body.x, body.weight
    y = theta[..., np.newaxis] * x
    S, A = sinc(y), bow(y)
    D = (S - A) ** 2 + sinc_slope(y, S) ** 2
    sine, one_minus_cosine = np.sin(y), y**2 * A
    sideways = x * y * A  # |dr/dphi|
    if kind == "printed":
        turning, turning_slope = x * np.cos(y) ** 2 + sine**2, x * (1.0 - x) * np.sin(2.0 * y)
    else:
        turning, turning_slope = np.broadcast_to(x, y.shape), np.zeros(y.shape)
    values = Sums(x**4 * D, sideways**2, turning**2, sine**2, one_minus_cosine**2)
    slopes = Sums(
        x**5 * speed_slope(y, A, D),
        2.0 * sideways * x**2 * (S - A),
        2.0 * turning * turning_slope,
        x * np.sin(2.0 * y),
        2.0 * one_minus_cosine * x * sine,
    )
    return Sums(*(v @ weight for v in values)), Sums(*(s @ weight for s in slopes))


def _polynomials(theta: FloatArray, cut: Sums) -> tuple[Sums, Sums]:
    """Return the values and the derivatives of sums cut after theta^4."""
    square = theta**2
    values = (c0 + (c1 + c2 * square) * square for c0, c1, c2 in cut)
    slopes = ((2.0 * c1 + 4.0 * c2 * square) * theta for _, c1, c2 in cut)
    return Sums(*values), Sums(*slopes)


@lru_cache(maxsize=128)
def _rounded_cut_sums(body: Body, kind: str) -> Sums:
    return Sums(*([float(c) for c in coefficients] for coefficients in cut_sums(body, kind)))


def cut_sums(body: Body, kind: str) -> Sums:
    """Return the coefficients of 1, theta^2, theta^4 in each sum, as fractions."""
    m = body.moment
    if kind == "printed-taylor":
        turning_theta = _cut_printed_turning(m)
    else:
        turning_theta = [m(2), 0 * m(0), 0 * m(0)]
    return Sums(
        along=[m(4) / 4, -m(6) / 72, m(8) / 2880],
        across=[0 * m(0), m(4) / 4, -m(6) / 24],
        turning_theta=turning_theta,
        turning_phi=[0 * m(0), m(2), -m(4) / 3],
        spin=[0 * m(0), 0 * m(0), m(4) / 4],
    )


def _cut_printed_turning(m: Callable[[int], Fraction]) -> list[Fraction]:
    """Return the coefficients of (x cos^2 y + sin^2 y)^2.

    It is (x + 1)^2/4 + (x - 1)^2/8 + (x^2 - 1)/2 cos 2y + (x - 1)^2/8 cos 4y.
    """
    constant = (m(2) + 2 * m(1) + m(0)) / 4 + (m(2) - 2 * m(1) + m(0)) / 8
    coefficients = [constant, 0 * m(0), 0 * m(0)]
    for j in range(3):
        p, sign = 2 * j, (-1) ** j
        second, fourth = m(p + 2) - m(p), m(p + 2) - 2 * m(p + 1) + m(p)
        coefficients[j] += sign * (4**j * second / 2 + 16**j * fourth / 8) / factorial(p)
    return coefficients


# --- Functions of y = x theta, without cancellation near zero -------------------------------------


def sinc(y: FloatArray) -> FloatArray:
    """Return S = sin(y)/y: how far along Z the element stands, over x."""
    return np.sinc(y / np.pi)


def bow(y: FloatArray) -> FloatArray:
    """Return A = (1 - cos y)/y^2: how far out it stands, over x^2 theta."""
    half: FloatArray = sinc(y / 2.0) ** 2 / 2.0
    return half


def sinc_slope(y: FloatArray, S: FloatArray) -> FloatArray:
    """Return S' = (cos y - S)/y."""
    return _odd(y, _SINC_SLOPE, np.cos(y) - S)


def speed_slope(y: FloatArray, A: FloatArray, D: FloatArray) -> FloatArray:
    """Return D' = 2 (A - 2 D)/y."""
    return _odd(y, _SPEED_SLOPE, 2.0 * (A - 2.0 * D))


def _odd(y: FloatArray, coefficients: FloatArray, numerator: FloatArray) -> FloatArray:
    """Return numerator/y, an odd function, by its power series where digits would be lost."""
    small = np.abs(y) < 1.0
    near = np.where(small, y, 0.0)
    square, series = near**2, np.zeros(y.shape)
    for c in coefficients[::-1]:
        series = series * square + c
    return np.where(small, near * series, numerator / np.where(small, 1.0, y))


def _slope_of(coefficient: Callable[[int], float]) -> FloatArray:
    """Return the derivative's coefficients of y, y^3, ... for a series in y^2."""
    return np.array([2.0 * j * coefficient(j) for j in range(1, _NUM_TERMS + 1)])


_SINC_SLOPE = _slope_of(lambda j: (-1.0) ** j / factorial(2 * j + 1))
_SPEED_SLOPE = _slope_of(lambda j: (-1.0) ** j * 2.0 * (2 * j + 3) / factorial(2 * j + 4))
