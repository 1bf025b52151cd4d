"""What a scenario file may hold: keys, types and ranges."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Tension = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
_STRICT = ConfigDict(extra="forbid", strict=True)


def _positive(description: str, **default: Any) -> Any:
    return Field(gt=0.0, allow_inf_nan=False, description=description, **default)


def _angles(description: str) -> Any:
    return Field(default=None, description=f"an array with one {description} for each section")


class ScenarioTable(BaseModel):
    """A scenario file. What robot and tension hold is checked apart, as each may be several things."""

    model_config = _STRICT

    title: str = Field(default="", description="a string")
    description: str = Field(default="", description="a string")
    source: str = Field(default="", description="a string")
    robot: str | dict[str, Any] = Field(
        description="the name of a robot, the name of a robot file (.toml) or a table with sections"
    )
    formulation: str = Field(default="exact", description='a string such as "exact"')
    initial: dict[str, Any] = Field(
        default={}, description="a table with q or theta and phi, and qd"
    )
    tension: list[_Tension] | dict[str, Any] = Field(
        default=None,
        description="an array with one number >= 0 [N] for each cable, or a table with t and rows, or with file",
    )
    t_end: float = _positive("a number > 0 [s]")
    num_samples: int = Field(
        default=1001, ge=2, le=100_000_000, description="a whole number 2 to 100000000"
    )
    method: Literal["bdf", "adams", "dopri5", "rk4"] = Field(
        default="bdf", description='"bdf", "adams", "dopri5" or "rk4"'
    )
    rtol: float = _positive("a number > 0 [1]", default=None)
    atol: float = _positive("a number > 0 [rad], [rad/s]", default=None)
    step: float = _positive("a number > 0 [s]", default=None)
    max_step: float = _positive("a number > 0 [s]", default=None)


class InitialTable(BaseModel):
    """The [initial] table: where the robot starts, straight and at rest unless told otherwise."""

    model_config = _STRICT

    q: list[_Finite] = Field(
        default=None, description="an array with two numbers [rad] for each section"
    )
    theta: list[_Finite] = _angles("number [rad]")
    theta_deg: list[_Finite] = _angles("number [deg]")
    phi: list[_Finite] = _angles("number [rad]")
    phi_deg: list[_Finite] = _angles("number [deg]")
    qd: list[_Finite] = Field(
        default=None, description="an array with two numbers [rad/s] for each section"
    )


class _TensionOverTime(BaseModel):
    model_config = _STRICT

    interpolation: Literal["linear", "previous"] = Field(
        default="linear", description='"linear" or "previous"'
    )


class TensionRows(_TensionOverTime):
    """The [tension] table with its numbers in the file."""

    t: list[_Finite] = Field(min_length=1, description="an array of increasing times [s]")
    rows: list[list[_Tension]] = Field(
        min_length=1,
        description="an array with one row for each time: a number >= 0 [N] for each cable",
    )


class TensionFile(_TensionOverTime):
    """The [tension] table that names a CSV file."""

    file: str = Field(description="the name of a CSV file with the columns t, cable 1, cable 2, ...")
