"""cdcr.paper.PolarModel: paper eq. (20) in theta and phi, beside the model in bending vectors."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp  # type: ignore[import-untyped]

import cdcr
from cdcr.paper import PolarModel, inertia

FloatArray = NDArray[np.float64]

# The two forms round differently; 1e-14 of the largest acceleration was seen.
ROUNDING = 5e-14
# DOP853 at rtol 1e-12 over 2 s; 1e-12 was seen.
DRIFT = 1e-11
# The same motion by two integrators at rtol 1e-12 over 2 s; 2e-12 rad was seen.
SAME_PATH = 5e-11

FORMULATIONS = ("exact", "taylor", "printed", "printed-taylor")
TABLE1 = cdcr.robots.amouri2020()
START = (1.0, 0.0, 0.5, 6.0)  # theta, phi [rad], thetad, phid [rad/s]


def loaded_robot() -> cdcr.Robot:
    """Everything at once that the paper leaves out."""
    section = dataclasses.replace(
        TABLE1.sections[0], damping=2e-3, num_disks=4, cable_angles=(0.1, 1.3, 2.6, 4.0, 5.5)
    )
    return cdcr.Robot(sections=[section], gravity=(1.0, -2.0, -9.81), payload=0.03)


def angular(
    q: FloatArray, qd: FloatArray, qdd: FloatArray, theta: float, phi: float
) -> tuple[float, float]:
    """Return thetadd and phidd of a motion in bending vectors."""
    along, across = np.array([np.cos(phi), np.sin(phi)]), np.array([-np.sin(phi), np.cos(phi)])
    thetad, phid = qd @ along, qd @ across / theta
    return qdd @ along + theta * phid**2, (qdd @ across - 2.0 * thetad * phid) / theta


# --- The same equations ---------------------------------------------------------------------------


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("robot", [TABLE1, loaded_robot()], ids=["table 1", "loaded"])
def test_accelerations_are_the_models(robot: cdcr.Robot, formulation: str) -> None:
    model, polar = cdcr.Model(robot, formulation), PolarModel(robot, formulation)
    rng = np.random.default_rng(20)
    largest = 2.2 if formulation.endswith("taylor") else math.pi
    for _ in range(300):
        theta = float(rng.choice([-1.0, 1.0]) * rng.uniform(0.05, largest))
        phi, thetad, phid = (float(v) for v in rng.uniform(-4.0, 4.0, 3))
        tension = rng.uniform(0.0, 5.0, robot.num_cables)
        along, across = np.array([np.cos(phi), np.sin(phi)]), np.array([-np.sin(phi), np.cos(phi)])
        q, qd = theta * along, thetad * along + theta * phid * across
        qdd = model.forward_dynamics(q, qd, tension)
        found = polar.forward_dynamics(theta, phi, thetad, phid, tension)
        expected = angular(q, qd, qdd, theta, phi)
        scale = np.max(np.abs(qdd)) + phid**2
        assert found[0] == pytest.approx(expected[0], abs=ROUNDING * scale)
        assert found[1] * theta == pytest.approx(expected[1] * theta, abs=ROUNDING * scale)
        assert polar.kinetic_energy(theta, thetad, phid) == pytest.approx(
            model.kinetic_energy(q, qd), rel=ROUNDING
        )
        assert polar.potential_energy(theta, phi) == pytest.approx(
            model.potential_energy(q), rel=ROUNDING, abs=ROUNDING
        )


def test_it_still_holds_close_to_the_straight_robot() -> None:
    """There thetadd and theta phidd keep their digits as long as theta does."""
    model, polar = cdcr.Model(TABLE1), PolarModel(TABLE1)
    for theta in (1e-2, 1e-4, 1e-6):
        q, qd = np.array([theta, 0.0]), np.array([0.3, theta * 2.0])
        qdd = model.forward_dynamics(q, qd, [0.0, 0.0, 0.0])
        expected = angular(q, qd, qdd, theta, 0.0)
        found = polar.forward_dynamics(theta, 0.0, 0.3, 2.0, [0.0, 0.0, 0.0])
        assert found == pytest.approx(expected, rel=ROUNDING)


def test_mass_matrix_is_that_of_eq_21() -> None:
    angles = np.array([[0.2, 1.0], [-2.0, 3.0]])
    M = PolarModel(TABLE1).mass_matrix(angles)
    assert M.shape == (2, 2, 2, 2)
    M11, M22 = inertia(angles, TABLE1)
    np.testing.assert_array_equal(M[..., 0, 0], M11)
    np.testing.assert_array_equal(M[..., 1, 1], M22)
    assert not np.any(M[..., 0, 1])
    assert not np.any(M[..., 1, 0])


def test_24_is_the_pull_of_cables_1_and_2() -> None:
    """At rest M thetadd + K theta = D F with D of eq. (24)."""
    theta, phi, F = 0.7, 0.4, np.array([3.0, 2.0, 0.0])
    polar, r = PolarModel(TABLE1), TABLE1.sections[0].cable_radius
    (thetadd, phidd), M = (
        polar.forward_dynamics(theta, phi, 0.0, 0.0, F),
        polar.mass_matrix(theta),
    )
    gamma = 2.0 * math.pi / 3.0
    Q1 = r * (F[0] * math.cos(phi) + F[1] * math.cos(gamma - phi))
    Q2 = r * theta * (-F[0] * math.sin(phi) + F[1] * math.sin(gamma - phi))
    elastic = TABLE1.sections[0].stiffness * theta
    assert M[0, 0] * thetadd + elastic == pytest.approx(Q1, rel=ROUNDING)
    assert M[1, 1] * phidd == pytest.approx(Q2, rel=ROUNDING)


def test_arrays_are_computed_at_once() -> None:
    polar = PolarModel(loaded_robot())
    rng = np.random.default_rng(7)
    (theta, phi, thetad, phid), tension = rng.uniform(0.2, 2.0, (4, 6)), rng.uniform(0.0, 5, (6, 5))
    thetadd, phidd = polar.forward_dynamics(theta, phi, thetad, phid, tension)
    assert thetadd.shape == phidd.shape == (6,)
    for i in range(6):
        one = polar.forward_dynamics(theta[i], phi[i], thetad[i], phid[i], tension[i])
        assert (thetadd[i], phidd[i]) == pytest.approx(one, rel=ROUNDING)


# --- Energy, E1 -----------------------------------------------------------------------------------


def free_run(polar: PolarModel, end: float) -> tuple[FloatArray, FloatArray]:
    """Return states (4, N) and energies (N,) of the free robot, straight from eq. (20)."""
    slack = np.zeros(polar.robot.num_cables)

    def rates(_: float, y: FloatArray) -> list[Any]:
        return [y[2], y[3], *polar.forward_dynamics(y[0], y[1], y[2], y[3], slack)]

    run = solve_ivp(rates, (0.0, end), START, method="DOP853", rtol=1e-12, atol=1e-13)
    assert run.success
    theta, phi, thetad, phid = run.y
    energy = polar.kinetic_energy(theta, thetad, phid) + polar.potential_energy(theta, phi)
    return run.y, energy


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_the_mended_order_keeps_the_energy(formulation: str) -> None:
    polar = PolarModel(TABLE1, formulation)
    y, energy = free_run(polar, 2.0)
    assert np.max(np.abs(energy / energy[0] - 1.0)) < DRIFT
    assert np.ptp(np.abs(y[0])) > 0.3  # it swings
    momentum = np.array([polar.mass_matrix(theta)[1, 1] for theta in y[0]]) * y[3]
    assert np.max(np.abs(momentum / momentum[0] - 1.0)) < DRIFT


@pytest.mark.parametrize(
    ("formulation", "lost"),
    [("exact", 0.183), ("taylor", 0.181), ("printed", 0.108), ("printed-taylor", 0.107)],
)
def test_e1_the_printed_order_loses_energy_at_once(formulation: str, lost: float) -> None:
    """Within 0.1 s, a seventh of a period; soon after the robot falls into the singularity."""
    polar = PolarModel(TABLE1, formulation, velocity_order="printed")
    _, energy = free_run(polar, 0.1)
    assert round(float(np.max(np.abs(energy / energy[0] - 1.0))), 3) == lost
    with pytest.raises(ValueError, match="theta must be at least 1e-08 rad"):
        free_run(polar, 0.2)


def test_both_forms_make_the_same_motion() -> None:
    y, _ = free_run(PolarModel(TABLE1), 2.0)
    theta, phi, thetad, phid = START
    q0, qd0 = [theta, 0.0], [thetad, theta * phid]
    run = cdcr.simulate(
        cdcr.Model(TABLE1), q0, qd0, t=[0.0, 2.0], method="dopri5", rtol=1e-12, atol=1e-13
    )
    assert phi == 0.0
    np.testing.assert_allclose(cdcr.bending(*y[:2, -1]), run.q[-1], rtol=0.0, atol=SAME_PATH)


# --- Refusals -------------------------------------------------------------------------------------


@pytest.mark.parametrize("theta", [0.0, 9e-9, [0.5, -1e-9]])
def test_the_straight_robot_is_refused_with_what_to_use(theta: Any) -> None:
    polar = PolarModel(TABLE1)
    sentence = "theta must be at least 1e-08 rad .* no phi; use cdcr.Model, whose bending vector"
    with pytest.raises(ValueError, match=sentence):
        polar.forward_dynamics(theta, 0.0, 0.0, 0.0, [0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match=sentence):
        polar.mass_matrix(theta)


def test_an_inertia_that_is_not_positive_is_refused() -> None:
    sentence = r"M22 must be > 0 kg m\^2 .* at theta = 3 rad with formulation 'taylor'; 'exact'"
    with pytest.raises(ValueError, match=sentence):
        PolarModel(TABLE1, "taylor").forward_dynamics([1.0, 3.0], 0.0, 0.0, 0.0, [0.0, 0.0, 0.0])
    weightless = dataclasses.replace(TABLE1.sections[0], backbone_mass=0.0, disk_mass=0.0)
    with pytest.raises(ValueError, match=r"M11 must be > 0 .* got 0 at theta = 1 rad"):
        PolarModel(cdcr.Robot(sections=[weightless])).mass_matrix(1.0)


def test_what_the_paper_does_not_cover_is_refused() -> None:
    with pytest.raises(ValueError, match="for one section, got a robot of 2"):
        PolarModel(cdcr.Robot(sections=2 * TABLE1.sections))
    with pytest.raises(ValueError, match=r"formulation must be one of .* got 'polar'"):
        PolarModel(TABLE1, "polar")
    with pytest.raises(ValueError, match="velocity_order must be 'mended' or 'printed', got 'tt'"):
        PolarModel(TABLE1, velocity_order="tt")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((10.0, 0.0, 0.0, 0.0, [0.0, 0.0, 0.0]), "theta must lie within cdcr.max_bending"),
        ((1.0, math.inf, 0.0, 0.0, [0.0, 0.0, 0.0]), "phi must be finite, got inf"),
        ((1.0, 0.0, math.nan, 0.0, [0.0, 0.0, 0.0]), "thetad must be finite, got nan"),
        ((1.0, 0.0, 0.0, "fast", [0.0, 0.0, 0.0]), "phid must be numbers, got str"),
        ((1.0, 0.0, 0.0, 0.0, [0.0, 0.0]), r"tension must have shape \(3,\) or .* got \(2,\)"),
        ((1.0, 0.0, 0.0, 0.0, [0.0, -2.0, 0.0]), "tension must be >= 0 N, got -2 N"),
    ],
)
def test_bad_arguments_are_refused(arguments: tuple[Any, ...], sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        PolarModel(TABLE1).forward_dynamics(*arguments)
