"""Robots of the literature, ready to use."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from cdcr._fields import nearest
from cdcr._robot import Robot, Section

__all__ = ["amouri2020", "get", "names"]


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
        cable_angles=(0.0, 2.0 * math.pi / 3.0, 4.0 * math.pi / 3.0),  # section 2, 120 deg apart
        damping=damping,
    )
    return Robot(sections=[section], gravity=gravity, payload=payload)


_ROBOTS: dict[str, Callable[[], Robot]] = {"amouri2020": amouri2020}


def names() -> tuple[str, ...]:
    """Return the names of all robots known here."""
    return tuple(_ROBOTS)


def get(name: str) -> Robot:
    """Return the robot of that name, with its options at their defaults.

    Raises
    ------
    ValueError
        For an unknown name, with the known ones.
    """
    if name not in _ROBOTS:
        known = ", ".join(names())
        raise ValueError(f"there is no robot {name!r}.{nearest(name, names())} Known: {known}")
    return _ROBOTS[name]()
