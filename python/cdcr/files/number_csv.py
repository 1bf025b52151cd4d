"""Numbers over time in CSV files: a column of times, then columns with known names."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from cdcr.base.check import count
from cdcr.base.decimals import number
from cdcr.files.text import read_text

if TYPE_CHECKING:
    from pathlib import Path

FloatRows = list[list[float]]
RUN_TIME = "t [s]"  # the column of times in the files of runs


class Layout(NamedTuple):
    """Columns after that of times, and the smallest value in them.

    In the file of a run, whose times are `RUN_TIME`, other columns may stand beside them.
    """

    columns: tuple[str, ...]
    requirement: str  # of each value, as 'a number [rad]'
    low: float = -math.inf
    time: str = "t"

    def places(self, header: Sequence[str]) -> list[int] | None:
        """Return where times and columns stand in a file with that header; None for another's."""
        wanted = [self.time, *self.columns]
        kinds = {digits_apart(name) for name in wanted}
        same = [name for name in header if self.time != RUN_TIME or digits_apart(name) in kinds]
        return [header.index(name) for name in wanted] if sorted(same) == sorted(wanted) else None


def digits_apart(name: str) -> str:
    """Return what the names of like columns have in common: q1_x, q2_x -> q#_x."""
    return re.sub(r"[0-9]+", "#", name)


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
    header, rows = read_rows(path, what)
    layout, places = _layout(header, layouts, path)
    if not rows:
        raise ValueError(f"{path} has no rows of numbers under its header")
    table = [_numbers([row[k] for k in places], layout, where) for where, row in rows]
    return layout, [row[0] for row in table], [row[1:] for row in table]


def read_rows(path: Path, what: str) -> tuple[list[str], list[tuple[str, list[str]]]]:
    """Return the header, and the cells of each row beside where it stands: file and line."""
    import csv  # few programs read files
    import io

    reader = csv.reader(io.StringIO(read_text(path, what), newline=""), strict=True)
    try:
        header = [name.strip() for name in next(reader, [])]
        rows = [(f"{path}, line {reader.line_num}", row) for row in reader if row]
    except csv.Error as error:
        raise ValueError(f"{path} is not a CSV file: {error}") from None
    for mark, name in ((";", "semicolons"), ("\t", "tabs"), ("|", "bars")):
        if len(header) == 1 and mark in header[0]:
            raise ValueError(f"{path}, line 1: columns must be separated by commas, not {name}")
    for where, row in rows:
        if len(row) != len(header):
            wanted = count(len(header), "column")
            raise ValueError(f"{where}: must have {wanted}, got {len(row)}")
    return header, rows


def _layout(header: list[str], layouts: Sequence[Layout], path: Path) -> tuple[Layout, list[int]]:
    for layout in layouts:
        places = layout.places(header)
        if places is not None:
            return layout, places
    plain = [one for one in layouts if one.time != RUN_TIME]
    requirement = "; or ".join(", ".join([one.time, *one.columns]) for one in plain)
    # A header that is nothing like ours may be of a file that is nobody's business.
    got = (
        ", ".join(header)
        if header[:1] in (["t"], [RUN_TIME])
        else "others"
        if header
        else "nothing"
    )
    raise ValueError(f"{path}, line 1: the columns must be {requirement}, got {got}")


def _numbers(row: list[str], layout: Layout, where: str) -> list[float]:
    numbers = []
    for text, column in zip(row, (layout.time, *layout.columns), strict=True):
        is_time = column == layout.time
        requirement, low = ("a time [s]", -math.inf) if is_time else layout[1:3]
        value = number(text)
        if not (math.isfinite(value) and value >= low):
            raise ValueError(f"{where}: {column} must be {requirement}, got {text!r}")
        numbers.append(value)
    return numbers
