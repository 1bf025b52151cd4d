"""Runs read back from the files that `save` writes."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from cdcr._core import Status
from cdcr.base.arrays import FloatArray, read_only
from cdcr.base.check import count, require_kind
from cdcr.base.decimals import number
from cdcr.base.extras import require
from cdcr.files.new_file import file_path
from cdcr.files.number_csv import RUN_TIME, digits_apart, read_rows
from cdcr.model.model import Model
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section
from cdcr.runs.export import by_length, columns_of, coordinates, dims_and_units
from cdcr.runs.stats import STATS, make_stats

# What readers of netCDF, JSON and numbers raise for files that are none of ours, or half of one.
_FOREIGN = (OSError, RuntimeError, LookupError, AttributeError, TypeError, ValueError)


def load(path: str | PathLike[str], model: Model | None) -> dict[str, Any]:
    """Return the fields of a stored run but its slack events as tuples; see Trajectory.load."""
    file = file_path(path)
    if file.suffix not in (".nc", ".csv"):
        raise ValueError(f"the file name must end in .nc or .csv, got {file.name!r}")
    if model is not None:
        require_kind("model", model, Model)
    if not file.is_file():
        raise FileNotFoundError(f"there is no run {file}")
    if file.suffix == ".csv" and model is None:
        raise ValueError(f"{file} holds numbers and no robot: give the model that ran, model=...")
    fields = _netcdf(file, model) if model is None or file.suffix == ".nc" else _csv(file, model)
    if not np.all(np.diff(fields["t"]) > 0.0):
        raise ValueError(f"{file} is no run that cdcr has written: its times do not increase")
    return fields


def _netcdf(file: Path, model: Model | None) -> dict[str, Any]:
    xr: Any = require("xarray", "data")
    require("h5netcdf", "data")
    try:
        with xr.open_dataset(file, engine="h5netcdf", decode_times=False) as data:
            found = data.load()
        about = found.attrs
        ran = model or _model(json.loads(about["robot"]), str(about["formulation"]))
        ended = _end(about, len(found.cable) if "cable" in found.dims else 0)
    except _FOREIGN as error:
        told = f"it has no {error}" if isinstance(error, LookupError) else error
        raise ValueError(f"{file} is no run that cdcr has written: {told}") from None
    try:
        return {"model": ran, **_arrays(found, ran), **ended}
    except _FOREIGN as error:
        what = "no run that cdcr has written" if model is None else "no run of this model"
        raise ValueError(f"{file} is {what}: {error}") from None


def _end(about: Mapping[str, Any], num_cables: int) -> dict[str, Any]:
    """Return how a run ended, and what it cost."""
    events = json.loads(about.get("slack_events", "[]"))  # cables counted from 1, as in files
    slack_events = [(float(t), cable - 1, bool(slack)) for t, cable, slack in events]
    wrong = [cable + 1 for _, cable, _ in slack_events if cable not in range(num_cables)]
    if wrong:
        raise ValueError(f"its slack events tell of a cable {wrong[0]}")
    return {
        "status": Status[about["status"]],
        "message": str(about["message"]),
        "method": str(about["method"]),
        "stats": make_stats(int(about[name]) for name in STATS),
        "slack_events": slack_events,
    }


def _arrays(found: Any, model: Model) -> dict[str, Any]:
    """Return the arrays of a run, whichever way round they are stored."""
    _same_drive(model, "command" in found)
    if found.time.ndim != 1 or not found.time.size:
        raise ValueError("it has no samples")
    if found.time.attrs.get("units", "s") != "s":
        raise ValueError(f"time must be in s, got {found.time.attrs['units']}")
    stored = [name for name in ("command", "deflection") if name in found]
    arrays = {name: _stored(found, name, model) for name in ("q", "qd", "tension", *stored)}
    return {
        "t": found.time.values,
        **{"command": arrays["tension"], **arrays},
        "sensitivities": _slopes(found, "dq_d"),
        "rate_sensitivities": _slopes(found, "dqd_d"),
    }


def _same_drive(model: Model, lengths: bool) -> None:
    """Refuse commands of cables that are driven otherwise than those of the model."""
    if by_length(model) and not lengths:
        raise ValueError("it has no lengths of cables, by which those of the model are driven")
    if lengths and not by_length(model):
        raise ValueError("its cables are driven by length, those of the model by tension")


def _stored(found: Any, name: str, model: Model) -> FloatArray:
    """Return an array (N, ...), or refuse another unit, and labels that are not the model's."""
    if name not in found:
        raise ValueError(f"it has no {name!r}")
    dims, units = dims_and_units(model, name)
    data = found[name].transpose("time", *dims)
    told, labels = data.attrs.get("units", units), coordinates(model, found.time.values)
    if told != units:
        raise ValueError(f"{name} must be in {units}, got {told}")
    for dim in dims:
        wanted, got = labels[dim][0], data[dim].values.tolist()
        if got != wanted:
            raise ValueError(f"{dim} of {name} must be {wanted}, got {got}")
    return np.asarray(data.values).reshape(len(data), -1)


def _slopes(found: Any, prefix: str) -> dict[str, FloatArray]:
    """Return the derivatives (N, d, k) that stand under this prefix and a name."""
    names = [name for name in found.data_vars if name.startswith(prefix)]
    rows = {
        name.removeprefix(prefix): found[name].transpose("time", "of_coordinate", ...).values
        for name in names
    }
    return {name: read_only(row.reshape(*row.shape[:2], -1)) for name, row in rows.items()}


def _model(described: dict[str, Any], formulation: str) -> Model:
    sections = [Section(**section) for section in described.pop("sections")]
    cables = [Cable(**cable) for cable in described.pop("cables", ())]
    return Model(Robot(sections=sections, cables=cables, **described), formulation)


def _csv(file: Path, model: Model) -> dict[str, Any]:
    try:
        header, rows = read_rows(file, "run")
        table = np.array([_numbers(*row) for row in rows]).reshape(len(rows), len(header))
    except ValueError as error:
        raise ValueError(f"{file} is no run that cdcr has written: {error}") from None
    if not rows:
        raise ValueError(f"{file} is no run that cdcr has written: it has no samples")
    columns = dict(zip(header, table.T, strict=True))
    if len(columns) < len(header):
        twice = next(name for name in header if header.count(name) > 1)
        raise ValueError(f"{file} has {count(header.count(twice), 'column')} {twice!r}")

    def values(names: list[str]) -> FloatArray:
        missing = [name for name in names if name not in columns]
        if missing:
            raise ValueError(f"{file} has no column {missing[0]!r}, which a run of this model has")
        found = [columns[name] for name in names]
        return np.stack(found, axis=1) if found else np.empty((len(table), 0))

    stored = ("q", "qd", "tension", "command")
    known, asking = [
        [one for name in names for one in columns_of(model, name)]
        for names in (stored if by_length(model) else stored[:3], stored)
    ]
    kinds = {digits_apart(name) for name in asking}
    other = [name for name in header if digits_apart(name) in kinds and name not in known]
    if other:
        raise ValueError(f"{file} has a column {other[0]!r}, which no run of this model has")
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
