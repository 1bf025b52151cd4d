"""What stands between a controller and the robot in a loop: actuators and sensors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any, Literal, get_args

from cdcr.base.check import Check, one_of, require_kind, short
from cdcr.base.keywords import by_keyword

SensorKind = Literal[
    "coordinates",
    "rates",
    "lengths",
    "tensions",
    "tip",
    "orientation",
    "curvature",
    "base_force",
    "base_moment",
]
KINDS: tuple[SensorKind, ...] = get_args(SensorKind)


def as_dicts(name: str, given: object, kind: type[Any]) -> list[dict[str, Any]]:
    """Return one or several parts of a loop as the core takes them."""
    if isinstance(given, kind):
        return [asdict(given)]
    check = Check()
    parts = check.items(name, given, f"a cdcr.{kind.__name__} or a sequence of them")
    check.done()
    for i, part in enumerate(parts):
        require_kind(f"{name}[{i}]", part, kind)
    return [asdict(part) for part in parts]


def _numbers(given: dict[str, Any]) -> dict[str, float]:
    """Return the values as floats, or refuse what is no number."""
    check = Check()
    found = {name: check.number(name, value, "a number") for name, value in given.items()}
    check.done()
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

    Without an estimator the controller is told what sensors of "coordinates" and "rates" say, and
    without one knows them exactly. The others are for estimators, and for `Loop.measurements`.

    Parameters
    ----------
    kind : str
        "coordinates" [rad], "rates" [rad/s], "lengths" of the cables in the robot [m], "tensions"
        at the base [N], "tip", its position in the base frame [m], "orientation" of the tip in the
        base frame, a rotation vector [rad], "curvature" of the backbone at places, in the x and y
        of its frame [1/m], or "base_force" [N] and "base_moment" [N m] of the robot on its base, as
        `Model.base_wrench` has them.
    period, delay : float, optional
        Whole numbers of steps of the loop [s]; 0: each step, at once.
    noise : float, optional
        Standard deviation of each value, normal and white, in the unit of the kind.
    bias : float, optional
        Added to each value. Noise and bias of an orientation turn it about its own axes.
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
            raise ValueError(f"kind must be one of {known}, got {short(self.kind)}")
        _numbers({name: getattr(self, name) for name in ("period", "delay", "noise", "bias")})
        check = Check()
        check.whole("seed", self.seed, "a whole number >= 0", low=0, high=2**63 - 1)
        for i, place in enumerate(check.items("places", self.places, "a sequence of places")):
            before = len(check.sentences)
            pair = check.items(f"places[{i}]", place, "an index of a section and a fraction")
            if len(pair) != 2:
                if len(check.sentences) == before:
                    check.refuse(f"places[{i}]", "an index of a section and a fraction", place)
                continue
            check.whole(f"the section of places[{i}]", pair[0], "an index of a section")
            check.number(f"the fraction of places[{i}]", pair[1], "a number 0 to 1")
        check.done()


def read_place(check: Check, place: tuple[int, float] | None) -> tuple[int, float] | None:
    """Return the place of a force, or refuse what is none by `check`."""
    if place is None:
        return None
    pair = check.items("force_at", place, "an index of a section and a fraction of its length")
    if len(pair) != 2:
        check.refuse("force_at", "an index of a section and a fraction of its length", place)
        return None
    section = check.whole("the section of force_at", pair[0], "an index of a section")
    return section, check.number("the fraction of force_at", pair[1], "a number 0 to 1")
