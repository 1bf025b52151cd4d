"""The tension of scenario files: constant, over time in place or in a CSV file, or shapes."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from cdcr.files.number_csv import Layout, read_numbers
from cdcr.files.toml import format_toml, refuse, schema_errors
from cdcr.model.model import Model
from cdcr.runs.command import TensionTable, command_input
from cdcr.scenarios.file.shapes import Shape, TensionShapes, pulse, ramp, sine, step
from cdcr.scenarios.file.trajectory import shape_errors
from cdcr.scenarios.file.values import count, error_prefix

SHAPES: dict[str, Callable[..., Shape]] = {
    "step": step,
    "ramp": ramp,
    "pulse": pulse,
    "sine": sine,
}


def read_tension(
    value: Any, model: Model, file: Path
) -> tuple[float, ...] | TensionTable | TensionShapes:
    """Return the tensions of a scenario file; `value` is None where it has none."""
    if isinstance(value, dict):
        return _over_time(value, model, file)
    if value and isinstance(value[0], dict):
        return _shapes(value, model, file)
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
    if "file" in table:
        where = str(file.parent / table["file"])
        columns = tuple(f"cable {j + 1}" for j in range(model.num_cables))
        layout = Layout(columns, "a number >= 0 [N]", 0.0)
        _, t, rows = read_numbers(Path(where), "tension file", [layout])
    else:
        where = f"{file}, [tension]"
        t, rows = table["t"], table["rows"]
        refuse(where, _row_errors(t, rows, model.num_cables))
    tension = TensionTable(t, rows, table.get("interpolation", "linear"))
    with error_prefix(where):
        command_input(model, tension)
    return tension


def _row_errors(t: list[float], rows: list[list[float]], num_cables: int) -> list[str]:
    if len(rows) != len(t):
        return [f"rows must be as many as t, {len(t)}, got {len(rows)}"]
    return [
        f"rows[{i}] must have {count(num_cables, 'number')}, one for each cable, got {len(row)}"
        for i, row in enumerate(rows)
        if len(row) != num_cables
    ]


def _shapes(tables: list[dict[str, Any]], model: Model, file: Path) -> TensionShapes:
    from cdcr.scenarios.file.shape_schema import TENSION_SHAPES

    found: list[str] = []
    for i, table in enumerate(tables):
        at = f"tension[{i}]"
        wrong = shape_errors(TENSION_SHAPES, table, at)
        if not wrong and table["cable"] > model.num_cables:
            requirement = f"the number of a cable, 1 to {model.num_cables}"
            wrong.append(f"{at}.cable must be {requirement}, got {table['cable']}")
        if "phase" in table and "phase_deg" in table:
            wrong.append(f"{at} must have phase or phase_deg, not both")
        found += wrong
    refuse(str(file), found)
    shapes = []
    for i, table in enumerate(tables):
        with error_prefix(f"{file}: tension[{i}]"):
            shapes.append((table["cable"] - 1, _shape(table)))
    with error_prefix(f"{file}, [[tension]]"):
        return TensionShapes(model.num_cables, shapes)


def _shape(table: dict[str, Any]) -> Shape:
    given = {key: value for key, value in table.items() if key not in ("cable", "shape")}
    if table["shape"] == "ramp":
        given["before"], given["after"] = given.pop("from", 0.0), given.pop("to")
    if "phase_deg" in given:
        given["phase"] = math.radians(given.pop("phase_deg"))
    return SHAPES[table["shape"]](**given)
