"""What a robot file may hold: keys and types. Ranges are checked by the C++ library."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from cdcr._robot import Robot, Section

_WANTED = {item.name: item.metadata["wanted"] for item in (*fields(Section), *fields(Robot))}


def _optional(wanted: str, **limits: Any) -> Any:
    """Return a key that may be left out; the default of Section or Robot then holds."""
    return Field(default=None, description=wanted, **limits)


class SectionTable(BaseModel):
    """A [[sections]] table."""

    model_config = ConfigDict(extra="forbid", strict=True)

    length: float = Field(description=_WANTED["length"])
    backbone_mass: float = Field(description=_WANTED["backbone_mass"])
    backbone_diameter: float = Field(description=_WANTED["backbone_diameter"])
    youngs_modulus: float = Field(description=_WANTED["youngs_modulus"])
    disk_mass: float = _optional(_WANTED["disk_mass"])
    disk_diameter: float = _optional(_WANTED["disk_diameter"])
    num_disks: int = _optional(_WANTED["num_disks"], ge=-(2**31), lt=2**31)
    cable_radius: float = _optional(_WANTED["cable_radius"])
    cable_angles: list[float] = _optional("an array of 0 to 16 numbers [rad]")
    cable_angles_deg: list[float] = _optional("an array of 0 to 16 numbers [deg]")
    damping: float = _optional(_WANTED["damping"])


class RobotTable(BaseModel):
    """A robot file, or a [robot] table in a scenario file."""

    model_config = ConfigDict(extra="forbid", strict=True)

    gravity: list[float] = _optional("an array of 3 numbers [m/s^2]", min_length=3, max_length=3)
    payload: float = _optional(_WANTED["payload"])
    sections: list[dict[str, Any]] = Field(description="one [[sections]] table for each section")
