"""What the tables of controllers and closed loops in a scenario file may hold."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel

from cdcr.runs.parts import KINDS, SensorKind
from cdcr.scenarios.file.schema import STRICT, Finite, needed, optional


def _positive(requirement: str, about: str) -> Any:
    return optional(requirement, about, gt=0.0, allow_inf_nan=False)


class _ControllerTable(BaseModel):
    """What the [controller] tables of all types have in common."""

    model_config = STRICT

    period: float = _positive("a number > 0 [s]", "between updates; commands are held")
    min_tension: float = optional(
        "a number [N], or -inf for no limit", "least tension of every cable"
    )
    max_tension: float = optional(
        "a number [N], or inf for no limit", "largest tension of every cable"
    )
    max_rate: float = optional(
        "a number > 0 [N/s], [m/s]", "largest rate of a command of a cable", gt=0.0
    )
    pretension: list[Finite] = optional(
        "an array with a number [N] for each cable", "least tension of each cable"
    )
    cables: list[int] = optional(
        "an array with numbers of cables, from 1",
        "cables that may be used; all by default",
        min_length=1,
    )
    motion: dict[str, Any] = optional(
        "a table with shape", "a motion to follow, in place of a reference to hold"
    )


class _OnCoordinates(_ControllerTable):
    reference: dict[str, Any] = optional(
        "a table with q, or theta and phi", "what to reach and hold; straight by default"
    )


class ControllerTable(_OnCoordinates):
    """The [controller] table of type "pid"."""

    type: Literal["pid"] = needed('"pid"', "kind of controller")
    kp: float = needed("a number >= 0 [N m/rad]", "proportional gain", ge=0.0, allow_inf_nan=False)
    ki: float = optional(
        "a number >= 0 [N m/(rad s)]", "integral gain", ge=0.0, allow_inf_nan=False
    )
    kd: float = optional(
        "a number >= 0 [N m s/rad]", "gain of the rate", ge=0.0, allow_inf_nan=False
    )
    feed_forward: bool = optional(
        "true or false", "whether the force that holds the reference still is added"
    )
    anti_windup: bool = optional(
        "true or false", "whether integration stops where the limits cannot give more"
    )
    filter: float = optional(
        "a number >= 0 [s]",
        "time constant of the derivative, then of the measured coordinates",
        ge=0.0,
        allow_inf_nan=False,
    )


class ComputedTorqueTable(_OnCoordinates):
    """The [controller] table of type "computed-torque"."""

    type: Literal["computed-torque"] = needed('"computed-torque"', "kind of controller")
    kp: float = optional(
        "a number >= 0 [1/s^2]", "square of a natural frequency", ge=0.0, allow_inf_nan=False
    )
    kd: float = optional(
        "a number >= 0 [1/s]",
        "twice a damping ratio times that frequency",
        ge=0.0,
        allow_inf_nan=False,
    )
    lead: float = optional(
        "a number >= 0 [s]", "how far ahead it reckons; half a period", ge=0.0, allow_inf_nan=False
    )
    delay: float = optional(
        "a number >= 0 [s]", "how old measurements are", ge=0.0, allow_inf_nan=False
    )


class LqrTable(_OnCoordinates):
    """The [controller] table of type "lqr": `cdcr.control.lqr` at the start of its reference."""

    type: Literal["lqr"] = needed('"lqr"', "kind of controller")
    state_weight: float = needed(
        "a number > 0 [1/rad^2]", "weight of the coordinates", gt=0.0, allow_inf_nan=False
    )
    rate_weight: float = needed(
        "a number >= 0 [s^2/rad^2]", "weight of their rates", ge=0.0, allow_inf_nan=False
    )
    command_weight: float = needed(
        "a number > 0 [1/N^2], [1/m^2]", "weight of the commands", gt=0.0, allow_inf_nan=False
    )


class TaskSpaceTable(_ControllerTable):
    """The [controller] table of type "task-space", which moves the tip."""

    type: Literal["task-space"] = needed('"task-space"', "kind of controller")
    kp: float = optional(
        "a number >= 0 [1/s^2]", "gain of the tip's error", ge=0.0, allow_inf_nan=False
    )
    kd: float = optional("a number >= 0 [1/s]", "gain of its rate", ge=0.0, allow_inf_nan=False)
    lead: float = optional(
        "a number >= 0 [s]", "how far ahead it reckons; half a period", ge=0.0, allow_inf_nan=False
    )
    delay: float = optional(
        "a number >= 0 [s]", "how old measurements are", ge=0.0, allow_inf_nan=False
    )
    damping: float = _positive("a number > 0 [1/rad]", "of the inverse, over the robot's length")
    posture: list[Finite] = optional(
        "an array with two numbers [rad] for each section", "coordinates to be near to"
    )
    posture_kp: float = optional(
        "a number >= 0 [1/s^2]", "gain of the posture", ge=0.0, allow_inf_nan=False
    )
    posture_kd: float = optional(
        "a number >= 0 [1/s]", "gain of its rate", ge=0.0, allow_inf_nan=False
    )
    tip: list[Finite] = optional(
        "three numbers [m], or six, with a rotation vector [rad], of orientation_weight",
        "position or pose to reach and hold, in the base frame",
        min_length=3,
        max_length=6,
    )
    orientation_weight: float | list[float] = optional(
        "a number >= 0 [m/rad], or three of the axes of the tip",
        "what a radian is worth in metres; without it the tip turns as it likes",
    )


class _RoundMotion(BaseModel):
    model_config = STRICT

    center: list[Finite] = needed("an array of numbers [rad], [m]", "what it goes round")
    x: list[Finite] = needed("an array of numbers [rad], [m]", "from there to where it begins")
    y: list[Finite] = needed("an array of numbers [rad], [m]", "to where it is a quarter later")
    turns: float = needed("a number", "how often it goes round", allow_inf_nan=False)
    duration: float = needed("a number > 0 [s]", "of all turns", gt=0.0, allow_inf_nan=False)
    rest_to_rest: bool = optional(
        "true or false", "whether it begins and ends at rest, by minimum jerk; true by default"
    )
    start: float = optional("a number [s]", "when it begins", allow_inf_nan=False)


class CircleMotion(_RoundMotion):
    """The [controller.motion] table of shape "circle"."""

    shape: Literal["circle"] = needed('"circle"', "kind of motion")


class HelixMotion(_RoundMotion):
    """The [controller.motion] table of shape "helix"."""

    shape: Literal["helix"] = needed('"helix"', "kind of motion")
    climb: list[Finite] = needed("an array of numbers [rad], [m]", "by how much it moves in a turn")


class PolygonMotion(BaseModel):
    """The [controller.motion] table of shape "polygon"."""

    model_config = STRICT

    shape: Literal["polygon"] = needed('"polygon"', "kind of motion")
    corners: list[list[Finite]] = needed(
        "an array of corners [rad], [m]", "at rest in each, along lines", min_length=2
    )
    duration: float = needed("a number > 0 [s]", "of all of it", gt=0.0, allow_inf_nan=False)
    start: float = optional("a number [s]", "when it begins", allow_inf_nan=False)


class SplineMotion(BaseModel):
    """The [controller.motion] table of shape "spline"."""

    model_config = STRICT

    shape: Literal["spline"] = needed('"spline"', "kind of motion")
    t: list[Finite] = needed("an array of increasing times [s]", "of the points", min_length=2)
    points: list[list[Finite]] = needed(
        "an array of points [rad], [m], one for each time",
        "the smoothest way through them, from rest to rest",
        min_length=2,
    )


class FileMotion(BaseModel):
    """The [controller.motion] table of shape "file"."""

    model_config = STRICT

    shape: Literal["file"] = needed('"file"', "kind of motion")
    file: str = needed(
        "the name of a CSV file with the columns t, then the names of the coordinates, or x, y, z "
        "of the tip, and rx, ry, rz where it is turned",
        "points that it goes through, from rest to rest; found from the folder of this file",
    )


class WinchTable(BaseModel):
    """The table winch of an actuator."""

    model_config = STRICT

    drum_radius: float = needed("a number > 0 [m]", "radius of the drum", gt=0.0)
    inertia: float = needed("a number > 0 [kg m^2]", "of the motor", gt=0.0)
    bandwidth: float = needed("a number > 0 [rad/s]", "of its position loop", gt=0.0)
    gear: float = _positive("a number > 0", "turns of the motor for one of the drum")
    max_torque: float = _positive("a number > 0 [N m]", "of the motor")
    max_speed: float = _positive("a number > 0 [rad/s]", "of the motor")


class ActuatorTable(BaseModel):
    """One table [[loop.actuators]], for all cables or for each."""

    model_config = STRICT

    time_constant: float = optional("a number >= 0 [s]", "of a first-order lag", ge=0.0)
    dead_time: float = optional("a number >= 0 [s]", "a whole number of steps", ge=0.0)
    max_rate: float = optional("a number > 0 [N/s], [m/s]", "of what the cable gets", gt=0.0)
    min_command: float = optional("a number >= 0 [N], [m]", "least command", ge=0.0)
    max_command: float = optional("a number >= 0 [N], [m]", "largest command", ge=0.0)
    resolution: float = optional(
        "a number >= 0 [N], [m]", "commands are multiples of it", ge=0.0, allow_inf_nan=False
    )
    winch: dict[str, Any] = optional(
        "a table with drum_radius, inertia, bandwidth", "of a cable driven by length"
    )


_SEVERAL = '", "'.join(KINDS[:-1])


class SensorTable(BaseModel):
    """One table [[loop.sensors]]."""

    model_config = STRICT

    kind: SensorKind = needed(f'"{_SEVERAL}" or "{KINDS[-1]}"', "what it measures")
    period: float = optional("a number >= 0 [s]", "a whole number of steps", ge=0.0)
    delay: float = optional("a number >= 0 [s]", "a whole number of steps", ge=0.0)
    noise: float = optional("a number >= 0", "standard deviation", ge=0.0, allow_inf_nan=False)
    bias: float = optional("a number", "added to each value", allow_inf_nan=False)
    seed: int = optional("a whole number >= 0", "of the noise", ge=0)
    places: list[list[float]] = optional(
        "an array of pairs: the number of a section, from 1, and a fraction of its length",
        "of curvature",
        min_length=1,
    )


class LoopTable(BaseModel):
    """The [loop] table: a controller in a loop of fixed steps, with actuators and sensors."""

    model_config = STRICT

    step: float = _positive("a number > 0 [s]", "of the robot; all periods are multiples of it")
    substeps: int = optional("a whole number > 0", "equal steps of the method in each", gt=0)
    method: Literal["rk4", "rosenbrock"] = optional(
        '"rk4" or "rosenbrock"', "explicit, or linearly implicit, which is stable whatever the step"
    )
    actuators: list[dict[str, Any]] = optional(
        "tables [[loop.actuators]]", "one for all cables, or one for each", min_length=1
    )
    sensors: list[dict[str, Any]] = optional(
        "tables [[loop.sensors]] with kind",
        "without one of coordinates or of rates these are known exactly",
        min_length=1,
    )
    estimator: dict[str, Any] = optional(
        "a table with type", "makes a state of what sensors tell, which the controller is told"
    )


# Tables of [controller] and [controller.motion] by their type and shape.
CONTROLLERS: dict[str, type[BaseModel]] = {
    "pid": ControllerTable,
    "computed-torque": ComputedTorqueTable,
    "lqr": LqrTable,
    "task-space": TaskSpaceTable,
}
MOTIONS: dict[str, type[BaseModel]] = {
    "circle": CircleMotion,
    "helix": HelixMotion,
    "polygon": PolygonMotion,
    "spline": SplineMotion,
    "file": FileMotion,
}
