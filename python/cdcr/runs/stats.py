"""What runs cost, added up or read back from a file."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from cdcr._core import Stats

STATS = ("steps", "rejected", "evaluations", "jacobians", "newton_failures")


def make_stats(counts: Iterable[int] = (0,) * len(STATS)) -> Stats:
    """Return the cost of a run from its counts, in the order of STATS; zero by default."""
    told: dict[str, Any] = dict(zip(STATS, counts, strict=True))
    return Stats(**told)


def chosen(stats: Stats) -> str:
    """Return what a run by "auto" chose, as an addition to that name; empty for other methods."""
    if stats.method is None:
        return ""
    since = "" if stats.stiff is None else f", stiff from {stats.stiff:.3g} s on"
    return f" ({stats.method}{since})"


def total(costs: Iterable[Stats]) -> Stats:
    """Return what several runs cost together; nothing for none."""
    rows = [[getattr(cost, name) for name in STATS] for cost in costs]
    return make_stats(sum(row[i] for row in rows) for i in range(len(STATS)))
