"""Sum up the runs kept in one file, or compare those of two.

A row is the median of its p50 over the runs of a file, with the range from smallest to largest.
Two files differ in a row only when their ranges do not overlap.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from rows import Spread, by_name, judged, layout, number, read, verdict


def summary(spreads: dict[str, Spread]) -> str:
    """All rows of one file."""
    header = ["", "unit", "p50", "range", "own", "runs", "error [rad]", "target"]
    lines = [
        [
            name,
            spread.row["unit"],
            number(spread.median),
            f"{number(spread.low)} to {number(spread.high)}",
            number(spread.own),
            str(spread.runs),
            number(spread.row.get("error")),
            verdict(judged({**spread.row, "p50": spread.median})),
        ]
        for name, spread in spreads.items()
    ]
    return layout(header, lines)


def change(before: Spread, after: Spread) -> str:
    """Faster, slower, or nothing to be said."""
    if after.high < before.low:
        return "less"
    return "more" if after.low > before.high else "within the spread"


def difference(before: dict[str, Spread], after: dict[str, Spread]) -> str:
    """Rows that both files have."""
    header = ["", "unit", "before", "after", "ratio", "change"]
    lines = [
        [
            name,
            new.row["unit"],
            old.text(),
            new.text(),
            number(new.median / old.median) if old.median else "",
            change(old, new),
        ]
        for name, new in after.items()
        if (old := before.get(name)) is not None
    ]
    return layout(header, lines)


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("before", type=Path, help="JSON lines written by run.py --out")
    parser.add_argument("after", type=Path, nargs="?", help="the same of another build")
    arguments = parser.parse_args()
    before = by_name(read(arguments.before))
    print(
        difference(before, by_name(read(arguments.after))) if arguments.after else summary(before)
    )


if __name__ == "__main__":
    main()
