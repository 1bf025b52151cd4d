"""Runs as labelled data, netCDF and CSV. One table of quantities serves every format."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.extras import require
from cdcr.files import netcdf
from cdcr.files.number_csv import RUN_TIME
from cdcr.model.signals import rate_names
from cdcr.runs.stats import STATS

if TYPE_CHECKING:
    import pandas  # type: ignore[import-untyped]
    import xarray

    from cdcr.model.model import Model
    from cdcr.runs.trajectory import Trajectory


# Dimensions after time and unit of what a run is made of.
_STATE = {
    "q": (("section", "component"), "rad"),
    "qd": (("section", "component"), "rad/s"),
    "tension": (("cable",), "N"),
    "command": (("cable",), "N or m"),
    "deflection": (("cable",), "m"),  # of cables that remember
}


# Dimensions of derivatives: which coordinate, and by which at the start.
_OF, _BY = "of_coordinate", "by_coordinate"


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
    found = [
        *_state(run),
        Quantity("tension", *_STATE["tension"], "cable tension", run.tension),
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
            Quantity("command", *_STATE["command"], what, run.command),
            Quantity("cable_energy", (), "J", "energy in the cables' springs", run.cable_energy),
        ]
    if run.deflection is not None:
        what = "how far the cable is from where it stuck"
        found.append(Quantity("deflection", *_STATE["deflection"], what, run.deflection))
    return found + [item for items in run.channels.values() for item in items]


def _state(run: Trajectory) -> list[Quantity]:
    """Bending vectors by section where there is nothing else, or coordinates one by one."""
    found = []
    for name, values, about in (("q", run.q, "{}"), ("qd", run.qd, "rate of the {}")):
        dims, units = dims_and_units(run.model, name)
        vectors = len(dims) == 2
        shape = (len(run), -1, 2) if vectors else values.shape
        long_name = about.format("bending vector" if vectors else "coordinate")
        found.append(Quantity(name, dims, units, long_name, values.reshape(shape)))
    return found


def dims_and_units(model: Model, name: str) -> tuple[tuple[str, ...], str]:
    """Return the dimensions after time, and the unit, of q, qd, tension, command or deflection."""
    dims, units = _STATE[name]
    if name not in ("q", "qd") or all_bend_evenly(model):
        return dims, units
    stretches = any(map(_is_stretch, model.coordinate_names))
    return ("coordinate",), f"{units} or {_of_stretch(units)}" if stretches else units


def all_bend_evenly(model: Model) -> bool:
    """Whether the coordinates are one bending vector for each section."""
    names = (f"q{i + 1}_{axis}" for i in range(model.num_sections) for axis in "xy")
    return model.coordinate_names == tuple(names)


def _is_stretch(name: str) -> bool:
    return name.startswith("e")


def _of_stretch(units: str) -> str:
    """rad/s -> m/s."""
    return units.replace("rad", "m")


def coordinates(model: Model, t: FloatArray) -> dict[str, tuple[list[Any], str, str]]:
    """Labels, unit and meaning of each dimension."""
    about = {
        "section": ("1", "section number, 1 at the base"),
        "component": ("1", "component of the bending vector"),
        "coordinate": ("1", "coordinate of a section, from 1: q bending, t twist, e stretch"),
        "cable": ("1", "cable number, from 1, section by section"),
        "axis": ("1", "axis of the base frame"),
    }
    labels = _labels(model)
    return {"time": (t.tolist(), "s", "time")} | {
        name: (labels[name], *words) for name, words in about.items() if name in labels
    }


def _labels(model: Model) -> dict[str, list[Any]]:
    even = all_bend_evenly(model)
    state = {"component": ["x", "y"]} if even else {"coordinate": list(model.coordinate_names)}
    return {
        "section": _numbers(model.num_sections),
        **state,
        "cable": _numbers(model.num_cables),
        "axis": ["x", "y", "z"],
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
        for name, (labels, units, long_name) in coordinates(run.model, run.t).items()
    }
    if run.sensitivities:
        data |= _sensitivities(run)
        names = list(run.model.coordinate_names)
        about = {"units": "1", "long_name": "coordinate that is differentiated, or by which"}
        coords |= {dim: (dim, names, about) for dim in (_OF, _BY)}
    dataset: xarray.Dataset = xr.Dataset(data, coords, attributes(run))
    return dataset


def _sensitivities(run: Trajectory) -> dict[str, tuple[Any, ...]]:
    """Return the derivatives of q and qd: of a number of the robot without a dimension for it."""
    found: dict[str, tuple[Any, ...]] = {}
    for letter, slopes in (("q", run.sensitivities), ("qd", run.rate_sensitivities)):
        for name, values in slopes.items():
            dims = {"q0": (_BY,), "qd0": (_BY,), "tension": ("cable",), "command": ("cable",)}
            by = dims.get(name, ())
            about = {"units": "SI", "long_name": f"derivative of {letter} by {name}"}
            shaped = values if by else values[:, :, 0]
            found[f"d{letter}_d{name}"] = (("time", _OF, *by), shaped, about)
    return found


def attributes(run: Trajectory) -> dict[str, str | int]:
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


def write_netcdf(run: Trajectory, path: Path) -> None:
    """Write the run as netCDF to a file of any name."""
    netcdf.write_netcdf(to_xarray(run), path)


def to_dataframe(run: Trajectory) -> pandas.DataFrame:
    """Return the run as a DataFrame; see Trajectory.to_dataframe."""
    pd: Any = require("pandas", "data")
    (time, *header), (t, *columns) = _table(run)
    frame: pandas.DataFrame = pd.DataFrame(
        dict(zip(header, columns, strict=True)), index=pd.Index(t, name=time)
    )
    return frame


def _table(run: Trajectory) -> tuple[list[str], list[FloatArray]]:
    """Return the names and the values (N,) of all columns, times first."""
    header, columns = [RUN_TIME], [run.t]
    for item in quantities(run):
        header += _columns(run.model, item.name, item.dims, item.units)
        columns += list(item.values.reshape(len(run), -1).T)
    return header, columns


def write_csv(run: Trajectory, path: Path) -> None:
    """Write the run as CSV to a file of any name."""
    header, columns = _table(run)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        # The csv module writes a Python float with repr, from which every bit can be read back.
        writer.writerows(row.tolist() for row in np.stack(columns, axis=1))


def columns_of(model: Model, name: str) -> list[str]:
    """Return the columns of q, qd, tension, command or deflection in a CSV file."""
    return _columns(model, name, *dims_and_units(model, name))


def _columns(model: Model, name: str, dims: Sequence[str], units: str) -> list[str]:
    names = column_names(model, name, dims)
    if dims != ("coordinate",):
        return [f"{one} [{units}]" for one in names]
    units = units.partition(" or ")[0]
    stretches = [_is_stretch(one) for one in model.coordinate_names]
    return [
        f"{one} [{_of_stretch(units) if stretch else units}]"
        for one, stretch in zip(names, stretches, strict=True)
    ]


def column_names(model: Model, name: str, dims: Sequence[str]) -> list[str]:
    """Return the names of the numbers of a quantity, such as q1_x, q1_y."""
    if dims == ("coordinate",):  # q, qd, or such as told_q
        names = rate_names(model) if name.endswith("qd") else list(model.coordinate_names)
        return [name.rpartition("q")[0] + one for one in names]
    names = [name]
    for dim in dims:
        names = [_column(one, label) for one in names for label in _labels(model)[dim]]
    return names


def _column(name: str, label: int | str) -> str:
    """q, 1 -> q1; q1, x -> q1_x."""
    return f"{name}{label}" if isinstance(label, int) else f"{name}_{label}"
