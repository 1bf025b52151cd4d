"""Rows: one measurement each; how they are made, kept and shown."""

from __future__ import annotations

import json
import statistics
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

Row = dict[str, Any]

# What the project wants of a row's p50, in the row's unit: at most this.
TARGETS = {
    "forward_dynamics": 60.0,
    "forward_dynamics, 3 sections": 1.5,
    "forward_dynamics, 10 sections": 6.0,
    "forward_dynamics, 20 sections over 10": 2.3,
    "forward_dynamics, rod of order 2 with twist": 2.0,
    "forward_dynamics, rod of order 3 with twist and stretch": 3.5,
    "forward_dynamics, 3 rods of order 2 with twist": 6.5,
    "equilibrium, rod of order 2 with twist": 30.0,
    "rollout by rk4, a step, 1 section": 32.0,
    "forward_dynamics of many, 3 sections": 400.0,
    "forward_dynamics of many, 10 sections": 1350.0,
    "Simulator.step": 300.0,
    "linearize, 3 sections": 4.0,
    "linearize, 10 sections": 25.0,
    "linearize, 20 sections": 80.0,
    "equilibrium, two sections, gravity, each draw": 50.0,
    "inverse kinematics, 3 sections": 200.0,
    "ExtendedKalman.update, 3 sections": 40.0,
    "free oscillation, dopri5 rtol 1e-8": 0.6,
    "free oscillation, adams rtol 1e-8": 3.0,
    "free oscillation, bdf rtol 1e-8": 3.0,
    "forward_dynamics from Python": 3.0,
    "simulate: Python over C++": 0.3,
    "identify 10 parameters, 443 poses": 2.0,
    "identify 10 parameters, 6000 samples of a motion at 100 Hz": 20.0,
    "import cdcr after numpy": 100.0,
    "resident memory, import cdcr and one run": 60.0,
}


def make_row(name: str, unit: str, samples: Sequence[float], **extra: Any) -> Row:
    """Sum samples up in a row."""
    p50, p95, p99 = (float(np.percentile(samples, p)) for p in (50, 95, 99))
    return {
        "name": name,
        "unit": unit,
        "p50": p50,
        "p95": p95,
        "p99": p99,
        "min": float(min(samples)),
        "max": float(max(samples)),
        "count": len(samples),
        **extra,
    }


def judged(row: Row) -> Row:
    """Add the target, if the row has one, and whether it is met."""
    target = TARGETS.get(row["name"])
    return row if target is None else {**row, "target": target, "met": row["p50"] <= target}


def ratios(rows: Iterable[Row]) -> list[Row]:
    """How the time of one call grows with the number of sections, from the rows of one run."""
    by = {row["name"]: row for row in rows}
    found = []
    for name in ("forward_dynamics", "inverse_dynamics"):
        small, large = by[f"{name}, 10 sections"], by[f"{name}, 20 sections"]
        new = make_row(f"{name}, 20 sections over 10", "1", [large["p50"] / small["p50"]])
        found.append({**large, **new})
    return found


def append(path: Path, rows: Iterable[Row]) -> None:
    """Add rows to a file of JSON lines."""
    with path.open("a", encoding="utf-8") as file:
        file.writelines(json.dumps(row) + "\n" for row in rows)


def read(path: Path) -> list[Row]:
    """Rows of a file of JSON lines."""
    with path.open(encoding="utf-8") as file:
        return [json.loads(line) for line in file if line.strip()]


def number(value: float | None) -> str:
    """Three digits; large numbers in full."""
    if value is None:
        return ""
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.3g}"


def verdict(row: Row) -> str:
    """Give a row's target in words."""
    if "target" not in row:
        return ""
    return f"<= {number(row['target'])} {'met' if row['met'] else 'MISSED'}"


def layout(header: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """Plain text in columns, the first to the left, the others to the right."""
    widths = [max(len(line[i]) for line in [header, *lines]) for i in range(len(header))]

    def one(line: Sequence[str]) -> str:
        rest = (cell.rjust(width) for cell, width in zip(line[1:], widths[1:], strict=True))
        return "  ".join([line[0].ljust(widths[0]), *rest]).rstrip()

    rule = "  ".join("-" * width for width in widths)
    return "\n".join([one(header), rule, *map(one, lines)])


def table(rows: Iterable[Row]) -> str:
    """Rows of one run as a table."""
    header = ["", "unit", "p50", "p95", "p99", "max", "own", "missed", "error [rad]", "target"]
    lines = [
        [
            row["name"],
            row["unit"],
            *(number(row.get(key)) for key in ("p50", "p95", "p99", "max", "own")),
            f"{row['missed']} of {row['count']}" if "missed" in row else "",
            number(row.get("error")),
            verdict(row),
        ]
        for row in rows
    ]
    return layout(header, lines)


def real_time(rows: Iterable[Row]) -> list[str]:
    """How much faster than real time the fixed-step runs were, and at which step."""
    return [
        f"{row['name']}: {number(row['times real time'])} times real time, "
        f"steps of {1e3 * row['step']:g} ms"
        for row in rows
        if "times real time" in row
    ]


class Spread:
    """One row over several runs: median, smallest and largest of its p50; median of its own."""

    def __init__(self, rows: Sequence[Row]) -> None:
        values = [row["p50"] for row in rows]
        self.row = rows[-1]
        self.runs = len(values)
        self.median = statistics.median(values)
        self.low, self.high = min(values), max(values)
        self.own = statistics.median(row["own"] for row in rows) if "own" in rows[0] else None

    def text(self) -> str:
        """Median and range."""
        return f"{number(self.median)} ({number(self.low)} to {number(self.high)})"


def by_name(rows: Iterable[Row]) -> dict[str, Spread]:
    """Group the rows of several runs."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row["name"], []).append(row)
    return {name: Spread(group) for name, group in groups.items()}
