"""Parameters of a robot by path, and the models beside it that derivatives are made of."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields
from typing import Any

from cdcr import _core
from cdcr.base.check import is_iterable, short
from cdcr.robot.cable import Cable
from cdcr.robot.numbers import Place, find, paths, refuse_unknown
from cdcr.robot.plain import core_robot, plain_robot
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

_KEPT = 8  # sets of parameters that a model remembers
# Sizes that matter of numbers that may be zero or negative, by unit; lengths are told by the robot.
_TYPICAL = {"kg": 0.01, "N/m": 1e3, "m/s^2": 1.0}


class ParameterSets:
    """Sets of parameters of one model, made once each."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._known: dict[tuple[str, ...], _core.ParameterSet] = {}

    def find(
        self, model: _core.Model, asked: str | Sequence[str], besides: Sequence[str] = ()
    ) -> _core.ParameterSet:
        """Return the set of these paths of the model; a refusal knows what there is besides.

        Raises
        ------
        ValueError
            For a path that leads to no number of the robot, or to one that may not change a bit.
        TypeError
            For what is no path.
        """
        one: Any = asked  # of any kind, as users may give
        names = tuple(one) if is_iterable(one) and not isinstance(one, str) else (one,)
        for name in names:
            if not isinstance(name, str):
                must = "paths, such as 'sections.1.youngs_modulus'"
                raise TypeError(f"parameters must be {must}, got {short(name)}")
        found = self._known.get(names)
        if found is None:
            found = _core.ParameterSet(model, [self._described(name, besides) for name in names])
            self._known[names] = found
            for old in list(self._known)[:-_KEPT]:  # another thread may have left it out already
                self._known.pop(old, None)
        return found

    def _described(
        self, path: str, besides: Sequence[str]
    ) -> tuple[str, float, float, Callable[[float], _core.Robot]]:
        """Return a parameter as the core takes it: how much is added to all numbers of a path."""
        table = plain_robot(self._robot)
        places = find(table, path)
        if not places:
            refuse_unknown(path, [*besides, *paths(table)])
        values = [thing[key] for thing, key in places]
        if any(isinstance(value, int) for value in values):
            raise ValueError(f"parameter {path!r} is a whole number, which has no derivative")
        value = values[0]

        def robot_at(other: float) -> _core.Robot:
            for (thing, key), before in zip(places, values, strict=True):
                thing[key] = before + (other - value)
            return core_robot(table)

        return path, value, self._size(path, places[0], min(map(abs, values))), robot_at

    def _size(self, path: str, place: Place, least: float) -> float:
        """Return a size that matters of a number; its own where it must be above zero."""
        words = path.split(".")
        kind: type[Any] = {"sections": Section, "cables": Cable}.get(words[0], Robot)
        about = {item.name: item.metadata for item in fields(kind)}
        word = next(word for word in reversed(words) if word in about)
        item = about[word]
        if "number > 0" in f"{item['requirement']} {item['each']}" and least > 0.0:
            return float(least)
        unit = item["unit"]
        typical = 0.02 * self._robot.length if unit == "m" else _TYPICAL.get(unit, 1.0)
        return float(max(least, typical))
