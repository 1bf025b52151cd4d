"""What the scripts share: a row of the table of truth, how it is printed, how files are read."""

from __future__ import annotations

import csv
import sys
import time
from argparse import ArgumentTypeError
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Row:
    """A model beside measurements.

    Attributes
    ----------
    source, model : str
        Which measurements; the model.
    fitted : int
        Numbers that were fitted.
    used, held_out : float
        RMS distance [mm] on data used for the fit, and on others; NaN where there are none.
    percent : float
        The error held out, or else the one used, in percent of what `of` says.
    of : str
        "length" of the robot, or "amplitude" of the motion.
    coordinates : int
        Of the model.
    seconds : float
        Processor time of the fit, or of the runs where nothing is fitted.
    """

    source: str
    model: str
    fitted: int
    used: float
    held_out: float
    percent: float
    of: str
    coordinates: int
    seconds: float


HEAD = ("source", "model", "fitted", "used [mm]", "held out [mm]", "", "coordinates", "time [s]")


def show(rows: Sequence[Row]) -> None:
    """Print rows as a table of Markdown."""
    cells = [
        (
            row.source, row.model, f"{row.fitted}", number(row.used), number(row.held_out),
            f"{row.percent:.2f} % of {row.of}", f"{row.coordinates}", f"{row.seconds:.2g}",
        )
        for row in rows
    ]  # fmt: skip
    widths = [max(len(one[k]) for one in [HEAD, *cells]) for k in range(len(HEAD))]
    for k, line in enumerate([HEAD, *cells]):
        print(
            "| "
            + " | ".join(one.ljust(width) for one, width in zip(line, widths, strict=True))
            + " |"
        )
        if k == 0:
            print("|" + "|".join("-" * (width + 2) for width in widths) + "|")


def number(value: float) -> str:
    """Return millimetres as the table shows them."""
    return "" if np.isnan(value) else f"{value:.2f}"


def rms(difference: FloatArray) -> float:
    """Return the root mean square length of rows (N, 3) [m], in mm."""
    return float(1e3 * np.sqrt(np.mean(np.sum(difference**2, axis=-1))))


def mean(values: Sequence[float]) -> float:
    """Return the root mean square, NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if values else np.nan


def amplitude(tip: FloatArray) -> float:
    """Return the largest distance of places (N, 3) [m] from their mean, in mm."""
    return float(1e3 * np.linalg.norm(tip - tip.mean(axis=0), axis=1).max())


def state_at(
    since: FloatArray, places: FloatArray, seen: Callable[[FloatArray], FloatArray],
    rest: FloatArray, modes: FloatArray,
) -> tuple[FloatArray, FloatArray]:  # fmt: skip
    """Return shape and rates at a time, in modes (d, k) from rest, from places a little around it.

    The modes go as cubics in the time `since` then (N,); `seen` gives the places that shapes (N, d)
    would show [m].
    """
    from scipy.optimize import least_squares  # type: ignore[import-untyped]

    powers = since[:, None] ** np.arange(4)

    def apart(x: FloatArray) -> FloatArray:
        off: FloatArray = (seen(rest + powers @ x.reshape(4, -1) @ modes.T) - places) / 1e-3
        return off.ravel()

    found = least_squares(apart, np.zeros(4 * modes.shape[1])).x.reshape(4, -1)
    return rest + modes @ found[0], modes @ found[1]


@contextmanager
def watch() -> Iterator[list[float]]:
    """Yield a list that holds the processor time afterwards [s]."""
    spent = [0.0]
    start = time.process_time()
    yield spent
    spent[0] = time.process_time() - start


def read_columns(path: Path, names: Sequence[str] | None = None, split: str = ",") -> FloatArray:
    """Return columns of a CSV file, all of them where no names are given and there is no header.

    Raises
    ------
    FileNotFoundError
        Where there is no such file.
    ValueError
        With file, line and column of what is no finite number, or not there.
    """
    if not path.is_file():
        raise FileNotFoundError(f"there is no file {path}")
    with path.open(newline="") as file:
        reader = csv.reader(file, delimiter=split)
        lines = [(reader.line_num, row) for row in reader if any(cell.strip() for cell in row)]
    header = [] if names is None else lines[0][1] if lines else []
    for name in names or ():
        if name not in header:
            known = ", ".join(header) or "none"
            raise ValueError(f"{path}, line 1: there is no column {name!r}; there are {known}")
    lines = lines[names is not None :]
    if not lines:
        raise ValueError(f"{path} has no rows of numbers")
    width = len(header) or len(lines[0][1])
    for line, row in lines:
        if len(row) != width:
            raise ValueError(f"{path}, line {line}: must have {width} columns, got {len(row)}")
    places = range(width) if names is None else [header.index(name) for name in names]
    labels = header or [f"column {k + 1}" for k in range(width)]
    return np.array([
        [_number(row[k], f"{path}, line {line}: {labels[k]}") for k in places]
        for line, row in lines
    ])  # fmt: skip


def _number(text: str, where: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise ValueError(f"{where} must be a finite number, got {text!r}")
    return value


def positive(text: str) -> int:
    """Return an argument that is a whole number > 0, or refuse it as argparse does."""
    if not (text.isascii() and text.isdigit() and int(text) > 0):
        raise ArgumentTypeError(f"must be a whole number > 0, got {text!r}")
    return int(text)


def script(rows: Callable[[], Sequence[Row]]) -> None:
    """Print the rows of a script, or say in a sentence what is missing, with exit code 2."""
    try:
        show(rows())
    except (OSError, ValueError) as error:
        print(f"{Path(sys.argv[0]).name}: {error}", file=sys.stderr)
        raise SystemExit(2) from None
