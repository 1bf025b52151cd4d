"""The residuals of a fit and their derivatives, shared by the search, its errors and designs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.processes import usable
from cdcr.identification.data import Data, Side, UnsolvedError
from cdcr.identification.parameter import Unknown, put_all
from cdcr.identification.setup import Plain, Setup, setup_of

T = TypeVar("T")
STEP = 1e-4  # of the size of an unknown, to either side: errors of 1e-8, of runs 1e-4


class Problem:
    """Measurements and unknowns, and the model's answers at values of these.

    Values are counted in sizes of the unknowns from their starts, so that all are about one.
    """

    def __init__(self, data: Sequence[Data], plain: Plain, unknowns: Sequence[Unknown]) -> None:
        self.data, self.unknowns = list(data), list(unknowns)
        self._plain = plain
        self.size = np.array([unknown.size for unknown in unknowns])
        self.origin = np.array([unknown.start for unknown in unknowns])
        self.low = (np.array([unknown.low for unknown in unknowns]) - self.origin) / self.size
        self.high = (np.array([unknown.high for unknown in unknowns]) - self.origin) / self.size
        self.noise = [[channel.noise or 1.0 for channel in one.channels] for one in data]
        self.evaluations = 0
        self._kept: tuple[FloatArray, Setup, list[Any], list[list[FloatArray]]] | None = None
        self._near: list[Any] = [None] * len(self.data)

    def values(self, x: FloatArray) -> FloatArray:
        """Return the unknowns themselves."""
        found: FloatArray = self.origin + x * self.size
        return found

    def counted(self, values: FloatArray) -> FloatArray:
        """Return values of the unknowns, counted in their sizes from their starts."""
        found: FloatArray = (values - self.origin) / self.size
        return found

    def setup(self, x: FloatArray, like: Setup | None = None) -> Setup:
        """Return the laboratory at values of the unknowns."""
        return setup_of(put_all(self._plain, self.unknowns, self.values(x)), like)

    def answers(self, x: FloatArray) -> tuple[Setup, list[Any], list[list[FloatArray]]]:
        """Return laboratory, states and answers, for each data and channel; or raise."""
        if self._kept is None or not np.array_equal(self._kept[0], x):
            self.evaluations += 1
            setup = self.setup(x, self._kept[1] if self._kept else None)
            _ = setup.model  # once, before threads ask for it
            states = self._each(lambda one, near: one._solve(setup, near), self._near)
            answers = self._each(lambda one, state: one._answers(setup, state), states)
            self._kept = x.copy(), setup, states, answers
            self._near = states
        return self._kept[1:]

    def _each(self, do: Callable[[Data, Any], T], beside: Sequence[Any]) -> list[T]:
        """Return what is done for each of the data, several side by side: runs need no Python."""
        threads = min(len(self.data), usable())
        if threads == 1:
            return list(map(do, self.data, beside))
        with ThreadPoolExecutor(threads) as pool:
            return list(pool.map(do, self.data, beside))

    def forget(self) -> None:
        """Begin elsewhere: states found so far are no help there."""
        self._near = [None] * len(self.data)

    def residuals(self, x: FloatArray) -> FloatArray:
        """Return (answer - measurement)/noise, one after another, and those of the priors.

        Where the model has no answer they are NaN: the search then steps less far.
        """
        try:
            _, _, answers = self.answers(x)
        except (UnsolvedError, ValueError):
            return np.full(self.num_residuals, np.nan)
        return np.concatenate([*self.parts(answers), self._priors(x)])

    @property
    def noise_is_given(self) -> bool:
        """Whether the noise of every channel was given."""
        return all(channel.noise is not None for one in self.data for channel in one.channels)

    @property
    def num_residuals(self) -> int:
        """How many residuals there are, priors among them."""
        return self.num_measurements + sum(one.prior is not None for one in self.unknowns)

    @property
    def num_measurements(self) -> int:
        """How many numbers were measured."""
        return sum(int(np.isfinite(c.values).sum()) for one in self.data for c in one.channels)

    def parts(self, answers: list[list[FloatArray]]) -> list[FloatArray]:
        """Return the residuals of each channel of each data, without those not measured."""
        return [
            ((answer - channel.values) / noise)[np.isfinite(channel.values)]
            for one, given, levels in zip(self.data, answers, self.noise, strict=True)
            for channel, answer, noise in zip(one.channels, given, levels, strict=True)
        ]

    def _priors(self, x: FloatArray) -> FloatArray:
        known = [(k, one.prior) for k, one in enumerate(self.unknowns) if one.prior is not None]
        values = self.values(x)
        return np.array([(values[k] - mean) / deviation for k, (mean, deviation) in known])

    def jacobian(self, x: FloatArray) -> FloatArray:
        """Return the derivatives of the residuals by x."""
        setup, states, _ = self.answers(x)
        sides = [self._side(x, k, setup) for k in range(x.size)]
        blocks = []
        every = self._each(lambda one, state: one._slopes(setup, state, sides), states)
        for one, slopes, levels in zip(self.data, every, self.noise, strict=True):
            for channel, slope, noise in zip(one.channels, slopes, levels, strict=True):
                blocks.append(slope[np.isfinite(channel.values)] / noise)
        rows = [k for k, one in enumerate(self.unknowns) if one.prior is not None]
        priors = np.zeros((len(rows), x.size))
        for row, k in enumerate(rows):
            prior = self.unknowns[k].prior
            assert prior is not None
            priors[row, k] = self.size[k] / prior[1]
        derivatives: FloatArray = np.concatenate([*blocks, priors])
        return derivatives

    def _side(self, x: FloatArray, k: int, setup: Setup) -> Side:
        """Return laboratories on either side in one unknown, both within its bounds."""
        # Half of the way to a bound at most: no robot may have what lies there.
        up, down = min(STEP, 0.5 * (self.high[k] - x[k])), min(STEP, 0.5 * (x[k] - self.low[k]))
        if up < STEP / 4:  # at the upper bound: one below, taken for the one above
            up, down = -STEP, 0.0
        elif down < STEP / 4:
            down = 0.0
        above = self.setup(_moved(x, k, up), setup)
        below = self.setup(_moved(x, k, -down), setup) if down else setup
        return Side(above, below, up, up + down)


def _moved(x: FloatArray, k: int, by: float) -> FloatArray:
    moved: FloatArray = x.copy()
    moved[k] += by
    return moved
