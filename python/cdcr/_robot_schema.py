"""What a robot file may hold: keys and types. Ranges are checked by the C++ library."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from cdcr._robot import Robot, Section

_WANTED = {item.name: item.metadata["wanted"] for item in (*fields(Section), *fields(Robot))}


def _number(name: str) -> Any:
    """Return an optional field for which the description's default holds."""
    return Field(default=None, description=_WANTED[name])


class SectionTable(BaseModel):
    """A [[sections]] table."""

    model_config = ConfigDict(extra="forbid", strict=True)

    length: float = Field(description=_WANTED["length"])
    backbone_mass: float = Field(description=_WANTED["backbone_mass"])
    backbone_diameter: float = Field(description=_WANTED["backbone_diameter"])
    youngs_modulus: float = Field(description=_WANTED["youngs_modulus"])
    disk_mass: float = _number("disk_mass")
    disk_diameter: float = _number("disk_diameter")
    num_disks: int = Field(default=None, ge=-(2**31), lt=2**31, description=_WANTED["num_disks"])
    cable_radius: float = _number("cable_radius")
    cable_angles: list[float] = Field(default=None, description="an array of 0 to 16 numbers [rad]")
    cable_angles_deg: list[float] = Field(
        default=None, description="an array of 0 to 16 numbers [deg]"
    )
    damping: float = _number("damping")


class RobotTable(BaseModel):
    """A robot file, or a [robot] table in a scenario file."""

    model_config = ConfigDict(extra="forbid", strict=True)

    gravity: list[float] = Field(
        default=None,
        min_length=3,
        max_length=3,
        description="an array of three numbers [m/s^2]",
    )
    payload: float = _number("payload")
    sections: list[dict[str, Any]] = Field(description="one [[sections]] table for each section")
