"""Cable tensions over time in a CSV file: columns t [s], cable 1 [N], cable 2 [N], ..."""

from __future__ import annotations

import csv
import math
from pathlib import Path

FloatRows = list[list[float]]


def read_tension_csv(path: Path, num_cables: int) -> tuple[list[float], FloatRows]:
    """Return times and rows of tensions, or raise a ValueError with file, line and column."""
    wanted = ["t", *(f"cable {j + 1}" for j in range(num_cables))]
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            reader = csv.reader(file, strict=True)
            header = [name.strip() for name in next(reader, [])]
            if header != wanted:
                got = ", ".join(header) or "nothing"
                raise ValueError(
                    f"{path}, line 1: the columns must be {', '.join(wanted)}, got {got}"
                )
            table = [
                _numbers(row, wanted, f"{path}, line {reader.line_num}") for row in reader if row
            ]
    except FileNotFoundError:
        raise FileNotFoundError(f"there is no tension file {path}") from None
    except (csv.Error, UnicodeDecodeError) as error:
        raise ValueError(f"{path} is not a CSV file: {error}") from None
    if not table:
        raise ValueError(f"{path} has no rows of numbers under its header")
    return [row[0] for row in table], [row[1:] for row in table]


def _numbers(row: list[str], columns: list[str], where: str) -> list[float]:
    if len(row) != len(columns):
        raise ValueError(f"{where}: must have {len(columns)} columns, got {len(row)}")
    numbers = []
    for text, column in zip(row, columns, strict=True):
        low = -math.inf if column == "t" else 0.0
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and value >= low):
            allowed = "a time [s]" if column == "t" else "a number >= 0 [N]"
            raise ValueError(f"{where}: {column} must be {allowed}, got {text!r}")
        numbers.append(value)
    return numbers
