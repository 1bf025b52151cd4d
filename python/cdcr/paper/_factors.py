"""The factors H1 to H8 of paper eqs. (9) to (16), and the inertia M11, M22 of eq. (21)."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from cdcr._core import max_bending
from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import Check, require_kind, short
from cdcr.model.model import FORMULATIONS
from cdcr.paper._elements import Sums, cut_sums, disks, rod, sums
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section


class Factors(NamedTuple):
    """The factors of paper eqs. (9), (14), (15), (16), by their numbers there.

    Those of thetad^2 are H1 and H3 (backbone: translation, rotation), H5 and H7 (disks); those of
    phid^2 are H2 and H4, H6 and H8. Eq. (9) has H1/3 and H2/4.

    Attributes
    ----------
    H1, H2, H3, H4, H5, H6, H7, H8 : float or (...) array
        Each of the shape of the angles [1].

    Examples
    --------
    >>> import cdcr.paper
    >>> H = cdcr.paper.factors(0.5)
    >>> print(f"{H.H1:.4f} {H.H3:.4f} {H.H5:.4f}")
    0.1485 0.3333 0.6265
    """

    H1: Any
    H2: Any
    H3: Any
    H4: Any
    H5: Any
    H6: Any
    H7: Any
    H8: Any

    def __repr__(self) -> str:
        if np.size(self.H1) > 1:
            return f"<Factors at {np.size(self.H1)} angles>"
        return f"Factors({', '.join(f'{k}={v!r}' for k, v in self._asdict().items())})"


def factors(theta: ArrayLike, kind: str = "exact", num_disks: int = 10) -> Factors:
    """Return the paper's inertia factors at bending angles.

    Parameters
    ----------
    theta : (...) array_like
        Bending angles [rad], up to ``cdcr.max_bending`` to either side.
    kind : {"exact", "taylor", "printed", "printed-taylor"}, optional
        What follows from paper eqs. (1) to (4); the same cut after theta^4; what eqs. (10), (11)
        and (25) to (30) print, with the cosine that (28) lacks (E6); the same cut.
    num_disks : int, optional
        Disks at k/num_disks of the length, k = 1 to num_disks; the paper has ten.

    Returns
    -------
    Factors
        H1 to H8, each of the shape of `theta` [1].

    Raises
    ------
    ValueError
        For an argument out of its range.

    Examples
    --------
    >>> from cdcr.paper import factors
    >>> H = factors(0.0)
    >>> print(f"{H.H1:.6g} {H.H5:.6g} {factors(0.0, 'printed').H5:.7g}")
    0.15 0.633325 0.3166625
    """
    check_kind(kind, "kind")
    angles = checked_angles(theta)
    of_rod, _ = sums(angles, rod(), kind)
    of_disks, _ = sums(angles, disks(_checked_count(num_disks)), kind)
    return _named(of_rod, of_disks, 0.5 if kind.startswith("printed") else 1.0)


def taylor_coefficients(kind: str = "taylor", num_disks: int = 10) -> Factors:
    """Return the coefficients of the cut factors, exactly.

    Parameters
    ----------
    kind : {"taylor", "printed-taylor"}, optional
        As in `factors`.
    num_disks : int, optional
        As in `factors`.

    Returns
    -------
    Factors
        For each of H1 to H8 an array (3,) of `fractions.Fraction`: those of 1, theta^2, theta^4.

    Raises
    ------
    ValueError
        For an argument out of its range.

    Examples
    --------
    >>> from cdcr.paper import taylor_coefficients
    >>> print(*taylor_coefficients().H1)
    3/20 -1/168 1/8640
    """
    from fractions import Fraction

    if kind not in ("taylor", "printed-taylor"):
        raise ValueError(f"kind must be 'taylor' or 'printed-taylor', got {short(kind)}")
    bodies = rod(), disks(_checked_count(num_disks))
    of_rod, of_disks = (Sums(*map(np.array, cut_sums(body, kind))) for body in bodies)
    return _named(of_rod, of_disks, Fraction(1, 2) if kind == "printed-taylor" else 1)


def _named(of_rod: Sums, of_disks: Sums, share: Any) -> Factors:
    """Return sums under the paper's names; `share` of the disks' translation is counted (E3)."""
    return Factors(
        H1=3 * of_rod.along,
        H2=4 * of_rod.across,
        H3=of_rod.turning_theta,
        H4=of_rod.turning_phi,
        H5=share * of_disks.along,
        H6=share * of_disks.across,
        H7=of_disks.turning_theta,
        H8=of_disks.turning_phi,
    )


def inertia(theta: ArrayLike, robot: Robot, kind: str = "exact") -> tuple[Any, Any]:
    """Return M11 and M22 of paper eq. (21), with the 1/3 and 1/4 of eq. (9) put back (E2).

    "exact" and "taylor" have the rotary inertia m_b d_b^2/16 in place of l I_b (E5) and the spin
    about the tangent with I_zz = 2 I_xx (E7); the printed kinds have l I_b and no spin. A payload,
    which the paper does not have, is a disk without size at the tip. These are the inertias of
    ``cdcr.Model`` of the same formulation: ``mass_matrix([theta, 0])`` is diag(M11, M22/theta^2).

    Parameters
    ----------
    theta : (...) array_like
        Bending angles [rad].
    robot : Robot
        Of one section.
    kind : {"exact", "taylor", "printed", "printed-taylor"}, optional
        As in `factors`.

    Returns
    -------
    M11, M22 : float or (...) array
        Of thetad^2 and phid^2 in twice the kinetic energy, each of the shape of `theta` [kg m^2].

    Raises
    ------
    ValueError
        For an argument out of its range, or a robot of several sections.

    Examples
    --------
    >>> import cdcr
    >>> import cdcr.paper
    >>> M11, M22 = cdcr.paper.inertia(0.5, cdcr.robots.amouri2020())
    >>> print(f"{M11:.6f} {M22:.6f} kg m^2")
    0.004346 0.001064 kg m^2
    """
    check_kind(kind, "kind")
    return inertia_and_slopes(checked_angles(theta), robot, kind)[0]


def inertia_and_slopes(
    theta: FloatArray, robot: Robot, kind: str
) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
    """Return (M11, M22) and their derivatives by theta, which make up paper eq. (22)."""
    section = only_section(robot)
    printed = kind.startswith("printed")
    spin = 0.0 if printed else 2.0  # I_zz/I_xx of a thin disk, E7
    if printed:  # E5: l I_b [m^5]
        rod_inertia = section.length * section.second_moment_of_area
    else:
        rod_inertia = section.backbone_mass * section.diameters[0] ** 2 / 16.0
    disk_inertia = section.disk_mass * section.disk_diameter**2 / 16.0
    parts = (
        (rod(), section.backbone_mass, rod_inertia),
        (disks(section.num_disks), section.disk_mass * (0.5 if printed else 1.0), disk_inertia),
        (disks(1), robot.payload, 0.0),  # one at the tip
    )
    zero = np.zeros(np.shape(theta))[()]
    inertias = [[zero, zero], [zero, zero]]  # values and slopes of M11 and M22
    for body, mass, turning in parts:
        if mass == turning == 0.0:
            continue
        for total, s in zip(inertias, sums(theta, body, kind), strict=True):
            turning_phi = s.turning_phi + spin * s.spin
            total[0] = total[0] + section.length**2 * mass * s.along + turning * s.turning_theta
            total[1] = total[1] + section.length**2 * mass * s.across + turning * turning_phi
    (M11, M22), (dM11, dM22) = inertias
    return (M11, M22), (dM11, dM22)


# --- Arguments ------------------------------------------------------------------------------------


def check_kind(kind: str, name: str) -> None:
    """Refuse an unknown kind of factors."""
    if kind not in FORMULATIONS:
        raise ValueError(f"{name} must be one of {FORMULATIONS}, got {short(kind)}")


def _checked_count(num_disks: int) -> int:
    check = Check()
    count = check.whole("num_disks", num_disks, "a whole number 0 to 64", 0, 64)
    check.done()
    return count


def checked_angles(theta: ArrayLike) -> FloatArray:
    """Return bending angles as an array, or refuse them."""
    angles = finite(theta, "theta")
    largest = float(np.max(np.abs(angles), initial=0.0))
    if largest > max_bending:
        raise ValueError(
            f"theta must lie within cdcr.max_bending = {max_bending:.6g} rad to either side, "
            f"got {largest:.6g} rad in magnitude"
        )
    return angles


def only_section(robot: Robot) -> Section:
    """Return the section of a one-section robot, or refuse what the paper's equations lack."""
    require_kind("robot", robot, Robot)
    if len(robot.sections) != 1:
        raise ValueError(
            f"the paper's equations are for one section, got a robot of {len(robot.sections)}"
        )
    section = robot.sections[0]
    for thing in (section, robot):
        for item in fields(thing):
            value = getattr(thing, item.name)
            if item.metadata["advanced"] and value != item.default:
                raise ValueError(f"the paper's equations have no {item.name}, got {short(value)}")
    return section
