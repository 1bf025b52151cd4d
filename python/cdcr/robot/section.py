"""Sections: a backbone, its disks and the cables that end on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cdcr import _core
from cdcr.base.check import Check
from cdcr.base.keywords import by_keyword
from cdcr.base.quantity import quantity


class Disk(NamedTuple):
    """A thin rigid disk, centred on the backbone and square to it."""

    position: float  # fraction of the section's length
    mass: float  # [kg]
    diameter: float  # [m]


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Section:
    """One constant-curvature section: a backbone, its disks and the cables that end at its end.

    Without `disk_positions`, disk k of N sits at fraction k/N of the length. The cables at
    `cable_angles` share radius, stiffness and damping, and run through all sections before; a
    ``cdcr.Cable`` of the robot takes what does not fit that. Numbers may be of any real type and
    the sequences of any kind; they are kept as floats and tuples.

    Parameters
    ----------
    length : float
        Arc length of the backbone [m], > 0.
    backbone_mass : float
        Mass spread evenly along the length [kg], >= 0.
    backbone_diameter : float
        Diameter of the round, solid backbone [m], > 0.
    youngs_modulus : float
        Young's modulus of the backbone [Pa], > 0.
    disk_mass : float, default 0
        Mass of each disk [kg], >= 0.
    disk_diameter : float, default 0
        Diameter of each disk [m], >= 0.
    num_disks : int, default 0
        Number of disks, 0 to 64. With `disk_positions` it may be left out, and is their number.
    disk_positions : sequence of float, default ()
        Where the disks sit, each a fraction of the length 0 to 1, in any order; up to 64.
    disk_masses : sequence of float, default ()
        Mass of each disk [kg], >= 0, in place of `disk_mass`; one for each disk.
    disk_diameters : sequence of float, default ()
        Diameter of each disk [m], >= 0, in place of `disk_diameter`; one for each disk.
    cable_radius : float, default 0
        Distance from backbone to cable [m], > 0 where there are cables.
    cable_angles : sequence of float, default ()
        Angle of each cable about Z, from X [rad]; 0 to 16 of them.
    cable_stiffness : float, default 0
        Of each cable and its drive [N/m], >= 0; 0 for cables driven by tension, see ``cdcr.Cable``.
    cable_damping : float, default 0
        Of each cable, along with a stiffness [N s/m], >= 0.
    cable_friction : float, default 0
        Coulomb's coefficient in the holes of this section, for every cable through them, >= 0.
    damping : float, default 0
        Viscous damping of each bending component [N m s/rad], >= 0.

    Raises
    ------
    ValueError
        With one sentence for each field that is out of its range, one a line.

    Examples
    --------
    >>> import cdcr
    >>> backbone = {"length": 0.2, "backbone_mass": 0.003, "backbone_diameter": 0.0016}
    >>> section = cdcr.Section(**backbone, youngs_modulus=60e9, num_disks=8, disk_mass=0.001)
    >>> print(f"{section.stiffness:.4f} N m/rad, {1e3 * section.mass:.1f} g")
    0.0965 N m/rad, 11.0 g
    """

    length: float = quantity("arc length of the backbone", "m", "> 0")
    backbone_mass: float = quantity("spread evenly along the length", "kg", ">= 0")
    backbone_diameter: float = quantity("of the round, solid backbone", "m", "> 0")
    youngs_modulus: float = quantity("of the backbone", "Pa", "> 0")
    disk_mass: float = quantity("of each disk", "kg", ">= 0", default=0.0)
    disk_diameter: float = quantity("of each disk", "m", ">= 0", default=0.0)
    num_disks: int = quantity(
        "equally spaced, the last at the end", "", "a whole number 0 to 64", kind="whole", default=0
    )
    disk_positions: tuple[float, ...] = quantity(
        "fractions of the length",
        "",
        "a sequence of 0 to 64 numbers 0 to 1",
        kind="numbers",
        each="a number 0 to 1",
        default=(),
        advanced=True,
    )
    disk_masses: tuple[float, ...] = quantity(
        "one for each disk",
        "kg",
        "a sequence of 0 to 64 numbers in kg",
        kind="numbers",
        each=">= 0",
        default=(),
        advanced=True,
    )
    disk_diameters: tuple[float, ...] = quantity(
        "one for each disk",
        "m",
        "a sequence of 0 to 64 numbers in m",
        kind="numbers",
        each=">= 0",
        default=(),
        advanced=True,
    )
    cable_radius: float = quantity("from backbone to cable", "m", "> 0", default=0.0)
    cable_angles: tuple[float, ...] = quantity(
        "about Z, from X",
        "rad",
        "a sequence of 0 to 16 numbers in rad",
        kind="numbers",
        each="a finite number of rad",
        default=(),
    )
    cable_stiffness: float = quantity(
        "cables driven by length", "N/m", ">= 0", default=0.0, advanced=True
    )
    cable_damping: float = quantity(
        "of the drive by length", "N s/m", ">= 0", default=0.0, advanced=True
    )
    cable_friction: float = quantity(
        "coefficient in the holes", "", ">= 0", default=0.0, advanced=True
    )
    damping: float = quantity("viscous, per bending component", "N m s/rad", ">= 0", default=0.0)

    if TYPE_CHECKING:  # any sequence goes in, a tuple comes out

        def __init__(
            self,
            *,
            length: float,
            backbone_mass: float,
            backbone_diameter: float,
            youngs_modulus: float,
            disk_mass: float = ...,
            disk_diameter: float = ...,
            num_disks: int = ...,
            disk_positions: Sequence[float] | NDArray[np.floating[Any]] = ...,
            disk_masses: Sequence[float] | NDArray[np.floating[Any]] = ...,
            disk_diameters: Sequence[float] | NDArray[np.floating[Any]] = ...,
            cable_radius: float = ...,
            cable_angles: Sequence[float] | NDArray[np.floating[Any]] = ...,
            cable_stiffness: float = ...,
            cable_damping: float = ...,
            cable_friction: float = ...,
            damping: float = ...,
        ) -> None: ...

    def __post_init__(self) -> None:
        """Keep every value as a plain float, int or tuple, or refuse it."""
        check = Check()
        check.keep(self)
        check.done(self._to_core().violations())
        if self.disk_positions:
            object.__setattr__(self, "num_disks", len(self.disk_positions))

    @property
    def second_moment_of_area(self) -> float:
        """Second moment of area of the backbone, I = pi d^4 / 64 [m^4]."""
        return math.pi / 64.0 * self.backbone_diameter**4

    @property
    def stiffness(self) -> float:
        """Bending stiffness K = E I / length [N m/rad], paper eq. (23)."""
        return self.youngs_modulus * self.second_moment_of_area / self.length

    @property
    def disks(self) -> tuple[Disk, ...]:
        """Position [fraction of the length], mass [kg] and diameter [m] of each disk."""
        return tuple(Disk(*disk) for disk in self._to_core().disks())

    @property
    def mass(self) -> float:
        """Mass of backbone and disks [kg]."""
        return self.backbone_mass + sum(disk.mass for disk in self.disks)

    def _to_core(self) -> _core.Section:
        return _core.Section(**{item.name: getattr(self, item.name) for item in fields(self)})
