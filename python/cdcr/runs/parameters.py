"""Robots that differ from one in a few numbers, without describing each in Python."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite, read_only
from cdcr.base.check import short
from cdcr.model.model import Model
from cdcr.robot.cable import Cable
from cdcr.robot.numbers import Place, find, paths, put, refuse_shared, refuse_unknown
from cdcr.robot.plain import core_robot, plain_robot
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section


class Variation:
    """A model, and others whose robots have other numbers at some paths.

    Parameters
    ----------
    model : Model
        The one.
    parameters : mapping of str to (N,) array_like
        By path, as `cdcr.sweep` names them: ``sections.1.youngs_modulus``, ``payload``,
        ``gravity.z``.

    Raises
    ------
    ValueError
        For a path that leads to no number of the robot, and arrays that do not fit together.
    """

    def __init__(self, model: Model, parameters: Mapping[str, ArrayLike]) -> None:
        self.model = model
        self.values: dict[str, FloatArray] = {}
        if not isinstance(parameters, Mapping):
            got = type(parameters).__name__
            raise TypeError(f"parameters must be a mapping of paths to arrays, got {got}")
        table = plain_robot(model.robot)
        found: dict[str, list[Place]] = {}
        for path, given in parameters.items():
            if not isinstance(path, str):
                must = "paths, such as 'sections.1.youngs_modulus'"
                raise TypeError(f"parameters must be {must}, got {short(path)}")
            places = find(table, path)
            if not places:
                refuse_unknown(path, list(paths(table)))
            values = np.array(finite(given, f"parameters[{path!r}]"))
            if values.ndim != 1:
                raise ValueError(f"parameters[{path!r}] must have shape (N,), got {values.shape}")
            if any(isinstance(thing[key], int) for thing, key in places):
                _refuse_fractions(path, values)
            self.values[path] = read_only(values)
            found[path] = places
        refuse_shared(found)
        sizes = {path: len(values) for path, values in self.values.items()}
        if len(set(sizes.values())) > 1:
            told = ", ".join(f"{size} of {path}" for path, size in sizes.items())
            raise ValueError(f"parameters must have as many values of each, got {told}")

    def spread(self, motions: int) -> dict[str, FloatArray]:
        """Return the values of so many motions, where one value may stand for all of them."""
        return {path: np.broadcast_to(one, (motions,)) for path, one in self.values.items()}

    def __len__(self) -> int:
        """Return the number of robots."""
        return len(next(iter(self.values.values()), ()))

    def models(self) -> list[_core.Model]:
        """Return the models, as the core has them; tables that can be shared are.

        Raises
        ------
        ValueError
            For numbers that are out of range, naming the motion.
        """
        table = plain_robot(self.model.robot)
        found = [(find(table, path), values) for path, values in self.values.items()]
        models = []
        for i in range(len(self)):
            for there, values in found:
                put(there, values[i])
            try:
                models.append(_core.Model(core_robot(table), self.model))
            except ValueError as error:
                raise ValueError(f"motion {i + 1}: {error}") from None
        return models

    def model_of(self, motion: int) -> Model:
        """Return the model of one motion, with its robot."""
        table = plain_robot(self.model.robot)
        for path, values in self.values.items():
            put(find(table, path), values[motion])
        table["sections"] = [Section(**one) for one in table["sections"]]
        table["cables"] = [Cable(**one) for one in table["cables"]]
        return Model(Robot(**table), self.model.formulation)


def _refuse_fractions(path: str, values: FloatArray) -> None:
    """Refuse values that are not whole for a number that is, such as how many disks there are."""
    odd = values[values != np.round(values)]
    if odd.size:
        raise ValueError(f"parameters[{path!r}] must be whole numbers, got {odd[0]:g}")
