"""Robots of the literature and an example of our own, ready to use."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from cdcr.base.check import known_name
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

__all__ = ["amouri2020", "get", "names", "rao2021", "three_sections"]

_THREE = (0.0, 2.0 * math.pi / 3.0, 4.0 * math.pi / 3.0)  # cables 120 degrees apart [rad]


def amouri2020(
    *, gravity: Sequence[float] = (0.0, 0.0, 0.0), payload: float = 0.0, damping: float = 0.0
) -> Robot:
    """Return the one-section robot of Amouri, Mahfoudi and Zaatri (2020).

    Numbers from the paper, doi 10.46604/ijeti.2020.4422. Its equations know neither gravity
    (section 4.2) nor payload nor damping; all three are zero unless given.

    Parameters
    ----------
    gravity : sequence of float, default (0, 0, 0)
        Gravity in the base frame [m/s^2].
    payload : float, default 0
        Point mass at the tip [kg].
    damping : float, default 0
        Viscous damping of each bending component [N m s/rad].

    Returns
    -------
    Robot

    Examples
    --------
    >>> import cdcr
    >>> f"{cdcr.robots.amouri2020().sections[0].stiffness:.6f} N m/rad"
    '0.363412 N m/rad'
    """
    section = Section(
        length=0.802,  # Table 1, l
        backbone_mass=0.0326,  # Table 1, m_b
        backbone_diameter=0.005,  # Table 1, d_b
        youngs_modulus=9.5e9,  # Table 1, E
        disk_mass=0.0082,  # Table 1, m_d
        disk_diameter=0.04,  # Table 1, d_d
        num_disks=10,  # nomenclature, k = 1, 2, ..., 10
        cable_radius=0.019,  # Table 1, r
        cable_angles=_THREE,  # section 2, 120 deg apart
        damping=damping,
    )
    return Robot(sections=[section], gravity=gravity, payload=payload)


def rao2021() -> Robot:
    """Return the two-section robot of Rao, Peyron, Lilge and Burgner-Kahrs (2021).

    The robot on which the authors compare static models, doi 10.3389/frobt.2020.630245. It has no
    mass: it has shapes under tension, but no dynamics.

    Returns
    -------
    Robot

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.rao2021()
    >>> f"{robot.sections[1].stiffness:.6f} N m/rad"
    '0.050915 N m/rad'
    """
    section = Section(
        length=0.2,
        backbone_mass=0.0,
        backbone_diameter=0.0014,
        youngs_modulus=54e9,
        num_disks=10,
        disk_diameter=0.02,  # just holds the cables: in pictures alone, as there is no mass
        cable_radius=0.01,
        cable_angles=_THREE,
    )
    return Robot(sections=[section, section])


def three_sections(
    *, gravity: Sequence[float] = (0.0, 0.0, 0.0), payload: float = 0.0, damping: float = 1e-3
) -> Robot:
    """Return a robot of three sections, an example design of this project.

    Nobody built it. The backbone is a Nitinol rod of 2 mm (60 GPa, 6450 kg/m^3) and the disks are
    printed, 36 mm wide and 2 mm thick (1040 kg/m^3), one every 50 mm. Each section has three
    cables, turned by 40 degrees against those of the section before so that none meet.

    Parameters
    ----------
    gravity : sequence of float, default (0, 0, 0)
        Gravity in the base frame [m/s^2].
    payload : float, default 0
        Point mass at the tip [kg].
    damping : float, default 1e-3
        Viscous damping of each bending component [N m s/rad].

    Returns
    -------
    Robot

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.three_sections()
    >>> f"{robot.length:.2f} m, {1e3 * robot.mass:.1f} g, {robot.num_cables} cables"
    '0.75 m, 47.0 g, 9 cables'
    """
    diameter, disk_diameter, thickness = 0.002, 0.036, 0.002
    sections = [
        Section(
            length=length,
            backbone_mass=6450.0 * math.pi / 4.0 * diameter**2 * length,
            backbone_diameter=diameter,
            youngs_modulus=60e9,
            disk_mass=1040.0 * math.pi / 4.0 * disk_diameter**2 * thickness,
            disk_diameter=disk_diameter,
            num_disks=num_disks,
            cable_radius=0.015,
            cable_angles=[angle + math.radians(turn) for angle in _THREE],
            damping=damping,
        )
        for length, num_disks, turn in ((0.3, 6, 0.0), (0.25, 5, 40.0), (0.2, 4, 80.0))
    ]
    return Robot(sections=sections, gravity=gravity, payload=payload)


_ROBOTS: dict[str, Callable[[], Robot]] = {
    "amouri2020": amouri2020,
    "rao2021": rao2021,
    "three_sections": three_sections,
}


def names() -> tuple[str, ...]:
    """Return the names of all robots known here.

    Examples
    --------
    >>> import cdcr
    >>> cdcr.robots.names()
    ('amouri2020', 'rao2021', 'three_sections')
    """
    return tuple(_ROBOTS)


def get(name: str) -> Robot:
    """Return the robot of that name, with its options at their defaults.

    Parameters
    ----------
    name : str
        One of `names`, with dashes or underscores.

    Returns
    -------
    Robot

    Raises
    ------
    ValueError
        For an unknown name, with the known ones.

    Examples
    --------
    >>> import cdcr
    >>> cdcr.robots.get("three_sections").num_cables
    9
    """
    return _ROBOTS[known_name("robot", name, names())]()
