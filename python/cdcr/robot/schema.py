"""What a robot file may hold: keys and types. Ranges are checked by the C++ library."""

from __future__ import annotations

from dataclasses import fields
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from cdcr.robot.cable import Cable
from cdcr.robot.section import Section


def _requirements(kind: type[Section | Cable]) -> dict[str, str]:
    return {item.name: item.metadata["requirement"] for item in fields(kind)}


_SECTION, _CABLE = _requirements(Section), _requirements(Cable)

_Int = Annotated[int, Field(ge=-(2**31), lt=2**31)]  # what the core can be told
_Three = Annotated[list[float], Field(min_length=3, max_length=3)]
_Rows = Annotated[list[_Three], Field(min_length=3, max_length=3)]


def _optional(requirement: str) -> Any:
    """Return a key that may be left out; the default of its description then holds."""
    return Field(default=None, description=requirement)


class SectionTable(BaseModel):
    """A [[sections]] table."""

    model_config = ConfigDict(extra="forbid", strict=True)

    length: float = Field(description=_SECTION["length"])
    backbone_mass: float = Field(description=_SECTION["backbone_mass"])
    backbone_diameter: float = Field(description=_SECTION["backbone_diameter"])
    youngs_modulus: float = Field(description=_SECTION["youngs_modulus"])
    disk_mass: float = _optional(_SECTION["disk_mass"])
    disk_diameter: float = _optional(_SECTION["disk_diameter"])
    num_disks: _Int = _optional(_SECTION["num_disks"])
    disk_positions: list[float] = _optional("an array of 0 to 64 numbers 0 to 1")
    disk_masses: list[float] = _optional("an array of 0 to 64 numbers [kg]")
    disk_diameters: list[float] = _optional("an array of 0 to 64 numbers [m]")
    cable_radius: float = _optional(_SECTION["cable_radius"])
    cable_angles: list[float] = _optional("an array of 0 to 16 numbers [rad]")
    cable_angles_deg: list[float] = _optional("an array of 0 to 16 numbers [deg]")
    cable_stiffness: float = _optional(_SECTION["cable_stiffness"])
    cable_damping: float = _optional(_SECTION["cable_damping"])
    cable_friction: float = _optional(_SECTION["cable_friction"])
    damping: float = _optional(_SECTION["damping"])


class CableTable(BaseModel):
    """A [[cables]] table."""

    model_config = ConfigDict(extra="forbid", strict=True)

    radius: float = Field(description=_CABLE["radius"])
    angle: float = _optional("a finite number [rad]")
    angle_deg: float = _optional("a finite number [deg]")
    end_section: _Int = Field(description=_CABLE["end_section"])
    stiffness: float = _optional(_CABLE["stiffness"])
    damping: float = _optional(_CABLE["damping"])
    friction: float = _optional("a number >= 0 and finite")


class RobotTable(BaseModel):
    """A robot file, or a [robot] table in a scenario file."""

    model_config = ConfigDict(extra="forbid", strict=True)

    gravity: _Three = _optional("an array of 3 numbers [m/s^2]")
    payload: float = _optional("a number >= 0 kg and finite")
    base_orientation: _Rows = _optional("an array of 3 rows of 3 numbers")
    payload_position: _Three = _optional("an array of 3 numbers [m]")
    payload_inertia: _Rows = _optional("an array of 3 rows of 3 numbers [kg m^2]")
    sliding_speed: float = _optional("a number > 0 m/s and finite")
    sections: list[dict[str, Any]] = Field(description="one [[sections]] table for each section")
    cables: list[dict[str, Any]] = _optional("one [[cables]] table for each cable")
