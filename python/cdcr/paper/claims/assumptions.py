"""Rows of the audit: the assumptions of section 3.1 and what they cost."""

from __future__ import annotations

import math

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.paper.claims.common import (
    EDGE,
    PULL,
    SECTION,
    Claim,
    excess,
    numbers,
)

_MANY = 100  # parts within 3e-5 of the beam, in the first two frequencies
_LOSS = 0.01  # of the bending moment, by friction


def beam_frequencies(parts: int) -> FloatArray:
    """Return the natural frequencies of small planar motion, slowest first [rad/s].

    Ritz's method on `parts` parts of constant curvature, each part's bending angle a coordinate;
    the disks are point masses. Many parts are the beam.
    """
    starts = np.arange(parts) / parts

    def deflection(x: FloatArray) -> FloatArray:
        """Return the way sideways at fractions x for a unit angle of each part."""
        behind = np.maximum(x[:, np.newaxis] - starts, 0.0) ** 2
        beyond = np.maximum(x[:, np.newaxis] - starts - 1.0 / parts, 0.0) ** 2
        out: FloatArray = SECTION.length * parts / 2.0 * (behind - beyond)
        return out

    nodes, weights = np.polynomial.legendre.leggauss(4)  # exact: the integrand has degree four
    x = (starts[:, np.newaxis] + (1.0 + nodes) / (2.0 * parts)).ravel()
    y = deflection(x)
    mass = SECTION.backbone_mass * y.T @ (np.tile(weights, parts)[:, np.newaxis] * y) / (2 * parts)
    y = deflection(np.arange(1, SECTION.num_disks + 1) / SECTION.num_disks)
    mass += SECTION.disk_mass * y.T @ y
    stiffness = SECTION.stiffness * parts  # a shorter part is stiffer
    # 1/frequency^2 are the eigenvalues of a symmetric matrix.
    flexibility = np.linalg.eigvalsh(mass / stiffness)[::-1]
    frequencies: FloatArray = 1.0 / np.sqrt(flexibility)
    return frequencies


def constant_curvature() -> Claim:
    """Compare natural frequencies of 1 to 8 parts of constant curvature with those of the beam."""
    beam = beam_frequencies(_MANY)
    found = {parts: beam_frequencies(parts) for parts in (1, 2, 3, 4, 5, 8)}
    first = {parts: excess(omega[0], beam[0]) for parts, omega in found.items()}
    second = {parts: excess(found[parts][1], beam[1]) for parts in (4, 8)}
    cut = ", ".join(f"{first[parts]:+.2f} % (n = {parts})" for parts in (2, 3, 4, 5, 8))
    return Claim(
        where="3.1, (1)",
        claim="The backbone is inextensible, continuous, of constant curvature, without torsion.",
        computed=(
            "Under one cable alone a weightless robot at rest is bent so. In motion it is not: one "
            f"section vibrates at {found[1][0]:.2f} rad/s, the beam of the same masses and E I_b "
            f"at {beam[0]:.3f} rad/s: {first[1]:.0f} % too fast. Cut into n sections: {cut}; the "
            f"second frequency {second[4]:+.1f} % (n = 4), {second[8]:+.1f} % (n = 8)."
        ),
        verdict="holds in part",
        values=numbers(
            beam=beam[0],
            one_section=found[1][0],
            **{f"first_{parts}_percent": error for parts, error in first.items()},
            **{f"second_{parts}_percent": error for parts, error in second.items()},
        ),
    )


def friction() -> Claim:
    """Solve (1 - exp(-z))/z = 0.99, z = mu theta, by Newton: a cable sliding along a bent section.

    By Capstan's law the tension left at fraction x is exp(-z x); its mean bends the section.
    """
    z = 2.0 * _LOSS
    for _ in range(20):
        kept = -math.expm1(-z) / z
        z -= (kept - (1.0 - _LOSS)) / ((math.exp(-z) - kept) / z)
    theta = SECTION.cable_radius * PULL / SECTION.stiffness
    at_rest, at_edge = z / theta, z / EDGE
    return Claim(
        where="3.1",
        claim="Friction in the disks' holes is neglected.",
        computed=(
            "No coefficient of friction is given. By Capstan's law one of "
            f"{at_rest:.3f} takes {100 * _LOSS:.0f} % off the moment of a cable at the "
            f"{math.degrees(theta):.1f} deg of 5 N, one of {at_edge:.3f} does at 3pi/5."
        ),
        verdict="cannot be checked",
        values=numbers(at_step=at_rest, at_edge=at_edge),
    )


def torsion() -> Claim:
    """Compare G J = E I_b/(1 + nu) of a round isotropic rod with E I_b, nu from 0 to 1/2."""
    stiffest, softest = (1.0 / (1.0 + poisson) for poisson in (0.0, 0.5))
    return Claim(
        where="3.1",
        claim="The backbone possesses a high stiffness that permits to avoid torsion.",
        computed=(
            f"The material is not named. An isotropic round rod is {softest:.2f} to {stiffest:.2f} "
            "times as stiff in torsion as in bending, so not stiffness avoids torsion but that the "
            "cables, along the backbone, do not twist it."
        ),
        verdict="cannot be checked",
        values=numbers(softest=softest, stiffest=stiffest),
    )
