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


def needed(requirement: str, about: str, **limits: Any) -> Any:
    """Return a key that must be there: what its value must be, and what it is."""
    return Field(description=requirement, title=about, **limits)


def optional(requirement: str, about: str, **limits: Any) -> Any:
    """Return a key that may be left out."""
    return Field(default=None, description=requirement, title=about, **limits)


def _positive(requirement: str, about: str) -> Any:
    """Return a key that may be left out, for a number > 0."""
    return optional(requirement, about, gt=0.0, allow_inf_nan=False)


class ScenarioTable(BaseModel):
    """A scenario file. The tables in it are checked on their own."""

    model_config = STRICT

    title: str = optional("a string", "what the run is called")
    description: str = optional("a string", "what happens in it")
    source: str = optional("a string", "where its numbers come from")
    robot: str | dict[str, Any] = needed(
        "the name of a robot, the name of a robot file (.toml), a table with sections "
        "or a table with the name of a robot and what is different",
        "the robot",
    )
    formulation: str = optional("a string", "the equations: exact, or the origin paper's")
    initial: dict[str, Any] = optional(
        "a table with q or theta and phi, qd, equilibrium",
        "where the robot starts; straight and at rest without it",
    )
    tension: list[_Tension] | list[dict[str, Any]] | dict[str, Any] = optional(
        "an array with a number >= 0 [N] for each cable, or tables [[tension]] with cable and "
        "shape, or a table with t and rows, hold, shapes or file",
        "what pulls the cables, in place of trajectory and controller",
    )
    wrenches: list[dict[str, Any]] = optional(
        "tables [[wrenches]] with section, force, moment", "forces and moments on the backbone"
    )
    trajectory: dict[str, Any] = optional(
        "a table with shape, or with t or file",
        "a motion to follow, in place of tension and controller",
    )
    controller: dict[str, Any] = optional(
        "a table with type",
        "a controller that pulls the cables, in place of tension and trajectory",
    )
    loop: dict[str, Any] = optional(
        "a table with step, actuators, sensors",
        "fixed steps, actuators and sensors around a controller, in place of integrator",
    )
    integrator: dict[str, Any] = optional(
        "a table with method, rtol, atol, step, max_step", "how the run is integrated"
    )
    output: dict[str, Any] = optional("a table with num_samples or files", "what is written")
    t_end: float = needed("a number > 0 [s]", "end of the run", gt=0.0, allow_inf_nan=False)


# A known robot, and what is different about it: [robot] with a name, and [robot.each_section].
RobotChanges: type[BaseModel] = create_model(
    "RobotChanges",
    __base__=table_of(Robot, partial=True),
    name=(str, needed("the name of a robot", "the known robot that is changed")),
    each_section=(
        dict[str, Any],
        optional("a table with fields of a section", "what is different about all sections"),
    ),
)
SECTION_CHANGES = table_of(Section, partial=True)


class IntegratorTable(BaseModel):
    """The [integrator] table: how the run is integrated."""

    model_config = STRICT

    method: Literal["auto", "bdf", "adams", "dopri5", "dop853", "rk4", "rosenbrock"] = optional(
        '"auto", "bdf", "adams", "dopri5", "dop853", "rk4" or "rosenbrock"',
        "all but the last two choose their steps",
    )
    rtol: float = _positive("a number > 0 [1]", "relative tolerance of a step")
    atol: float = _positive("a number > 0 [rad], [rad/s]", "absolute tolerance of a step")
    step: float = _positive("a number > 0 [s]", "step of rk4 and rosenbrock")
    max_step: float = _positive("a number > 0 [s]", "largest step")
    max_steps: int = optional(
        "a whole number > 0", "number of steps after which the run is given up", gt=0, lt=2**63
    )


class ReferenceTable(BaseModel):
    """Bending vectors, or the angles of them: [controller.reference]."""

    model_config = STRICT

    q: list[Finite] = optional(
        "an array with two numbers [rad] for each section",
        "bending vectors theta (cos phi, sin phi)",
    )
    theta: list[Finite] = optional(
        "an array with a number [rad] for each section", "bending angles"
    )
    theta_deg: list[Finite] = optional(
        "an array with a number [deg] for each section", "bending angles"
    )
    phi: list[Finite] = optional(
        "an array with a number [rad] for each section", "orientation angles, 0 towards X"
    )
    phi_deg: list[Finite] = optional(
        "an array with a number [deg] for each section", "orientation angles, 0 towards X"
    )


class InitialTable(ReferenceTable):
    """The [initial] table: where the robot starts, straight and at rest unless told otherwise."""

    qd: list[Finite] = optional(
        "an array with two numbers [rad/s] for each section", "rates of the bending vectors"
    )
    equilibrium: bool = optional(
        "true or false",
        "whether it starts at rest under what pulls then; angles or q say where to search",
    )
    payload: float = optional(
        "a number >= 0 [kg]",
        "mass at the tip until the start, when it falls off, beside that of the robot",
        ge=0.0,
        allow_inf_nan=False,
    )


class OutputTable(BaseModel):
    """The [output] table: what is written."""

    model_config = STRICT

    num_samples: int = optional(
        f"a whole number 2 to {MAX_SAMPLES}",
        "samples of the run, evenly spaced, both ends included",
        ge=2,
        le=MAX_SAMPLES,
    )
    files: list[Literal["picture", "csv", "nc", "mcap"]] = optional(
        'an array with one or more of "picture", "csv", "nc", "mcap"',
        "kinds of files to write",
        min_length=1,
    )


class _TensionOverTime(BaseModel):
    model_config = STRICT

    interpolation: Literal["linear", "previous"] = optional(
        '"linear" or "previous"', "between the times: lines, or each value held until the next"
    )


class TensionRows(_TensionOverTime):
    """The [tension] table with its numbers in the file."""

    t: list[Finite] = needed("an array of increasing times [s]", "times of the rows", min_length=1)
    rows: list[list[_Tension]] = needed(
        "an array with one row for each time: a number >= 0 [N] for each cable",
        "tensions at these times",
        min_length=1,
    )


class TensionHold(_TensionOverTime):
    """The [tension] table with shapes of the robot that the tensions hold."""

    t: list[Finite] = optional(
        "an array of increasing times [s]",
        "times of the shapes; without them one shape is held for ever",
        min_length=1,
    )
    hold: dict[str, Any] = needed(
        "a table with q, or theta and phi",
        "shapes of the robot, held by the least tensions that do",
    )


class TensionSampled(BaseModel):
    """The [tension] table with tables [[tension.shapes]] that are sampled."""

    model_config = STRICT

    step: float = needed(
        "a number > 0 [s]", "time between the samples of the shapes", gt=0.0, allow_inf_nan=False
    )
    shapes: list[dict[str, Any]] = needed(
        "tables [[tension.shapes]] with cable and shape",
        "changes of tension over time, which add up",
        min_length=1,
    )


class TensionFile(_TensionOverTime):
    """The [tension] table that names a CSV file."""

    file: str = needed(
        "the name of a CSV file with the columns t, cable 1, cable 2, ...",
        "file of tensions over time, found from the folder of this one",
    )


_Row = list[Finite] | list[list[Finite]]


def _held(unit: str, about: str, each: str = "a number") -> Any:
    where = "for each section; where there are times, a row of them for each"
    return optional(f"an array with {each} [{unit}] {where}", about)


class HoldTable(BaseModel):
    """The [tension.hold] table: shapes of the robot, and what hangs at its tip in them."""

    model_config = STRICT

    q: _Row = _held("rad", "bending vectors theta (cos phi, sin phi)", "two numbers")
    theta: _Row = _held("rad", "bending angles")
    theta_deg: _Row = _held("deg", "bending angles")
    phi: _Row = _held("rad", "orientation angles, 0 towards X")
    phi_deg: _Row = _held("deg", "orientation angles, 0 towards X")
    payload: float = optional(
        "a number >= 0 [kg]",
        "mass at the tip while held, beside that of the robot",
        ge=0.0,
        allow_inf_nan=False,
    )


class WrenchTable(BaseModel):
    """One table [[wrenches]]: a force and a moment on the backbone."""

    model_config = STRICT

    section: int = needed(
        "the number of a section, from 1", "section that it acts on, base to tip", gt=0
    )
    fraction: float = optional(
        "a fraction of the section's length, 0 to 1",
        "where along the section",
        ge=0.0,
        le=1.0,
        allow_inf_nan=False,
    )
    force: list[Finite] = optional("three numbers [N]", "force", min_length=3, max_length=3)
    moment: list[Finite] = optional(
        "three numbers [N m]",
        "moment about the point where the force acts",
        min_length=3,
        max_length=3,
    )
    frame: Literal["base", "local"] = optional(
        '"base" or "local"', "frame of force and moment; local turns with the backbone"
    )
    times: list[Finite] = optional(
        "an array of increasing times [s]", "times at which their size changes", min_length=1
    )
    factors: list[Finite] = optional(
        "an array with a number for each time",
        "their size at these times, over the one given",
        min_length=1,
    )
    interpolation: Literal["linear", "previous"] = optional(
        '"linear" or "previous"', "between the times: lines, or each factor held until the next"
    )
