"""The origin paper's inertia factors, what is right and what is not; E1 to E7 as in cpp/README.md.

All is derived from the paper's eqs. (1), (2) and (4) alone, in its own coordinates theta and phi,
by differences at 60 digits: Amouri, Mahfoudi, Zaatri (2020), doi 10.46604/ijeti.2020.4422.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from mpmath.ctx_mp import MPContext  # type: ignore[import-untyped]

import cdcr

Real = Any  # a number of mp
Matrix = Any  # a matrix of mp

mp = MPContext()  # of our own: other tests keep their precision
mp.dps = 60
STEP = mp.mpf(10) ** -15  # of central differences, good to 30 digits
SAME = mp.mpf(10) ** -25  # closed forms against differences
DOUBLE = 1e-14  # the compiled model: rounding of some dozen operations

ANGLES = [mp.mpf(angle) for angle in ("0.3", "1", "1.885", "3", "5.5")]
each_angle = pytest.mark.parametrize("t", ANGLES, ids=str)
PHI = mp.mpf("0.7")
GAUSS = mp.gauss_quadrature(32, "legendre")
DISKS = [mp.mpf(k) / 10 for k in range(1, 11)]

SECTION = cdcr.robots.amouri2020().sections[0]  # Table 1
LENGTH, ROD, DISK = (
    mp.mpf(value) for value in (SECTION.length, SECTION.backbone_mass, SECTION.disk_mass)
)
I_XX = DISK * mp.mpf(SECTION.disk_diameter) ** 2 / 16
I_B = mp.pi * mp.mpf(SECTION.backbone_diameter) ** 4 / 64  # second moment of area [m^4]
ROTARY = ROD * mp.mpf(SECTION.backbone_diameter) ** 2 / 16  # rotary inertia [kg m^2]


# --- What follows from eqs. (1) to (4), the length being one --------------------------------------


def position(t: Real, phi: Real, x: Real) -> Matrix:
    """Paper eq. (1)."""
    bow = (1 - mp.cos(x * t)) / t
    return mp.matrix([bow * mp.cos(phi), bow * mp.sin(phi), mp.sin(x * t) / t])


def tangent(t: Real, phi: Real, x: Real) -> Matrix:
    """Paper eq. (4)."""
    y = x * t
    return mp.matrix([mp.cos(phi) * mp.sin(y), mp.sin(phi) * mp.sin(y), mp.cos(y)])


def rotation(t: Real, phi: Real, x: Real) -> Matrix:
    """Paper eq. (2)."""

    def about_z(angle: Real) -> Matrix:
        c, s = mp.cos(angle), mp.sin(angle)
        return mp.matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])

    c, s = mp.cos(x * t), mp.sin(x * t)
    return about_z(phi) * mp.matrix([[c, 0, s], [0, 1, 0], [-s, 0, c]]) * about_z(-phi)


def by_theta(f: Callable[[Real, Real, Real], Matrix], t: Real, x: Real) -> Matrix:
    return (f(t + STEP, PHI, x) - f(t - STEP, PHI, x)) / (2 * STEP)


def by_phi(f: Callable[[Real, Real, Real], Matrix], t: Real, x: Real) -> Matrix:
    return (f(t, PHI + STEP, x) - f(t, PHI - STEP, x)) / (2 * STEP)


def square(v: Matrix) -> Real:
    """|v|^2; for the rate v of the tangent t this is |t x v|^2, since both are at right angles."""
    return mp.fdot(v, v)


def over_disks(f: Callable[[Real], Real]) -> Real:
    return mp.fsum(f(x) for x in DISKS)


def over_rod(f: Callable[[Real], Real]) -> Real:
    return mp.fsum(weight / 2 * f((1 + z) / 2) for z, weight in zip(*GAUSS, strict=True))


# --- The factors as printed -----------------------------------------------------------------------


def H1(t: Real) -> Real:
    return (t**3 + 6 * t - 12 * mp.sin(t) + 6 * t * mp.cos(t)) / t**5


def H2(t: Real) -> Real:
    return (6 * t - 8 * mp.sin(t) + mp.sin(2 * t)) / t**3


def H3(t: Real) -> Real:
    polynomial = mp.mpf(5) / 8 - mp.mpf(15) / (64 * t**2) + mp.cos(t) ** 2 / (2 * t**2)
    return polynomial - mp.sin(2 * t) / (8 * t**3) - mp.sin(4 * t) / (256 * t**3)


def H4(t: Real) -> Real:
    return mp.mpf(1) / 2 - t * mp.sin(2 * t) / (4 * t**2)


def H5(t: Real) -> Real:
    waves = over_disks(lambda x: 40 * mp.cos(x * t) + 40 * x * t * mp.sin(x * t))
    return (400 + 77 * t**2 - waves) / (40 * t**4)


def H6(t: Real, cosine: Callable[[Real], Real] = mp.cos) -> Real:
    """``cosine`` stands before 9 theta/5; the identity is what eq. (28) prints."""
    tenths = {20: 1, 12: 1, 14: 1, 16: 1, 5: -4, 1: -4, 3: -4, 7: -4, 9: -4}
    tenths |= {2: -3, 4: -3, 6: -3, 8: -3, 10: -3}
    waves = mp.fsum(c * mp.cos(k * t / 10) for k, c in tenths.items())
    return (30 + waves + cosine(9 * t / 5)) / (4 * t**2)


def H7(t: Real) -> Real:
    in_800ths = {20: 25, 2: -396, 4: -303, 6: -364, 8: -272, 12: -207, 14: -204, 16: -108}
    in_800ths |= {18: -76, 24: 16, 28: 9, 32: 4, 36: 1, 10: -300}
    waves = mp.fsum(c * mp.cos(k * t / 10) for k, c in in_800ths.items())
    return waves / 800 + mp.mpf(1051) / 160


def H8(t: Real) -> Real:
    return over_disks(lambda x: mp.sin(x * t) ** 2)


def spin(x: Real, t: Real) -> Real:
    """(omega.t/phid)^2 of E7."""
    return (1 - mp.cos(x * t)) ** 2


def close(actual: Real, expected: Real, tolerance: Real = SAME) -> bool:
    return bool(abs(actual - expected) <= tolerance * abs(expected))


# --- What is right --------------------------------------------------------------------------------


@each_angle
def test_translation_of_the_backbone_is_right_in_eq_9(t: Real) -> None:
    assert close(over_rod(lambda x: square(by_theta(position, t, x))), H1(t) / 3)
    assert close(over_rod(lambda x: square(by_phi(position, t, x))), H2(t) / 4)


def test_taylor_polynomials_12_and_13_are_right() -> None:
    t = mp.mpf(10) ** -4
    series_1 = t**4 / 8640 - t**2 / 168 + mp.mpf(3) / 20
    series_2 = -(t**4) / 42 + t**2 / 5
    assert abs(H1(t) - series_1) < t**6
    assert abs(H2(t) - series_2) < t**6


@each_angle
def test_turning_about_phi_is_right_in_26_and_30(t: Real) -> None:
    assert close(over_rod(lambda x: square(by_phi(tangent, t, x))), H4(t))
    assert close(over_disks(lambda x: square(by_phi(tangent, t, x))), H8(t))


def test_statics_18_and_19_at_5_newton() -> None:
    """theta = F r l/(E I); the 15.53 degrees of the paper's Fig. 9 do not follow from Table 1."""
    model = cdcr.Model(cdcr.robots.amouri2020())
    theta, phi = cdcr.polar(model.equilibrium([5.0, 0.0, 0.0]))
    expected = 5 * mp.mpf(SECTION.cable_radius) * LENGTH / (mp.mpf(SECTION.youngs_modulus) * I_B)
    assert close(theta, expected, DOUBLE)
    assert mp.degrees(theta) == pytest.approx(14.978, abs=5e-4)
    assert phi == 0.0


# --- E1 to E7 -------------------------------------------------------------------------------------


def power(order: str) -> Real:
    """d(T + U)/dt of the free robot in one state, from eqs. (20) and (22) with sound M11, M22.

    ``order`` names the velocities that the three columns of C multiply.
    """
    t, td, fd, K = mp.mpf(1), mp.mpf(2), mp.mpf(3), mp.mpf(SECTION.stiffness)

    def M11(s: Real) -> Real:
        return LENGTH**2 * (ROD * H1(s) / 3 + DISK * 2 * H5(s))

    def M22(s: Real) -> Real:
        return LENGTH**2 * (ROD * H2(s) / 4 + DISK * 2 * H6(s))

    dM11, dM22 = mp.diff(M11, t), mp.diff(M22, t)
    products = {"tt": td * td, "tf": td * fd, "ff": fd * fd}
    first, second, third = (products[name] for name in order.split())
    tdd = -(dM11 / 2 * first - dM22 / 2 * third + K * t) / M11(t)
    fdd = -dM22 * second / M22(t)
    kinetic = M11(t) * td * tdd + dM11 * td**3 / 2 + M22(t) * fd * fdd + dM22 * td * fd**2 / 2
    return (kinetic + K * t * td) / (K * t * td)


def test_e1_the_velocities_of_eq_20_stand_in_the_wrong_order() -> None:
    assert abs(power("tt ff tf")) > 0.01  # as printed: energy out of nothing
    assert abs(power("tt tf ff")) < SAME


def test_e2_eq_21_lacks_the_third_and_the_quarter_of_eq_9() -> None:
    """Near theta = 0 the inertia must not depend on the direction: M11 = M22/theta^2."""
    t = mp.mpf(10) ** -6
    l_I_b = LENGTH * I_B
    M11 = LENGTH**2 * (ROD * H1(t) + DISK * H5(t)) + l_I_b * H3(t) + I_XX * H7(t)
    M22 = LENGTH**2 * (ROD * H2(t) + DISK * H6(t)) + l_I_b * H4(t) + I_XX * H8(t)
    assert close(M11, 4.8186e-3, 1e-5)
    assert close(M22 / t**2, 5.8670e-3, 1e-5)
    third, quarter = LENGTH**2 * ROD * H1(t) * 2 / 3, LENGTH**2 * ROD * H2(t) * 3 / 4
    assert close(M11 - third, (M22 - quarter) / t**2, 1e-9)


@each_angle
def test_e3_h5_and_h6_are_half_of_what_eq_15_needs(t: Real) -> None:
    assert close(H5(t), over_disks(lambda x: square(by_theta(position, t, x))) / 2)
    assert close(H6(t), over_disks(lambda x: square(by_phi(position, t, x))) / 2)


def test_e3_at_the_straight_robot() -> None:
    t = mp.mpf(10) ** -6
    assert close(H5(t), 0.316663, 1e-5)
    assert close(over_disks(lambda x: square(by_theta(position, t, x))), 0.633325, 1e-5)


@each_angle
def test_e4_h3_and_h7_are_constants(t: Real) -> None:
    assert close(over_rod(lambda x: square(by_theta(tangent, t, x))), mp.mpf(1) / 3)
    assert close(over_disks(lambda x: square(by_theta(tangent, t, x))), mp.mpf(77) / 20)

    def slip(x: Real) -> Real:
        """As printed: the factor x is missing from the rate of the cosine in the tangent."""
        return (x * mp.cos(x * t) ** 2 + mp.sin(x * t) ** 2) ** 2

    assert close(H3(t), over_rod(slip))
    assert close(H7(t), over_disks(slip))


def test_e5_l_i_b_of_eq_14_lacks_the_density() -> None:
    volume = mp.pi * mp.mpf(SECTION.backbone_diameter) ** 2 / 4 * LENGTH
    assert close(ROD / volume * LENGTH * I_B, ROTARY)


def test_e6_eq_28_lacks_a_cosine() -> None:
    """Without it H6 grows beyond all bounds towards the straight robot, where it is zero."""
    t = mp.mpf(10) ** -4
    assert close(H6(t), t**2 * 0.316663, 1e-5)
    assert H6(t, cosine=lambda angle: angle) < -1 / (5 * t**2)


@each_angle
def test_e7_the_frame_of_eq_2_spins_about_its_tangent(t: Real) -> None:
    """omega = t x td has no part along t; that of the frame is phid (cos theta_s - 1)."""
    x = mp.mpf("0.6")
    skew = by_phi(rotation, t, x) * rotation(t, PHI, x).T
    omega = mp.matrix([skew[2, 1], skew[0, 2], skew[1, 0]])
    assert close(mp.fdot(omega, tangent(t, PHI, x)), mp.cos(x * t) - 1)
    across = square(omega) - (mp.cos(x * t) - 1) ** 2
    assert close(across, mp.sin(x * t) ** 2)  # as eq. (3) has it, and H4 and H8


# --- Equation (22): the paper's inertia and the model's -------------------------------------------


def inertia(formulation: str, t: Real) -> tuple[float, float]:
    """M11 = a + b sigma and M22/sigma = a of the model."""
    M = cdcr.Model(cdcr.robots.amouri2020(), formulation).mass_matrix([float(t), 0.0])
    return M[0, 0], M[1, 1]


@each_angle
def test_22_the_mended_factors_are_the_exact_formulation(t: Real) -> None:
    M11 = LENGTH**2 * (ROD * H1(t) / 3 + DISK * 2 * H5(t)) + ROTARY / 3 + I_XX * 77 / 20
    M22 = LENGTH**2 * (ROD * H2(t) / 4 + DISK * 2 * H6(t)) + ROTARY * H4(t) + I_XX * H8(t)
    M22 += 2 * ROTARY * over_rod(lambda x: spin(x, t))
    M22 += 2 * I_XX * over_disks(lambda x: spin(x, t))
    along, across = inertia("exact", t)
    assert close(along, M11, DOUBLE)
    assert close(across, M22 / t**2, DOUBLE)


@each_angle
def test_22_the_printed_formulation_mends_e1_e2_and_e6_only(t: Real) -> None:
    l_I_b = LENGTH * I_B
    M11 = LENGTH**2 * (ROD * H1(t) / 3 + DISK * H5(t)) + l_I_b * H3(t) + I_XX * H7(t)
    M22 = LENGTH**2 * (ROD * H2(t) / 4 + DISK * H6(t)) + l_I_b * H4(t) + I_XX * H8(t)
    along, across = inertia("printed", t)
    assert close(along, M11, DOUBLE)
    assert close(across, M22 / t**2, DOUBLE)


@pytest.mark.parametrize(("whole", "cut"), [("exact", "taylor"), ("printed", "printed-taylor")])
def test_22_the_taylor_formulations_keep_four_powers_of_theta(whole: str, cut: str) -> None:
    """What is cut off M11 and M22 = sigma a falls with the sixth power of theta."""
    ratios = []
    for t in (0.1, 0.2):
        (M11, a), (cut_M11, cut_a) = inertia(whole, t), inertia(cut, t)
        ratios.append(np.array([M11 - cut_M11, t**2 * (a - cut_a)]) / t**6)
    assert ratios[1] == pytest.approx(ratios[0], rel=0.05)
