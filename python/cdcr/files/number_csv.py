"""Numbers over time in CSV files: a column t [s], then columns with known names."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

FloatRows = list[list[float]]


class Layout(NamedTuple):
    """Columns after t, and the smallest value in them."""

    columns: tuple[str, ...]
    requirement: str  # of each value, as 'a number [rad]'
    low: float = -math.inf


def read_numbers(
    path: Path, what: str, layouts: Sequence[Layout]
) -> tuple[Layout, list[float], FloatRows]:
    """Return the layout found, the times and the rows after them.

    Raises
    ------
    FileNotFoundError
        Calling the missing file `what`, as in 'tension file'.
    ValueError
        With file, line and column of what is wrong.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file, strict=True)
            layout = _layout([name.strip() for name in next(reader, [])], layouts, path)
            table = [
                _numbers(row, layout, f"{path}, line {reader.line_num}") for row in reader if row
            ]
    except FileNotFoundError:
        raise FileNotFoundError(f"there is no {what} {path}") from None
    except (csv.Error, UnicodeDecodeError) as error:
        raise ValueError(f"{path} is not a CSV file: {error}") from None
    if not table:
        raise ValueError(f"{path} has no rows of numbers under its header")
    return layout, [row[0] for row in table], [row[1:] for row in table]


def _layout(header: list[str], layouts: Sequence[Layout], path: Path) -> Layout:
    for layout in layouts:
        if header == ["t", *layout.columns]:
            return layout
    requirement = "; or ".join(", ".join(["t", *layout.columns]) for layout in layouts)
    got = ", ".join(header) or "nothing"
    raise ValueError(f"{path}, line 1: the columns must be {requirement}, got {got}")


def _numbers(row: list[str], layout: Layout, where: str) -> list[float]:
    columns = ("t", *layout.columns)
    if len(row) != len(columns):
        raise ValueError(f"{where}: must have {len(columns)} columns, got {len(row)}")
    numbers = []
    for text, column in zip(row, columns, strict=True):
        requirement, low = ("a time [s]", -math.inf) if column == "t" else layout[1:]
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and value >= low):
            raise ValueError(f"{where}: {column} must be {requirement}, got {text!r}")
        numbers.append(value)
    return numbers
