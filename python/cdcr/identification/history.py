"""Poses whose order counts: friction remembers the way from one to the next."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.identification.data import Side, UnsolvedError
from cdcr.identification.loads import Wrenches
from cdcr.identification.setup import Setup
from cdcr.model.quasi_static import QuasiStatic, quasi_static


def follow(setup: Setup, commands: FloatArray, wrenches: Wrenches) -> QuasiStatic:
    """Return the robot as it follows commands (N, num_cables) slowly, or raise UnsolvedError."""
    run = quasi_static(setup.model, commands, wrenches=wrenches, throw=False)
    if run.message:
        raise UnsolvedError(run.message)
    return run


def differences(
    answers: Callable[[Setup], list[FloatArray]], sides: Sequence[Side]
) -> list[FloatArray]:
    """Return the derivatives of answers, (N, k, len(sides)) each, by runs on either side."""
    found = [
        [
            (a - b) / side.width
            for a, b in zip(answers(side.above), answers(side.below), strict=True)
        ]
        for side in sides
    ]
    return [np.stack(columns, axis=-1) for columns in zip(*found, strict=True)]
