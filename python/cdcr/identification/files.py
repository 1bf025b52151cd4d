"""Measurements in CSV files: columns have names and units, other files' columns are mapped."""

from __future__ import annotations

import hashlib
import math
import re
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import format_value, nearest
from cdcr.base.decimals import number
from cdcr.files.new_file import file_path
from cdcr.files.number_csv import read_rows
from cdcr.identification.channels import whole
from cdcr.identification.setup import Place
from cdcr.model.model import Model

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot

# What a unit is in SI units.
_UNITS = {
    "m": ("m", 1.0),
    "mm": ("m", 1e-3),
    "cm": ("m", 1e-2),
    "N m": ("N m", 1.0),
    "N mm": ("N m", 1e-3),
    "N": ("N", 1.0),
    "mN": ("N", 1e-3),
    "rad": ("rad", 1.0),
    "deg": ("rad", math.pi / 180.0),
    "s": ("s", 1.0),
    "ms": ("s", 1e-3),
    "N or m": ("N or m", 1.0),  # as files of runs say of commands
}
_COLUMN = re.compile(r"(?P<name>[^\[\]]*[^\[\]\s])\s*\[(?P<unit>[^\]]*)\]")
_WHOLE = re.compile(r"t|(cable|pull|command) \d+")  # columns without gaps
_OF_A_RUN = re.compile(
    r"(qd\d+ [xy]( \d+)?|(t|e)d\d+( \d+)?|theta\d+|phi\d+|deflection\d+|.*energy)"
)  # that say nothing new


class Table:
    """The columns of a file in SI units, by name.

    Parameters
    ----------
    path : path-like
    columns : mapping of str to str
        Names with units, such as ``tip x [mm]``, to names in the file; the file's other columns are
        ignored then.
    every : int
        One row of so many is taken.
    """

    def __init__(
        self, path: str | PathLike[str], columns: Mapping[str, str] | None, every: int, gaps: str
    ) -> None:
        self.file = file_path(path)
        every = whole("every", every, 1)
        header, rows = read_rows(self.file, "file of measurements")
        if not rows:
            raise ValueError(f"{self.file} has no rows of numbers under its header")
        self._lines = [where for where, _ in rows[::every]]
        self._header: dict[str, str] = {}  # what a column is called in the file
        self._units: dict[str, str] = {}
        self.columns: dict[str, FloatArray] = {}
        for label, column in self._chosen(header, columns).items():
            name, unit, factor = self._named(label)
            if header.count(column) > 1 or name in self.columns:
                raise ValueError(f"{self.file}, line 1: column {label!r} is there twice")
            k = header.index(column)
            cells = [row[k] for _, row in rows[::every]]
            self._header[name], self._units[name] = column, unit
            may = "never" if _WHOLE.fullmatch(name) else gaps
            self.columns[name] = factor * self._numbers(cells, column, may)

    def _chosen(
        self, header: Sequence[str], columns: Mapping[str, str] | None
    ) -> Mapping[str, str]:
        if columns is None:
            if not any(_COLUMN.fullmatch(one.strip()) for one in header):  # not to be shown, then
                raise ValueError(
                    f"{self.file}, line 1: the columns must have units, as in 'tip x [m]', and "
                    "none has"
                )
            return {one: one for one in header}
        if not isinstance(columns, Mapping):
            must = "a mapping such as {'tip x [mm]': 'X'}"
            raise TypeError(f"columns must be {must}, got {format_value(columns)}")
        for label, column in columns.items():
            if column not in header:
                raise ValueError(
                    f"{self.file}, line 1: there is no column {column!r} for {label!r}."
                    f"{nearest(str(column), header)}"
                )
        return columns

    def _named(self, label: str) -> tuple[str, str, float]:
        found = _COLUMN.fullmatch(label.strip())
        if found is None:
            raise ValueError(
                f"{self.file}, line 1: column {label!r} must have its unit, as in '{label} [m]'"
            )
        if found["unit"] not in _UNITS and not _OF_A_RUN.fullmatch(_plain(found["name"])):
            raise ValueError(
                f"{self.file}, line 1: the unit of column {label!r} must be one of "
                f"{', '.join(list(_UNITS)[:-1])}, got {found['unit']!r}"
            )
        return _plain(found["name"]), *_UNITS.get(found["unit"], ("", 1.0))

    def _numbers(self, cells: Sequence[str], column: str, gaps: str) -> FloatArray:
        values = np.array([number(cell) for cell in cells])
        empty = np.array([cell.strip().lower() in ("", "nan") for cell in cells])
        bad = np.flatnonzero(~np.isfinite(values) & ~(empty & (gaps == "skip")))
        if bad.size:
            i = int(bad[0])
            got = f"got {cells[i]!r}" if cells[i].strip() else "got nothing"
            skip = empty[i] and gaps != "never"
            hint = "; gaps = 'skip' leaves out what was not measured" if skip else ""
            raise ValueError(f"{self._lines[i]}: {column} must be a number, {got}{hint}")
        return values

    def where(self, row: int, column: str) -> str:
        """Name a place in the file by its line, and by the name that the column has there."""
        return f"{self._lines[row]}: {self._header.get(column, column)}"

    def called(self, name: str) -> str:
        """Return what a column is called in the file."""
        return self._header[name]

    def commands(self, kind: str, units: Sequence[Sequence[str]]) -> FloatArray:
        """Return the columns that are commands, of each cable in one of its units.

        Refusals call them by the names they have.
        """
        found = np.empty((len(self._lines), len(units)))
        for j, known in enumerate(units):
            name = f"{kind} {j + 1}"
            column = self.take([name], known, needed=True)
            assert column is not None
            found[:, j] = column[:, 0]
            self._header[f"cable {j + 1}"] = self._header[name]
        return found

    def shapes(self, names: Sequence[str]) -> FloatArray | None:
        """Return the columns that are coordinates; refusals call them by the names they have."""
        plain = [name.replace("_", " ") for name in names]
        if not any(name in self.columns for name in plain):
            return None
        found: list[FloatArray] = []
        for k, name in enumerate(plain):
            column = self.take([name], ["m" if name.startswith("e") else "rad"], needed=True)
            assert column is not None
            found.append(column)
            self._header[f"q {k + 1}"] = self._header[name]
        return np.concatenate(found, axis=1)

    def take(
        self, names: Sequence[str], units: Sequence[str], *, needed: bool = False
    ) -> FloatArray | None:
        """Return columns side by side and forget them; None where there are none of them."""
        there = [name for name in names if name in self.columns]
        if not there and not needed:
            return None
        for name in names:
            if name not in self.columns:
                known = ", ".join(self._header.values()) or "none"
                raise ValueError(
                    f"{self.file}, line 1: there must be a column '{name} [{units[0]}]', and the "
                    f"columns are {known}"
                )
            if self._units[name] not in units:
                known = " or ".join(unit for unit in units if unit != "N or m")
                raise ValueError(
                    f"{self.file}, line 1: column {self._header[name]!r} must be in {known}, got "
                    f"{self._units[name]}"
                )
        return np.stack([self.columns.pop(name) for name in names], axis=-1)

    def done(self) -> None:
        """Refuse columns that nobody took, except those that the file of a run has beside."""
        for name in self.columns:
            if re.fullmatch(r"marker \d+ [xyz]", name):
                raise ValueError(
                    f"{self.file}, line 1: column {self._header[name]!r} is of a marker whose "
                    "place 'markers' does not tell"
                )
            if not _OF_A_RUN.fullmatch(name):
                known = ["t", "cable 1", "pull 1", "tip x", "marker 1 x", "tension 1", "length 1"]
                known += ["base force x", "base moment x"]
                raise ValueError(
                    f"{self.file}, line 1: there is no channel {self._header[name]!r}."
                    f"{nearest(name, known)} Known: {', '.join(known)}, q1 x"
                )

    @property
    def source(self) -> dict[str, Any]:
        """Name and SHA-256 sum of the file."""
        return {"file": self.file.name, "sha256": _sum(self.file)}


def _plain(name: str) -> str:
    """Return a name as ours are: 'tip_x' is 'tip x', 'tension1' is 'tension 1'."""
    words = name.strip().replace("_", " ").lower()
    return re.sub(r"^(tension|command|length|cable|marker|pull)(\d)", r"\1 \2", words)


def _sum(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def read_measured(
    path: str | PathLike[str],
    robot: Robot,
    *,
    timed: bool,
    columns: Mapping[str, str] | None = None,
    every: int = 1,
    markers: Sequence[Place] = (),
    **options: Any,
) -> dict[str, Any]:
    """Return the arguments of Poses or, where `timed`, of a Motion that a file has, by name.

    Raises
    ------
    FileNotFoundError
        Where there is no such file.
    ValueError
        With file, line and column of what is wrong.
    """
    table = Table(path, columns, every, options.get("gaps", "refuse"))
    t = table.take(["t"], ["s"], needed=timed)
    given = _measured(table, robot, markers, options)
    return given | {"t": t[:, 0]} if timed and t is not None else given


def _measured(
    table: Table, robot: Robot, markers: Sequence[Place], options: Mapping[str, Any]
) -> dict[str, Any]:
    """Return the arguments of a measurement, those of the file among them."""
    cables = range(1, robot.num_cables + 1)
    given: dict[str, Any] = {"name": table.file.name, "where": table.where} | dict(options)
    # A tension in metres, or a length in newtons, is another robot's.
    units = [["m" if cable.length_driven else "N"] for cable in robot.all_cables]
    command: Any
    if any(f"pull {j}" in table.columns for j in cables):
        given["pulled"], command = True, table.commands("pull", units)
    elif "command" in given:
        command = given.pop("command")
        twice = [name for name in table.columns if re.fullmatch(r"(cable|command) \d+", name)]
        if twice:
            raise ValueError(
                f"{table.file}, line 1: column {table.called(twice[0])!r} is a command, and so is "
                "what 'command' tells: leave out one of them"
            )
    elif "command 1" in table.columns:
        command = table.commands("command", [[*one, "N or m"] for one in units])
        table.take([f"tension {j}" for j in cables], ["N"])  # in a run's file: what came of it
    elif "tension 1" in table.columns and "cable 1" not in table.columns:
        command = table.commands("tension", [["N"]] * robot.num_cables)
    else:
        command = table.commands("cable", units)
    names = {
        "tip": ([f"tip {axis}" for axis in "xyz"], "m"),
        "tension": ([f"tension {j}" for j in cables], "N"),
        "length": ([f"length {j}" for j in cables], "m"),
        "base_force": ([f"base force {axis}" for axis in "xyz"], "N"),
        "base_moment": ([f"base moment {axis}" for axis in "xyz"], "N m"),
    }
    for name, (labels, unit) in names.items():
        given[name] = table.take(labels, [unit])
    q = table.shapes(Model(robot).coordinate_names)
    # The file of a run has shapes beside the tip, which only a simulation knows.
    given["q"] = q if given["tip"] is None and not markers else None
    given["markers"] = {
        tuple(place): table.take([f"marker {i + 1} {axis}" for axis in "xyz"], ["m"], needed=True)
        for i, place in enumerate(markers)
    }
    table.done()
    return given | {"command": command, "source": table.source}
