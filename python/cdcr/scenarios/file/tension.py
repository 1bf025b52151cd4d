"""The tension of scenario files: constant, over time in place or in a CSV file, or shapes.

Shapes of the robot are held by the least tensions that do: [tension.hold]. Shapes over time add up:
[[tension]], exact at all times, or [[tension.shapes]], sampled every `step`, and where they jump or
bend, and joined by lines.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from cdcr.base.arrays import FloatArray, check_step, even_times
from cdcr.base.check import count
from cdcr.files.refusals import named_by
from cdcr.files.toml import format_toml, refuse, schema_errors
from cdcr.model.model import Model
from cdcr.motion.inverse import where
from cdcr.robot.file import doubled
from cdcr.runs.command import Interpolation, TensionTable, command_input
from cdcr.scenarios.file import values
from cdcr.scenarios.file.shapes import Shape, TensionShapes, constant, pulse, ramp, sine, step
from cdcr.scenarios.file.start import carrying
from cdcr.scenarios.file.trajectory import shape_errors

SHAPES: dict[str, Callable[..., Shape]] = {
    "step": step,
    "ramp": ramp,
    "pulse": pulse,
    "sine": sine,
}


@dataclass(frozen=True, eq=False)
class Hold:
    """Commands under which the robot is at rest in given shapes, with least tensions.

    Parameters
    ----------
    t : (N,) array
        Times [s]; one alone holds for ever.
    q : (N, d) array
        Coordinates at those times.
    payload : float
        Mass at the tip, beside that of the robot [kg].
    interpolation : {"linear", "previous"}
        Of the commands between the times.
    where : str
        What a refusal begins with.
    """

    t: FloatArray
    q: FloatArray
    payload: float
    interpolation: Interpolation
    where: str

    def commands(self, model: Model) -> FloatArray:
        """Return the commands (N, num_cables) at the times [N], [m] of cables driven by length."""
        loaded, still = carrying(model, self.payload), np.zeros(model.num_coordinates)
        with values.error_prefix(self.where):
            return np.array(
                [
                    loaded.commands(q, loaded.allocate(force, q=where(loaded, q)))
                    for q in self.q
                    for force in [loaded.inverse_dynamics(q, still, still)]
                ]
            )

    def __call__(self, model: Model, t_end: float) -> TensionTable:
        """Return the commands over time."""
        return TensionTable(self.t, self.commands(model), self.interpolation)


Sampled: TypeAlias = Callable[[Model, float], TensionTable]


def read_tension(
    value: Any, model: Model, t_end: float, file: Path
) -> tuple[float, ...] | TensionTable | TensionShapes | Sampled:
    """Return the tensions of a scenario file; `value` is None where it has none."""
    if isinstance(value, dict):
        if "hold" in value:
            return _hold(value, model, file)
        if "shapes" in value:
            return _sampled(value, model, t_end, file)
        return _over_time(value, model, file)
    if value and isinstance(value[0], dict):
        shapes = _shapes(value, model, file, "tension")
        with values.error_prefix(f"{file}, [[tension]]"):
            values.refuse_function(
                model, "write [[tension.shapes]], and [tension] with step, which samples them"
            )
        return shapes
    num_cables = model.num_cables
    tension = model.rest_command() if value is None else value
    if len(tension) != num_cables:
        requirement = f"tension must have {count(num_cables, 'number')}, one for each cable"
        refuse(str(file), [f"{requirement}, got {format_toml(value)}"])
    return tuple(map(float, tension))


def _over_time(table: dict[str, Any], model: Model, file: Path) -> TensionTable:
    from cdcr.scenarios.file.schema import TensionFile, TensionRows

    if "shape" in table:
        refuse(str(file), ["a table with shape must be written [[tension]], one for each shape"])
    refuse(
        str(file), schema_errors(TensionFile if "file" in table else TensionRows, table, "tension")
    )
    interpolation = table.get("interpolation", "linear")
    if "file" in table:
        named = file.parent / table["file"]
        where = f"{file}, tension.file: {named}"
        with named_by(f"{file}, tension.file"):
            tension = TensionTable.load(named, model, interpolation=interpolation)
    else:
        where = f"{file}, [tension]"
        t, rows = table["t"], table["rows"]
        refuse(where, _row_errors(t, rows, model.num_cables))
        with values.error_prefix(where):
            tension = TensionTable(t, rows, interpolation)
    with values.error_prefix(where):
        command_input(model, tension)
    return tension


def _row_errors(t: list[float], rows: list[list[float]], num_cables: int) -> list[str]:
    if len(rows) != len(t):
        return [f"rows must be as many as t, {len(t)}, got {len(rows)}"]
    must = f"must have {count(num_cables, 'number')}, one for each cable"
    return [
        f"rows[{i}] {must}, got {len(row)}" for i, row in enumerate(rows) if len(row) != num_cables
    ]


def _hold(table: dict[str, Any], model: Model, file: Path) -> Hold:
    from cdcr.scenarios.file.schema import HoldTable, TensionHold

    at, hold = "tension.hold", table["hold"]
    refuse(str(file), schema_errors(TensionHold, table, "tension"))
    refuse(str(file), [*schema_errors(HoldTable, hold, at), *values.rival_errors(hold, at)])
    t = table.get("t", [0.0])
    given = {key: value for key, value in hold.items() if key != "payload"}
    rows = given if "t" in table else {key: [value] for key, value in given.items()}
    for key, value in rows.items():
        if len(value) != len(t) or not all(isinstance(row, list) for row in value):
            must = f"must have a row for each time, {len(t)}"
            refuse(str(file), [f"{at}.{key} {must}, got {format_toml(value)}"])
    q = []
    for k in range(len(t)):
        shape = {key: value[k] for key, value in rows.items()}
        refuse(str(file), values.length_errors(shape, model, at))
        with values.error_prefix(str(file)):
            q.append(values.coordinates(shape, model, at))
    times, payload = np.array(t), hold.get("payload", 0.0)
    held = Hold(times, np.array(q), payload, table.get("interpolation", "linear"), f"{file}, {at}")
    commands = held(model, float(times[-1]))
    with values.error_prefix(f"{file}, [tension]"):
        command_input(model, commands)
    return held


def _sampled(table: dict[str, Any], model: Model, t_end: float, file: Path) -> Sampled:
    from cdcr.scenarios.file.schema import TensionSampled

    refuse(str(file), schema_errors(TensionSampled, table, "tension"))
    shapes = _shapes(table["shapes"], model, file, "tension.shapes")
    with values.error_prefix(f"{file}, [tension]"):
        check_step(t_end, table["step"])

    def rows(model: Model, t_end: float) -> TensionTable:
        with values.error_prefix(f"{file}, [tension]"):
            t = even_times(t_end, table["step"])
        return shapes.table(t)

    return rows


def _shapes(tables: list[dict[str, Any]], model: Model, file: Path, name: str) -> TensionShapes:
    from cdcr.scenarios.file.shape_schema import TENSION_SHAPES

    found: list[str] = []
    for i, table in enumerate(tables):
        at = f"{name}[{i}]"
        wrong = shape_errors(TENSION_SHAPES, table, at)
        if not wrong and table["cable"] > model.num_cables:
            requirement = f"the number of a cable, 1 to {model.num_cables}"
            wrong.append(f"{at}.cable must be {requirement}, got {table['cable']}")
        found += wrong + doubled(table, at, "phase")
    refuse(str(file), found)
    shapes = []
    for i, table in enumerate(tables):
        with values.error_prefix(f"{file}: {name}[{i}]"):
            shapes.append((table["cable"] - 1, _shape(table)))
    given = {cable for cable, _ in shapes}
    rest = enumerate(model.rest_command())
    shapes += [(j, constant(value=value)) for j, value in rest if j not in given]
    with values.error_prefix(f"{file}, [[{name}]]"):
        return TensionShapes(model.num_cables, shapes)


def _shape(table: dict[str, Any]) -> Shape:
    given = {key: value for key, value in table.items() if key not in ("cable", "shape")}
    if table["shape"] == "ramp":
        given["before"], given["after"] = given.pop("from", 0.0), given.pop("to")
    if "phase_deg" in given:
        given["phase"] = math.radians(given.pop("phase_deg"))
    return SHAPES[table["shape"]](**given)
