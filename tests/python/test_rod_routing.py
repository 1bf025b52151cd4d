"""Helical and converging robots of Tummers et al. (2023), against Kirchhoff's equations.

Routings and material are those published with "Cosserat Rod Modeling of Continuum Robots from
Newtonian and Lagrangian Perspectives" (doi 10.1109/TRO.2023.3238171), where tips are not. Without
weight the balance of moments beyond each place, K u = sum F t x d with d and t place and direction
of a cable in the frame of the disk, decides the strains u there by themselves; frames follow from
them. The shear modulus is E/(2 (1 + nu)).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp  # type: ignore[import-untyped]

import cdcr

LENGTH, HOLES, RADIUS = 0.242, 8e-3, 0.4e-3  # of backbone, cables' circle and backbone [m]
MODULUS, POISSON = 210e9, 0.3125
BENDING = MODULUS * np.pi / 4.0 * RADIUS**4
TWIST = BENDING / (1.0 + POISSON)
# Of the length: four parts of orders 4, ten times what is seen.
TIP = 4e-8

Array = np.ndarray
Route = tuple[tuple[float, float], tuple[float, float]]  # radius and angle at base and tip
HELIX: Route = ((HOLES, HOLES), (0.0, 2.0 * np.pi))
CONE: Route = ((HOLES, 0.02 * HOLES), (0.0, 0.0))  # which ends on the backbone, but for a fiftieth


def place(route: Route) -> Callable[[float], tuple[Array, Array]]:
    """Return place and slope of a cable over the fraction of the length."""
    (r0, r1), (a0, a1) = route

    def at(x: float) -> tuple[Array, Array]:
        r, a = r0 + x * (r1 - r0), a0 + x * (a1 - a0)
        out, around = np.array([np.cos(a), np.sin(a), 0.0]), np.array([-np.sin(a), np.cos(a), 0.0])
        return r * out, (r1 - r0) * out + r * (a1 - a0) * around

    return at


def kirchhoff(routes: list[Route], tensions: list[float]) -> tuple[Array, Array]:
    """Return rotation and place of the tip."""
    stiffness = np.array([BENDING, BENDING, TWIST]) / LENGTH
    paths = [place(route) for route in routes]

    def strains(x: float) -> Array:
        u = np.zeros(3)
        for _ in range(30):  # a cable's own path changes by some percent
            moment = np.zeros(3)
            for path, tension in zip(paths, tensions, strict=True):
                d, slope = path(x)
                s = np.array([0.0, 0.0, LENGTH]) + np.cross(u, d) + slope
                moment += tension * np.cross(s / np.linalg.norm(s), d)
            last, u = u, moment / stiffness
        assert np.abs(u - last).max() < 1e-12
        return u

    def rates(x: float, y: Array) -> Array:
        R = y[:9].reshape(3, 3)
        turned = R @ np.cross(strains(x), np.eye(3)).T
        return np.concatenate([turned.ravel(), LENGTH * R[:, 2]])

    start = np.concatenate([np.eye(3).ravel(), np.zeros(3)])
    end = solve_ivp(rates, (0.0, 1.0), start, rtol=1e-10, atol=1e-12, method="DOP853").y[:, -1]
    return end[:9].reshape(3, 3), end[9:]


def robot(routes: list[Route], **orders: int) -> cdcr.Robot:
    section = cdcr.Section(
        length=LENGTH,
        backbone_mass=1e-3,
        backbone_diameter=2.0 * RADIUS,
        youngs_modulus=MODULUS,
        shear_modulus=MODULUS / (2.0 * (1.0 + POISSON)),
        **orders,  # type: ignore[arg-type]
    )
    cables = [cdcr.Cable(radius=[r], angle=[a], end_section=0) for r, a in routes]
    return cdcr.Robot(sections=[section], cables=cables)


def opposite(route: Route) -> Route:
    radius, (base, tip) = route
    return radius, (base + np.pi, tip + np.pi)


@pytest.mark.parametrize("route", [HELIX, CONE], ids=["helix", "cone"])
@pytest.mark.parametrize("tensions", [[1.0, 0.0], [0.0, 5.0]])
def test_tips_are_those_of_kirchhoff(route: Route, tensions: list[float]) -> None:
    routes = [route, opposite(route)]
    R, p = kirchhoff(routes, tensions)
    errors = []
    for order in (1, 2, 3, 4):
        model = cdcr.Model(robot(routes, bending_order=order, twist_order=order))
        found = model.tip(model.equilibrium(tensions))[1]
        errors.append(float(np.linalg.norm(found - p) / LENGTH))
    finest = cdcr.Model(robot(routes, bending_order=4, twist_order=4).subdivide(4))
    rotation, found = finest.tip(finest.equilibrium(tensions))
    off = float(np.linalg.norm(found - p) / LENGTH)
    print(f"\ntip {1e3 * p} mm; off over its length by {errors}, in four parts {off:.1e}")
    assert off < TIP
    assert np.abs(rotation - R).max() < 10.0 * TIP
    assert errors[-1] < 0.1 * errors[0]
    assert np.linalg.norm(p[:2]) > 0.02 * LENGTH  # it does bend


def test_pairs_may_be_an_array() -> None:
    pairs = [(0.01, 0.008), (0.008, 0.005)]
    cable = cdcr.Cable(radius=np.array(pairs), angle=np.array(pairs), end_section=1)
    assert cable == cdcr.Cable(radius=pairs, angle=pairs, end_section=1)
    with pytest.raises(ValueError, match=r"^radius\[0\] must be two numbers, base and tip, got "):
        cdcr.Cable(radius=np.zeros((2, 3)), angle=0.0, end_section=1)
