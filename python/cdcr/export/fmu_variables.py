"""The variables of an FMU, in the order of their value references."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

import numpy as np

from cdcr.model.model import Model


class Variable(NamedTuple):
    """A variable; its value reference is its place in the list."""

    name: str
    causality: str
    unit: str
    description: str
    start: float | None = None  # of parameters and inputs
    state: str = ""  # of which it is the derivative
    depends_on: tuple[str, ...] = ()  # inputs and states, of outputs and derivatives


def variables(model: Model) -> list[Variable]:
    """Return the variables of a robot; bindings/fmu/variables.hpp has the same order."""
    return list(_variables(model))


def _variables(model: Model) -> Iterator[Variable]:
    d = model.num_coordinates
    q, qd, qdd = (_names(name, d) for name in ("q", "qd", "qdd"))
    names = model.coordinate_names
    units = ["m" if name.startswith("e") else "rad" for name in names]
    commands = [
        f"{'length' if cable.length_driven else 'tension'}[{j + 1}]"
        for j, cable in enumerate(model.robot.all_cables)
    ]

    yield Variable("time", "independent", "s", "simulated time")
    for k in range(3):
        about = f"gravity in the base frame, {'xyz'[k]}"
        start = model.robot.gravity[k]
        yield Variable(f"gravity[{k + 1}]", "parameter", "m/s2", about, start)
    for i in range(d):
        about = f"coordinate {names[i]} at the start"
        yield Variable(f"q_start[{i + 1}]", "parameter", units[i], about, 0.0)
    for i in range(d):
        about = f"rate of {names[i]} at the start"
        yield Variable(f"qd_start[{i + 1}]", "parameter", f"{units[i]}/s", about, 0.0)
    yield from _inputs(model, commands)
    for i in range(d):
        yield Variable(q[i], "output", units[i], f"coordinate {names[i]}", depends_on=(q[i],))
    for i in range(d):
        about = f"rate of {names[i]}"
        yield Variable(qd[i], "output", f"{units[i]}/s", about, state=q[i], depends_on=(qd[i],))
    for i in range(d):
        about, on = f"acceleration of {names[i]}", (*q, *qd, *commands)
        yield Variable(qdd[i], "local", f"{units[i]}/s2", about, state=qd[i], depends_on=on)
    yield from _tip(q)
    for name in _names("cable_length", model.num_cables):
        yield Variable(name, "output", "m", "length inside the robot", depends_on=q)
    for command, name in zip(commands, _names("cable_tension", model.num_cables), strict=True):
        on = (*q, *qd, command) if command.startswith("length") else (command,)
        yield Variable(name, "output", "N", "tension at the base", depends_on=on)


def _names(name: str, count: int) -> tuple[str, ...]:
    return tuple(f"{name}[{i + 1}]" for i in range(count))


def _inputs(model: Model, commands: Sequence[str]) -> Iterator[Variable]:
    straight = model.cable_lengths(np.zeros(model.num_coordinates))
    for j, cable in enumerate(model.robot.all_cables):
        to = f"cable {j + 1}, on section {cable.end_section + 1}"
        if cable.length_driven:
            yield Variable(commands[j], "input", "m", f"length of {to}", float(straight[j]))
        else:
            yield Variable(commands[j], "input", "N", f"tension of {to}", 0.0)


def _tip(q: tuple[str, ...]) -> Iterator[Variable]:
    for k in range(3):
        about = f"in the base frame, {'xyz'[k]}"
        yield Variable(f"tip.position[{k + 1}]", "output", "m", about, depends_on=q)
    for i, j in product((1, 2, 3), repeat=2):
        about = "rotation matrix from the tip frame to the base frame"
        yield Variable(f"tip.orientation[{i},{j}]", "output", "1", about, depends_on=q)
