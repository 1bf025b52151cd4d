"""Runs as labelled data and as files. One table of quantities serves every format."""

from __future__ import annotations

import csv
import json
import os
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.extras import require
from cdcr.files.new_file import new_file
from cdcr.runs.stats import STATS

if TYPE_CHECKING:
    import xarray

    from cdcr.model.model import Model
    from cdcr.runs.trajectory import Trajectory


class Quantity(NamedTuple):
    """One array of a run: its dimensions after time, its unit and what it is."""

    name: str
    dims: tuple[str, ...]
    units: str
    long_name: str
    values: FloatArray


def by_length(model: Model) -> bool:
    """Whether any command is a length: only then it is stored beside the tensions."""
    return any(cable.length_driven for cable in model.robot.all_cables)


def quantities(run: Trajectory) -> list[Quantity]:
    """Everything a run has to say, first index time."""
    by_component = (len(run), run.model.num_sections, 2)
    vector = ("section", "component")
    found = [
        Quantity("q", vector, "rad", "bending vector", run.q.reshape(by_component)),
        Quantity("qd", vector, "rad/s", "rate of the bending vector", run.qd.reshape(by_component)),
        Quantity("tension", ("cable",), "N", "cable tension", run.tension),
        Quantity("theta", ("section",), "rad", "bending angle", run.theta),
        Quantity("phi", ("section",), "rad", "orientation angle", run.phi),
        Quantity("tip", ("axis",), "m", "tip position in the base frame", run.tip),
        Quantity("kinetic_energy", (), "J", "kinetic energy", run.kinetic_energy),
        Quantity("potential_energy", (), "J", "elastic energy plus weight", run.potential_energy),
        Quantity("energy", (), "J", "total mechanical energy", run.energy),
    ]
    if by_length(run.model):
        what = "what was asked of the cable: tension [N], or length [m] where driven by length"
        found += [
            Quantity("command", ("cable",), "N or m", what, run.command),
            Quantity("cable_energy", (), "J", "energy in the cables' springs", run.cable_energy),
        ]
    return found


def coordinates(run: Trajectory) -> dict[str, tuple[list[Any], str, str]]:
    """Labels, unit and meaning of each dimension."""
    return {
        "time": (run.t.tolist(), "s", "time"),
        "section": (_numbers(run.model.num_sections), "1", "section number, 1 at the base"),
        "component": (["x", "y"], "1", "component of the bending vector"),
        "cable": (_numbers(run.model.num_cables), "1", "cable number, from 1, section by section"),
        "axis": (["x", "y", "z"], "1", "axis of the base frame"),
    }


def _numbers(count: int) -> list[int]:
    return list(range(1, count + 1))


def to_xarray(run: Trajectory) -> xarray.Dataset:
    """Return the run as a Dataset; see Trajectory.to_xarray."""
    xr: Any = require("xarray", "data")
    data = {
        item.name: (
            ("time", *item.dims),
            item.values,
            {"units": item.units, "long_name": item.long_name},
        )
        for item in quantities(run)
    }
    coords = {
        name: (name, labels, {"units": units, "long_name": long_name})
        for name, (labels, units, long_name) in coordinates(run).items()
    }
    dataset: xarray.Dataset = xr.Dataset(data, coords, _attributes(run))
    return dataset


def _attributes(run: Trajectory) -> dict[str, str | int]:
    """Where the numbers come from."""
    return {
        "title": "Run of a cable-driven continuum robot",
        "cdcr_version": _core.__version__,
        "status": run.status.name,
        "message": run.message,
        "method": run.method,
        "formulation": run.model.formulation,
        "robot": json.dumps(asdict(run.model.robot)),
        "slack_events": json.dumps(
            [event._replace(cable=event.cable + 1) for event in run.slack_events]
        ),
        **{name: getattr(run.stats, name) for name in STATS},
    }


def save(run: Trajectory, path: str | os.PathLike[str], *, overwrite: bool = False) -> Path:
    """Write the run to a file; see Trajectory.save."""
    path = Path(path)
    writers = {".nc": _write_netcdf, ".csv": _write_csv}
    if path.suffix not in writers:
        allowed = " or ".join(writers)
        raise ValueError(f"the file name must end in {allowed}, got {path.name!r}")
    with new_file(path, overwrite=overwrite) as partial:
        writers[path.suffix](run, partial)
    return path


def _write_netcdf(run: Trajectory, path: Path) -> None:
    require("h5netcdf", "data")
    to_xarray(run).to_netcdf(path, engine="h5netcdf")


def _write_csv(run: Trajectory, path: Path) -> None:
    header, columns = ["t [s]"], [run.t]
    labels = coordinates(run)
    for item in quantities(run):
        names = [item.name]
        for dim in item.dims:
            names = [_column(name, label) for name in names for label in labels[dim][0]]
        header += [f"{name} [{item.units}]" for name in names]
        columns += list(item.values.reshape(len(run), -1).T)
    with path.open("x", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        # The csv module writes a Python float with repr, from which every bit can be read back.
        writer.writerows(row.tolist() for row in np.stack(columns, axis=1))


def _column(name: str, label: int | str) -> str:
    """q, 1 -> q1; q1, x -> q1_x."""
    return f"{name}{label}" if isinstance(label, int) else f"{name}_{label}"
