"""Tensions put together from steps, ramps, pulses and sines, smooth between known times."""

from __future__ import annotations

import math
import warnings
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.runs.simulate import simulate, warn_beyond_taylor_range
from cdcr.runs.stats import total
from cdcr.runs.trajectory import Trajectory

# Relative; what sums like 0.1 + 0.2 - 0.3 may lack of zero.
_ROUNDING = 1e-12


class Piece(NamedTuple):
    """A smooth function of time: level + slope (t - since) + amplitude sin(...)."""

    level: float  # [N]
    since: float = 0.0  # [s]
    slope: float = 0.0  # [N/s]
    amplitude: float = 0.0  # [N]
    frequency: float = 0.0  # [Hz]
    phase: float = 0.0  # at `since` [rad]

    def line(self, t: float) -> float:
        """Return its value without the sine [N]."""
        return self.level + self.slope * (t - self.since) if self.slope else self.level

    def __call__(self, t: FloatArray) -> FloatArray:
        """Return its values at times (...,) [N]."""
        after = t - self.since
        turn = 2.0 * math.pi * self.frequency * after + self.phase
        return self.level + self.slope * after + self.amplitude * np.sin(turn)


class Shape(NamedTuple):
    """A function of time of one cable: constant, pieces between its breaks, constant."""

    breaks: tuple[float, ...]  # times at which it is not smooth, increasing [s]
    pieces: tuple[Piece, ...]  # what it is before, between and after them


def step(*, value: float, at: float = 0.0) -> Shape:
    """Return zero, then `value` [N] from `at` [s] on."""
    return Shape((at,), (Piece(0.0), Piece(value)))


def ramp(*, before: float = 0.0, after: float, start: float = 0.0, end: float) -> Shape:
    """Return `before` [N] until `start`, a line to `after` [N] at `end` [s], which then holds."""
    _require_order(start, end)
    line = Piece(before, start, (after - before) / (end - start))
    return Shape((start, end), (Piece(before), line, Piece(after)))


def pulse(*, value: float, start: float, end: float, base: float = 0.0) -> Shape:
    """Return `value` [N] from `start` until `end` [s], `base` [N] before and after."""
    _require_order(start, end)
    return Shape((start, end), (Piece(base), Piece(value), Piece(base)))


def sine(
    *, mean: float, amplitude: float, frequency: float, phase: float = 0.0, start: float = 0.0
) -> Shape:
    """Return mean + amplitude sin(2 pi frequency (t - start) + phase) from `start` on.

    In N, Hz, rad and s; `mean` before.
    """
    wave = Piece(mean, start, 0.0, amplitude, frequency, phase)
    return Shape((start,), (Piece(mean), wave))


def _require_order(start: float, end: float) -> None:
    if not start < end:
        raise ValueError(f"end must be later than start, {start:g} s, got {end:g} s")


class TensionShapes:
    """Commands of all cables as sums of shapes, never below zero.

    Made of the number of cables, and of pairs: the index of a cable, and what adds to its command.
    A cable without shapes is slack. `break_points` are the times at which the commands jump or
    bend, increasing [s]. Where the shapes of a cable add up to less than zero or are not finite,
    a ValueError names the cable, counted from 1.
    """

    integrates = True

    def __init__(self, num_cables: int, shapes: Iterable[tuple[int, Shape]]) -> None:
        self.num_cables = num_cables
        given = list(shapes)
        self.break_points = tuple(sorted({t for _, shape in given for t in shape.breaks}))
        # Of each stretch between break points, of each cable: the pieces that add up.
        self._stretches: list[list[list[Piece]]] = []
        for left in (-math.inf, *self.break_points):
            cables: list[list[Piece]] = [[] for _ in range(num_cables)]
            for cable, shape in given:
                cables[cable].append(shape.pieces[bisect_right(shape.breaks, left)])
            self._stretches.append(cables)
        self._check()

    def _check(self) -> None:
        edges = (-math.inf, *self.break_points, math.inf)
        for stretch, cables in enumerate(self._stretches):
            ends = edges[stretch : stretch + 2]
            for cable, pieces in enumerate(cables):
                if not np.isfinite([number for piece in pieces for number in piece]).all():
                    raise ValueError(f"cable {cable + 1} must have finite tensions at all times")
                lowest = min(_lowest(pieces, t) for t in ends)
                scale = sum(abs(piece.level) + piece.amplitude for piece in pieces)
                if lowest < -_ROUNDING * scale:
                    raise ValueError(_pushing(cable, lowest, *ends))

    def __call__(self, t: ArrayLike) -> FloatArray:
        """Return tensions (num_cables,) or (N, num_cables) [N] at t or (N,) [s].

        At a jump, the value after it.
        """
        times = np.asarray(t, dtype=np.float64)
        flat = times.ravel()
        tension = np.zeros((flat.size, self.num_cables))
        stretches = np.searchsorted(self.break_points, flat, side="right")
        for stretch in np.unique(stretches):
            inside = stretches == stretch
            tension[inside] = self.within(int(stretch), flat[inside])
        return tension.reshape(*times.shape, self.num_cables)

    def within(self, stretch: int, t: ArrayLike) -> FloatArray:
        """Return the tensions (..., num_cables) [N] of one stretch, its two ends included.

        Stretch 0 is before the first break point, k after the k-th: at a break point, the two
        stretches that meet there give the values before and after.
        """
        times = np.asarray(t, dtype=np.float64)
        tension = np.zeros((*times.shape, self.num_cables))
        for cable, pieces in enumerate(self._stretches[stretch]):
            for piece in pieces:
                tension[..., cable] += piece(times)
        return np.maximum(tension, 0.0)

    def run(
        self,
        model: Model,
        q0: ArrayLike,
        qd0: ArrayLike,
        t: ArrayLike,
        *,
        max_steps: int | None = None,
        **options: Any,
    ) -> Trajectory:
        """Run the robot under these tensions, stretch by stretch; see `cdcr.simulate`.

        An integrator evaluates the tensions at both ends of its steps. A plain function of time has
        only one value at a jump; here each stretch has its own function, so that both sides of a
        jump are exact.
        """
        times = np.asarray(t, dtype=np.float64)
        inner = [b for b in self.break_points if times[0] < b < times[-1]]
        parts: list[Trajectory] = []
        edges = [float(times[0]), *inner, float(times[-1])]
        for start, end in pairwise(edges):
            stretch = bisect_right(self.break_points, start)
            within = times[(times > start) & (times < end)]
            with warn_once():
                part = simulate(
                    model,
                    q0,
                    qd0,
                    t=np.concatenate([[start], within, [end]]),
                    tension=self._source(stretch),
                    max_steps=max_steps,
                    **options,
                )
            parts.append(part)
            if not part.success:
                break
            q0, qd0 = part.q[-1], part.qd[-1]
            if max_steps is not None:
                max_steps = max(1, max_steps - part.stats.steps)
        return self._joined(parts, times)

    def _source(self, stretch: int) -> FloatArray | Callable[[float], FloatArray]:
        """Return what `simulate` takes for one stretch: numbers where nothing changes."""
        pieces = [piece for cable in self._stretches[stretch] for piece in cable]
        if any(piece.slope or piece.amplitude for piece in pieces):
            return partial(self.within, stretch)
        return self.within(stretch, 0.0)

    def _joined(self, parts: list[Trajectory], times: FloatArray) -> Trajectory:
        """Return the parts as one run, sampled at the output times alone."""
        last = parts[-1]
        # A break point stands in two parts, at the end of one and the start of the next.
        before = [slice(0, -1)] * (len(parts) - 1)
        rows = list(zip(parts, [*before, slice(None)], strict=True))
        t = np.concatenate([part.t[row] for part, row in rows])
        q = np.concatenate([part.q[row] for part, row in rows])
        qd = np.concatenate([part.qd[row] for part, row in rows])
        tension = np.concatenate([part.tension[row] for part, row in rows])
        wanted = np.isin(t, times)
        asked = self(t[wanted])
        driven = [cable.length_driven for cable in last.model.robot.all_cables]
        run = Trajectory(
            model=last.model,
            t=t[wanted],
            q=q[wanted],
            qd=qd[wanted],
            tension=np.where(driven, tension[wanted], asked),
            status=last.status,
            message=last.message,
            stats=total(part.stats for part in parts),
            method=last.method,
            command=asked,
            slack_events=tuple(event for part in parts for event in part.slack_events),
        )
        warn_beyond_taylor_range(run.model, run.q)
        return run


@contextmanager
def warn_once() -> Iterator[None]:
    """Keep back the warning about a Taylor formulation, which is given for the run as a whole."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="formulation .* holds for")
        yield


def _lowest(pieces: list[Piece], t: float) -> float:
    return sum(piece.line(t) - abs(piece.amplitude) for piece in pieces)


def _pushing(cable: int, lowest: float, start: float, end: float) -> str:
    when = f"from t = {start:g} s on" if math.isfinite(start) else f"before t = {end:g} s"
    if math.isfinite(start) and math.isfinite(end):
        when = f"between t = {start:g} and {end:g} s"
    return (
        f"cable {cable + 1} would go down to {lowest:g} N {when}; what its shapes add up to must "
        "be >= 0 N at all times (a sine counts with its whole amplitude), since a cable cannot push"
    )
