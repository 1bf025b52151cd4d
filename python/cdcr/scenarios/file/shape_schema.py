"""What the shapes of scenario files may hold: of tensions and of trajectories."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, Field, create_model

from cdcr.scenarios.file.schema import STRICT, Finite, optional

_Values = Finite | list[Finite]
_COMMAND = "a number [N], or [m] for a cable driven by length"
_Rows = list[Finite] | list[list[Finite]]


def _number(requirement: str, **limits: Any) -> Any:
    return Field(allow_inf_nan=False, description=requirement, **limits)


class TensionShape(BaseModel):
    """What all [[tension]] tables have."""

    model_config = STRICT

    cable: int = Field(ge=1, description="the number of a cable, from 1")
    shape: str = Field(description='"step", "ramp", "pulse" or "sine"')


class StepTable(TensionShape):
    """Zero, then a value."""

    value: float = _number(_COMMAND)
    at: float = _number("a number [s]", default=0.0)


class PulseTable(TensionShape):
    """A value for some time."""

    value: float = _number(_COMMAND)
    start: float = _number("a number [s]")
    end: float = _number("a number [s], later than start")
    base: float = _number(_COMMAND, default=0.0)


class SineTable(TensionShape):
    """A sine about a mean."""

    mean: float = _number(_COMMAND)
    amplitude: float = _number(_COMMAND.replace("number", "number >= 0"), ge=0.0)
    frequency: float = _number("a number > 0 [Hz]", gt=0.0)
    phase: float = optional("a number [rad]", allow_inf_nan=False)
    phase_deg: float = optional("a number [deg]", allow_inf_nan=False)
    start: float = _number("a number [s]", default=0.0)


# A class body cannot have a field called `from`.
RampTable: type[BaseModel] = create_model(
    "RampTable",
    __base__=TensionShape,
    **{
        "from": (float, _number(_COMMAND, default=0.0)),
        "to": (float, _number(_COMMAND)),
        "start": (float, _number("a number [s]", default=0.0)),
        "end": (float, _number("a number [s], later than start")),
    },  # type: ignore[call-overload]
)

TENSION_SHAPES: dict[str, type[BaseModel]] = {
    "step": StepTable,
    "ramp": RampTable,
    "pulse": PulseTable,
    "sine": SineTable,
}


def _of_sections(unit: str) -> Any:
    return optional(f"a number [{unit}], or an array with one for each section")


class _Tracking(BaseModel):
    """What all [trajectory] tables may have."""

    model_config = STRICT

    min_tension: float = optional("a number >= 0 [N]", ge=0.0, allow_inf_nan=False)
    max_tension: float = optional("a number > 0 [N], or inf for no limit", gt=0.0)
    infeasible: Literal["raise", "nearest"] = optional('"raise" or "nearest"')
    simulate: bool = optional("true or false")
    shorter: float = optional("a number [m]", allow_inf_nan=False)
    step: float = optional("a number > 0 [s]", gt=0.0, allow_inf_nan=False)


class _Direction(_Tracking):
    shape: str = Field(description='"circle", "line", "swing" or "move"')
    phi: _Values = _of_sections("rad")
    phi_deg: _Values = _of_sections("deg")


class CircleTable(_Direction):
    """A fixed bending angle that goes round; phi is where it starts."""

    theta: _Values = _of_sections("rad")
    theta_deg: _Values = _of_sections("deg")
    turns_per_second: _Values = Field(
        description="a number [1/s], or an array with one for each section"
    )


class LineTable(_Direction):
    """A bending angle that grows evenly; theta is where it starts."""

    theta: _Values = _of_sections("rad")
    theta_deg: _Values = _of_sections("deg")
    theta_rate: _Values = _of_sections("rad/s")
    theta_rate_deg: _Values = _of_sections("deg/s")


class SwingTable(_Direction):
    """A bending angle that swings as a sine through straight."""

    amplitude: _Values = _of_sections("rad")
    amplitude_deg: _Values = _of_sections("deg")
    frequency: float = _number("a number > 0 [Hz]", gt=0.0)


class MoveTable(_Direction):
    """From straight to theta and phi, from rest to rest, holding them after or until `back`."""

    theta: _Values = _of_sections("rad")
    theta_deg: _Values = _of_sections("deg")
    start: float = _number("a number [s]", default=0.0)
    duration: float = _number("a number > 0 [s]", gt=0.0)
    back: float = optional("a number [s], not before the end of the move", allow_inf_nan=False)


TRAJECTORY_SHAPES: dict[str, type[BaseModel]] = {
    "circle": CircleTable,
    "line": LineTable,
    "swing": SwingTable,
    "move": MoveTable,
}


def _samples(unit: str) -> Any:
    return optional(f"an array with a number [{unit}] for each time, or a row of them")


class TrajectorySamples(_Tracking):
    """A [trajectory] with its samples in the file."""

    t: list[Finite] = Field(description="an array of increasing times [s]")
    q: list[list[Finite]] = optional("an array with one row [rad] for each time")
    theta: _Rows = _samples("rad")
    theta_deg: _Rows = _samples("deg")
    phi: _Rows = _samples("rad")
    phi_deg: _Rows = _samples("deg")


class TrajectoryFile(_Tracking):
    """A [trajectory] that names a CSV file."""

    file: str = Field(
        description="the name of a CSV file with the columns t, theta_deg 1, phi_deg 1, ... "
        "or t, theta 1, phi 1, ... or t, q 1 x, q 1 y, ..."
    )
