"""Curved rods in space: a helix held by its end, and a ring sector bent and twisted at its tip.

``pytest -s`` prints the errors over the order.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr

FloatArray = NDArray[np.float64]

# A state of uniform strain is one of every order: Newton's method ends near rounding.
UNIFORM = 1e-9
# What order 4 leaves of the compliance of a half ring, relative, and what rounding leaves.
RING, ROUNDING = 5e-5, 1e-11

LENGTH = 0.5
ROD = cdcr.Section(
    length=LENGTH,
    backbone_mass=0.02,
    backbone_diameter=0.004,
    youngs_modulus=2e8,
    shear_modulus=8e7,
    twist_order=0,
    nodes=32,
)
EI = ROD.youngs_modulus * ROD.second_moment_of_area
GJ = 2.0 * 8e7 * ROD.second_moment_of_area


def model_of(order: int, **change: object) -> cdcr.Model:
    rod = replace(ROD, bending_order=order, twist_order=order, **change)  # type: ignore[arg-type]
    return cdcr.Model(cdcr.Robot(sections=[rod]))


# --- Helix ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize(("theta", "twist"), [(1.0, 0.7), (3.0, -2.0), (4.0, 2.0)])
def test_a_wrench_along_the_axis_of_a_helix_holds_it(
    order: int, theta: float, twist: float
) -> None:
    """Kirchhoff: of curvature k, torsion t and w^2 = k^2 + t^2 under (G J - E I) t w along it."""
    model = model_of(order)
    q = np.zeros(model.num_coordinates)
    q[:2] = theta * np.array([np.cos(0.3), np.sin(0.3)])
    q[model.coordinate_names.index("t1")] = twist
    R, p = model.tip(q)
    u = np.array([-q[1], q[0], twist]) / LENGTH  # in the frame of the disks, along the whole rod
    axis = R @ u / np.linalg.norm(u)
    force = (GJ - EI) * twist / LENGTH * np.linalg.norm(u) * axis
    load = cdcr.Wrench(section=0, force=force, moment=R @ (np.array([EI, EI, GJ]) * u))
    # The place along the axis and the radius about it are those of a helix.
    turned = np.linalg.norm(u) * LENGTH
    assert p @ axis == pytest.approx(LENGTH**2 * u[2] / turned)
    radius = np.hypot(u[0], u[1]) / (u @ u)
    assert np.linalg.norm(p - (p @ axis) * axis) == pytest.approx(
        2.0 * radius * abs(np.sin(0.5 * turned))
    )
    found = model.equilibrium(q0=q + 0.01, wrenches=load)
    assert np.abs(found - q).max() <= UNIFORM


# --- Ring sector ----------------------------------------------------------------------------------


def ring(angle: float) -> FloatArray:
    """Compliances of a ring sector at its tip, by Castigliano: in its plane, and across it.

    Forces act along the radius, along the tangent and across the plane; phi counts from the tip.
    """
    radius = LENGTH / angle
    s, c = np.sin(angle), np.cos(angle)
    sine = 0.5 * (angle - s * c)  # int sin^2 dphi
    versine = 1.5 * angle - 2.0 * s + 0.5 * s * c  # int (1 - cos)^2 dphi
    return np.asarray(radius**3 * np.array([sine / EI, versine / EI, sine / EI + versine / GJ]))


@pytest.mark.parametrize("angle", [0.5 * np.pi, np.pi])
def test_a_ring_sector_yields_as_castigliano_says(angle: float) -> None:
    direction = np.array([np.cos(0.7), np.sin(0.7)])
    errors = []
    for order in range(5):
        model = model_of(order, rest_bending=angle * direction)
        q = model.rest_shape
        R, _ = model.tip(q)
        J = model.tip_jacobian(q)[:3]
        compliance = J @ np.linalg.solve(model.static_stiffness(q, []), J.T)
        radial = R @ np.array([*direction, 0.0])
        across = R @ np.array([-direction[1], direction[0], 0.0])
        found = [d @ compliance @ d for d in (radial, R[:, 2], across)]
        errors.append(np.array(found) / ring(angle) - 1.0)
        print(f"\n{angle:.2f} rad, order {order}: radius, tangent, across {errors[-1]}")
    # An order is a constraint less: it yields more, and no more than the ring.
    assert np.all(np.diff(errors, axis=0) > -ROUNDING)
    assert np.all(np.array(errors) < ROUNDING)
    assert np.abs(errors[-1]).max() <= RING
