"""Subdivided robots under load against the elastica: a tip force, and their own weight.

Equilibria are found here from the model's elastic and weight forces and its Jacobian alone:
dU/dq = J^T w. ``pytest -s`` prints the errors over the number of parts.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_bvp  # type: ignore[import-untyped]
from scipy.optimize import root  # type: ignore[import-untyped]

import cdcr
from bent_rod import FLEXURAL, LENGTH, Tip, backbone, elastica, tip_of

FloatArray = NDArray[np.float64]

PARTS = (1, 2, 4, 8, 16)
# Moments in balance over the bending stiffness: Powell's method ends near rounding.
AT_REST = 1e-11
# Of solve_bvp, in lengths and radians.
BVP = 1e-8
# Halving the parts quarters the error, up to higher terms: orders from 8 to 16 parts.
ORDER = 0.05


def equilibrium(model: cdcr.Model, tip_force: FloatArray, steps: int = 8) -> FloatArray:
    """Bending vectors where dU/dq = J^T f of a force at the tip, the load put on in steps."""
    rest = np.zeros(model.num_coordinates)
    last = model.num_sections - 1
    stiffness = model.robot.sections[0].stiffness

    def unbalanced(q: FloatArray, share: float) -> FloatArray:
        J = model.jacobian(q, last, 1.0)
        weight = model.bias(q, rest) - elastic * q
        return np.asarray(elastic * q + share * (weight - J[:3].T @ tip_force)) / stiffness

    elastic = np.repeat([section.stiffness for section in model.robot.sections], 2)
    q = rest
    for step in range(1, steps + 1):
        q = root(unbalanced, q, args=(step / steps,), tol=1e-14).x
    assert np.abs(unbalanced(q, 1.0)).max() < AT_REST
    return q


def check_convergence(what: str, tip_with: Callable[[int], Tip], exact: Tip) -> None:
    """Errors over the number of parts fall with its square."""
    errors = np.array([np.abs(tip_with(parts) - exact) for parts in PARTS])
    orders = np.log2(errors[:-1] / errors[1:])
    print(f"\n{what}: tip along {exact[0]:.6f}, across {exact[1]:.6f}, angle {exact[2]:.6f} rad")
    for parts, error in zip(PARTS, errors, strict=True):
        print(f"{parts:2d} parts: off by", "  ".join(f"{e:.2e}" for e in error))
    print("orders at the end:", np.round(orders[-1], 3))
    assert np.all(np.abs(orders[-1] - 2.0) < ORDER)


# --- Force at the tip -----------------------------------------------------------------------------


def test_the_elastica_of_a_small_load_is_the_beam_of_the_textbook() -> None:
    load = 1e-3
    assert elastica(load)[1:] == pytest.approx([load / 3.0, load / 2.0], rel=1e-6)


@pytest.mark.parametrize("load", [1.0, 3.0, 10.0])
def test_a_tip_force_bends_the_robot_into_the_elastica(load: float) -> None:
    direction = np.array([math.cos(0.4), math.sin(0.4), 0.0])
    force = load * FLEXURAL / LENGTH**2 * direction

    def tip_with(parts: int) -> Tip:
        model = cdcr.Model(backbone().subdivide(parts))
        return tip_of(model, equilibrium(model, force), direction)

    check_convergence(f"tip force F l^2/(E I) = {load:g}", tip_with, elastica(load))


# --- Own weight -----------------------------------------------------------------------------------

# Horizontal: the robot's Z along X of the base frame.
HORIZONTAL = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0))
GRAVITY = (0.0, 0.0, -9.81)
DOWN = np.array([0.0, 0.0, -1.0])
NOTHING = np.zeros(3)


def sagging(loads: FloatArray, spread: float) -> Tip:
    """Tip of a horizontal elastica of unit length and stiffness, with weight spread along it.

    `loads` hang at the ends of equal stretches besides; on a stretch psi' = kappa and
    kappa' = -(weight beyond) cos psi.
    """
    count = len(loads)
    width = 1.0 / count
    beyond = np.cumsum(loads[::-1])[::-1]
    starts = width * np.arange(count)

    def rates(x: FloatArray, y: FloatArray) -> FloatArray:
        psi, kappa, _, _ = y.reshape(4, count, -1)
        weight = beyond[:, None] + spread * (1.0 - starts[:, None] - width * x)
        rate = np.stack([kappa, -weight * np.cos(psi), np.cos(psi), np.sin(psi)])
        return width * rate.reshape(4 * count, -1)

    def conditions(first: FloatArray, last: FloatArray) -> FloatArray:
        first, last = first.reshape(4, count), last.reshape(4, count)
        joined = (first[:, 1:] - last[:, :-1]).ravel()
        clamped = [first[0, 0], last[1, -1], first[2, 0], first[3, 0]]
        return np.concatenate([joined, clamped])

    x = np.linspace(0.0, 1.0, 41)
    start = np.zeros((4 * count, x.size))
    solution = solve_bvp(rates, conditions, x, start, tol=BVP / 10.0, max_nodes=20000)
    assert solution.success, solution.message
    psi, _, along, down = solution.y[:, -1].reshape(4, count)[:, -1]
    return np.array([along, down, psi])


def sag(whole: cdcr.Robot) -> Callable[[int], Tip]:
    def tip_with(parts: int) -> Tip:
        model = cdcr.Model(whole.subdivide(parts))
        return tip_of(model, equilibrium(model, NOTHING), DOWN)

    return tip_with


def test_a_light_rod_sags_by_an_eighth_of_its_load() -> None:
    load = 1e-3  # w l^3/(E I)
    tip = sagging(np.zeros(1), load)
    assert tip[1:] == pytest.approx([load / 8.0, load / 6.0], rel=1e-5)


@pytest.mark.parametrize("load", [1.0, 6.0])
def test_a_horizontal_rod_sags_under_its_own_weight(load: float) -> None:
    mass = load * FLEXURAL / LENGTH**2 / 9.81
    whole = backbone(mass, gravity=GRAVITY, base_orientation=HORIZONTAL)
    exact = sagging(np.zeros(1), load)
    check_convergence(f"own weight w l^3/(E I) = {load:g}", sag(whole), exact)


def test_the_horizontal_robot_of_table_1_sags_under_its_disks() -> None:
    table_1 = cdcr.robots.amouri2020()
    s = table_1.sections[0]
    whole = cdcr.Robot(sections=[s], gravity=GRAVITY, base_orientation=HORIZONTAL)
    unit = 9.81 * s.length / s.stiffness  # a weight of m g l/K, as l^2/(E I) = l/K
    exact = sagging(np.full(s.num_disks, s.disk_mass * unit), s.backbone_mass * unit)

    check_convergence("Table 1, horizontal", sag(whole), exact)
