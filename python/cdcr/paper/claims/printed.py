"""The factors letter by letter as the paper prints them, where the audit needs the print itself.

They lose digits towards theta = 0, as closed forms with theta below the fraction bar do;
``cdcr.paper.factors`` does not.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.paper._factors import factors
from cdcr.robot.robot import Robot

_TENTHS = np.arange(1, 11) / 10.0


def printed_factors(theta: FloatArray) -> dict[str, FloatArray]:
    """Return H1 to H8 by eqs. (10), (11), (25) to (30), a missing cosine in (28) included (E6)."""
    t, s, c = theta, np.sin(theta), np.cos(theta)
    y = t[..., np.newaxis] * _TENTHS
    return {
        "H1": (t**3 + 6.0 * t - 12.0 * s + 6.0 * t * c) / t**5,  # (10)
        "H2": (6.0 * t - 8.0 * s + np.sin(2.0 * t)) / t**3,  # (11)
        "H3": 5.0 / 8.0  # (25)
        - 15.0 / (64.0 * t**2)
        + c**2 / (2.0 * t**2)
        - np.sin(2.0 * t) / (8.0 * t**3)
        - np.sin(4.0 * t) / (256.0 * t**3),
        "H4": 1.0 / 2.0 - t * np.sin(2.0 * t) / (4.0 * t**2),  # (26)
        "H5": (  # (27)
            400.0
            - 40.0 * np.sum(np.cos(y), axis=-1)
            + 77.0 * t**2
            - 40.0 * t * (np.sin(y) @ _TENTHS)
        )
        / (40.0 * t**4),
        "H6": printed_h6(t, (9.0 * t / 5.0)),
        "H7": _printed_h7(t),
        "H8": np.sum(np.sin(y) ** 2, axis=-1),  # (30)
    }


def printed_h6(t: FloatArray, ninth: FloatArray) -> FloatArray:
    """Return eq. (28) with a term of choice where it prints (9 theta/5) without a cosine."""
    c = np.cos
    total: FloatArray = (
        30.0
        + c(2.0 * t)
        + c(1.2 * t)
        + c(1.4 * t)
        + c(1.6 * t)
        + ninth
        - 4.0 * (c(0.5 * t) + c(0.1 * t) + c(0.3 * t) + c(0.7 * t) + c(0.9 * t))
        - 3.0 * (c(0.2 * t) + c(0.4 * t) + c(0.6 * t) + c(0.8 * t) + c(t))
    )
    return total / (4.0 * t**2)


def printed_inertia(theta: Any, robot: Robot, kind: str = "printed") -> tuple[Any, Any]:
    """Return M11 and M22 by eq. (21) with every error of the print (E2, E3, E4, E5) [kg m^2].

    Its l I_b is an area's moment, so the sum is not one of inertias; it is small.
    """
    section, H = robot.sections[0], factors(theta, kind)
    weights = (
        section.length**2 * section.backbone_mass,
        section.length * section.second_moment_of_area,
        section.length**2 * section.disk_mass,
        section.disk_mass * section.disk_diameter**2 / 16.0,
    )
    M11 = sum(w * h for w, h in zip(weights, H[0::2], strict=True))
    M22 = sum(w * h for w, h in zip(weights, H[1::2], strict=True))
    return M11, M22


def _printed_h7(t: FloatArray) -> FloatArray:
    """Return eq. (29)."""
    terms = (  # numerator and denominator before cos(k theta/5), and k
        (1, 32, 10),
        (-99, 200, 1),
        (-303, 800, 2),
        (-91, 200, 3),
        (-17, 50, 4),
        (-207, 800, 6),
        (-51, 200, 7),
        (-27, 200, 8),
        (-19, 200, 9),
        (1, 50, 12),
        (9, 800, 14),
        (1, 200, 16),
        (1, 800, 18),
        (-3, 8, 5),
    )
    total = np.full(np.shape(t), 1051.0 / 160.0)
    for over, under, k in terms:
        total += over / under * np.cos(k * t / 5.0)
    return total
