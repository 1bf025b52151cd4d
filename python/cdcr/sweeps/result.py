"""The result of a sweep: labelled arrays, and their file."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.extras import require
from cdcr.files.netcdf import write_netcdf
from cdcr.files.new_file import check_folder, new_file
from cdcr.files.new_folder import ZARR, new_folder
from cdcr.sweeps.design import Design
from cdcr.sweeps.jobs import Outcome
from cdcr.sweeps.metrics import Asked

if TYPE_CHECKING:
    import xarray

SUFFIXES = (".nc", ".zarr")
ZARR_FORMAT = 2  # in which strings are specified
_BESIDE = ("status", "message")  # variables that are no metrics
NAMES = (*_BESIDE, "run")  # that no metric can have


def require_sweep(result: object) -> None:
    """Refuse what is no result of a sweep."""
    if "sweep" not in getattr(result, "attrs", ()):
        raise _no_sweep(result)


def _no_sweep(result: object) -> TypeError:
    got = type(result).__name__
    return TypeError(
        f"result must be a Dataset of cdcr.sweep, or one read from its file, got {got}"
    )


def metric_names(result: xarray.Dataset) -> list[str]:
    """Return the names of the metrics of a sweep."""
    return [str(name) for name in result.data_vars if name not in _BESIDE]


def parameter_names(result: xarray.Dataset) -> list[str]:
    """Return the names of the parameters of a sweep."""
    try:
        return list(json.loads(result.attrs["sweep"])["parameters"])
    except (AttributeError, KeyError, TypeError, ValueError):
        raise _no_sweep(result) from None


def make_dataset(
    design: Design,
    metrics: Sequence[Asked],
    outcomes: Mapping[int, Outcome],
    units: Mapping[str, str],
    sweep: Mapping[str, Any],
) -> xarray.Dataset:
    """Return the outcomes of all runs, in the shape of the grid or along the runs."""
    xr: Any = require("xarray", "sweep")
    ended = [outcomes[i] for i in range(len(design.rows))]
    about = {name: {"units": units[name]} if units.get(name) else {} for name in design.names}
    coords: dict[str, Any]
    if design.axes:
        dims: tuple[str, ...] = design.names
        shape = tuple(axis.size for axis in design.axes)
        pairs = zip(design.names, design.axes, strict=True)
        coords = {name: (name, axis, about[name]) for name, axis in pairs}
    else:
        dims, shape = ("run",), (len(design.rows),)
        columns = zip(design.names, design.rows.T, strict=True)
        coords = {name: ("run", column, about[name]) for name, column in columns}
        coords["run"] = ("run", np.arange(1, len(design.rows) + 1), {"long_name": "run, from 1"})
    values = np.array([one.values for one in ended]).reshape(len(ended), len(metrics))
    data: dict[str, Any] = {
        metric.name: (dims, column.reshape(shape), _attributes(metric))
        for metric, column in zip(metrics, values.T, strict=True)
    }
    words = {"status": "how the run ended", "message": "why, where it failed"}
    for name, told in words.items():
        strings = np.array([getattr(one, name) for one in ended]).reshape(shape)
        data[name] = (dims, strings, {"long_name": told})
    title = "Sweep of a cable-driven continuum robot"
    dataset: xarray.Dataset = xr.Dataset(
        data, coords, {"title": title, "samples": design.kind, "sweep": json.dumps(sweep)}
    )
    return dataset


def _attributes(metric: Asked) -> dict[str, str]:
    told = {"units": metric.unit, "long_name": metric.about or metric.name}
    return {key: value for key, value in told.items() if value}


def check_name(path: Path) -> None:
    """Refuse a name that no result can have."""
    if path.suffix not in SUFFIXES:
        raise ValueError(f"the file name must end in .nc or .zarr, got {path.name!r}")


def check_path(path: Path) -> None:
    """Refuse a path that no result can have, for want of an extra too."""
    check_name(path)
    require("zarr", "zarr") if path.suffix == ".zarr" else require("h5netcdf", "sweep")
    check_folder(path.parent)
    is_zarr = any((path / name).exists() for name in ZARR)
    if path.is_dir() and not (path.suffix == ".zarr" and is_zarr):
        raise IsADirectoryError(f"{path} is a folder, not a sweep")


def write(result: xarray.Dataset, path: Path, *, overwrite: bool) -> None:
    """Write a result, which appears whole or not at all."""
    if path.suffix == ".zarr":
        with new_folder(path, overwrite=overwrite) as folder:
            result.to_zarr(folder, zarr_format=ZARR_FORMAT)
        return
    with new_file(path, overwrite=overwrite) as part:
        write_netcdf(result, part)


def read(path: Path) -> xarray.Dataset:
    """Return the result that a file holds."""
    xr: Any = require("xarray", "sweep")
    engine = "zarr" if path.suffix == ".zarr" else "h5netcdf"
    try:
        with xr.open_dataset(path, engine=engine) as stored:
            found: xarray.Dataset = stored.load()
        json.loads(found.attrs["sweep"])
    except KeyError:
        raise FileExistsError(f"{path} is no sweep that cdcr has written") from None
    except (OSError, ValueError) as error:
        raise FileExistsError(f"{path} is no sweep that cdcr has written: {error}") from None
    return found
