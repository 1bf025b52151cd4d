"""The four formulations of the model, and the numbers the paper's equations give with Table 1.

Amouri, Mahfoudi, Zaatri (2020), doi 10.46604/ijeti.2020.4422; E1 to E7 as in cpp/README.md. Figures
are compared to the digits stated.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

import cdcr
from cdcr.paper import factors, inertia

# Dormand-Prince at rtol 1e-12 over 10 s, fourteen periods; 1.3e-11 was seen.
DRIFT = 5e-11
# A handful of operations.
ROUNDING = 1e-14
STRAIGHT = 1e-7  # so little bent that theta^2 is rounding [rad]
EDGE = 3.0 * math.pi / 5.0  # of the paper's range [rad]

FORMULATIONS = ("exact", "taylor", "printed", "printed-taylor")
ROBOT = cdcr.robots.amouri2020()
SECTION = ROBOT.sections[0]
L2 = SECTION.length**2
I_XX = SECTION.disk_mass * SECTION.disk_diameter**2 / 16.0
L_I_B = SECTION.length * SECTION.second_moment_of_area


def eq21_as_printed(theta: float, cut: str = "") -> tuple[float, float]:
    """M11 and M22 without the third and the quarter of eq. (9): E2."""
    H = factors(theta, "printed" + cut)
    m_b, m_d = SECTION.backbone_mass, SECTION.disk_mass
    M11 = L2 * m_b * H.H1 + L_I_B * H.H3 + L2 * m_d * H.H5 + I_XX * H.H7
    M22 = L2 * m_b * H.H2 + L_I_B * H.H4 + L2 * m_d * H.H6 + I_XX * H.H8
    return M11, M22


# --- Energy ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_each_formulation_keeps_the_energy(formulation: str) -> None:
    model = cdcr.Model(ROBOT, formulation)
    t = np.linspace(0.0, 10.0, 201)
    run = cdcr.simulate(model, [1.0, 0.0], [0.5, 3.0], t=t, method="dopri5", rtol=1e-12, atol=1e-14)
    assert run.success
    assert run.energy_drift < DRIFT
    assert run.theta.min() < 0.3  # it swings, and turns as it does
    assert run.theta.max() > 1.0
    assert np.ptp(run.phi) > 2.0 * np.pi


def test_formulations_differ() -> None:
    """So that the test above is of four models, not of one."""
    inertias = {inertia(1.0, ROBOT, kind) for kind in FORMULATIONS}
    assert len(inertias) == 4
    masses = {
        tuple(cdcr.Model(ROBOT, kind).mass_matrix([1.0, 0.5]).ravel()) for kind in FORMULATIONS
    }
    assert len(masses) == 4


# --- What is right --------------------------------------------------------------------------------


def test_18_and_23_elastic_energy_and_stiffness() -> None:
    EI = SECTION.youngs_modulus * SECTION.second_moment_of_area
    assert round(EI, 6) == 0.291456
    assert round(SECTION.stiffness, 6) == 0.363412
    for kind in FORMULATIONS:
        model = cdcr.Model(ROBOT, kind)
        assert model.potential_energy([0.6, -0.8]) == pytest.approx(
            SECTION.stiffness / 2.0, rel=ROUNDING
        )


def test_16_the_disk() -> None:
    assert pytest.approx(8.2e-7, rel=ROUNDING) == I_XX


def test_19_follows_from_the_cable_lengths() -> None:
    """l_i = l - r theta cos(gamma_i - phi), and the force is -dl/d(theta, phi) times tension."""
    model = cdcr.Model(ROBOT)
    theta, phi, r = 1.1, 0.5, SECTION.cable_radius
    away = 2.0 * np.pi / 3.0 * np.arange(3) - phi
    lengths = model.cable_lengths(cdcr.bending(theta, phi))
    np.testing.assert_allclose(lengths, SECTION.length - r * theta * np.cos(away), rtol=ROUNDING)
    along, across = np.array([np.cos(phi), np.sin(phi)]), np.array([-np.sin(phi), np.cos(phi)])
    B = model.actuation_matrix()
    np.testing.assert_allclose(along @ B, r * np.cos(away), rtol=0.0, atol=ROUNDING)
    np.testing.assert_allclose(
        theta * across @ B, r * theta * np.sin(away), rtol=0.0, atol=ROUNDING
    )


# --- What is not ----------------------------------------------------------------------------------


def test_e2_the_straight_robot_would_have_a_direction() -> None:
    M11, M22 = eq21_as_printed(STRAIGHT)
    assert f"{M11:.4e}" == "4.8186e-03"
    assert f"{M22 / STRAIGHT**2:.4e}" == "5.8670e-03"
    for kind in FORMULATIONS:  # mended, it has none
        M11, M22 = inertia(STRAIGHT, ROBOT, kind)
        assert pytest.approx(M11, rel=1e-13) == M22 / STRAIGHT**2
        a = cdcr.Model(ROBOT, kind).mass_matrix([0.0, 0.0])
        assert a[0, 0] == a[1, 1] == pytest.approx(M11, rel=1e-13)
        assert a[0, 1] == 0.0


def test_e3_h5_is_half_of_what_15_needs() -> None:
    assert f"{factors(0.0, 'printed').H5:.8f}" == "0.31666250"
    assert f"{factors(0.0).H5:.6f}" == "0.633325"


def test_e4_h3_and_h7_are_constants() -> None:
    angles = np.linspace(-EDGE, EDGE, 41)
    H = factors(angles)
    np.testing.assert_allclose(H.H3, 1.0 / 3.0, rtol=ROUNDING)
    np.testing.assert_allclose(H.H7, 77.0 / 20.0, rtol=ROUNDING)
    printed = factors(angles, "printed")
    assert round(printed.H3[0] / printed.H3[20], 2) == 1.75  # a third at the straight robot
    assert round(printed.H7[0] / printed.H7[20], 2) == 1.64


def test_e5_the_rotary_inertia_of_the_backbone() -> None:
    """What l I_b lacks is the density: 5.1e-8 kg m^2, not 2.5e-11 m^5. Either is small."""
    rotary = SECTION.backbone_mass * SECTION.backbone_diameter**2 / 16.0
    volume = SECTION.length * math.pi * SECTION.backbone_diameter**2 / 4.0
    assert SECTION.backbone_mass / volume * L_I_B == pytest.approx(rotary, rel=ROUNDING)
    assert f"{rotary:.2e} {L_I_B:.2e}" == "5.09e-08 2.46e-11"


def test_e7_the_spin_adds_little() -> None:
    """In per cent of M22, at the edge of the paper's range."""
    H, (_, M22) = factors(EDGE), inertia(EDGE, ROBOT)
    rotary = SECTION.backbone_mass * SECTION.backbone_diameter**2 / 16.0
    without = L2 * (SECTION.backbone_mass * H.H2 / 4.0 + SECTION.disk_mass * H.H6)
    without += rotary * H.H4 + I_XX * H.H8
    assert round(100.0 * (M22 / without - 1.0), 3) == 0.084


def test_the_cut_of_21_as_printed() -> None:
    """In per cent, at the edge of the paper's range, where it says "less than 0.05"."""
    both = zip(eq21_as_printed(EDGE, "-taylor"), eq21_as_printed(EDGE), strict=True)
    M11, M22 = (100.0 * (cut / whole - 1.0) for cut, whole in both)
    assert (round(M11, 3), round(M22, 1)) == (0.056, -12.6)
