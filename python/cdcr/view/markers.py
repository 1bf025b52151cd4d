"""Markers that were measured, shown beside the robot."""

from __future__ import annotations

from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray, finite, numbers
from cdcr.base.check import format_value

WANTED = (
    "markers must be positions (k, 3) that stay, a pair of times (N,) and positions (N, 3) or "
    "(N, k, 3), or a cdcr.identification.Motion"
)


class Markers:
    """Positions over time, on a line between samples; nowhere before, after, and amid a gap.

    Parameters
    ----------
    given : (k, 3) array_like, (t, positions) or Motion
        Positions in the base frame [m]: of markers that stay; a pair of times (N,) [s] and
        positions (N, 3) or (N, k, 3), in which NaN is a gap; or what `cdcr.identification` takes.

    Raises
    ------
    ValueError
        For anything else.
    """

    def __init__(self, given: Any) -> None:
        self.t: FloatArray | None = None
        if hasattr(given, "channels") and hasattr(given, "t"):
            seen = [c.values for c in given.channels if c.name == "tip" or "marker" in c.name]
            if not seen:
                raise ValueError(f"markers must be measured, and {given.name} has none, nor a tip")
            self.t, self.positions = finite(given.t, "markers"), np.stack(seen, axis=1)
        elif isinstance(given, tuple) and len(given) == 2:
            self.t, self.positions = finite(given[0], "times of markers"), numbers(given[1], WANTED)
            if self.positions.ndim == 2:
                self.positions = self.positions[:, None]
        else:
            self.positions = numbers(given, WANTED)[None]
        shape = self.positions.shape
        if len(shape) != 3 or shape[2] != 3 or (self.t is not None and self.t.shape != shape[:1]):
            raise ValueError(f"{WANTED}, got {format_value(given)}")
        if self.t is not None and not (len(self.t) and np.all(np.diff(self.t) > 0.0)):
            raise ValueError("times of markers must increase")

    def at(self, time: float) -> FloatArray:
        """Return where those are (k, 3) that are seen at a time [m]."""
        if self.t is None:
            now = self.positions[0]
        elif not self.t[0] <= time <= self.t[-1]:
            return np.empty((0, 3))
        else:
            right = int(np.searchsorted(self.t, time))
            now = self.positions[right]
            if time < self.t[right]:
                start, end = self.t[right - 1 : right + 1]
                share = (time - start) / (end - start)
                now = (1.0 - share) * self.positions[right - 1] + share * now
        return np.asarray(now[np.isfinite(now).all(axis=1)])
