"""Measurements of a robot at rest: equilibria and their derivatives by the implicit function."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.identification.data import Data, Side, UnsolvedError
from cdcr.identification.loads import Wrenches
from cdcr.identification.setup import Setup


class AtRest(Data):
    """Equilibria q(p) of r(q, p) = dU/dq - Q(q, commands) = 0, one for each row of commands.

    dq/dp = -K^-1 dr/dp, with K the static stiffness; what is measured, y(q, p), changes along
    (dq/dp, 1), by central differences.
    """

    wrenches: Wrenches

    def _told(self, setup: Setup) -> FloatArray:
        """Return what the cables are told (N, num_cables)."""
        raise NotImplementedError

    def _named(self, row: int, column: str) -> str:
        """Name a row and a column."""
        raise NotImplementedError

    def _at(self, setup: Setup, q: FloatArray) -> list[FloatArray]:
        """Return what the model says at shapes q (N, 2n)."""
        raise NotImplementedError

    def _answers(self, setup: Setup, state: Any) -> list[FloatArray]:
        """Return what the model says, an array for each channel."""
        return self._at(setup, state)

    def _solve(self, setup: Setup, near: Any) -> FloatArray:
        """Return shapes (N, 2n) at rest."""
        model, commands = setup.model, self._told(setup)
        shapes = np.empty((len(commands), model.num_coordinates))
        for i, command in enumerate(commands):
            found = model.find_equilibrium(
                command, None if near is None else near[i], self.wrenches
            )
            if found.status is not _core.Status.ok:
                told = _core.status_message(found.status)
                raise UnsolvedError(f"{self._named(i, 'equilibrium')}: {told}")
            shapes[i] = found.q
        return shapes

    def _slopes(self, setup: Setup, state: Any, sides: Sequence[Side]) -> list[FloatArray]:
        """Return the derivatives of the answers, (N, k, len(sides)) for each channel."""
        q: FloatArray = state
        found: list[list[FloatArray]] = []
        for side, shift in zip(
            sides, shifts(setup, q, self._told, self.wrenches, sides), strict=True
        ):
            above, below = side.shares
            high = self._at(side.above, q + above * side.width * shift)
            low = self._at(side.below, q + below * side.width * shift)
            found.append([(a - b) / side.width for a, b in zip(high, low, strict=True)])
        return [np.stack(columns, axis=-1) for columns in zip(*found, strict=True)]


def shifts(
    setup: Setup,
    q: FloatArray,
    told: Callable[[Setup], FloatArray],
    wrenches: Wrenches,
    sides: Sequence[Side],
) -> Iterator[FloatArray]:
    """Yield the derivatives of equilibria q (N, 2n) by each unknown."""

    def imbalance(there: Setup) -> FloatArray:
        model = there.model
        force = model.potential_gradient(q)
        force = force - model.cable_force(q, np.zeros_like(q), told(there))
        return force - model.wrench_force(q, wrenches) if wrenches else force

    stiffness = setup.model.static_stiffness(q, told(setup), wrenches)
    for side in sides:
        change = (imbalance(side.above) - imbalance(side.below)) / side.width
        shift: FloatArray = -np.linalg.solve(stiffness, change[..., None])[..., 0].astype(
            np.float64
        )
        yield shift
