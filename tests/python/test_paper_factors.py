"""cdcr.paper.factors and cdcr.paper.inertia against what the paper prints, at 60 digits.

The expressions are typed term by term from Amouri, Mahfoudi, Zaatri (2020), doi
10.46604/ijeti.2020.4422; other numbers of disks are checked against sums over the disks.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from mpmath.ctx_mp import MPContext  # type: ignore[import-untyped]
from numpy.typing import NDArray

import cdcr
from cdcr.paper import Factors, factors, inertia, taylor_coefficients

FloatArray = NDArray[np.float64]
Real = Any  # a number of mp
Formula = Callable[[Real], Real]

mp = MPContext()  # of our own: other tests keep their precision
mp.dps = 60  # theta^5 in a denominator takes 35 of them at the smallest angle

# A sum of some dozen positive terms in double precision: 3e-15 was seen.
ROUNDING = 1e-14
# Each coefficient is a fraction, rounded once.
ONE_ROUNDING = 2.3e-16

ANGLES = np.concatenate([np.geomspace(1e-7, 0.1, 13), np.linspace(0.15, math.pi, 30), [6.0, 9.4]])
EDGE = 3.0 * math.pi / 5.0  # of the paper's range
KINDS = ("exact", "taylor", "printed", "printed-taylor")


def c(angle: Real) -> Real:
    return mp.cos(angle)


def s(angle: Real) -> Real:
    return mp.sin(angle)


# --- As printed -----------------------------------------------------------------------------------


def eq10(t: Real) -> Real:
    return (t**3 + 6 * t - 12 * s(t) + 6 * t * c(t)) / t**5


def eq11(t: Real) -> Real:
    return (6 * t - 8 * s(t) + s(2 * t)) / t**3


def eq25(t: Real) -> Real:
    first = mp.mpf(5) / 8 - 15 / (64 * t**2) + c(t) ** 2 / (2 * t**2)
    return first - s(2 * t) / (8 * t**3) - s(4 * t) / (256 * t**3)


def eq26(t: Real) -> Real:
    return mp.mpf(1) / 2 - t * s(2 * t) / (4 * t**2)


def eq27(t: Real) -> Real:
    bracket = 400 - 40 * c(t / 2) - 40 * c(t / 5) - 40 * c(2 * t / 5) - 40 * c(3 * t / 5)
    bracket += -40 * c(4 * t / 5) - 40 * c(t / 10) - 40 * c(3 * t / 10) - 40 * c(7 * t / 10)
    bracket += -40 * c(9 * t / 10) + 77 * t**2 - 40 * c(t) - 40 * t * s(t) - 20 * t * s(t / 2)
    bracket += -8 * t * s(t / 5) - 16 * t * s(2 * t / 5) - 24 * t * s(3 * t / 5)
    bracket += -32 * t * s(4 * t / 5) - 4 * t * s(t / 10) - 12 * t * s(3 * t / 10)
    bracket += -28 * t * s(7 * t / 10) - 36 * t * s(9 * t / 10)
    return bracket / (40 * t**4)


def eq28(t: Real) -> Real:
    """With the cosine before 9 theta/5 that is not printed (E6)."""
    bracket = 30 + c(2 * t) - 4 * c(t / 2) - 3 * c(t / 5) - 3 * c(2 * t / 5) - 3 * c(3 * t / 5)
    bracket += -3 * c(4 * t / 5) - 4 * c(t / 10) + c(6 * t / 5) + c(7 * t / 5) - 4 * c(3 * t / 10)
    bracket += c(8 * t / 5) + c(9 * t / 5) - 4 * c(7 * t / 10) - 4 * c(9 * t / 10) - 3 * c(t)
    return bracket / (4 * t**2)


def eq29(t: Real) -> Real:
    terms = c(2 * t) / 32 - 99 * c(t / 5) / 200 - 303 * c(2 * t / 5) / 800
    terms += -91 * c(3 * t / 5) / 200 - 17 * c(4 * t / 5) / 50 - 207 * c(6 * t / 5) / 800
    terms += -51 * c(7 * t / 5) / 200 - 27 * c(8 * t / 5) / 200 - 19 * c(9 * t / 5) / 200
    terms += c(12 * t / 5) / 50 + 9 * c(14 * t / 5) / 800 + c(16 * t / 5) / 200
    return terms + c(18 * t / 5) / 800 - 3 * c(t) / 8 + mp.mpf(1051) / 160


def eq30(t: Real) -> Real:
    terms = s(t / 2) ** 2 + s(t / 5) ** 2 + s(2 * t / 5) ** 2 + s(3 * t / 5) ** 2
    terms += s(4 * t / 5) ** 2 + s(t / 10) ** 2 + s(3 * t / 10) ** 2 + s(7 * t / 10) ** 2
    return terms + s(9 * t / 10) ** 2 + s(t) ** 2


PRINTED: tuple[Formula, ...] = (eq10, eq11, eq25, eq26, eq27, eq28, eq29, eq30)
EXACT: tuple[Formula, ...] = (
    eq10,
    eq11,
    lambda t: mp.mpf(1) / 3,  # E4
    eq26,
    lambda t: 2 * eq27(t),  # E3
    lambda t: 2 * eq28(t),
    lambda t: mp.mpf(77) / 20,
    eq30,
)


# --- Sums over disks at k/N, from eqs. (1) to (4) -------------------------------------------------


def disk_sums(t: Real, num_disks: int) -> dict[str, Real]:
    total = dict.fromkeys(("H5", "H6", "H7", "H7 printed", "H8"), mp.zero)
    for k in range(1, num_disks + 1):
        x = mp.mpf(k) / num_disks
        y = x * t
        outwards = (y * s(y) - 1 + c(y)) / t**2  # d/dtheta of (1 - cos y)/theta
        along_z = (y * c(y) - s(y)) / t**2  # d/dtheta of sin y / theta
        total["H5"] += outwards**2 + along_z**2
        total["H6"] += ((1 - c(y)) / t) ** 2
        total["H7"] += x**2
        total["H7 printed"] += (x * c(y) ** 2 + s(y) ** 2) ** 2
        total["H8"] += s(y) ** 2
    return total


@pytest.mark.parametrize(("kind", "formulas"), [("printed", PRINTED), ("exact", EXACT)])
@pytest.mark.parametrize("i", range(8), ids=Factors._fields)
def test_factors_of_ten_disks(kind: str, formulas: tuple[Formula, ...], i: int) -> None:
    expected = [float(formulas[i](mp.mpf(float(t)))) for t in ANGLES]
    np.testing.assert_allclose(factors(ANGLES, kind)[i], expected, rtol=ROUNDING, atol=0.0)


@pytest.mark.parametrize("num_disks", [1, 2, 7, 10, 64])
def test_factors_of_any_number_of_disks(num_disks: int) -> None:
    some = ANGLES[::4]
    expected = [disk_sums(mp.mpf(float(t)), num_disks) for t in some]
    exact, printed = (factors(some, kind, num_disks) for kind in ("exact", "printed"))
    for name, found in (
        ("H5", exact.H5),
        ("H5", 2.0 * printed.H5),  # E3
        ("H6", exact.H6),
        ("H6", 2.0 * printed.H6),
        ("H7", exact.H7),
        ("H7 printed", printed.H7),  # E4
        ("H8", exact.H8),
        ("H8", printed.H8),
    ):
        values = [float(one[name]) for one in expected]
        np.testing.assert_allclose(found, values, rtol=ROUNDING, atol=0.0, err_msg=name)
    np.testing.assert_array_equal(exact[:2], printed[:2])  # H1, H2 have no disks


def test_no_disks_have_no_inertia() -> None:
    for kind in KINDS:
        assert factors(1.0, kind, 0)[4:] == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("kind", KINDS)
def test_at_the_straight_robot(kind: str) -> None:
    H = factors(0.0, kind)
    half = 0.5 if kind.startswith("printed") else 1.0
    expected = (0.15, 0.0, 1.0 / 3.0, 0.0, half * 0.633325, 0.0, 3.85, 0.0)
    np.testing.assert_allclose(H, expected, rtol=ROUNDING, atol=0.0)
    assert all(np.ndim(h) == 0 for h in H)


@pytest.mark.parametrize("kind", KINDS)
def test_shape_and_sign(kind: str) -> None:
    angles = np.linspace(-3.0, 3.0, 12).reshape(3, 4)
    H = np.array(factors(angles, kind))
    assert H.shape == (8, 3, 4)
    np.testing.assert_allclose(H, np.array(factors(-angles, kind)), rtol=ROUNDING, atol=0.0)
    one = np.array(factors(angles[1, 2], kind))
    np.testing.assert_allclose(H[:, 1, 2], one, rtol=ROUNDING, atol=0.0)


# --- Taylor ---------------------------------------------------------------------------------------


def test_12_and_13_are_the_coefficients_of_h1_and_h2() -> None:
    for kind in ("taylor", "printed-taylor"):
        H1, H2, *_ = taylor_coefficients(kind)
        assert list(H1) == [Fraction(3, 20), Fraction(-1, 168), Fraction(1, 8640)]
        assert list(H2) == [0, Fraction(1, 5), Fraction(-1, 42)]


@pytest.mark.parametrize("i", range(8), ids=Factors._fields)
def test_coefficients_are_the_derivatives_at_zero(i: int) -> None:
    # By Cauchy's integral around zero, where the expressions themselves divide zero by zero.
    with mp.workdps(20):  # a circle of radius one loses none
        expected = [float(a) for a in mp.taylor(PRINTED[i], 0, 4, method="quad", radius=1)]
    assert expected[1::2] == pytest.approx([0.0, 0.0], abs=ONE_ROUNDING)
    found = [float(a) for a in taylor_coefficients("printed-taylor")[i]]
    assert found == pytest.approx(expected[::2], rel=ONE_ROUNDING, abs=ONE_ROUNDING)


def test_derived_coefficients_differ_as_e3_and_e4_say() -> None:
    derived, printed = taylor_coefficients("taylor"), taylor_coefficients("printed-taylor")
    assert list(derived.H3) == [Fraction(1, 3), 0, 0]
    assert list(derived.H7) == [Fraction(77, 20), 0, 0]
    for name, factor in (("H1", 1), ("H2", 1), ("H4", 1), ("H5", 2), ("H6", 2), ("H8", 1)):
        assert list(getattr(derived, name)) == list(factor * getattr(printed, name)), name


@pytest.mark.parametrize("kind", ["taylor", "printed-taylor"])
@pytest.mark.parametrize("num_disks", [3, 10])
def test_cut_factors_are_their_polynomials(kind: str, num_disks: int) -> None:
    for H, (c0, c1, c2) in zip(
        factors(ANGLES, kind, num_disks), taylor_coefficients(kind, num_disks), strict=True
    ):
        exact = [c0 + c1 * Fraction(t) ** 2 + c2 * Fraction(t) ** 4 for t in ANGLES]
        terms = [abs(c0) + abs(c1) * Fraction(t) ** 2 + abs(c2) * Fraction(t) ** 4 for t in ANGLES]
        error = np.abs(np.array([float(Fraction(h) - e) for h, e in zip(H, exact, strict=True)]))
        assert np.all(error <= 4 * ONE_ROUNDING * np.array([float(a) for a in terms]))


def test_what_the_cut_costs_at_the_edge_of_the_papers_range() -> None:
    """In per cent, to the digits given; the paper says less than 0.05 for the whole."""
    exact, cut = factors(EDGE), factors(EDGE, "taylor")
    errors = {name: 100 * (getattr(cut, name) / getattr(exact, name) - 1) for name in exact._fields}
    assert round(errors["H1"], 3) == 0.045
    assert round(errors["H5"], 3) == 0.059
    assert [round(errors[name]) for name in ("H2", "H4", "H6", "H8")] == [-12, -41, -14, -51]
    robot = cdcr.robots.amouri2020()
    both = zip(inertia(EDGE, robot, "taylor"), inertia(EDGE, robot), strict=True)
    M11, M22 = (100 * (cut / exact - 1) for cut, exact in both)
    assert (round(M11, 3), round(M22, 1)) == (0.056, -13.8)


# --- Inertia, eq. (21) ----------------------------------------------------------------------------


def robots() -> list[cdcr.Robot]:
    table1 = cdcr.robots.amouri2020()
    section = dataclasses.replace(table1.sections[0], num_disks=3, disk_diameter=0.3)
    return [table1, cdcr.Robot(sections=[section], payload=0.05)]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("robot", robots(), ids=["table 1", "large disks and payload"])
def test_inertia_is_the_models(robot: cdcr.Robot, kind: str) -> None:
    angles = np.concatenate([np.geomspace(1e-8, 0.1, 20), np.linspace(0.1, math.pi, 60)])
    model = cdcr.Model(robot, kind)
    of_model = np.array([np.diag(model.mass_matrix([t, 0.0])) for t in angles])
    M11, M22 = inertia(angles, robot, kind)
    np.testing.assert_allclose(M11, of_model[:, 0], rtol=1e-13, atol=0.0)
    # M22 of the cut kinds passes through zero, where no relative error can be small.
    away = np.abs(of_model[:, 1]) > 0.01 * of_model[0, 1]
    assert np.sum(away) >= 78
    np.testing.assert_allclose((M22 / angles**2)[away], of_model[away, 1], rtol=1e-13, atol=0.0)


@pytest.mark.parametrize("kind", KINDS)
def test_inertia_is_eq_21_with_the_third_and_the_quarter(kind: str) -> None:
    robot = cdcr.robots.amouri2020()
    section = robot.sections[0]
    l2, m_b, m_d = section.length**2, section.backbone_mass, section.disk_mass
    I_xx = m_d * section.disk_diameter**2 / 16.0
    if kind.startswith("printed"):
        turning = section.length * section.second_moment_of_area  # E5
    else:
        turning = m_b * section.backbone_diameter**2 / 16.0
    angles = ANGLES[ANGLES > 0.1]  # the closed form of the spin loses digits below
    H = factors(angles, kind)
    M11 = l2 * m_b * H.H1 / 3.0 + turning * H.H3 + l2 * m_d * H.H5 + I_xx * H.H7
    M22 = l2 * m_b * H.H2 / 4.0 + turning * H.H4 + l2 * m_d * H.H6 + I_xx * H.H8
    of_backbone, of_disks = spin(kind, angles)
    M22 = M22 + 2.0 * (turning * of_backbone + I_xx * of_disks)
    found = inertia(angles, robot, kind)
    np.testing.assert_allclose(found[0], M11, rtol=ROUNDING, atol=0.0)
    np.testing.assert_allclose(found[1], M22, rtol=ROUNDING, atol=0.0)


def spin(kind: str, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """E7: (1 - cos y)^2 over the backbone and over ten disks."""
    y = t[:, np.newaxis] * np.arange(1, 11) / 10.0
    if kind == "exact":
        backbone = 1.5 - 2.0 * np.sin(t) / t + np.sin(2.0 * t) / (4.0 * t)
        return backbone, np.sum((1.0 - np.cos(y)) ** 2, axis=1)
    if kind == "taylor":
        return t**4 / 20.0, np.sum(y**4, axis=1) / 4.0
    return np.zeros_like(t), np.zeros_like(t)


# --- Refusals -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((1.0, "exakt"), r"kind must be one of .*'printed-taylor'\), got 'exakt'"),
        ((math.nan,), "theta must be finite, got nan"),
        (("far",), "theta must be numbers, got str"),
        (([0.0, -9.5],), r"theta must lie within cdcr.max_bending = 9.42478 rad .* got 9.5 rad"),
        ((1.0, "exact", 65), r"num_disks must be a whole number 0 to 64, got 65 \(int\)"),
        ((1.0, "taylor", 2.5), r"num_disks must be a whole number 0 to 64, got 2.5 \(float\)"),
    ],
)
def test_bad_arguments_are_refused(arguments: tuple[Any, ...], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        factors(*arguments)


def test_only_a_cut_has_coefficients() -> None:
    with pytest.raises(ValueError, match="kind must be 'taylor' or 'printed-taylor', got 'exact'"):
        taylor_coefficients("exact")


def test_inertia_is_of_one_section() -> None:
    two = cdcr.Robot(sections=2 * cdcr.robots.amouri2020().sections)
    with pytest.raises(ValueError, match="for one section, got a robot of 2"):
        inertia(1.0, two)
    with pytest.raises(TypeError, match=r"robot must be a cdcr\.Robot, got dict"):
        inertia(1.0, {})  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="kind must be one of"):
        inertia(1.0, cdcr.robots.amouri2020(), "cut")
