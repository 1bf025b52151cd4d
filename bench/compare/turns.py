"""Processor time of runs that take turns, and the time that a method needs for an error."""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

LEAST = 0.02  # processor time of one sample [s]


@dataclass
class Entry:
    """A method at a tolerance: its error, and its time for one run in each turn [s]."""

    method: str
    tolerance: float
    error: float
    run: Callable[[], object]
    times: list[float] = field(default_factory=list)
    calls: int = 1

    def sample(self) -> float:
        """Processor time of one run, the threads of this process together."""
        before = time.process_time()
        for _ in range(self.calls):
            self.run()
        return (time.process_time() - before) / self.calls


def measure(entries: Sequence[Entry], turns: int) -> None:
    """Time every entry once a turn, after a first time that says how many runs a sample takes."""
    for entry in entries:
        entry.run()
        entry.calls = max(1, math.ceil(LEAST / max(entry.sample(), 1e-6)))
    for _ in range(turns):
        for entry in entries:
            entry.times.append(entry.sample())


def time_at(entries: Sequence[Entry], error: float, turn: int) -> float | None:
    """Time at an error, between the entries of one method on both sides of it.

    None where it lies outside of them. An entry that another beats in both does not count.
    """
    best: list[tuple[float, float]] = []
    for entry in sorted(entries, key=lambda one: (one.times[turn], one.error)):
        if entry.error > 0.0 and (not best or entry.error < best[-1][0]):
            best.append((entry.error, entry.times[turn]))
    for (large, little), (small, much) in pairwise(best):
        if small <= error <= large:
            share = math.log(error / large) / math.log(small / large)
            return little * (much / little) ** share
    return None


@dataclass
class Spread:
    """Median and range of a number over the turns."""

    values: list[float]

    @property
    def median(self) -> float:
        """Return the middle of them."""
        return statistics.median(self.values)

    def __str__(self) -> str:
        return f"{self.median:.3g} ({min(self.values):.3g} to {max(self.values):.3g})"


def over(
    entries: Sequence[Entry], method: str, others: Sequence[str], error: float
) -> Spread | None:
    """Ratio of the time of a method to that of the best of others at an error, turn by turn."""
    by = {name: [one for one in entries if one.method == name] for name in (method, *others)}
    ratios = []
    for turn in range(len(entries[0].times)):
        mine = time_at(by[method], error, turn)
        theirs = [t for name in others if (t := time_at(by[name], error, turn)) is not None]
        if mine is None or not theirs:
            return None
        ratios.append(mine / min(theirs))
    return Spread(ratios)
