"""Rows of the audit: sections 4.3 and 4.4, generalised forces and equations of motion."""

from __future__ import annotations

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.coordinates import bending
from cdcr.paper._polar import PolarModel, VelocityOrder
from cdcr.paper.claims.common import (
    EDGE,
    ROBOT,
    SAME,
    SECTION,
    Claim,
    gap,
    holds_if,
    model,
    numbers,
    tiny,
)
from cdcr.paper.claims.printed import printed_inertia

_START = (np.pi / 4.0, 0.0, 2.0, 6.0)  # theta, phi [rad], thetad, phid [rad/s] of a free swing
_STEP, _TIME = 4e-3, 0.2  # [s]
_SLACK = np.zeros(3)
_KEPT = 1e-2  # what counts as no change [per cent]


def print_of_24(theta: float, phi: float) -> FloatArray:
    """Return the matrix D of paper eq. (24)."""
    r, third = SECTION.cable_radius, 2.0 * np.pi / 3.0
    return np.array(
        [
            [r * np.cos(phi), r * np.cos(third - phi)],
            [-r * theta * np.sin(phi), r * theta * np.sin(third - phi)],
        ]
    )


def generalised_forces() -> Claim:
    """Compare (24) with (19) and with virtual work: differences of the model's cable lengths."""
    step, by_work, by_19 = 1e-4, 0.0, 0.0
    gamma = np.array([0.0, 2.0 * np.pi / 3.0])
    for theta in (0.3, 1.0, EDGE):
        for phi in (0.0, 0.7, 2.0, -2.5):
            D, length = print_of_24(theta, phi), model().cable_lengths
            work = [
                (length(bending(theta - dt, phi - dp)) - length(bending(theta + dt, phi + dp)))[:2]
                / (2.0 * step)
                for dt, dp in ((step, 0.0), (0.0, step))
            ]
            away = SECTION.cable_radius * np.array(
                [np.cos(gamma - phi), theta * np.sin(gamma - phi)]
            )
            by_work, by_19 = max(by_work, gap(work, D)), max(by_19, gap(away, D))
    return Claim(
        where="4.3, (19); (24)",
        claim="Q = D F with the entries and signs of (24).",
        computed=(
            f"(24) is (19) with gamma = 0 and 2pi/3 to {tiny(by_19)} m, and the virtual work of "
            "cables of length l - r theta cos(gamma - phi), signs included, to "
            f"{tiny(by_work)} m by differences."
        ),
        verdict=holds_if(by_19 < SAME and by_work < 1e-9),  # differences lose some digits
        values=numbers(work_gap=by_work, gap_19=by_19),
    )


def two_cables() -> Claim:
    """Solve K theta = Q1, 0 = Q2 by (24) for the two tensions, around the circle."""
    theta = np.pi / 12.0
    load = np.array([SECTION.stiffness * theta, 0.0])
    phis = np.linspace(0.0, 2.0 * np.pi, 361)
    tensions = np.array([np.linalg.solve(print_of_24(theta, phi), load) for phi in phis])
    inside = phis <= 2.0 * np.pi / 3.0 + 1e-9
    least, lowest = np.min(tensions[inside]), np.min(tensions[~inside])
    three = min(
        float(np.min(model().allocate(model().inverse_dynamics(q, [0.0, 0.0], [0.0, 0.0]))))
        for q in bending(np.full((len(phis), 1), theta), phis[:, np.newaxis])
    )
    return Claim(
        where="2; 4.3, (19)",
        claim="Two degrees of freedom by one or two cables at a time; phi in [0, 2pi/3] by "
        "cables 1 and 2.",
        computed=(
            f"At theta = 15 deg at rest, cables 1 and 2 need no push for phi in [0, 2pi/3] (least "
            f"{abs(least):.2f} N); outside they would have to push with up to {-lowest:.2f} N. "
            f"With the pair of the sector all phi are reached, the idle cable at {three:.2f} N."
        ),
        verdict=holds_if(least > -1e-9 and three >= 0.0),  # 1e-9 N: rounding
        values=numbers(least_inside=least, lowest_outside=lowest, least_of_three=three),
    )


def swing(order: VelocityOrder) -> float:
    """Return the largest change of energy in a free swing by (20), in per cent (own RK4)."""
    polar = PolarModel(ROBOT, velocity_order=order)

    def rate(y: FloatArray) -> FloatArray:
        thetadd, phidd = polar.forward_dynamics(y[0], y[1], y[2], y[3], _SLACK)
        return np.array([y[2], y[3], thetadd, phidd])

    def energy(y: FloatArray) -> float:
        kinetic = polar.kinetic_energy(y[0], y[2], y[3])
        return float(kinetic + polar.potential_energy(y[0], y[1]))

    y, h, worst = np.array(_START), _STEP, 0.0
    start = energy(y)
    for _ in range(round(_TIME / _STEP)):
        k1 = rate(y)
        k2 = rate(y + h / 2.0 * k1)
        k3 = rate(y + h / 2.0 * k2)
        k4 = rate(y + h * k3)
        y = y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        worst = max(worst, abs(energy(y) / start - 1.0))
    return 100.0 * worst


def velocity_order() -> Claim:
    """Integrate (20) from theta = pi/4 with some speed, without tension, in either order."""
    printed, mended = swing("printed"), swing("mended")
    return Claim(
        where="4.4, (20), (22)",
        claim="The velocities beside C11, C12, C13 are (thetad^2, phid^2, thetad phid).",
        computed=(
            f"So the free robot does not keep its energy: it changes by {printed:.0f} % within "
            f"{_TIME} s from theta = pi/4, thetad = {_START[2]:.0f}, phid = {_START[3]:.0f} rad/s. "
            f"Since C13 = -M22'/2 and C22 = M22', the order must be (thetad^2, thetad phid, "
            f"phid^2): then by {mended:.0e} %."
        ),
        verdict=holds_if(printed < _KEPT),
        sources=("E1",),
        values=numbers(printed_percent=printed, mended_percent=mended),
    )


def coefficients() -> Claim:
    """Compare (20), its order and factors mended, with the model in bending components."""
    worst, polar = 0.0, PolarModel(ROBOT)
    for theta, phi, thetad, phid in (
        (0.4, 0.3, 1.0, -2.0),
        (1.2, 2.0, -3.0, 1.5),
        (EDGE, -1, 2, 2),
    ):
        tension = np.array([3.0, 1.0, 0.0])
        thetadd, phidd = polar.forward_dynamics(theta, phi, thetad, phid, tension)
        out, side = np.array([np.cos(phi), np.sin(phi)]), np.array([-np.sin(phi), np.cos(phi)])
        qd = thetad * out + theta * phid * side
        qdd = (thetadd - theta * phid**2) * out + (theta * phidd + 2.0 * thetad * phid) * side
        worst = max(worst, gap(qdd, model().forward_dynamics(theta * out, qd, tension)))
    M = model().mass_matrix([EDGE, 0.0])
    return Claim(
        where="4.4, (20)-(24)",
        claim="M12 = 0, C11 = M11'/2, C13 = -M22'/2, C22 = M22', others zero; K11 alone in K.",
        computed=(
            f"Right, once each C stands beside its own velocities (E1): the accelerations of (20) "
            f"are then those of the equations in q to {tiny(worst)} of their size, and M12 is "
            f"{tiny(abs(M[0, 1]))}."
        ),
        verdict=holds_if(worst < SAME and abs(M[0, 1]) < SAME),
        values=numbers(worst_gap=worst, m12=M[0, 1]),
    )


def missing_fractions() -> Claim:
    """Evaluate (21) literally at theta -> 0, where M11 must be M22/theta^2, and mended."""
    theta = 1e-6
    M11, M22 = printed_inertia(theta, ROBOT)
    across = M22 / theta**2
    M = model().mass_matrix([0.0, 0.0])
    return Claim(
        where="4.4, (21), (22)",
        claim="M11 = l^2 m_b H1 + ..., M22 = l^2 m_b H2 + ...",
        computed=(
            f"At theta -> 0 this makes M11 = {M11:.4e} and M22/theta^2 = {across:.4e} kg m^2: the "
            "inertia of the straight robot would depend on the direction. (9) has H1/3 and H2/4; "
            f"with these both are {M[0, 0]:.4e} kg m^2 (E3 to E5 mended, too)."
        ),
        verdict=holds_if(abs(across / M11 - 1.0) < _KEPT / 100.0),
        sources=("E2",),
        values=numbers(
            m11_printed=M11, m22_printed_over_square=across, m11=M[0, 0], m22_over_square=M[1, 1]
        ),
    )
