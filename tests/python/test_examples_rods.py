"""Examples of rods find what closed forms and quadrature find."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.optimize import root  # type: ignore[import-untyped]

from example_script import Example


def test_helical_cable(example: Example) -> None:
    found = example(17)
    # A rod bent by theta and twisted by t runs along a helix about their sum, a fixed axis.
    l, (x, y, t) = 0.2, (found["bent"], 0.0, found["twisted"])
    u = np.array([-y, x, t])
    angle = np.linalg.norm(u)
    axis, z = u / angle, np.array([0.0, 0.0, 1.0])
    turned = np.sin(angle) / angle * z + (1 - np.cos(angle)) / angle * np.cross(axis, z)
    turned = turned + (1 - np.sin(angle) / angle) * (axis @ z) * axis
    np.testing.assert_allclose(found["tip"], l * turned, rtol=0, atol=1e-8 * l)
    # By virtual work alone: twist of a straight rod that its cable shortens by.
    G, J, r, pull = 10e6, np.pi / 32 * 0.008**4, found["radius"], found["pull"]
    for turn, twist in zip(found["turns"], found["twists"], strict=True):
        a = 2 * np.pi * turn
        alone = root(lambda t, a=a: G * J / l * t + pull * r**2 * (a + t) / l, 0.0).x[0]
        assert twist == pytest.approx(alone, rel=0.2, abs=1e-9)
    # A whole turn bends it nowhere in sum, to first order; none bends it by F r l/(E I).
    assert found["leaning"][0] == pytest.approx(pull * r * l / (30e6 * J / 2), rel=1e-6)
    assert found["leaning"][3] < 0.1 * found["leaning"][0]


def test_tapered_arm(example: Example) -> None:
    found = example(18)
    l, base, E, density = (found[name] for name in ("LENGTH", "BASE", "MODULUS", "DENSITY"))
    s, h = np.linspace(0.0, l, 4001, retstep=True)

    def integral(y: Any) -> Any:
        return np.concatenate([[0.0], np.cumsum((y[1:] + y[:-1]) * h / 2)])

    def first_frequency(tip: float) -> float:
        """Vianello's iteration of a cantilever: deflect it under its own inertia."""
        d = base + s / l * (tip - base)
        EI, m = E * np.pi / 64 * d**4, density * np.pi / 4 * d**2
        w = s**2
        for _ in range(30):
            shear = integral((m * w)[::-1])[::-1]
            moment = integral(shear[::-1])[::-1]
            new = integral(integral(moment / EI))
            squared, w = w[-1] / new[-1], new / new[-1]
        return float(np.sqrt(squared) / (2 * np.pi))

    for k in (5, 10, 14):  # rotary inertia lowers it a little
        tip = found["tips"][k]
        assert found["frequency"][4][k] == pytest.approx(first_frequency(tip), rel=2e-3)
        assert found["frequency"][0][k] > found["frequency"][1][k]
    d = base + s / l * (0.5 * base - base)
    deflection = found["load"] * integral((l - s) ** 2 / (E * np.pi / 64 * d**4))[-1]
    assert found["moved"][4] == pytest.approx(deflection, rel=2e-3)
    off = [abs(found["moved"][order] - deflection) for order in range(5)]
    assert off[0] > off[1] > off[2] > off[3] > off[4]
