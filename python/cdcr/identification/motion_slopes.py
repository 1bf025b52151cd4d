"""Derivatives of a measured motion by the unknowns: one run, with its sensitivities."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.identification.data import Side, answers_of
from cdcr.identification.loads import under
from cdcr.identification.rest import shifts
from cdcr.identification.setup import Setup
from cdcr.runs.sensitivities import Asked

if TYPE_CHECKING:
    from cdcr.identification.motions import Motion
    from cdcr.runs.trajectory import Trajectory

NOTHING = Asked(())


@dataclass(frozen=True)
class Samples:
    """A run at the times measured: coordinates, rates, tensions and commands."""

    q: FloatArray
    qd: FloatArray
    tension: FloatArray
    command: FloatArray

    @classmethod
    def of(cls, run: Trajectory, rows: FloatArray) -> Samples:
        """Return these rows of a run."""
        return cls(run.q[rows], run.qd[rows], run.tension[rows], run.command[rows])


def motion_slopes(
    motion: Motion, setup: Setup, state: Samples, sides: Sequence[Side]
) -> list[FloatArray]:
    """Return the derivatives of the answers, (N, k, len(sides)) for each channel.

    What is measured changes with the unknowns and along the motion, which is their sum.
    """
    asked = _asked(motion, setup, sides)
    run, rows = motion._run(setup, asked)
    moving = (rows > 0)[:, None]
    tense = any(channel.name == "tension" for channel in motion.channels)
    found: list[list[FloatArray]] = []
    for k, side in enumerate(sides):
        name = asked.names[k]
        late = (side.above.time_shift - side.below.time_shift) / side.width
        still = np.zeros_like(state.qd)
        on_q = run.sensitivities[name][rows, :, 0] - late * np.where(moving, state.qd, still)
        on_qd = run.rate_sensitivities[name][rows, :, 0]
        if late:
            model, wrenches = setup.model, motion.wrenches
            now = state.q, state.qd, state.command
            qdd = under(model.forward_dynamics, now, wrenches, _when(motion, setup, rows))
            on_qd = on_qd - late * np.where(moving, qdd, still)
        ends = []
        for there, share in zip((side.above, side.below), side.shares, strict=True):
            q = state.q + share * side.width * on_q
            qd = state.qd + share * side.width * on_qd
            command = _commands(motion, there, state, rows, setup)
            tension = there.model.cable_tensions(q, qd, command) if tense else None
            shown = there, motion.channels, motion.places, q, command, tension, qd
            ends.append(answers_of(*shown, motion.wrenches, _when(motion, there, rows)))
        found.append([(a - b) / side.width for a, b in zip(*ends, strict=True)])
    return [np.stack(columns, axis=-1) for columns in zip(*found, strict=True)]


def _when(motion: Motion, there: Setup, rows: FloatArray) -> FloatArray:
    """Return the times of the run in another laboratory at which it was measured here."""
    t = np.asarray(motion.t)
    return np.where(rows > 0, t - there.time_shift, t[0])


def _commands(
    motion: Motion, there: Setup, state: Samples, rows: FloatArray, setup: Setup
) -> FloatArray:
    """Return the commands of a run in another laboratory, at the times measured."""
    if not _moves_commands(motion, setup, there):
        return state.command
    t = np.asarray(motion.t)
    wanted = _when(motion, there, rows)
    told = motion._told(there)
    if motion.interpolation == "previous":
        found: FloatArray = told[np.searchsorted(t, wanted, side="right") - 1]
        return found
    return np.stack([np.interp(wanted, t, column) for column in told.T], axis=1)


def _moves_commands(motion: Motion, setup: Setup, there: Setup) -> bool:
    return there.time_shift != setup.time_shift or not np.array_equal(
        motion._told(there), motion._told(setup)
    )


def _asked(motion: Motion, setup: Setup, sides: Sequence[Side]) -> Asked:
    """Return what the run is to be differentiated by: all unknowns, in sizes."""
    names = tuple(str(k) for k in range(len(sides)))

    parameters = _core.ParameterSet.of_sides(
        setup.model,
        [
            (name, side.above.model, side.below.model, side.width)
            for name, side in zip(names, sides, strict=True)
        ],
    )
    told = [(motion._told(one.above) - motion._told(one.below)) / one.width for one in sides]
    t = np.asarray(motion.t)
    slopes = None
    if any(np.any(one) for one in told):
        slopes = t, np.concatenate(told, axis=1), motion.interpolation == "linear"
    d = setup.model.num_coordinates
    start = np.zeros((2 * d, len(sides)))
    held = motion._held(setup)
    if held is not None:
        q = setup.model.find_equilibrium(held, None, motion._wrenches_at_start).q

        def commands(there: Setup) -> FloatArray:
            return np.asarray(motion._held(there))

        for k, shift in enumerate(shifts(setup, q, commands, motion._wrenches_at_start, sides)):
            start[:d, k] = shift
    return Asked(names, parameters, start, slopes)
