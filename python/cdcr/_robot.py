"""Robots: sections from base to tip, and what acts on them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cdcr import _core
from cdcr._fields import Check


def _quantity(about: str, unit: str, wanted: str) -> dict[str, str]:
    """Say what a field is, for refusals and for the comments in robot files."""
    return {"about": about, "unit": unit, "wanted": wanted}


@dataclass(frozen=True, kw_only=True)
class Section:
    """One constant-curvature section: a backbone, equally spaced disks and its cables.

    Disk k of N sits at fraction k/N of the length. The cables end at the last disk. Numbers may be
    of any real type and the angles any sequence; they are kept as floats and a tuple.

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
        Number of disks, 0 to 64.
    cable_radius : float, default 0
        Distance from backbone to cable [m], > 0 where there are cables.
    cable_angles : sequence of float, default ()
        Angle of each cable about Z, from X [rad]; 0 to 16 of them.
    damping : float, default 0
        Viscous damping of each bending component [N m s/rad], >= 0.

    Raises
    ------
    ValueError
        With one sentence for each field that is out of its range, one a line.
    """

    length: float = field(
        metadata=_quantity("arc length of the backbone", "m", "a number > 0 m and finite")
    )
    backbone_mass: float = field(
        metadata=_quantity("spread evenly along the length", "kg", "a number >= 0 kg and finite")
    )
    backbone_diameter: float = field(
        metadata=_quantity("of the round, solid backbone", "m", "a number > 0 m and finite")
    )
    youngs_modulus: float = field(
        metadata=_quantity("of the backbone", "Pa", "a number > 0 Pa and finite")
    )
    disk_mass: float = field(
        default=0.0, metadata=_quantity("of each disk", "kg", "a number >= 0 kg and finite")
    )
    disk_diameter: float = field(
        default=0.0, metadata=_quantity("of each disk", "m", "a number >= 0 m and finite")
    )
    num_disks: int = field(
        default=0,
        metadata=_quantity("equally spaced, the last at the end", "", "a whole number 0 to 64"),
    )
    cable_radius: float = field(
        default=0.0,
        metadata=_quantity("from backbone to cable", "m", "a number > 0 m and finite"),
    )
    cable_angles: tuple[float, ...] = field(
        default=(),
        metadata=_quantity("about Z, from X", "rad", "a sequence of 0 to 16 numbers in rad"),
    )
    damping: float = field(
        default=0.0,
        metadata=_quantity(
            "viscous, per bending component", "N m s/rad", "a number >= 0 N m s/rad and finite"
        ),
    )

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
            cable_radius: float = ...,
            cable_angles: Sequence[float] | NDArray[np.floating[Any]] = ...,
            damping: float = ...,
        ) -> None: ...

    def __post_init__(self) -> None:
        """Keep every value as a plain float, int or tuple, or refuse it."""
        check = Check()
        for item in fields(self):
            name, wanted, value = item.name, item.metadata["wanted"], getattr(self, item.name)
            plain: object
            if name == "num_disks":
                plain = check.whole(name, value, wanted)
            elif name == "cable_angles":
                plain = check.numbers(name, value, wanted, each="a finite number of rad")
            else:
                plain = check.number(name, value, wanted)
            object.__setattr__(self, name, plain)
        check.done()
        check.done(self._to_core().violations())

    @property
    def second_moment_of_area(self) -> float:
        """Second moment of area of the backbone, I = pi d^4 / 64 [m^4]."""
        return math.pi / 64.0 * self.backbone_diameter**4

    @property
    def stiffness(self) -> float:
        """Bending stiffness K = E I / length [N m/rad], paper eq. (23)."""
        return self.youngs_modulus * self.second_moment_of_area / self.length

    @property
    def mass(self) -> float:
        """Mass of backbone and disks [kg]."""
        return self.backbone_mass + self.num_disks * self.disk_mass

    def _to_core(self) -> _core.Section:
        return _core.Section(**{item.name: getattr(self, item.name) for item in fields(self)})


@dataclass(frozen=True, kw_only=True)
class Robot:
    """A cable-driven continuum robot: its sections from base to tip, and what acts on all of them.

    Parameters
    ----------
    sections : sequence of Section
        From base to tip, 1 to 32 of them.
    gravity : sequence of float, default (0, 0, 0)
        Gravity in the base frame [m/s^2]; (0, 0, -9.81) for a robot that stands upright.
    payload : float, default 0
        Point mass at the tip [kg], >= 0.

    Raises
    ------
    ValueError
        With one sentence for each field that is out of its range, one a line.

    Examples
    --------
    >>> import dataclasses
    >>> import cdcr
    >>> section = cdcr.Section(length=0.8, backbone_mass=0.03, backbone_diameter=0.005,
    ...                        youngs_modulus=9.5e9, cable_radius=0.02, cable_angles=[0, 2, 4])
    >>> robot = cdcr.Robot(sections=[section])
    >>> dataclasses.replace(robot, payload=0.1).payload
    0.1
    """

    sections: tuple[Section, ...] = field(
        metadata=_quantity("base to tip", "", "a sequence of 1 to 32 cdcr.Section")
    )
    gravity: tuple[float, float, float] = field(
        default=(0.0, 0.0, 0.0),
        metadata=_quantity("in the base frame", "m/s^2", "three numbers in m/s^2"),
    )
    payload: float = field(
        default=0.0,
        metadata=_quantity("point mass at the tip", "kg", "a number >= 0 kg and finite"),
    )

    if TYPE_CHECKING:  # any sequence goes in, a tuple comes out

        def __init__(
            self,
            *,
            sections: Sequence[Section],
            gravity: Sequence[float] | NDArray[np.floating[Any]] = ...,
            payload: float = ...,
        ) -> None: ...

    def __post_init__(self) -> None:
        """Keep every value as a plain float or tuple, or refuse it."""
        check = Check()
        wanted = {item.name: item.metadata["wanted"] for item in fields(self)}
        sections = check.items("sections", self.sections, wanted["sections"])
        for i, section in enumerate(sections):
            if not isinstance(section, Section):
                check.refuse(f"sections[{i}]", "a cdcr.Section", section)
        gravity = check.numbers("gravity", self.gravity, wanted["gravity"], "a number in m/s^2")
        if len(gravity) != 3 and not check.sentences:
            check.refuse("gravity", wanted["gravity"], self.gravity)
        payload = check.number("payload", self.payload, wanted["payload"])
        check.done()
        for name, plain in (("sections", sections), ("gravity", gravity), ("payload", payload)):
            object.__setattr__(self, name, plain)
        check.done(self._to_core().violations())

    @property
    def mass(self) -> float:
        """Mass of all sections and the payload [kg]."""
        return sum(section.mass for section in self.sections) + self.payload

    @property
    def length(self) -> float:
        """Arc length of all sections together [m]."""
        return sum(section.length for section in self.sections)

    @property
    def num_cables(self) -> int:
        """Number of cables of all sections together."""
        return sum(len(section.cable_angles) for section in self.sections)

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Robot:
        """Read a robot from a TOML file, as `save` writes it.

        Parameters
        ----------
        path : str or path
            The file. A section gives its cables either as ``cable_angles`` [rad] or as
            ``cable_angles_deg`` [deg].

        Returns
        -------
        Robot

        Raises
        ------
        FileNotFoundError
            Where there is no such file.
        ValueError
            Naming file, key and what is allowed, for broken TOML, unknown or missing keys, wrong
            types and values out of range.
        """
        from cdcr._robot_file import load_robot

        return load_robot(path)

    def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> None:
        """Write the robot to a TOML file; `load` gives back an equal robot.

        Parameters
        ----------
        path : str or path
            The file; it appears whole or not at all.
        overwrite : bool, default False
            Whether a file of that name may be replaced.

        Raises
        ------
        FileExistsError
            Where there is such a file and `overwrite` is False.
        FileNotFoundError
            Where there is no such folder.
        """
        from cdcr._robot_file import save_robot

        save_robot(self, path, overwrite=overwrite)

    def _to_core(self) -> _core.Robot:
        return _core.Robot(
            sections=[section._to_core() for section in self.sections],
            gravity=np.array(self.gravity),
            payload=self.payload,
        )
