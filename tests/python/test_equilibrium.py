"""Robots at rest, as Python sees them."""

import math

import numpy as np
import pytest

import cdcr

# Sums of a few moments of the size of the stiffness times one radian.
ROUNDING = 1e-12


def three_sections(**options: float) -> cdcr.Model:
    return cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), **options))


def test_a_wrench_is_balanced() -> None:
    model = three_sections()
    pull = cdcr.Wrench(section=1, fraction=0.5, force=(0.1, -0.2, 0.05))
    tension = np.linspace(0.0, 2.0, 9)
    q = model.equilibrium(tension, wrenches=[pull])
    left = model.bias(q, np.zeros(6)) - model.actuation_matrix() @ tension
    J = model.jacobian(q, 1, 0.5)[:3]
    np.testing.assert_allclose(left, J.T @ pull.force, rtol=0.0, atol=ROUNDING)
    assert np.linalg.norm(q - model.equilibrium(tension)) > 0.01


def test_one_wrench_needs_no_list() -> None:
    model = three_sections()
    pull = cdcr.Wrench(section=2, force=(0.1, 0.0, 0.0))
    one = model.find_equilibrium(np.zeros(9), wrenches=pull)
    np.testing.assert_array_equal(one.q, model.find_equilibrium(np.zeros(9), wrenches=[pull]).q)
    assert one.status is cdcr.Status.ok
    assert one.stable
    assert one.searches == 1
    assert one.load_steps == 0
    np.testing.assert_array_equal(one.tension, np.zeros(9))


def test_a_follower_moment_is_felt_in_the_stiffness() -> None:
    model = three_sections()
    twist = cdcr.Wrench(section=2, moment=(0.0, 0.01, 0.05), frame="local")
    found = model.find_equilibrium(np.ones(9), wrenches=[twist])
    assert found.status is cdcr.Status.ok
    K = model.static_stiffness(found.q, np.ones(9), [twist])
    assert np.max(np.abs(K - K.T)) > 1e-4 * np.max(np.abs(K))
    expected = np.sort(np.linalg.eigvals(K).real)
    np.testing.assert_allclose(found.eigenvalues, expected, rtol=1e-9)


def test_commands_hold_the_tensions_asked_for() -> None:
    robot = cdcr.robots.rao2021()
    sections = [
        cdcr.Section(
            length=s.length,
            backbone_mass=0.0,
            backbone_diameter=s.backbone_diameter,
            youngs_modulus=s.youngs_modulus,
            num_disks=s.num_disks,
            disk_diameter=0.02,
            cable_radius=s.cable_radius,
            cable_angles=s.cable_angles,
            cable_stiffness=5e3,
        )
        for s in robot.sections
    ]
    by_tension, by_length = cdcr.Model(robot), cdcr.Model(cdcr.Robot(sections=sections))
    tension = np.array([4.0, 0.5, 0.0, 0.3, 2.0, 0.1])
    q = by_tension.equilibrium(tension)
    np.testing.assert_array_equal(by_tension.commands(q, tension), tension)
    lengths = by_length.commands(q, tension)
    np.testing.assert_allclose(lengths, by_length.cable_lengths(q) - tension / 5e3, rtol=1e-15)
    found = by_length.find_equilibrium(lengths)
    np.testing.assert_allclose(found.q, q, rtol=0.0, atol=ROUNDING)
    # Rounding of a length times 5 kN/m.
    np.testing.assert_allclose(found.tension, tension, rtol=0.0, atol=1e-11)


def test_refusals() -> None:
    model = three_sections()
    with pytest.raises(ValueError, match=r"^wrenches\[0\]\.section must be 0 to 2, got 3$"):
        model.equilibrium(np.zeros(9), wrenches=[cdcr.Wrench(section=3)])
    with pytest.raises(ValueError, match=r"^wrenches\[0\] must be a cdcr.Wrench, got int$"):
        model.equilibrium(np.zeros(9), wrenches=[1])  # type: ignore[list-item]
    with pytest.raises(ValueError, match=r"^q\[0\] \(section 1\) must be finite, got nan$"):
        model.commands([math.nan] * 6, np.zeros(9))
    with pytest.raises(cdcr.ConvergenceError, match="bent beyond 3 pi"):
        cdcr.Model(cdcr.robots.rao2021()).equilibrium([0.0, 0.0, 0.0, 200.0, 0.0, 0.0])


def test_strong_loads_without_an_energy_come_to_rest() -> None:
    """Newtons and moments on a soft robot: one in a hundred needs more than a first search."""
    section = cdcr.robots.amouri2020().sections[0]
    model = cdcr.Model(cdcr.Robot(sections=[section, section]))
    random = np.random.default_rng(1)
    for _ in range(500):
        wrenches = [
            cdcr.Wrench(section=i, force=random.normal(size=3) * 2.0, moment=random.normal(size=3))
            for i in (0, 1)
        ]
        answer = model.find_equilibrium(np.zeros(6), wrenches=wrenches)
        assert answer.status is cdcr.Status.ok
        left = model.bias(answer.q, np.zeros(4)) - model.wrench_force(answer.q, wrenches)
        np.testing.assert_allclose(left, np.zeros(4), rtol=0.0, atol=1e3 * ROUNDING)
