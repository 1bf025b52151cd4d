"""A robot as it stands in a laboratory: described, mounted, commanded and measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

Place = tuple[int, float]  # section and fraction of its length
Plain = dict[str, Any]  # lists and tables in one another, as a file would have them

# What a measurement has that a robot has not, with the value that changes nothing.
MOUNTING = {"base_tilt": (0.0, 0.0), "base_yaw": 0.0, "time_shift": 0.0}


@dataclass(frozen=True)
class Setup:
    """A robot in its laboratory.

    Attributes
    ----------
    robot : Robot
        The robot, mounted as it is: what was found of its base stands in its base orientation.
    command_offset : (num_cables,) tuple
        What is added to each command [N], [m].
    command_gain : (num_cables,) tuple
        By which each command is multiplied first; of a pull, what is pulled.
    places : tuple of (int, float)
        Section and fraction of its length of each marker.
    marker_offset : tuple of (3,) tuples
        Where each marker sits in the frame of its place on the backbone [m].
    time_shift : float
        By which the clock of the measurement is ahead of that of the commands [s].
    """

    robot: Robot
    command_offset: tuple[float, ...]
    command_gain: tuple[float, ...]
    places: tuple[Place, ...] = ()
    marker_offset: tuple[tuple[float, float, float], ...] = ()
    time_shift: float = 0.0

    @cached_property
    def model(self) -> Model:
        """The robot, ready for computing."""
        return Model(self.robot)

    @cached_property
    def length_driven(self) -> FloatArray:
        """Whether each cable is driven by length (num_cables,)."""
        return np.array([cable.length_driven for cable in self.robot.all_cables], dtype=bool)

    def commands(self, command: FloatArray, *, pulled: bool) -> FloatArray:
        """Return what arrives at the cables (..., num_cables) [N], [m].

        A pull is how far a cable driven by length is pulled from where the robot is straight. No
        cable pushes, however its offset is.
        """
        told = np.array(self.command_gain) * command
        if pulled:
            told = np.where(self.length_driven, self.model.rest_command() - told, told)
        arrived: FloatArray = np.maximum(told + np.array(self.command_offset), 0.0)
        return arrived

    def marker(self, q: FloatArray, place: Place) -> FloatArray:
        """Return where a marker is (..., 3) [m]."""
        rotation, position = self.model.pose(q, *place)
        offset = self.marker_offset[self.places.index(place)]
        there: FloatArray = position + rotation @ np.array(offset)
        return there


def plain_setup(robot: Robot, places: tuple[Place, ...] = ()) -> Plain:
    """Return a robot and its laboratory as lists and tables, whose entries may be set."""
    cables = robot.num_cables
    plain: Plain = _table(robot) | MOUNTING
    plain["sections"] = [_table(section) for section in robot.sections]
    plain["cables"] = [_table(cable) for cable in robot.cables]
    plain |= {"command_offset": [0.0] * cables, "command_gain": [1.0] * cables}
    plain |= {"places": list(places), "marker_offset": [[0.0] * 3 for _ in places]}
    return {key: _lists(value) for key, value in plain.items()}


def copy_plain(value: Any) -> Any:
    """Return a copy of lists and tables, and of those in them."""
    if isinstance(value, dict):
        return {key: copy_plain(one) for key, one in value.items()}
    return [copy_plain(one) for one in value] if isinstance(value, list) else value


def setup_of(plain: Plain, like: Setup | None = None) -> Setup:
    """Return the laboratory that lists and tables describe; the robot of `like` where it is equal.

    Making a robot and its model is what costs: commands and markers need none.

    Raises
    ------
    ValueError
        For numbers that no robot has.
    """
    rest = {name: plain[name] for name in plain if name not in MOUNTING}
    laboratory = {
        "command_offset": tuple(rest.pop("command_offset")),
        "command_gain": tuple(rest.pop("command_gain")),
        "places": tuple(map(tuple, rest.pop("places"))),
        "marker_offset": tuple(map(tuple, rest.pop("marker_offset"))),
        "time_shift": plain["time_shift"],
    }
    turn = _rotation(plain["base_tilt"], plain["base_yaw"])
    if turn is not None:
        rest["base_orientation"] = np.array(rest["base_orientation"]) @ turn
    rest["sections"] = [Section(**one) for one in rest["sections"]]
    rest["cables"] = [Cable(**one) for one in rest["cables"]]
    robot = Robot(**rest)
    if like is not None and like.robot == robot:
        setup = replace(like, **laboratory)
        setup.__dict__.update(model=like.model, length_driven=like.length_driven)
        return setup
    return Setup(robot, **laboratory)


def _rotation(tilt: list[float], yaw: float) -> FloatArray | None:
    """Return the turn of a base: tilted about its own X and Y, then turned about its axis."""
    if not (any(tilt) or yaw):
        return None
    return rotation((tilt[0], tilt[1], 0.0)) @ rotation((0.0, 0.0, yaw))


def rotation(vector: tuple[float, float, float]) -> FloatArray:
    """Return the rotation matrix of a rotation vector [rad], by Rodrigues' formula."""
    angle = float(np.linalg.norm(vector))
    x, y, z = vector
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    s = np.sinc(angle / np.pi)
    c = 0.5 * np.sinc(0.5 * angle / np.pi) ** 2
    turned: FloatArray = np.eye(3) + s * cross + c * (cross @ cross)
    return turned


def _table(thing: Robot | Section | Cable) -> Plain:
    return {item.name: getattr(thing, item.name) for item in fields(thing)}


def _lists(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _lists(one) for key, one in value.items()}
    return [_lists(one) for one in value] if isinstance(value, tuple | list) else value
