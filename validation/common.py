"""What the scripts share: a row of the table of truth, how it is printed, how files are read."""

from __future__ import annotations

import csv
import sys
import time
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


@contextmanager
def watch() -> Iterator[list[float]]:
    """Yield a list that holds the processor time afterwards [s]."""
    spent = [0.0]
    start = time.process_time()
    yield spent
    spent[0] = time.process_time() - start


def read_columns(path: Path, names: Sequence[str] | None = None) -> FloatArray:
    """Return columns of a CSV file, all of them where no names are given and there is no header."""
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    if names is None:
        return np.array([[float(cell) for cell in row] for row in rows])
    places = [rows[0].index(name) for name in names]
    return np.array([[float(row[k]) for k in places] for row in rows[1:]])


def script(rows: Callable[[], Sequence[Row]]) -> None:
    """Print the rows of a script, or say in a sentence what is missing, with exit code 2."""
    try:
        show(rows())
    except (OSError, ValueError) as error:
        print(f"{Path(sys.argv[0]).name}: {error}", file=sys.stderr)
        raise SystemExit(2) from None
