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
from cdcr.base.quantity import quantity, told


class Disk(NamedTuple):
    """A thin rigid disk, centred on the backbone and square to it."""

    position: float  # fraction of the section's length
    mass: float  # [kg]
    diameter: float  # [m]


Pair = tuple[float, float]


def _order(about: str, default: int | None = None) -> Any:
    requirement = "a whole number 0 to 4, or None to lock it"
    return quantity(f"order {about}", "", requirement, kind="order", default=default, advanced=True)


def _given(about: str, unit: str) -> Any:
    requirement = f"a number > 0 {unit} and finite, or None"
    return quantity(about, unit, requirement, kind="number or none", default=None, advanced=True)


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Section:
    """One section: a backbone, its disks and the cables that end at its end.

    By default it bends with constant curvature, and neither twists nor stretches. The order of a
    strain is that of its Legendre polynomials along the section, cpp/rods.md: bending of order 2
    has three bending vectors. A strain of order None is locked; a section with all three locked is
    a rigid link.

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
    backbone_diameter : float or (float, float)
        Diameter of the round backbone [m], > 0; a pair is that at base and tip of an even taper.
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
    bending_order : int or None, default 0
        Order of its bending, 0 to 4.
    twist_order, stretch_order : int or None, default None
        Orders of its twist, which needs a `shear_modulus` or a `twist_stiffness`, and its stretch.
    backbone_inner_diameter : float, default 0
        Of a tube [m], >= 0 and below the outer diameter.
    shear_modulus : float or None, default None
        Shear modulus of the backbone [Pa], > 0.
    bending_stiffness, twist_stiffness : float or None, default None
        E I and G J [N m^2], > 0, in place of what material and shape give.
    stretch_stiffness : float or None, default None
        E A [N], > 0, likewise.
    twist_damping : float, default 0
        Viscous damping of the twist [N m s/rad], >= 0.
    stretch_damping : float, default 0
        Viscous damping of the stretch [N s/m], >= 0.
    material_damping : float, default 0
        Kelvin-Voigt's time [s], >= 0: this times each stiffness is damping too.
    rest_bending : (2,) sequence of float, default (0, 0)
        Bending vector of the unloaded backbone [rad].
    rest_twist : float, default 0
        Twist of the unloaded backbone [rad].
    nodes : int or None, default None
        Places where the mass of a section of varying strains is summed up, 3 to 32; None for
        enough to get accelerations to about 1e-8.
    cable_entry_friction, cable_sheath_friction, cable_viscosity : float, default 0
        Friction of each cable at its entry, see ``cdcr.Cable`` [N], [-], [N s/m], >= 0.
    cable_pretension, cable_backlash : float, default 0
        Of each cable driven by length, see ``cdcr.Cable`` [N], [m], >= 0.

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
    backbone_diameter: Any = quantity(
        "of the round backbone",
        "m",
        "a number > 0 m and finite, or one (base, tip) pair",
        kind="number or pair",
        each="a number in m",
    )
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
    bending_order: int | None = _order("of the bending along the section", default=0)
    twist_order: int | None = _order("of the twist")
    stretch_order: int | None = _order("of the stretch")
    backbone_inner_diameter: float = quantity("of a tube", "m", ">= 0", default=0.0, advanced=True)
    shear_modulus: float | None = _given("of the backbone", "Pa")
    bending_stiffness: float | None = _given("E I, in place of the material's", "N m^2")
    twist_stiffness: float | None = _given("G J, in place of the material's", "N m^2")
    stretch_stiffness: float | None = _given("E A, in place of the material's", "N")
    twist_damping: float = quantity("viscous", "N m s/rad", ">= 0", default=0.0, advanced=True)
    stretch_damping: float = quantity("viscous", "N s/m", ">= 0", default=0.0, advanced=True)
    material_damping: float = quantity(
        "this times each stiffness is damping", "s", ">= 0", default=0.0, advanced=True
    )
    rest_bending: Pair = quantity(
        "bending vector of the unloaded backbone",
        "rad",
        "two numbers of rad",
        kind="pair",
        each="a number of rad",
        default=(0.0, 0.0),
        advanced=True,
    )
    rest_twist: float = quantity(
        "of the unloaded backbone", "rad", "a finite number of rad", default=0.0, advanced=True
    )
    nodes: int | None = quantity(
        "where its mass is summed up",
        "",
        "a whole number 3 to 32, or None",
        kind="whole or none",
        default=None,
        advanced=True,
    )
    cable_entry_friction: float = quantity("at the entry", "N", ">= 0", default=0.0, advanced=True)
    cable_sheath_friction: float = quantity(
        "mu of a sheath times its turning", "", ">= 0", default=0.0, advanced=True
    )
    cable_viscosity: float = quantity(
        "viscous friction at the entry", "N s/m", ">= 0", default=0.0, advanced=True
    )
    cable_pretension: float = quantity("driven by length", "N", ">= 0", default=0.0, advanced=True)
    cable_backlash: float = quantity(
        "play of the drive by length", "m", ">= 0", default=0.0, advanced=True
    )

    if TYPE_CHECKING:  # any sequence goes in, a tuple comes out

        def __init__(
            self,
            *,
            length: float,
            backbone_mass: float,
            backbone_diameter: float | Sequence[float],
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
            bending_order: int | None = ...,
            twist_order: int | None = ...,
            stretch_order: int | None = ...,
            backbone_inner_diameter: float = ...,
            shear_modulus: float | None = ...,
            bending_stiffness: float | None = ...,
            twist_stiffness: float | None = ...,
            stretch_stiffness: float | None = ...,
            twist_damping: float = ...,
            stretch_damping: float = ...,
            material_damping: float = ...,
            rest_bending: Sequence[float] | NDArray[np.floating[Any]] = ...,
            rest_twist: float = ...,
            nodes: int | None = ...,
            cable_entry_friction: float = ...,
            cable_sheath_friction: float = ...,
            cable_viscosity: float = ...,
            cable_pretension: float = ...,
            cable_backlash: float = ...,
        ) -> None: ...

    def __repr__(self) -> str:
        """Say what one would type, without what is left at its default of what few need."""
        return told(self)

    def __post_init__(self) -> None:
        """Keep every value as a plain float, int or tuple, or refuse it."""
        check = Check()
        check.keep(self)
        check.done(self._to_core().violations())
        if self.disk_positions:
            object.__setattr__(self, "num_disks", len(self.disk_positions))

    @property
    def second_moment_of_area(self) -> float:
        """Second moment of area I of the backbone [m^4], paper eq. (23); the mean of a taper."""
        base, tip = self.diameters
        fourth = sum(base ** (4 - k) * tip**k for k in range(5)) / 5.0 if base != tip else base**4
        return math.pi / 64.0 * (fourth - self.backbone_inner_diameter**4)

    @property
    def diameters(self) -> Pair:
        """Outer diameter of the backbone at base and tip [m]."""
        outer = self.backbone_diameter
        return (outer, outer) if isinstance(outer, float) else outer

    @property
    def stiffness(self) -> float:
        """Bending stiffness K = E I / length [N m/rad], paper eq. (23); the mean of a taper."""
        return self._to_core().stiffness

    @property
    def is_rod(self) -> bool:
        """Whether it is more than an arc: its strains or its diameter vary, or it bends at rest."""
        return self._to_core().is_rod

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
