"""What the shapes of scenario files may hold: of tensions and of trajectories."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, Field, create_model

from cdcr.scenarios.file.schema import STRICT, Finite, needed, optional

_Values = Finite | list[Finite]
_COMMAND = "a number [N], or [m] for a cable driven by length"
_Rows = list[Finite] | list[list[Finite]]


def _number(requirement: str, about: str, **limits: Any) -> Any:
    return Field(allow_inf_nan=False, description=requirement, title=about, **limits)


class TensionShape(BaseModel):
    """What all [[tension]] tables have."""

    model_config = STRICT

    cable: int = needed("the number of a cable, from 1", "cable that it pulls", ge=1)
    shape: str = needed('"step", "ramp", "pulse" or "sine"', "kind of change")


class StepTable(TensionShape):
    """Zero, then a value."""

    value: float = _number(_COMMAND, "from the step on")
    at: float = _number("a number [s]", "time of the step", default=0.0)


class PulseTable(TensionShape):
    """A value for some time."""

    value: float = _number(_COMMAND, "during the pulse")
    start: float = _number("a number [s]", "start of the pulse")
    end: float = _number("a number [s], later than start", "end of the pulse")
    base: float = _number(_COMMAND, "before and after", default=0.0)


class SineTable(TensionShape):
    """A sine about a mean."""

    mean: float = _number(_COMMAND, "mean, also before the start")
    amplitude: float = _number(
        _COMMAND.replace("number", "number >= 0"), "amplitude of the sine", ge=0.0
    )
    frequency: float = _number("a number > 0 [Hz]", "frequency of the sine", gt=0.0)
    phase: float = optional("a number [rad]", "phase at the start", allow_inf_nan=False)
    phase_deg: float = optional("a number [deg]", "phase at the start", allow_inf_nan=False)
    start: float = _number("a number [s]", "start of the sine", default=0.0)


# A class body cannot have a field called `from`.
RampTable: type[BaseModel] = create_model(
    "RampTable",
    __base__=TensionShape,
    **{
        "from": (float, _number(_COMMAND, "before the ramp", default=0.0)),
        "to": (float, _number(_COMMAND, "after the ramp")),
        "start": (float, _number("a number [s]", "start of the ramp", default=0.0)),
        "end": (float, _number("a number [s], later than start", "end of the ramp")),
    },  # type: ignore[call-overload]
)

TENSION_SHAPES: dict[str, type[BaseModel]] = {
    "step": StepTable,
    "ramp": RampTable,
    "pulse": PulseTable,
    "sine": SineTable,
}


def _of_sections(unit: str, about: str) -> Any:
    return optional(f"a number [{unit}], or an array with one for each section", about)


class _Tracking(BaseModel):
    """What all [trajectory] tables may have."""

    model_config = STRICT

    min_tension: float = optional(
        "a number >= 0 [N]",
        "least tension of every cable; above 0 keeps them taut",
        ge=0.0,
        allow_inf_nan=False,
    )
    max_tension: float = optional(
        "a number > 0 [N], or inf for no limit", "largest tension of every cable", gt=0.0
    )
    infeasible: Literal["raise", "nearest"] = optional(
        '"raise" or "nearest"', "what to do where the limits are too narrow"
    )
    simulate: bool = optional(
        "true or false", "whether the robot moves under the tensions found, open loop"
    )
    shorter: float = optional(
        "a number [m]",
        "how much shorter than the straight robot's all cables are wound, for pretension",
        allow_inf_nan=False,
    )
    step: float = optional(
        "a number > 0 [s]",
        "time between the tensions found; exact without it",
        gt=0.0,
        allow_inf_nan=False,
    )


class _Direction(_Tracking):
    shape: str = needed('"circle", "line", "swing" or "move"', "kind of motion")
    phi: _Values = _of_sections("rad", "orientation angle, at the start")
    phi_deg: _Values = _of_sections("deg", "orientation angle, at the start")


class CircleTable(_Direction):
    """A fixed bending angle that goes round; phi is where it starts."""

    theta: _Values = _of_sections("rad", "bending angle")
    theta_deg: _Values = _of_sections("deg", "bending angle")
    turns_per_second: _Values = needed(
        "a number [1/s], or an array with one for each section",
        "how fast the orientation goes round; negative is clockwise",
    )


class LineTable(_Direction):
    """A bending angle that grows evenly; theta is where it starts."""

    theta: _Values = _of_sections("rad", "bending angle at the start")
    theta_deg: _Values = _of_sections("deg", "bending angle at the start")
    theta_rate: _Values = _of_sections("rad/s", "rate of the bending angle")
    theta_rate_deg: _Values = _of_sections("deg/s", "rate of the bending angle")


class SwingTable(_Direction):
    """A bending angle that swings as a sine through straight."""

    amplitude: _Values = _of_sections("rad", "amplitude of the bending angle")
    amplitude_deg: _Values = _of_sections("deg", "amplitude of the bending angle")
    frequency: float = _number("a number > 0 [Hz]", "frequency of the swing", gt=0.0)


class MoveTable(_Direction):
    """From straight to theta and phi, from rest to rest, holding them after or until `back`."""

    theta: _Values = _of_sections("rad", "bending angle to reach")
    theta_deg: _Values = _of_sections("deg", "bending angle to reach")
    start: float = _number("a number [s]", "start of the move", default=0.0)
    duration: float = _number("a number > 0 [s]", "how long the move takes", gt=0.0)
    back: float = optional(
        "a number [s], not before the end of the move",
        "when it goes back to straight",
        allow_inf_nan=False,
    )


TRAJECTORY_SHAPES: dict[str, type[BaseModel]] = {
    "circle": CircleTable,
    "line": LineTable,
    "swing": SwingTable,
    "move": MoveTable,
}


def _samples(unit: str, about: str) -> Any:
    return optional(f"an array with a number [{unit}] for each time, or a row of them", about)


class TrajectorySamples(_Tracking):
    """A [trajectory] with its samples in the file."""

    t: list[Finite] = needed("an array of increasing times [s]", "times of the samples")
    q: list[list[Finite]] = optional(
        "an array with one row [rad] for each time", "bending vectors theta (cos phi, sin phi)"
    )
    theta: _Rows = _samples("rad", "bending angles")
    theta_deg: _Rows = _samples("deg", "bending angles")
    phi: _Rows = _samples("rad", "orientation angles")
    phi_deg: _Rows = _samples("deg", "orientation angles")


class TrajectoryFile(_Tracking):
    """A [trajectory] that names a CSV file."""

    file: str = needed(
        "the name of a CSV file with the columns t, theta_deg 1, phi_deg 1, ... "
        "or t, theta 1, phi 1, ... or t, q 1 x, q 1 y, ...",
        "file of the samples, found from the folder of this one",
    )
