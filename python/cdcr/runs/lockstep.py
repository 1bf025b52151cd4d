"""Rollouts whose motions go on together, since one function commands all of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite
from cdcr.model.memory import remembers
from cdcr.runs.stats import make_stats, total

if TYPE_CHECKING:
    from cdcr.runs.rollout import Batch

BatchController: TypeAlias = Callable[[float, FloatArray, FloatArray], ArrayLike]


def run_in_lockstep(batch: Batch, function: BatchController, every: int) -> tuple[Any, ...]:
    """Run a rollout whose function is asked each so many steps; as `Batch.run`."""
    rows = batch.record_every
    if batch.steps % every != 0 or (rows % every != 0 and every % rows != 0):
        raise ValueError(
            f"control_every must divide the {batch.steps} steps, and record_every = {rows} or be a "
            f"multiple of it, got {every}"
        )
    if any(map(remembers, batch.models)):
        raise ValueError(
            "controller must not be a function where cables or drives remember, which would forget "
            "from one call to the next: presliding_stiffness and backlash must be 0"
        )
    return _Lockstep(batch, function, every).run()


class _Lockstep:
    """The motions that go on, and the rows so far."""

    def __init__(self, batch: Batch, function: BatchController, every: int) -> None:
        self.batch, self.function, self.every = batch, function, every
        num_rows = batch.steps // batch.record_every + 1
        motions, d = batch.q0.shape
        self.cables = batch.models[0].num_cables
        self.q, self.qd = (np.full((motions, num_rows, d), np.nan) for _ in range(2))
        self.command = np.full((motions, num_rows, self.cables), np.nan)
        self.now = [np.array(batch.q0), np.array(batch.qd0)]
        self.alive = np.arange(motions)
        self.failures: list[tuple[int, _core.Status, str]] = []
        self.cost = make_stats()

    def run(self) -> tuple[Any, ...]:
        """Go through all periods, or as far as Ctrl-C lets it."""
        self.q[:, 0], self.qd[:, 0] = self.now
        step = 0
        try:
            while step < self.batch.steps and len(self.alive) > 0:
                is_stopped = self._advance(step, self._asked(step))
                step += self.every
                if is_stopped:  # by Ctrl-C within it, of which the core tells in this way
                    raise KeyboardInterrupt
                if self.batch.progress is not None:
                    self.batch.progress(step)
        except KeyboardInterrupt:
            told = f"Stopped after {step} steps (interrupted)."
            self.failures += [(int(i), _core.Status.interrupted, told) for i in self.alive]
        return (
            self.q,
            self.qd,
            self.command,
            sorted(self.failures, key=lambda failure: failure[0]),
            self.cost,
        )

    def _asked(self, step: int) -> FloatArray:
        """Return the commands (N, num_cables) that the function gives, 0 to motions that failed."""
        given = self.function(step * self.batch.step, *(np.array(state) for state in self.now))
        shape = (len(self.q), self.cables)
        if len(self.alive) < shape[0] and np.shape(given) == shape:
            given = np.array(given)
            given[np.delete(np.arange(shape[0]), self.alive)] = 0
        command = finite(given, "controller")
        if command.shape != shape:
            raise ValueError(f"controller must give commands of shape {shape}, got {command.shape}")
        if np.min(command, initial=0.0) < 0.0:
            i, j = (int(one[0]) for one in np.nonzero(command < 0.0))
            raise ValueError(
                f"the command of motion {i + 1}, step {step + 1}, cable {j + 1} must be finite and "
                f">= 0 (a cable cannot push), got {command[i, j]:g}"
            )
        return command

    def _advance(self, k: int, command: FloatArray) -> bool:
        """Take all motions that go on through one period, and keep their rows.

        Returns whether that was interrupted.
        """
        batch, alive = self.batch, self.alive
        inner = min(batch.record_every, self.every)
        several = len(batch.models) > 1
        part = replace(
            batch,
            models=[batch.models[int(i)] for i in alive] if several else batch.models,
            q0=self.now[0][alive],
            qd0=self.now[1][alive],
            commands=command[alive, None, :],
            steps=self.every,
            record_every=inner,
            start=k * batch.step,
            progress=None,
        )
        q, qd, _, failures, cost = part.run()
        self.cost = total((self.cost, cost))
        first = -(-k // batch.record_every)  # the row at k or the next
        if k % batch.record_every == 0:
            self.command[alive, first] = command[alive]
        for j in range(1, self.every // inner + 1):
            step = k + j * inner
            if step % batch.record_every == 0:
                row = step // batch.record_every
                self.q[alive, row], self.qd[alive, row] = q[:, j], qd[:, j]
                self.command[alive, row] = command[alive]
        for state, rows in zip(self.now, (q, qd), strict=True):
            state[alive] = rows[:, -1]
        self.failures += [(int(alive[i]), status, message) for i, status, message in failures]
        self.alive = np.delete(alive, [i for i, _, _ in failures])
        return any(status is _core.Status.interrupted for _, status, _ in failures)
