"""The [controller.motion] table of scenario files: a path that a controller follows."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from cdcr._core import ReferencePath
from cdcr.files.toml import refuse
from cdcr.scenarios.file.trajectory import kind_errors
from cdcr.scenarios.file.values import error_prefix

AT = "controller.motion"
_SIZED = ("center", "x", "y", "climb", "corners", "points")


def read_path(table: dict[str, Any], size: int, file: Path) -> ReferencePath:
    """Return the path of a motion of so many values, or refuse it with file, key and value."""
    from cdcr.scenarios.file.control_schema import MOTIONS

    refuse(str(file), kind_errors(MOTIONS, table, AT, "shape"))
    for key in _SIZED:
        rows = np.atleast_1d(np.array(table.get(key, np.zeros(size)), dtype=object))
        if rows.shape[-1] != size or rows.ndim > 2:
            told = f"{size} numbers" if key not in ("corners", "points") else f"rows of {size}"
            refuse(str(file), [f"{AT}.{key} must have {told}, as the reference has"])
    with error_prefix(f"{file}, [{AT}]"):
        return _made(table)


def _made(table: dict[str, Any]) -> ReferencePath:
    shape, start = table["shape"], float(table.get("start", 0.0))
    if shape == "spline":
        return ReferencePath.spline(table["t"], table["points"])
    if shape == "polygon":
        return ReferencePath.polygon(table["corners"], table["duration"]).delayed(start)
    center = np.array(table["center"], dtype=np.float64)
    climb = table.get("climb", np.zeros_like(center))
    return ReferencePath.helix(
        center,
        table["x"],
        table["y"],
        climb,
        float(table["turns"]),
        float(table["duration"]),
        bool(table.get("rest_to_rest", True)),
    ).delayed(start)
