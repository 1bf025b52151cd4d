"""What files of a closed loop's run tell beside the motion, by topic."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from cdcr.base.arrays import FloatArray, read_only
from cdcr.model.model import Model
from cdcr.runs.export import Quantity, by_length, dims_and_units

Channels = dict[str, tuple[Quantity, ...]]


def loop_channels(
    model: Model, found: Mapping[str, Any], estimated: Sequence[str] | None
) -> Channels:
    """Return the channels of what the core gave, named as the columns of `LoopLog` in C++.

    `estimated` are the names of what the estimator tells beside the state, None without one.
    """
    commands = "N or m" if by_length(model) else "N"
    channels = {
        "tension": (
            _quantity("asked", ("cable",), commands, "asked by controller", found["asked"]),
        ),
        "estimate": (
            _state(model, "told_q", "coordinate that the controller is told", found["told_q"]),
            _state(model, "told_qd", "rate that the controller is told", found["told_qd"]),
            *_estimates(found, estimated),
        ),
        "reference": _reference(model, found["reference_names"], found["reference"]),
        "sensors": tuple(
            _quantity(f"sensor{i}_{k}", (), "SI", "told by a sensor", values)
            for i, told in enumerate(found["told"], start=1)
            for k, values in enumerate(told.T, start=1)
        ),
        "timing": (
            _quantity("duration", (), "s", "of the controller's update", found["durations"]),
        ),
    }
    return {topic: items for topic, items in channels.items() if items}


def _quantity(
    name: str, dims: tuple[str, ...], units: str, about: str, values: FloatArray
) -> Quantity:
    return Quantity(name, dims, units, about, read_only(values.view()))


def _state(model: Model, name: str, about: str, values: FloatArray) -> Quantity:
    dims, units = dims_and_units(model, "qd" if name.endswith("qd") else "q")
    shape = (len(values), -1, 2) if len(dims) == 2 else values.shape
    return _quantity(name, dims, units, about, values.reshape(shape))


def _reference(model: Model, names: Sequence[str], values: FloatArray) -> tuple[Quantity, ...]:
    about = "followed by the controller"
    if list(names) == list(model.coordinate_names):
        return (_state(model, "reference_q", about, values),)
    return tuple(
        _quantity(f"reference_{name}", (), "m" if name[:3] == "tip" else "rad", about, column)
        for name, column in zip(names, values.T, strict=True)
    )


def _estimates(found: Mapping[str, Any], names: Sequence[str] | None) -> list[Quantity]:
    if names is None:
        return []
    more = [
        _quantity(f"{kind}_{name}", (), "SI", about, values)
        for kind, about, table in (
            ("estimated", "estimate", found["estimated"]),
            ("deviation", "standard deviation of the estimate", found["deviations"]),
        )
        for name, values in zip(names, table.T, strict=True)
    ]
    return [
        *more,
        _quantity("innovation", (), "1", "of the estimator's update", found["innovation"]),
        _quantity("measured", (), "1", "values in the innovation", found["measured"]),
    ]
