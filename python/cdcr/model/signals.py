"""Signals of a robot as a system of python-control: their names, values and derivatives."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import format_value, known_name

if TYPE_CHECKING:
    from cdcr.model.model import Model


class Output(NamedTuple):
    """What a system may give out: names, values, and derivatives with respect to q and qd."""

    names: Callable[[Model], list[str]]
    values: Callable[[Model, FloatArray, FloatArray], FloatArray]
    derivative: Callable[[Model, FloatArray], FloatArray]  # (k, 2d)


def rate_names(model: Model) -> list[str]:
    """Return the names of the rates: qd1_x of q1_x, td1 of t1."""
    return [f"{name[0]}d{name[1:]}" for name in model.coordinate_names]


def _of_shape(derivative: FloatArray) -> FloatArray:
    """Return a derivative (k, 2d) of what does not depend on qd, from that (k, d) by q."""
    return np.hstack([derivative, np.zeros_like(derivative)])


_OUTPUTS = {
    "q": Output(
        lambda model: list(model.coordinate_names),
        lambda model, q, qd: q,
        lambda model, q: np.eye(len(q), 2 * len(q)),
    ),
    "qd": Output(
        rate_names,
        lambda model, q, qd: qd,
        lambda model, q: np.eye(len(q), 2 * len(q), len(q)),
    ),
    "tip": Output(
        lambda model: [f"tip_{axis}" for axis in "xyz"],
        lambda model, q, qd: model.tip(q)[1],
        lambda model, q: _of_shape(model.tip_jacobian(q)[:3]),
    ),
    "lengths": Output(
        lambda model: [f"length{j + 1}" for j in range(model.num_cables)],
        lambda model, q, qd: model.cable_lengths(q),
        lambda model, q: _of_shape(-model.actuation_matrix(q).T),
    ),
}


def state_names(model: Model) -> list[str]:
    """Return the names of the 2d states: q1_x, q1_y, ..., then qd1_x, qd1_y, ..."""
    return _OUTPUTS["q"].names(model) + _OUTPUTS["qd"].names(model)


def input_names(model: Model) -> list[str]:
    """Return the names of the inputs: tension1, ..., or command1 of a cable driven by length."""
    cables = model.robot.all_cables
    return [
        f"{'command' if cable.length_driven else 'tension'}{j + 1}"
        for j, cable in enumerate(cables)
    ]


def find_outputs(outputs: str | Sequence[str]) -> list[Output]:
    """Return the outputs of these names, or refuse one that is none."""
    names: object = [outputs] if isinstance(outputs, str) else outputs
    if not (isinstance(names, Sequence) and names):
        raise ValueError(f"outputs must be names of outputs, got {format_value(outputs)}")
    found = [known_name("output", name, tuple(_OUTPUTS)) for name in names]
    if len(set(found)) < len(found):
        raise ValueError(f"outputs must differ from each other, got {format_value(outputs)}")
    return [_OUTPUTS[name] for name in found]
