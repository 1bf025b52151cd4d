"""One section of varying curvature against the elastica: a force and a moment at its tip.

``pytest -s`` prints the errors over the order of bending, and the order with which they fall where
the section is cut into parts.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp  # type: ignore[import-untyped]
from scipy.optimize import brentq  # type: ignore[import-untyped]

import cdcr
from bent_rod import FLEXURAL, LENGTH, Tip, backbone, elastica, tip_of

FloatArray = NDArray[np.float64]

ORDERS = (0, 1, 2, 3, 4)
# What order 4 leaves of the tip, in lengths and radians: ten times what was found.
BEST = 4e-6
# By how much each order is better than the one before, at least.
FASTER = 2.5
# Sums of some hundred terms near 1, divided by themselves.
ROUNDING = 1e-12
# Of solve_ivp at its tightest, after a bracketed root.
SHOOTING = 1e-10
# Of the order of convergence, from 4 to 8 parts: what higher terms leave.
EXPONENT = 0.3

ACROSS = np.array([math.cos(0.4), math.sin(0.4), 0.0])
ABOUT = np.array([-ACROSS[1], ACROSS[0], 0.0])  # a moment about it bends towards ACROSS


def shot(force: float, moment: float) -> Tip:
    """Tip of a cantilever of unit length and stiffness, by shooting: psi'' = -force cos psi."""

    def end(kappa: float) -> FloatArray:
        def slope(_: float, y: FloatArray) -> list[float]:
            psi, bent = y[0], y[1]
            return [bent, -force * math.cos(psi), math.cos(psi), math.sin(psi)]

        start = [0.0, kappa, 0.0, 0.0]
        return np.asarray(solve_ivp(slope, (0.0, 1.0), start, "DOP853", rtol=1e-13, atol=1e-14).y)

    low, high = sorted((moment, moment + force))  # cos psi is between 0 and 1 here
    kappa = brentq(lambda k: end(k)[1, -1] - moment, low - 1e-9, high + 1e-9, xtol=1e-14)
    psi, _, along, across = end(kappa)[:, -1]
    return np.array([along, across, psi])


def tip_with(order: int, parts: int, force: float, moment: float) -> Tip:
    """Tip of the robot at rest, in lengths."""
    (section,) = backbone().sections
    rod = replace(section, bending_order=order, nodes=32)
    model = cdcr.Model(cdcr.Robot(sections=[rod]).subdivide(parts))
    load = cdcr.Wrench(
        section=parts - 1,
        force=force * FLEXURAL / LENGTH**2 * ACROSS,
        moment=moment * FLEXURAL / LENGTH * ABOUT,
    )
    return tip_of(model, model.equilibrium(wrenches=load), ACROSS)


def errors_of_orders(force: float, moment: float) -> FloatArray:
    """Return the largest error of the tip for each order (5,), and print them."""
    exact = shot(force, moment)
    errors = np.array([np.abs(tip_with(order, 1, force, moment) - exact) for order in ORDERS])
    print(f"\nF l^2/(E I) = {force:g}, M l/(E I) = {moment:g}: along, across [l], angle [rad]")
    for order, error in zip(ORDERS, errors, strict=True):
        print(f"order {order}: off by", "  ".join(f"{e:.1e}" for e in error))
    return np.asarray(errors.max(axis=1))


def test_shooting_gives_the_elliptic_integrals() -> None:
    for load in (1.0, 3.0, 10.0):
        assert np.abs(shot(load, 0.0) - elastica(load)).max() <= SHOOTING
    assert shot(0.0, 1.2) == pytest.approx([math.sin(1.2) / 1.2, (1 - math.cos(1.2)) / 1.2, 1.2])


@pytest.mark.parametrize(("force", "moment"), [(1.0, 0.0), (3.0, 0.0), (2.0, 1.0), (3.0, -1.0)])
def test_each_order_comes_nearer(force: float, moment: float) -> None:
    errors = errors_of_orders(force, moment)
    assert np.all(errors[1:] * FASTER <= errors[:-1])
    assert errors[-1] <= BEST


def test_a_moment_alone_bends_every_order_into_the_arc() -> None:
    assert errors_of_orders(0.0, 2.0).max() <= ROUNDING


@pytest.mark.parametrize("order", [1, 2])
def test_parts_converge_with_twice_the_power(order: int) -> None:
    """The tip is a linear answer of the energy's minimum: twice the order of the curvature's."""
    exact = shot(3.0, 0.0)
    errors = np.array([np.abs(tip_with(order, n, 3.0, 0.0) - exact).max() for n in (1, 2, 4, 8)])
    found = np.log2(errors[:-1] / errors[1:])
    print(f"\norder {order} in 1, 2, 4, 8 parts:", errors, "orders:", found.round(2))
    assert abs(found[-1] - 2.0 * (order + 1)) < EXPONENT
