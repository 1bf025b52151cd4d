"""Runs read back from the files that `save` writes."""

from __future__ import annotations

import json
import math
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from cdcr._core import Status
from cdcr.base.arrays import FloatArray, read_only
from cdcr.base.decimals import number
from cdcr.base.extras import require
from cdcr.files.new_file import file_path
from cdcr.files.number_csv import RUN_TIME, read_rows
from cdcr.model.model import Model
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section
from cdcr.runs.export import by_length, columns_of
from cdcr.runs.stats import STATS, make_stats


def load(path: str | PathLike[str], model: Model | None) -> dict[str, Any]:
    """Return the fields of a stored run but its slack events as tuples; see Trajectory.load."""
    file = file_path(path)
    if file.suffix not in (".nc", ".csv"):
        raise ValueError(f"the file name must end in .nc or .csv, got {file.name!r}")
    if not file.is_file():
        raise FileNotFoundError(f"there is no run {file}")
    if file.suffix == ".nc":
        return _netcdf(file, model)
    if model is None:
        raise ValueError(f"{file} holds numbers and no robot: give the model that ran, model=...")
    return _csv(file, model)


def _netcdf(file: Path, model: Model | None) -> dict[str, Any]:
    xr: Any = require("xarray", "data")
    require("h5netcdf", "data")
    try:
        with xr.open_dataset(file, engine="h5netcdf") as data:
            found = data.load()
        about = found.attrs
        model = model or _model(json.loads(about["robot"]), about["formulation"])
        rows = len(found.time)
        events = json.loads(about.get("slack_events", "[]"))  # cables counted from 1, as in files
        command = found.command if "command" in found else found.tension
        return {
            "model": model,
            "t": found.time.values,
            "q": found.q.values.reshape(rows, -1),
            "qd": found.qd.values.reshape(rows, -1),
            "tension": found.tension.values,
            "command": command.values,
            "deflection": found.deflection.values if "deflection" in found else None,
            "status": Status[about["status"]],
            "message": about["message"],
            "method": about["method"],
            "stats": make_stats(int(about[name]) for name in STATS),
            "slack_events": [(t, cable - 1, slack) for t, cable, slack in events],
            "sensitivities": _slopes(found, "dq_d"),
            "rate_sensitivities": _slopes(found, "dqd_d"),
        }
    except (OSError, KeyError, AttributeError) as error:
        raise ValueError(f"{file} is no run that cdcr has written: {error}") from None


def _slopes(found: Any, prefix: str) -> dict[str, FloatArray]:
    """Return the derivatives (N, d, k) that stand under this prefix and a name."""
    names = [name for name in found.data_vars if name.startswith(prefix)]
    rows = {name.removeprefix(prefix): found[name].values for name in names}
    return {name: read_only(row.reshape(*row.shape[:2], -1)) for name, row in rows.items()}


def _model(described: dict[str, Any], formulation: str) -> Model:
    sections = [Section(**section) for section in described.pop("sections")]
    cables = [Cable(**cable) for cable in described.pop("cables", ())]
    return Model(Robot(sections=sections, cables=cables, **described), formulation)


def _csv(file: Path, model: Model) -> dict[str, Any]:
    try:
        header, rows = read_rows(file, "run")
        table = np.array([_numbers(*row) for row in rows]).reshape(-1, len(header))
    except ValueError as error:
        raise ValueError(f"{file} is no run that cdcr has written: {error}") from None
    columns = dict(zip(header, table.T, strict=True))

    def values(names: list[str]) -> FloatArray:
        missing = [name for name in names if name not in columns]
        if missing:
            raise ValueError(f"{file} has no column {missing[0]!r}, which a run of this model has")
        found = [columns[name] for name in names]
        return np.stack(found, axis=1) if found else np.empty((len(table), 0))

    tension = values(columns_of(model, "tension"))
    asked = values(columns_of(model, "command")) if by_length(model) else tension
    stuck = columns_of(model, "deflection")
    return {
        "model": model,
        "t": values([RUN_TIME])[:, 0],
        "q": values(columns_of(model, "q")),
        "qd": values(columns_of(model, "qd")),
        "tension": tension,
        "command": asked,
        "deflection": values(stuck) if stuck[:1] and stuck[0] in columns else None,
        "status": Status.ok,
        "message": f"{file.name} does not hold how the run ended, its method and its cost",
        "stats": make_stats(),
        "slack_events": [],
    }


def _numbers(where: str, row: list[str]) -> list[float]:
    found = [number(text) for text in row]
    wrong = [text for text, value in zip(row, found, strict=True) if not math.isfinite(value)]
    if wrong:
        raise ValueError(f"{where}: {wrong[0]!r} is no number")
    return found
