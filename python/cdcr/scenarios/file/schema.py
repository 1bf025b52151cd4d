"""What a scenario file may hold: keys, types and ranges."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from cdcr.scenarios.scenario import MAX_SAMPLES

_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Tension = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
_STRICT = ConfigDict(extra="forbid", strict=True)


def _optional(requirement: str, **limits: Any) -> Any:
    """Return a key that may be left out."""
    return Field(default=None, description=requirement, **limits)


def _positive(requirement: str) -> Any:
    """Return a key that may be left out, for a number > 0."""
    return _optional(requirement, gt=0.0, allow_inf_nan=False)


class ScenarioTable(BaseModel):
    """A scenario file. The tables in it are checked on their own."""

    model_config = _STRICT

    title: str = _optional("a string")
    description: str = _optional("a string")
    source: str = _optional("a string")
    robot: str | dict[str, Any] = Field(
        description="the name of a robot, the name of a robot file (.toml) or a table with sections"
    )
    formulation: str = _optional("a string")
    initial: dict[str, Any] = _optional("a table with q or theta and phi, and qd")
    tension: list[_Tension] | list[dict[str, Any]] | dict[str, Any] = _optional(
        "an array with a number >= 0 [N] for each cable, or tables [[tension]] with cable and "
        "shape, or a table with t and rows, or a table with file"
    )
    wrenches: list[dict[str, Any]] = _optional("tables [[wrenches]] with section, force, moment")
    trajectory: dict[str, Any] = _optional("a table with shape, or with t or file")
    controller: dict[str, Any] = _optional("a table with type")
    output: dict[str, Any] = _optional("a table with num_samples or files")
    t_end: float = Field(gt=0.0, allow_inf_nan=False, description="a number > 0 [s]")
    num_samples: int = _optional(f"a whole number 2 to {MAX_SAMPLES}", ge=2, le=MAX_SAMPLES)
    method: Literal["bdf", "adams", "dopri5", "rk4"] = _optional(
        '"bdf", "adams", "dopri5" or "rk4"'
    )
    rtol: float = _positive("a number > 0 [1]")
    atol: float = _positive("a number > 0 [rad], [rad/s]")
    step: float = _positive("a number > 0 [s]")
    max_step: float = _positive("a number > 0 [s]")
    max_steps: int = _optional("a whole number > 0", gt=0, lt=2**63)


class ReferenceTable(BaseModel):
    """Bending vectors, or the angles of them: [controller.reference]."""

    model_config = _STRICT

    q: list[_Finite] = _optional("an array with two numbers [rad] for each section")
    theta: list[_Finite] = _optional("an array with a number [rad] for each section")
    theta_deg: list[_Finite] = _optional("an array with a number [deg] for each section")
    phi: list[_Finite] = _optional("an array with a number [rad] for each section")
    phi_deg: list[_Finite] = _optional("an array with a number [deg] for each section")


class InitialTable(ReferenceTable):
    """The [initial] table: where the robot starts, straight and at rest unless told otherwise."""

    qd: list[_Finite] = _optional("an array with two numbers [rad/s] for each section")


class OutputTable(BaseModel):
    """The [output] table: what is written."""

    model_config = _STRICT

    num_samples: int = _optional(f"a whole number 2 to {MAX_SAMPLES}", ge=2, le=MAX_SAMPLES)
    files: list[Literal["picture", "csv", "nc"]] = _optional(
        'an array with one or more of "picture", "csv", "nc"', min_length=1
    )


class ControllerTable(BaseModel):
    """The [controller] table of type "pid"."""

    model_config = _STRICT

    type: Literal["pid"] = Field(description='"pid"')
    kp: float = Field(ge=0.0, allow_inf_nan=False, description="a number >= 0 [N m/rad]")
    ki: float = _optional("a number >= 0 [N m/(rad s)]", ge=0.0, allow_inf_nan=False)
    kd: float = _optional("a number >= 0 [N m s/rad]", ge=0.0, allow_inf_nan=False)
    period: float = _positive("a number > 0 [s]")
    feed_forward: bool = _optional("true or false")
    anti_windup: bool = _optional("true or false")
    min_tension: float = _optional("a number [N], or -inf for no limit")
    max_tension: float = _optional("a number [N], or inf for no limit")
    cables: list[int] = _optional("an array with numbers of cables, from 1", min_length=1)
    reference: dict[str, Any] = _optional("a table with q, or theta and phi")


class _TensionOverTime(BaseModel):
    model_config = _STRICT

    interpolation: Literal["linear", "previous"] = _optional('"linear" or "previous"')


class TensionRows(_TensionOverTime):
    """The [tension] table with its numbers in the file."""

    t: list[_Finite] = Field(min_length=1, description="an array of increasing times [s]")
    rows: list[list[_Tension]] = Field(
        min_length=1,
        description="an array with one row for each time: a number >= 0 [N] for each cable",
    )


class TensionFile(_TensionOverTime):
    """The [tension] table that names a CSV file."""

    file: str = Field(
        description="the name of a CSV file with the columns t, cable 1, cable 2, ..."
    )


class WrenchTable(BaseModel):
    """One table [[wrenches]]: a force and a moment on the backbone."""

    model_config = _STRICT

    section: int = Field(gt=0, description="the number of a section, from 1")
    fraction: float = _optional(
        "a fraction of the section's length, 0 to 1", ge=0.0, le=1.0, allow_inf_nan=False
    )
    force: list[_Finite] = _optional("three numbers [N]", min_length=3, max_length=3)
    moment: list[_Finite] = _optional("three numbers [N m]", min_length=3, max_length=3)
    frame: Literal["base", "local"] = _optional('"base" or "local"')
    times: list[_Finite] = _optional("an array of increasing times [s]", min_length=1)
    factors: list[_Finite] = _optional("an array with a number for each time", min_length=1)
    interpolation: Literal["linear", "previous"] = _optional('"linear" or "previous"')
