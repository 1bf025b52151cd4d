"""Examples of many robots: each runs, and finds what other means find."""

from __future__ import annotations

import numpy as np
import pytest

import cdcr
from example_script import Example


def test_dask_sweep(example: Example) -> None:
    pytest.importorskip("distributed", reason="the extra dask is not installed")
    names = example(15)
    found, section = names["found"], names["section"]
    at = {name.split(".")[-1]: found[name].values for name in names["tolerances"]}
    # The angle of rest is F r L/(E I), and the robot swings beyond it like a damped oscillator.
    second_moment = np.pi / 64.0 * at["backbone_diameter"] ** 4
    stiffness = at["youngs_modulus"] * second_moment / section.length
    rest = 5.0 * at["cable_radius"] / stiffness
    np.testing.assert_allclose(found.final_theta, rest, rtol=1e-3)
    inertia = cdcr.Model(cdcr.robots.amouri2020()).mass_matrix([0.26, 0.0])[0, 0]
    decay = at["damping"] / (2.0 * inertia)
    beyond = np.exp(-np.pi * decay / np.sqrt(stiffness / inertia - decay**2))
    np.testing.assert_allclose(found.peak_theta, rest * (1.0 + beyond), rtol=0.02)
    # Of a product of powers with small tolerances, shares of the variance are those of the squares.
    squares = np.square([1 * 0.03, 4 * 0.01, 1 * 0.02, 0.0])
    shares = names["indices"].total_order.sel(metric="final_theta")
    np.testing.assert_allclose(shares, squares / squares.sum(), atol=0.1)


def test_domain_randomisation(example: Example) -> None:
    found = example(19)
    numbers, section = found["robots"], found["section"]
    # The angle of rest is F r L/(E I); what swings most has not quite come to rest.
    radius = numbers["sections.1.cable_radius"] / section.cable_radius
    modulus = numbers["sections.1.youngs_modulus"] / section.youngs_modulus
    np.testing.assert_allclose(30.0 + found["apart"], 30.0 * radius / modulus, rtol=0.02)
    assert found["loose"].success
    assert found["held"].success
    assert found["left"][:, -1].max() < 1e-9


def test_fast_tip(example: Example) -> None:
    found = example(26)
    assert found["best"] > 3.0 * found["speed"](found["once"]).max()
    assert found["bound"] > 0.95
    # At a bound it would be slower with any tension within; the motion itself is by another method.
    assert found["best"] == pytest.approx(-found["search"].fun, rel=1e-6)
    _, slopes = found["value"](found["search"].x)
    within, steps = found["search"].x, 1e-4
    for k in (0, 7, 299):
        ahead, behind = (found["value"](within + side * np.eye(300)[k])[0] for side in (steps, 0.0))
        np.testing.assert_allclose((ahead - behind) / steps, slopes[k], atol=1e-5)
