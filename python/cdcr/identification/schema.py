"""What a file for ``cdcr identify`` may hold: keys, types and ranges."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field

_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Positive = Annotated[float, Field(gt=0.0, allow_inf_nan=False)]
_STRICT = ConfigDict(extra="forbid", strict=True)


def _needed(requirement: str, about: str, **limits: Any) -> Any:
    return Field(description=requirement, title=about, **limits)


def _optional(requirement: str, about: str, **limits: Any) -> Any:
    return Field(default=None, description=requirement, title=about, **limits)


class TaskTable(BaseModel):
    """The whole file. The tables in it are checked on their own."""

    model_config = _STRICT

    robot: str = _needed(
        "the name of a robot, or of a robot file (.toml)", "the robot as it is known"
    )
    parameters: dict[str, Any] = _needed(
        "a table of paths, each with a table of start, low, high, prior, or a start",
        "what is sought; sections and cables count from 1",
    )
    poses: list[dict[str, Any]] = _optional(
        "tables [[poses]] with file", "poses of the robot at rest"
    )
    motions: list[dict[str, Any]] = _optional("tables [[motions]] with file", "motions in time")
    frequencies: list[dict[str, Any]] = _optional(
        "tables [[frequencies]] with frequency or damping_ratio, and command", "vibrations"
    )
    loss: Literal["linear", "soft_l1", "huber", "cauchy"] = _optional(
        '"linear", "soft_l1", "huber" or "cauchy"',
        "how residuals count; the last three bear outliers",
    )
    starts: int = _optional("a whole number > 0", "searches, from that many starts", gt=0)
    seed: int = _optional("a whole number >= 0", "of the starts that are drawn", ge=0)
    folds: int = _optional("a whole number > 1", "parts of the data for cross-validation", gt=1)


class MeasuredTable(BaseModel):
    """What tables [[poses]] and [[motions]] have in common."""

    model_config = _STRICT

    file: str = _needed("the name of a CSV file", "what was measured")
    name: str = _optional("a string", "for tables; by default the file's")
    columns: dict[str, str] = _optional(
        'a table of names with units, as "tip x [mm]", to columns of the file',
        "columns that have other names; the file's other columns are ignored then",
    )
    every: int = _optional("a whole number > 0", "one row of so many is taken", gt=0)
    command: list[_Finite] = _optional(
        "an array with a number for each cable", "commands, where the file has none"
    )
    pulled: bool = _optional(
        "true or false", "whether cables driven by length are told what they are pulled by"
    )
    markers: list[list[float]] = _optional(
        "an array of pairs, a section from 1 and a fraction of its length", "where markers sit"
    )
    noise: _Positive | dict[str, _Positive] = _optional(
        "a number > 0, or a table of channels", "standard deviation of one number"
    )
    gaps: Literal["refuse", "skip"] = _optional(
        '"refuse" or "skip"', "what to do about cells that are empty"
    )


class PosesTable(MeasuredTable):
    """A table [[poses]]."""

    history: bool = _optional(
        "true or false",
        "whether the poses follow one another, so that friction remembers the way",
    )


class MotionTable(MeasuredTable):
    """A table [[motions]]."""

    start: list[_Finite] = _optional(
        "an array with a number for each cable",
        "commands under which the robot rests before; by default the first",
    )
    interpolation: Literal["linear", "previous"] = _optional(
        '"linear" or "previous"', "of the commands between the times"
    )
    method: Literal["auto", "bdf", "adams", "dopri5", "dop853", "rk4", "rosenbrock"] = _optional(
        '"auto", "bdf", "adams", "dopri5", "dop853", "rk4" or "rosenbrock"',
        "of the integrator",
    )
    rtol: _Positive = _optional("a number > 0 [1]", "relative tolerance of a step")
    step: _Positive = _optional("a number > 0 [s]", "step of rk4 and rosenbrock")


class FrequenciesTable(BaseModel):
    """A table [[frequencies]]."""

    model_config = _STRICT

    frequency: list[_Positive] = _optional("an array of numbers > 0 [Hz]", "natural frequencies")
    damping_ratio: list[_Positive] = _optional("an array of numbers > 0 [1]", "of the same")
    command: list[_Finite] = _needed(
        "an array with a number for each cable", "what they were told meanwhile"
    )
    mode: list[Annotated[int, Field(ge=1)]] = _optional(
        "an array of whole numbers > 0", "which vibrations of the model these are, from 1"
    )
    noise: _Positive | dict[str, _Positive] = _optional(
        "a number > 0, or a table of channels", "standard deviation of one number"
    )
    name: str = _optional("a string", "for tables")
