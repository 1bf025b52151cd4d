"""Rows of the audit: sections 3 and 4.1 of the paper, kinematics and kinetic energy."""

from __future__ import annotations

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.coordinates import bending
from cdcr.paper._factors import factors, taylor_coefficients
from cdcr.paper.claims.common import (
    DISK_INERTIA,
    EDGE,
    ROD_INERTIA,
    SAME,
    SECTION,
    Claim,
    gap,
    holds_if,
    model,
    numbers,
    tiny,
)
from cdcr.paper.claims.printed import printed_factors

_ANGLES = np.linspace(0.3, EDGE, 9)
_DIRECTIONS = (0.0, 0.7, 2.0, -2.5)
_STEP = 1e-5  # of central differences, good to ten digits


def position(theta: float, phi: float, x: float) -> FloatArray:
    """Return paper eq. (1) at fraction x of the length."""
    y = theta * x
    along = SECTION.length / theta * np.array([1.0 - np.cos(y), 1.0 - np.cos(y), np.sin(y)])
    out: FloatArray = along * np.array([np.cos(phi), np.sin(phi), 1.0])
    return out


def rotation(theta: float, phi: float, x: float) -> FloatArray:
    """Return paper eq. (2)."""

    def about_z(angle: float) -> FloatArray:
        c, s = np.cos(angle), np.sin(angle)
        return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    c, s = np.cos(theta * x), np.sin(theta * x)
    about_y = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    out: FloatArray = about_z(phi) @ about_y @ about_z(-phi)
    return out


def turning(theta: float, phi: float, x: float, rates: tuple[float, float]) -> FloatArray:
    """Return the angular velocity of the frame (2), by central differences."""
    ahead = rotation(theta + _STEP * rates[0], phi + _STEP * rates[1], x)
    behind = rotation(theta - _STEP * rates[0], phi - _STEP * rates[1], x)
    spin = (ahead - behind) / (2.0 * _STEP) @ rotation(theta, phi, x).T
    return np.array([spin[2, 1], spin[0, 2], spin[1, 0]])


def kinematics() -> Claim:
    """Compare (1) with the integral of (4) along the arc, and (1), (2) with the model's pose."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    shares, turn = (1.0 + nodes) / 2.0, SECTION.length * weights / 2.0
    integral = pose = 0.0
    for theta in _ANGLES:
        for phi in _DIRECTIONS:
            x, r, R = 0.8, position(theta, phi, 0.8), rotation(theta, phi, 0.8)
            tangents = np.array([rotation(theta, phi, share * x)[:, 2] for share in shares])
            integral = max(integral, gap(x * turn @ tangents, r))
            known_R, known_r = model().pose(bending(theta, phi), 0, x)
            pose = max(pose, gap(known_r, r), gap(known_R, R))
    start = gap(rotation(0.0, 0.7, 1.0), np.eye(3))
    worst = max(integral, pose, start)
    return Claim(
        where="3.2, (1), (2)",
        claim="Position and orientation along an arc of constant curvature, without torsion.",
        computed=(
            f"(1) is the integral of (4) along the arc to {tiny(integral)} m; both are the model's "
            f"pose to {tiny(pose)}; at theta = 0 the frame (2) is the base's, whatever phi."
        ),
        verdict=holds_if(worst < SAME),
        values=numbers(integral_gap=integral, pose_gap=pose, straight_gap=start),
    )


def angular_velocity() -> Claim:
    """Differentiate (2) and split its angular velocity along and across the tangent (4)."""
    phi, x, phid = 0.7, 1.0, 1.0
    omega = turning(EDGE, phi, x, (0.0, phid))
    tangent = rotation(EDGE, phi, x)[:, 2]
    spin = float(omega @ tangent)
    along_theta = turning(EDGE, phi, x, (1.0, 0.0)) @ tangent
    turned = np.arange(1, SECTION.num_disks + 1) / SECTION.num_disks * EDGE
    missing = 2.0 * DISK_INERTIA * np.sum((1.0 - np.cos(turned)) ** 2)
    M22 = EDGE**2 * model().mass_matrix([EDGE, 0.0])[1, 1]
    return Claim(
        where="3.3, (3); 4.1.4, (16)",
        claim="The angular velocity is omega = t x dt/dt.",
        computed=(
            f"Right for bending. When phi turns, the frame (2) also spins about t, at the tip by "
            f"{spin:.4f} phid at 3pi/5 = (cos theta - 1) phid, which t x dt/dt lacks. With I_zz = "
            f"2 I_xx that is {100 * missing / M22:.2f} % of M22 there: small."
        ),
        verdict="holds in part",
        sources=("E7",),
        values=numbers(
            spin=spin,
            spin_expected=np.cos(EDGE) - 1.0,
            spin_of_bending=along_theta,
            share_of_m22_percent=100 * missing / M22,
        ),
    )


def backbone_translation() -> Claim:
    """Compare (10)/3 and (11)/4 with Gauss integrals of |dr/dtheta|^2 and |dr/dphi|^2 of (1)."""
    printed, derived = printed_factors(_ANGLES), factors(_ANGLES)
    first, second = gap(printed["H1"], derived.H1), gap(printed["H2"], derived.H2)
    start = factors(0.0)
    return Claim(
        where="4.1.1, (9)-(11)",
        claim="Translation of the backbone: l^2 m_b (H1/3 thetad^2 + H2/4 phid^2)/2.",
        computed=(
            f"(10) and (11) are the integrals over (1) to {tiny(max(first, second))}; H1 = "
            f"{start.H1:.2f} at theta = 0. In the integrand of (9) m_b must mean m_b/l."
        ),
        verdict=holds_if(max(first, second) < SAME),
        values=numbers(h1_gap=first, h2_gap=second, h1_straight=start.H1),
    )


def backbone_taylor() -> Claim:
    """Compare the printed coefficients with exact fractions of the power series."""
    cut = taylor_coefficients()
    H1, H2 = [float(c) for c in cut.H1], [float(c) for c in cut.H2]
    difference = max(
        gap(H1, [3.0 / 20.0, -1.0 / 168.0, 1.0 / 8640.0]),
        gap(H2, [0.0, 1.0 / 5.0, -1.0 / 42.0]),
    )
    return Claim(
        where="4.1.1, (12), (13)",
        claim="The Taylor polynomials of H1 and H2 to theta^4.",
        computed=(
            f"The coefficients of 1, theta^2, theta^4 in (10) are {', '.join(map(str, cut.H1))}, "
            f"in (11) {', '.join(map(str, cut.H2))}: those printed."
        ),
        verdict=holds_if(difference == 0.0),
        values=numbers(
            h1_0=H1[0], h1_2=H1[1], h1_4=H1[2], h2_2=H2[1], h2_4=H2[2], difference=difference
        ),
    )


def singularities() -> Claim:
    """Evaluate (10) in double precision near zero, and M22 of (21) with Taylor factors at zero."""
    theta = 1e-4 * np.linspace(0.9, 1.1, 21)
    lost = float(np.max(np.abs(printed_factors(theta)["H1"] / factors(theta).H1 - 1.0)))
    straight = factors(0.0, "taylor")
    left = max(abs(float(value)) for value in (straight.H2, straight.H4, straight.H6, straight.H8))
    return Claim(
        where="1; 4.1.1",
        claim="Taylor expansions avoid the numerical singularities near theta = 0.",
        computed=(
            f"In the factors, yes: (10) as it stands is wrong by up to {100 * lost:,.0f} % at "
            f"theta of about {np.mean(theta):.0e} rad in double precision. In the motion, no: H2, "
            f"H4, H6 and H8 are {left:.0f} at theta = 0, so M22 = 0 and (20) divides zero by "
            "zero. Bending components q = theta (cos phi, sin phi) cure both."
        ),
        verdict="holds in part",
        values=numbers(h1_error_percent=100.0 * lost, phi_factors_straight=left),
    )


def backbone_rotation() -> Claim:
    """Put l I_b of (14) beside the rotary inertia of a round rod, m_b d_b^2/16."""
    printed = SECTION.length * SECTION.second_moment_of_area
    return Claim(
        where="4.1.2, (14), (21)",
        claim="Rotation of the backbone: l I_b (H3 thetad^2 + H4 phid^2)/2, I_b second moment of "
        "area.",
        computed=(
            f"l I_b = {printed:.3e} is in m^5, not kg m^2. Rotary inertia is m_b d_b^2/16 = "
            f"{ROD_INERTIA:.3e} kg m^2, in number {ROD_INERTIA / printed:.0f} times as much."
        ),
        verdict="does not hold",
        sources=("E5",),
        values=numbers(printed=printed, derived=ROD_INERTIA, ratio=ROD_INERTIA / printed),
    )


def moment_of_inertia() -> Claim:
    """Evaluate omega^T I omega by (17) with I_zz = 2 I_xx, for omega of (3) at a bent disk."""
    worst = 0.0
    for theta in _ANGLES:
        R = rotation(theta, 0.7, 1.0)
        omega = turning(theta, 0.7, 1.0, (0.6, 1.1))
        omega -= R[:, 2] * (omega @ R[:, 2])  # (3) has no part along t
        inertia = R @ np.diag([1.0, 1.0, 2.0]) @ R.T
        worst = max(worst, gap(omega @ inertia @ omega, omega @ omega))
    return Claim(
        where="4.1.4, (16), (17)",
        claim="The disks' moment of inertia turns with them; of it I_xx alone stands in (16).",
        computed=(
            "With I_xx = I_yy and omega of (3), omega^T I omega is I_xx |omega|^2, to "
            f"{tiny(worst)}. So (16) follows from (3) and (17); I_zz drops out with the spin that "
            "(3) lacks."
        ),
        verdict=holds_if(worst < SAME),
        values=numbers(worst_gap=worst),
    )
