"""What every kind of measurement has: a name, channels, and answers of the model beside them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, format_value
from cdcr.identification.channels import (
    Channel,
    Where,
    ask_about_cables,
    ask_about_places,
    ask_about_shapes,
    measured,
    noise_levels,
)
from cdcr.identification.loads import Wrenches, check_wrenches, under
from cdcr.identification.setup import Place, Setup
from cdcr.model.memory import remembers
from cdcr.model.model import Model

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot

Noise = Mapping[str, float] | float | None
MEASURED = {  # what may be measured beside markers, and its unit
    "tip": "m", "tension": "N", "length": "m", "q": "rad", "base_force": "N", "base_moment": "N m",
}  # fmt: skip
_OF_AXES = ("tip", "base_force", "base_moment")


class UnsolvedError(Exception):
    """The model has no answer at these values."""


@dataclass(frozen=True)
class Side:
    """A laboratory on either side of another, where one unknown differs.

    Attributes
    ----------
    above, below : Setup
    step : float
        From the middle to the one above.
    width : float
        From the one below, which may be the middle itself, to the one above.
    """

    above: Setup
    below: Setup
    step: float
    width: float

    @property
    def shares(self) -> tuple[float, float]:
        """Where those above and below are, counted from the middle in widths."""
        return self.step / self.width, self.step / self.width - 1.0


class Data(ABC):
    """Measurements of one kind, with what was asked of the robot meanwhile."""

    name: str
    channels: tuple[Channel, ...]
    source: Mapping[str, Any] = {}  # where they came from, for the record

    @property
    @abstractmethod
    def places(self) -> tuple[Place, ...]:
        """Section and fraction of each marker."""

    @abstractmethod
    def _check(self, robot: Robot) -> None:
        """Refuse what does not fit a robot."""

    @abstractmethod
    def _solve(self, setup: Setup, near: Any) -> Any:
        """Return the states of the model, sought near others, or raise UnsolvedError."""

    @abstractmethod
    def _answers(self, setup: Setup, state: Any) -> list[FloatArray]:
        """Return what the model says, an array for each channel."""

    @abstractmethod
    def _slopes(self, setup: Setup, state: Any, sides: Sequence[Side]) -> list[FloatArray]:
        """Return the derivatives of the answers, (N, k, len(sides)) for each channel."""

    @abstractmethod
    def _rows(self, chosen: FloatArray) -> Data:
        """Return the same with some rows alone measured; what was asked of the robot stays."""

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.channels[0].values)


def require_data(item: str, value: object, more: str = "") -> None:
    """Refuse what is no measurement."""
    if not isinstance(value, Data):
        raise TypeError(
            f"{item} must be Poses, a Motion or Frequencies{more}, got {type(value).__name__}"
        )


def measured_in(data: Any, rows: NDArray[np.bool_]) -> dict[str, Any]:
    """Return everything measured of poses or of a motion, as gaps where not in these rows."""

    def part(value: ArrayLike | None) -> FloatArray | None:
        if value is None:
            return None
        array: FloatArray = np.where(rows[:, None], np.asarray(value, float), np.nan)
        return array

    given: dict[str, Any] = {name: part(getattr(data, name)) for name in MEASURED}
    given["markers"] = {place: part(one) for place, one in (data.markers or {}).items()}
    return given | {"gaps": "skip"}


def channels_of(
    given: Mapping[str, ArrayLike | None],
    markers: Mapping[Place, ArrayLike],
    rows: int,
    noise: Noise,
    where: Where,
    *,
    gaps: bool,
) -> tuple[Channel, ...]:
    """Return the channels of poses or of a motion that were measured, or refuse them."""
    found: list[tuple[str, str, FloatArray]] = []
    for name, value in given.items():
        if value is None:
            continue
        wide = 3 if name in _OF_AXES else None
        array = measured(name, value, (rows, wide), where, gaps=gaps)
        found.append((name, MEASURED[name], array))
    for i, value in enumerate(markers.values()):
        array = measured(f"marker {i + 1}", value, (rows, 3), where, gaps=gaps)
        found.append((f"marker {i + 1}", "m", array))
    names = [name for name, _, _ in found]
    if not names:
        raise ValueError(f"nothing was measured: give one of {', '.join(given)} or markers")
    levels = noise_levels(noise, names)
    return tuple(Channel(name, unit, values, levels.get(name)) for name, unit, values in found)


def check_channels(
    data: Data,
    command: FloatArray,
    robot: Robot,
    where: Where,
    wrenches: Wrenches,
    over_time: bool = False,
) -> None:
    """Refuse columns, places and loads that the robot has not, and numbers that ask for a unit."""
    check_wrenches(wrenches, robot, over_time)
    for section, fraction in data.places:
        if not (0 <= section < len(robot.sections) and 0.0 <= fraction <= 1.0):
            raise ValueError(
                f"a marker's place must be a section from 0 to {len(robot.sections) - 1} and a "
                f"fraction from 0 to 1, got ({section}, {fraction:g})"
            )
    sizes = {"tension": robot.num_cables, "length": robot.num_cables}
    sizes["q"] = Model(robot).num_coordinates
    for channel in data.channels:
        size = sizes.get(channel.name, 3)
        if channel.values.shape[1] != size:
            raise ValueError(
                f"{channel.name} must have shape ({len(channel.values)}, {size}), got "
                f"{channel.values.shape}"
            )
        if channel.unit == "m" and size == 3:
            ask_about_places(channel.values, robot, where, channel.name)
        elif channel.name == "q":
            ask_about_shapes(channel.values, robot, where)
        elif channel.name in sizes:
            ask_about_cables(channel, command, robot, where)


def answers_of(
    setup: Setup,
    channels: Sequence[Channel],
    places: Sequence[Place],
    q: FloatArray,
    command: FloatArray,
    tension: FloatArray | None = None,
    qd: FloatArray | None = None,
    wrenches: Wrenches = (),
    times: FloatArray | None = None,
) -> list[FloatArray]:
    """Return what channels of poses or of a motion would show at shapes q (N, 2n).

    Without rates and the times of the shapes [s] the robot is at rest.
    """
    model = setup.model
    found: list[FloatArray] = []
    on_base: FloatArray | None = None
    for channel in channels:
        if channel.name == "tip":
            found.append(model.tips(q))
        elif channel.name == "q":
            found.append(q)
        elif channel.name == "length":
            found.append(model.cable_lengths(q))
        elif channel.name == "tension":
            still = np.zeros_like(q)
            found.append(model.cable_tensions(q, still, command) if tension is None else tension)
        elif channel.name in ("base_force", "base_moment"):
            if on_base is None:
                on_base = _on_base(model, q, qd, command, wrenches, times)
            found.append(on_base[:, :3] if channel.name == "base_force" else on_base[:, 3:])
        else:
            place = places[int(channel.name.rpartition(" ")[2]) - 1]
            found.append(setup.marker(q, place))
    return found


def _on_base(
    model: Model,
    q: FloatArray,
    qd: FloatArray | None,
    command: FloatArray,
    wrenches: Wrenches,
    times: FloatArray | None,
) -> FloatArray:
    """Return force and moment of the robot on its base (N, 6) [N], [N m]."""
    if qd is None or times is None:
        return model.base_wrench(q, np.zeros_like(q), np.zeros_like(q), wrenches)
    if remembers(model):
        raise UnsolvedError(
            "what a moving robot does to its base is not known where friction or play remembers: "
            "presliding_stiffness and backlash must be 0"
        )
    qdd = under(model.forward_dynamics, (q, qd, command), wrenches, times)
    return under(model.base_wrench, (q, qd, qdd), wrenches, times)


def markers_of(markers: Mapping[Place, ArrayLike] | None) -> dict[Place, ArrayLike]:
    """Return markers by place, or refuse what is no place."""
    if markers is None:
        return {}
    table: object = markers
    if not isinstance(table, Mapping):
        raise ValueError(
            "markers must be a table from (section, fraction) to positions, got "
            f"{format_value(markers)}"
        )
    places: list[object] = list(markers)
    for place in places:
        if not (isinstance(place, tuple) and len(place) == 2):
            raise ValueError(
                f"a marker's place must be (section, fraction), got {format_value(place)}"
            )
        check = Check()
        check.whole("section of a marker's place", place[0], "a whole number")
        check.number("fraction of a marker's place", place[1], "a number")
        check.done()
    return dict(markers)
