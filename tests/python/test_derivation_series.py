"""The power series of cpp/README.md eq. (21), and how good the model's polynomials are.

Rational arithmetic multiplies the series of the brackets out, so the coefficients are proven, not
compared to rounding. The accuracy table of cpp/README.md is held against what is measured here:
``pytest -s -k accuracy`` prints it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mpmath.ctx_mp import MPContext  # type: ignore[import-untyped]

import cdcr

README = Path(__file__).parents[2] / "cpp" / "README.md"

NUM_TERMS = 46  # as many as cpp/src/section/mass_moments.hpp keeps
REFERENCE_TERMS = 80  # enough for 40 digits at 3 pi
SAMPLES = 60  # bending angles in each of the three columns of the table

mp = MPContext()  # of our own: other tests keep their precision
mp.dps = 60

Series = list[Fraction]  # coefficients of y^0, y^2, y^4, ..., or of sigma^0, sigma^1, ...
Errors = dict[tuple[str, str], list[float]]  # by function and scale: up to pi, 2 pi, 3 pi


def product(f: Series, g: Series) -> Series:
    return [
        sum((f[i] * g[k - i] for i in range(k + 1)), Fraction(0))
        for k in range(min(len(f), len(g)))
    ]


def brackets(num_terms: int) -> dict[str, Series]:
    """A, S, A^2, S^2, (D - A^2)/y^2 and (1 - S^2)/y^2 from the series of cos y and sin y / y."""
    n = num_terms + 3  # divisions by y^2 take terms off the front
    cos = [Fraction((-1) ** k, math.factorial(2 * k)) for k in range(n)]
    S = [Fraction((-1) ** k, math.factorial(2 * k + 1)) for k in range(n)]
    A = [-c for c in cos[1:]]
    A2, S2 = product(A, A), product(S, S)
    # y^2 + 2 - 2 cos y - 2 y sin y, of which y^0 and y^2 vanish
    D = [-2 * c - 2 * s for c, s in zip(cos, [Fraction(0), *S], strict=False)]
    D[0] += 2
    D[1] += 1
    assert D[:2] == [0, 0]
    spread = [d - a for d, a in zip(D[2:], A2, strict=False)]
    turn = [-s for s in S2]
    turn[0] += 1
    assert spread[0] == turn[0] == 0
    series = {"A": A, "S": S, "A^2": A2, "S^2": S2, "spread": spread[1:], "turn": turn[1:]}
    return {name: f[:num_terms] for name, f in series.items()}


def test_the_coefficients_of_the_brackets() -> None:
    derived = brackets(NUM_TERMS)
    for j in range(NUM_TERMS):

        def term(factor: int, n: int, sign: int = (-1) ** j) -> Fraction:
            return Fraction(sign * factor, math.factorial(n))

        assert derived["A"][j] == term(1, 2 * j + 2)
        assert derived["S"][j] == term(1, 2 * j + 1)
        assert derived["A^2"][j] == term(8 * 4**j - 2, 2 * j + 4)
        assert derived["S^2"][j] == term(2 * 4**j, 2 * j + 2)
        assert derived["spread"][j] == term(32 * 4**j - 4 * (j + 3), 2 * j + 6)
        assert derived["turn"][j] == term(8 * 4**j, 2 * j + 4)


def test_the_first_term_left_out_is_below_rounding() -> None:
    """At 3 pi the fastest growing bracket, cos 2y, has fallen below 1e-23 of its first term."""
    last = NUM_TERMS - 1
    assert mp.mpf(6 * math.pi) ** (2 * last) / mp.factorial(2 * last) < 1e-22


class Moments:
    """Sums over the elements of (weight) x^power."""

    def __init__(self, num_disks: int, rod: Fraction, disk: Fraction, tip: Fraction) -> None:
        self.num_disks, self.rod, self.disk, self.tip = num_disks, rod, disk, tip

    def __call__(self, power: int) -> Fraction:
        fractions = [Fraction(k, self.num_disks) for k in range(1, self.num_disks + 1)]
        disks = sum((x**power for x in fractions), Fraction(0))
        return self.rod / (power + 1) + self.disk * disks + self.tip


def exact_series(robot: cdcr.Robot) -> dict[str, Series]:
    """Equation (21) in rational numbers: a, b, G_A, G_S as series in sigma."""
    s, c = robot.sections[0], brackets(REFERENCE_TERMS)
    l2 = Fraction(s.length) ** 2
    rod, disk = Fraction(s.backbone_mass), Fraction(s.disk_mass)
    mass = Moments(s.num_disks, rod, disk, Fraction(robot.payload))
    rod *= Fraction(s.backbone_diameter) ** 2 / 16
    disk *= Fraction(s.disk_diameter) ** 2 / 16
    I_t = Moments(s.num_disks, rod, disk, Fraction(0))

    f: dict[str, Series] = {"a": [], "b": [], "G_A": [], "G_S": []}
    for j in range(REFERENCE_TERMS):
        a = l2 * mass(2 * j + 4) * c["A^2"][j] + I_t(2 * j + 2) * c["S^2"][j]
        if j > 0:
            a += 2 * I_t(2 * j + 2) * c["A^2"][j - 1]
        f["a"].append(a)
        b = l2 * mass(2 * j + 6) * c["spread"][j]
        f["b"].append(b + I_t(2 * j + 4) * (c["turn"][j] - 2 * c["A^2"][j]))
        f["G_A"].append(mass(2 * j + 2) * c["A"][j])
        f["G_S"].append(mass(2 * j + 1) * c["S"][j])
    return f


class Reference:
    """a, b, G_A, G_S and the largest entry of M at 60 digits."""

    def __init__(self, robot: cdcr.Robot) -> None:
        self.series = {
            name: [mp.mpf(c.numerator) / c.denominator for c in coefficients]
            for name, coefficients in exact_series(robot).items()
        }

    def __call__(self, name: str, sigma: Any) -> Any:
        if name == "M":
            a, b = self("a", sigma), self("b", sigma)
            return max(a, a + b * sigma)
        total = mp.mpf(0)
        for coefficient in reversed(self.series[name]):
            total = total * sigma + coefficient
        return total


class Reader:
    """a, b, G_A and G_S as the compiled model has them, each read without cancellation."""

    def __init__(self, robot: cdcr.Robot) -> None:
        # Hardly any stiffness: the potential energy is weight alone.
        section = replace(robot.sections[0], youngs_modulus=1e-290)
        limp = replace(robot, sections=(section,))
        self.length = section.length
        self.sideways = cdcr.Model(replace(limp, gravity=(-1.0, 0.0, 0.0)))
        self.upwards = cdcr.Model(replace(limp, gravity=(0.0, 0.0, -1.0)))

    def __call__(self, theta: float) -> Iterator[tuple[str, Any, float]]:
        """Name, sigma at which the model was asked, value."""
        u = theta / math.sqrt(2.0)  # q = (u, u): an entry of M that is b alone
        along, across = mp.mpf(theta) ** 2, 2 * mp.mpf(u) ** 2
        M = self.sideways.mass_matrix([theta, 0.0])
        weight = self.sideways.potential_energy([theta, 0.0])
        yield "a", along, M[1, 1]
        yield "b", across, self.sideways.mass_matrix([u, u])[0, 1] / u**2
        yield "G_A", along, weight / theta / self.length
        yield "G_S", along, self.upwards.potential_energy([theta, 0.0]) / self.length
        yield "M", along, max(M[0, 0], M[1, 1])


def accuracy(robot: cdcr.Robot) -> Errors:
    """Largest error over the function's own value, and over its value when straight."""
    reference, read = Reference(robot), Reader(robot)
    found: Errors = {}
    for column in range(3):
        for theta in np.linspace(column, column + 1, SAMPLES + 1)[1:] * math.pi:
            # The last angle of all must not lie beyond the bending limit.
            for name, sigma, value in read(min(float(theta), cdcr.max_bending)):
                expected = reference(name, sigma)
                difference = abs(mp.mpf(value) - expected)
                for scale, size in (("its value", expected), ("straight", reference(name, 0))):
                    worst = found.setdefault((name, scale), [0.0, 0.0, 0.0])
                    error = float(abs(difference / size)) if difference else 0.0
                    worst[column:] = np.maximum(worst[column:], error).tolist()
    return found


def stated() -> Errors:
    """The rows of the README's accuracy table."""
    number = r"(\d(?:\.\d)?e-\d+)"
    row = rf"^\| (\w+) \| (its value|straight) \| {number} \| {number} \| {number} \|$"
    rows = re.findall(row, README.read_text(), re.MULTILINE)
    return {(name, scale): [float(v) for v in values] for name, scale, *values in rows}


TABLE_1 = cdcr.robots.amouri2020()
SECTION = TABLE_1.sections[0]
ROD = replace(SECTION, num_disks=0)
ONE_DISK = replace(SECTION, num_disks=1, disk_diameter=SECTION.length)
OTHERS = {
    "no disks": replace(TABLE_1, sections=(ROD,)),
    "heavy tip": replace(TABLE_1, payload=0.5),
    "payload alone": replace(TABLE_1, sections=(replace(ROD, backbone_mass=0.0),), payload=0.1),
    "one wide disk": replace(TABLE_1, sections=(ONE_DISK,)),
}


def show(title: str, found: Errors) -> None:
    print(f"\n{title}: relative error up to pi, 2 pi, 3 pi")
    for (name, scale), errors in found.items():
        print(f"  {name:4} over {scale:10}", *(f"{error:8.1e}" for error in errors))


def test_accuracy_of_table_1_is_as_the_readme_states() -> None:
    found, limits = accuracy(TABLE_1), stated()
    show("Table 1", found)
    assert {name for name, _ in limits} == {"a", "b", "G_A", "G_S", "M"}
    for row, limit in limits.items():
        assert all(np.array(found[row]) <= limit), row


@pytest.mark.parametrize("name", OTHERS)
def test_accuracy_of_other_robots_is_as_the_readme_states(name: str) -> None:
    found = accuracy(OTHERS[name])
    show(name, found)
    limit = float(re.search(r"below (\S+) of that for other robots", README.read_text())[1])  # type: ignore[index]
    for function in ("a", "b", "G_A", "G_S"):
        assert max(found[function, "straight"]) <= limit, function
