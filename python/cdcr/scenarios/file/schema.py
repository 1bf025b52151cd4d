"""What a scenario file may hold: keys, types and ranges."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, create_model

from cdcr.base.arrays import MAX_SAMPLES
from cdcr.robot.robot import Robot
from cdcr.robot.schema import table_of
from cdcr.robot.section import Section

Finite = Annotated[float, Field(allow_inf_nan=False)]
_Tension = Annotated[float, Field(ge=0.0, allow_inf_nan=False)]
STRICT = ConfigDict(extra="forbid", strict=True)


def optional(requirement: str, **limits: Any) -> Any:
    """Return a key that may be left out."""
    return Field(default=None, description=requirement, **limits)


def _positive(requirement: str) -> Any:
    """Return a key that may be left out, for a number > 0."""
    return optional(requirement, gt=0.0, allow_inf_nan=False)


class ScenarioTable(BaseModel):
    """A scenario file. The tables in it are checked on their own."""

    model_config = STRICT

    title: str = optional("a string")
    description: str = optional("a string")
    source: str = optional("a string")
    robot: str | dict[str, Any] = Field(
        description="the name of a robot, the name of a robot file (.toml), a table with sections "
        "or a table with the name of a robot and what is different"
    )
    formulation: str = optional("a string")
    initial: dict[str, Any] = optional("a table with q or theta and phi, qd, equilibrium")
    tension: list[_Tension] | list[dict[str, Any]] | dict[str, Any] = optional(
        "an array with a number >= 0 [N] for each cable, or tables [[tension]] with cable and "
        "shape, or a table with t and rows, hold, shapes or file"
    )
    wrenches: list[dict[str, Any]] = optional("tables [[wrenches]] with section, force, moment")
    trajectory: dict[str, Any] = optional("a table with shape, or with t or file")
    controller: dict[str, Any] = optional("a table with type")
    integrator: dict[str, Any] = optional("a table with method, rtol, atol, step, max_step")
    output: dict[str, Any] = optional("a table with num_samples or files")
    t_end: float = Field(gt=0.0, allow_inf_nan=False, description="a number > 0 [s]")


# A known robot, and what is different about it: [robot] with a name, and [robot.each_section].
RobotChanges: type[BaseModel] = create_model(
    "RobotChanges",
    __base__=table_of(Robot, partial=True),
    name=(str, Field(description="the name of a robot")),
    each_section=(dict[str, Any], optional("a table with fields of a section")),
)
SECTION_CHANGES = table_of(Section, partial=True)


class IntegratorTable(BaseModel):
    """The [integrator] table: how the run is integrated."""

    model_config = STRICT

    method: Literal["bdf", "adams", "dopri5", "rk4"] = optional('"bdf", "adams", "dopri5" or "rk4"')
    rtol: float = _positive("a number > 0 [1]")
    atol: float = _positive("a number > 0 [rad], [rad/s]")
    step: float = _positive("a number > 0 [s]")
    max_step: float = _positive("a number > 0 [s]")
    max_steps: int = optional("a whole number > 0", gt=0, lt=2**63)


class ReferenceTable(BaseModel):
    """Bending vectors, or the angles of them: [controller.reference]."""

    model_config = STRICT

    q: list[Finite] = optional("an array with two numbers [rad] for each section")
    theta: list[Finite] = optional("an array with a number [rad] for each section")
    theta_deg: list[Finite] = optional("an array with a number [deg] for each section")
    phi: list[Finite] = optional("an array with a number [rad] for each section")
    phi_deg: list[Finite] = optional("an array with a number [deg] for each section")


class InitialTable(ReferenceTable):
    """The [initial] table: where the robot starts, straight and at rest unless told otherwise."""

    qd: list[Finite] = optional("an array with two numbers [rad/s] for each section")
    equilibrium: bool = optional("true or false")
    payload: float = optional("a number >= 0 [kg]", ge=0.0, allow_inf_nan=False)


class OutputTable(BaseModel):
    """The [output] table: what is written."""

    model_config = STRICT

    num_samples: int = optional(f"a whole number 2 to {MAX_SAMPLES}", ge=2, le=MAX_SAMPLES)
    files: list[Literal["picture", "csv", "nc", "mcap"]] = optional(
        'an array with one or more of "picture", "csv", "nc", "mcap"', min_length=1
    )


class ControllerTable(BaseModel):
    """The [controller] table of type "pid"."""

    model_config = STRICT

    type: Literal["pid"] = Field(description='"pid"')
    kp: float = Field(ge=0.0, allow_inf_nan=False, description="a number >= 0 [N m/rad]")
    ki: float = optional("a number >= 0 [N m/(rad s)]", ge=0.0, allow_inf_nan=False)
    kd: float = optional("a number >= 0 [N m s/rad]", ge=0.0, allow_inf_nan=False)
    period: float = _positive("a number > 0 [s]")
    feed_forward: bool = optional("true or false")
    anti_windup: bool = optional("true or false")
    min_tension: float = optional("a number [N], or -inf for no limit")
    max_tension: float = optional("a number [N], or inf for no limit")
    cables: list[int] = optional("an array with numbers of cables, from 1", min_length=1)
    reference: dict[str, Any] = optional("a table with q, or theta and phi")


class _TensionOverTime(BaseModel):
    model_config = STRICT

    interpolation: Literal["linear", "previous"] = optional('"linear" or "previous"')


class TensionRows(_TensionOverTime):
    """The [tension] table with its numbers in the file."""

    t: list[Finite] = Field(min_length=1, description="an array of increasing times [s]")
    rows: list[list[_Tension]] = Field(
        min_length=1,
        description="an array with one row for each time: a number >= 0 [N] for each cable",
    )


class TensionHold(_TensionOverTime):
    """The [tension] table with shapes of the robot that the tensions hold."""

    t: list[Finite] = optional("an array of increasing times [s]", min_length=1)
    hold: dict[str, Any] = Field(description="a table with q, or theta and phi")


class TensionSampled(BaseModel):
    """The [tension] table with tables [[tension.shapes]] that are sampled."""

    model_config = STRICT

    step: float = Field(gt=0.0, allow_inf_nan=False, description="a number > 0 [s]")
    shapes: list[dict[str, Any]] = Field(
        min_length=1, description="tables [[tension.shapes]] with cable and shape"
    )


class TensionFile(_TensionOverTime):
    """The [tension] table that names a CSV file."""

    file: str = Field(
        description="the name of a CSV file with the columns t, cable 1, cable 2, ..."
    )


_Row = list[Finite] | list[list[Finite]]


def _held(unit: str, each: str = "a number") -> Any:
    where = "for each section; where there are times, a row of them for each"
    return optional(f"an array with {each} [{unit}] {where}")


class HoldTable(BaseModel):
    """The [tension.hold] table: shapes of the robot, and what hangs at its tip in them."""

    model_config = STRICT

    q: _Row = _held("rad", "two numbers")
    theta: _Row = _held("rad")
    theta_deg: _Row = _held("deg")
    phi: _Row = _held("rad")
    phi_deg: _Row = _held("deg")
    payload: float = optional("a number >= 0 [kg]", ge=0.0, allow_inf_nan=False)


class WrenchTable(BaseModel):
    """One table [[wrenches]]: a force and a moment on the backbone."""

    model_config = STRICT

    section: int = Field(gt=0, description="the number of a section, from 1")
    fraction: float = optional(
        "a fraction of the section's length, 0 to 1", ge=0.0, le=1.0, allow_inf_nan=False
    )
    force: list[Finite] = optional("three numbers [N]", min_length=3, max_length=3)
    moment: list[Finite] = optional("three numbers [N m]", min_length=3, max_length=3)
    frame: Literal["base", "local"] = optional('"base" or "local"')
    times: list[Finite] = optional("an array of increasing times [s]", min_length=1)
    factors: list[Finite] = optional("an array with a number for each time", min_length=1)
    interpolation: Literal["linear", "previous"] = optional('"linear" or "previous"')
