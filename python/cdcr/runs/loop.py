"""Closed loops in C++: robot, actuators, sensors and controller, each at its own period."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, one_of, require_kind
from cdcr.base.keywords import by_keyword
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench
from cdcr.robot.units import ask_about_commands
from cdcr.runs.trajectory import Trajectory

SensorKind = Literal["coordinates", "rates", "lengths", "tensions", "tip", "curvature"]
KINDS: tuple[SensorKind, ...] = (
    *("coordinates", "rates", "lengths"),
    *("tensions", "tip", "curvature"),
)


def _numbers(given: dict[str, Any]) -> dict[str, float]:
    """Return the values as floats, or refuse what is no number."""
    check = Check()
    found = {name: check.number(name, value, "a number") for name, value in given.items()}
    check.done()
    return found


def _several(item: str, given: object, kind: type) -> tuple[Any, ...]:
    """Return one thing or a sequence of them as a tuple, or refuse what is of another kind."""
    if isinstance(given, kind):
        return (given,)
    check = Check()
    found = check.items(item, given, f"a cdcr.{kind.__name__} or a sequence of them")
    check.done()
    for i, one in enumerate(found):
        require_kind(f"{item}[{i}]", one, kind)
    return found


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Winch:
    """A motor with a gear and a drum, whose position loop lets out the length asked for.

    Critically damped, without an integral: under a tension F it gives way by F over its mass times
    bandwidth^2, where that mass is inertia (gear/drum_radius)^2.

    Parameters
    ----------
    drum_radius : float
        > 0 [m].
    inertia : float
        Of the motor, > 0 [kg m^2].
    bandwidth : float
        Of the position loop, > 0 [rad/s].
    gear : float, optional
        Turns of the motor for one of the drum, > 0 [1].
    max_torque, max_speed : float, optional
        Of the motor, > 0 [N m], [rad/s].

    Examples
    --------
    >>> import cdcr
    >>> winch = cdcr.Winch(drum_radius=0.01, gear=20.0, inertia=1e-6, bandwidth=100.0)
    >>> cdcr.Actuator(winch=winch).winch.gear
    20.0
    """

    drum_radius: float
    inertia: float
    bandwidth: float
    gear: float = 1.0
    max_torque: float = math.inf
    max_speed: float = math.inf

    def __post_init__(self) -> None:
        """Refuse what is no number; ranges are looked at where a loop is made."""
        _numbers(asdict(self))


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Actuator:
    """What stands between a command and its cable; each part is absent unless it is given.

    Parameters
    ----------
    time_constant : float, optional
        Of a first-order lag, >= 0 [s].
    dead_time : float, optional
        A whole number of steps of the loop, >= 0 [s].
    max_rate : float, optional
        Of what the cable gets, > 0 [N/s], [m/s].
    min_command, max_command : float, optional
        0 <= min_command <= max_command [N], [m].
    resolution : float, optional
        Commands are rounded to multiples of it, >= 0 [N], [m].
    winch : Winch, optional
        In place of lag and rate, of a cable driven by length.

    Examples
    --------
    >>> import cdcr
    >>> cdcr.Actuator(time_constant=0.02, max_rate=200.0).time_constant
    0.02
    """

    time_constant: float = 0.0
    dead_time: float = 0.0
    max_rate: float = math.inf
    min_command: float = 0.0
    max_command: float = math.inf
    resolution: float = 0.0
    winch: Winch | None = None

    def __post_init__(self) -> None:
        """Refuse what is of another kind; ranges are looked at where a loop is made."""
        given = dict(self.__dict__)
        if given.pop("winch") is not None:
            require_kind("winch", self.winch, Winch)
        _numbers(given)


@by_keyword
@dataclass(frozen=True, kw_only=True)
class Sensor:
    """Something measured, each period: value + bias + noise, and told after a delay.

    The controller is told what sensors of "coordinates" and "rates" say; without one it knows them
    exactly. The others are for `Loop.measurements`, controllers and estimators of your own.

    Parameters
    ----------
    kind : str
        "coordinates" [rad], "rates" [rad/s], "lengths" of the cables in the robot [m], "tensions"
        at the base [N], "tip", its position in the base frame [m], or "curvature" of the backbone
        at places, in the x and y of its frame [1/m].
    period, delay : float, optional
        Whole numbers of steps of the loop [s]; 0: each step, at once.
    noise : float, optional
        Standard deviation of each value, normal and white, in the unit of the kind.
    bias : float, optional
        Added to each value.
    places : sequence of (int, float), optional
        Of curvature: indices of sections, and fractions of their lengths.
    seed : int, optional
        Of the noise, >= 0.

    Examples
    --------
    >>> import cdcr
    >>> cdcr.Sensor(kind="coordinates", noise=1e-3, delay=2e-3).kind
    'coordinates'
    """

    kind: SensorKind
    period: float = 0.0
    delay: float = 0.0
    noise: float = 0.0
    bias: float = 0.0
    places: Sequence[tuple[int, float]] = ()
    seed: int = 1

    def __post_init__(self) -> None:
        """Refuse what is of another kind; ranges are looked at where a loop is made."""
        if not one_of(self.kind, KINDS):
            known = ", ".join(map(repr, KINDS))
            raise ValueError(f"kind must be one of {known}, got {self.kind!r}")
        _numbers({name: getattr(self, name) for name in ("period", "delay", "noise", "bias")})
        check = Check()
        check.whole("seed", self.seed, "a whole number >= 0", low=0, high=2**63 - 1)
        for i, place in enumerate(check.items("places", self.places, "a sequence of places")):
            pair = check.items(f"places[{i}]", place, "an index of a section and a fraction")
            if len(pair) != 2:
                check.refuse(f"places[{i}]", "an index of a section and a fraction", place)
                continue
            check.whole(f"the section of places[{i}]", pair[0], "an index of a section")
            check.number(f"the fraction of places[{i}]", pair[1], "a number 0 to 1")
        check.done()


@dataclass(frozen=True, eq=False, repr=False)
class LoopRun:
    """A run of a closed loop, sampled.

    Parameters
    ----------
    trajectory : Trajectory
        The motion; its command is what the cables got.
    asked : (N, num_cables) array
        What the controller asked for [N], [m].
    told_q, told_qd : (N, d) array
        The state that it was told [rad], [rad/s].
    measurements : tuple of (N, m) array
        What each sensor told [of its kind].
    durations : (N,) array
        Of the controller's last update, by the clock [s].

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> loop = cdcr.Loop(model, cdcr.ComputedTorque(model))
    >>> loop.reset([0.1, 0.0], [0.0, 0.0])
    >>> loop.run(0.1, record_every=10)
    <LoopRun: 11 samples, t = 0 to 0.1 s, status ok>
    """

    trajectory: Trajectory
    asked: FloatArray
    told_q: FloatArray
    told_qd: FloatArray
    measurements: tuple[FloatArray, ...]
    durations: FloatArray

    def __repr__(self) -> str:
        """Say what a person wants to know first."""
        run = self.trajectory
        end = f": {run.message}" if run.message else ""
        return (
            f"<LoopRun: {len(run)} samples, t = {run.t[0]:g} to {run.t[-1]:g} s, "
            f"status {run.status.name}{end}>"
        )


@by_keyword
class Loop(_core.Loop):
    """A closed loop in C++: the robot, its actuators and sensors and a controller.

    In a step of the plant sensors measure, the controller is asked where its time has come,
    actuators move, and the robot moves under what they give. The same loop gives the same bits.
    After a failure the last good state stays until `reset`. With controllers of the package no
    Python runs inside; one written in Python is called each period, which is slower.

    Parameters
    ----------
    model : Model
        The robot.
    controller : Controller
        Its period is a whole number of steps.
    step : float, optional
        Of the plant [s].
    substeps : int, optional
        Runge-Kutta steps in each.
    actuators : Actuator or sequence of Actuator, optional
        One for all cables, or one for each.
    sensors : Sensor or sequence of Sensor, optional
        What is measured.

    Raises
    ------
    ValueError
        For what is out of its range, periods and delays that are no whole numbers of steps, and a
        controller made for a robot of other sizes.
    TypeError
        For a model or a controller that is none.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> controller = cdcr.ComputedTorque(model, kp=64.0, kd=16.0, min_tension=0.5)
    >>> controller.reference = [0.3, 0.1]
    >>> loop = cdcr.Loop(
    ...     model,
    ...     controller,
    ...     actuators=cdcr.Actuator(time_constant=2e-3),
    ...     sensors=cdcr.Sensor(kind="coordinates", noise=1e-4),
    ... )
    >>> loop.reset([0.0, 0.0], [0.0, 0.0])
    >>> run = loop.run(3.0, record_every=10)
    >>> bool(abs(run.trajectory.q[-1] - [0.3, 0.1]).max() < 1e-3)
    True
    """

    def __init__(
        self,
        model: Model,
        controller: _core.Controller,
        *,
        step: float = 1e-3,
        substeps: int = 1,
        actuators: Actuator | Sequence[Actuator] = (),
        sensors: Sensor | Sequence[Sensor] = (),
    ) -> None:
        require_kind("model", model, Model)
        require_kind("controller", controller, _core.Controller)
        check = Check()
        options: dict[str, Any] = {
            "step": check.number("step", step, "a number"),
            "substeps": check.whole("substeps", substeps, "a whole number >= 1"),
        }
        check.done()
        drives = _several("actuators", actuators, Actuator)
        looks = _several("sensors", sensors, Sensor)
        options["actuators"] = [asdict(one) for one in drives]
        options["sensors"] = [asdict(one) | {"places": list(one.places)} for one in looks]
        super().__init__(model, controller, options)

    def run(
        self,
        duration: float,
        *,
        record_every: int = 1,
        wrenches: Wrench | Sequence[Wrench] = (),
        throw: bool = False,
    ) -> LoopRun:
        """Step over a duration and sample.

        Parameters
        ----------
        duration : float
            A whole number of steps [s].
        record_every : int, optional
            Steps between samples; the first is the state now.
        wrenches : Wrench or sequence of Wrench, optional
            Constant forces and moments on the robot.
        throw : bool, optional
            Raise RuntimeError with the message when the run fails.

        Returns
        -------
        LoopRun
            What holds over the step that begins at a sample stands in its row; in the last row,
            of which no step begins, what held before.

        Raises
        ------
        ValueError
            For an argument out of its range, or a loop without a state or that has ended.
        """
        check = Check()
        duration = check.number("duration", duration, "a number")
        every = check.whole("record_every", record_every, "a whole number >= 1")
        check.done()
        found = self._sampled(duration, every, wrenches)
        names = ("t", "q", "qd", "tension", "command", "status", "message", "stats")
        run = Trajectory(model=self.model, method="rk4", **{name: found[name] for name in names})
        ask_about_commands(self.model.robot, found["asked"])
        if throw and not run.success:
            raise RuntimeError(run.message)
        told = found["told_q"], found["told_qd"], tuple(found["told"])
        return LoopRun(run, found["asked"], *told, found["durations"])
