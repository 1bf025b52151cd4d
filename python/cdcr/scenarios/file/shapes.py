"""Commands put together from steps, ramps, pulses and sines, smooth between known times."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.runs.command import TensionTable
from cdcr.runs.simulate import simulate
from cdcr.runs.trajectory import Trajectory

# Relative; what sums like 0.1 + 0.2 - 0.3 may lack of zero.
_ROUNDING = 1e-12


class Piece(NamedTuple):
    """A smooth function of time: level + slope (t - since) + amplitude sin(...).

    Its unit is that of the cable's command: N here and below, or m where driven by length.
    """

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


def constant(*, value: float) -> Shape:
    """Return `value` [N] at all times."""
    return Shape((), (Piece(value),))


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
    A cable without shapes is told 0. `break_points` are the times at which the commands jump or
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
                    raise ValueError(f"cable {cable + 1} must have finite commands at all times")
                lowest = min(_lowest(pieces, t) for t in ends)
                scale = sum(abs(piece.level) + piece.amplitude for piece in pieces)
                if lowest < -_ROUNDING * scale:
                    raise ValueError(_pushing(cable, lowest, *ends))

    def __call__(self, t: ArrayLike) -> FloatArray:
        """Return commands (num_cables,) or (N, num_cables) [N], [m] at t or (N,) [s].

        At a jump, the value after it.
        """
        times = np.asarray(t, dtype=np.float64)
        if times.ndim == 0:
            return self._within(bisect_right(self.break_points, float(times)), times)
        command = np.zeros((*times.shape, self.num_cables))
        stretches = np.searchsorted(self.break_points, times, side="right")
        for stretch in np.unique(stretches):
            inside = stretches == stretch
            command[inside] = self._within(int(stretch), times[inside])
        return command

    def table(self, t: FloatArray) -> TensionTable:
        """Return a table with rows at increasing times (N,) [s] and where commands jump or bend."""
        breaks = np.array([one for one in self.break_points if t[0] < one < t[-1]], dtype=float)
        after = np.searchsorted(t, breaks)
        samples = np.concatenate([after - 1, after])
        is_break = np.abs(t[samples] - np.tile(breaks, 2)) <= _ROUNDING * (t[-1] - t[0])
        kept = np.delete(t, samples[is_break])
        times = np.concatenate([kept, breaks, breaks])
        before = [self._within(bisect_right(self.break_points, one) - 1, one) for one in breaks]
        rows = np.concatenate([self(kept), np.reshape(before, (-1, self.num_cables)), self(breaks)])
        order = np.argsort(times, kind="stable")  # rows before a break stay before those after
        return TensionTable(times[order], rows[order])

    def _within(self, stretch: int, times: FloatArray) -> FloatArray:
        command = np.zeros((*times.shape, self.num_cables))
        for cable, pieces in enumerate(self._stretches[stretch]):
            for piece in pieces:
                command[..., cable] += piece(times)
        return np.maximum(command, 0.0)

    def run(
        self, model: Model, q0: ArrayLike, qd0: ArrayLike, t: ArrayLike, **options: Any
    ) -> Trajectory:
        """Run the robot under these commands; see `cdcr.simulate`."""
        return simulate(
            model, q0, qd0, t=t, command=self, break_points=self.break_points, **options
        )


def _lowest(pieces: list[Piece], t: float) -> float:
    return sum(piece.line(t) - abs(piece.amplitude) for piece in pieces)


def _pushing(cable: int, lowest: float, start: float, end: float) -> str:
    when = f"from t = {start:g} s on" if math.isfinite(start) else f"before t = {end:g} s"
    if math.isfinite(start) and math.isfinite(end):
        when = f"between t = {start:g} and {end:g} s"
    return (
        f"cable {cable + 1} would go down to {lowest:g} {when}; what its shapes add up to must be "
        ">= 0 at all times, as a tension or a length (a sine counts with its whole amplitude)"
    )
