"""Motions of bending vectors as those of any robot's coordinates."""

from __future__ import annotations

from dataclasses import dataclass

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.motion.splines import Motion


@dataclass(frozen=True, eq=False)
class _Placed:
    """Coordinates of a robot that bends as a motion says."""

    motion: Motion
    model: Model

    def __call__(self, times: FloatArray) -> FloatArray:
        """Return values, rates and accelerations at times (M,)."""
        return self.model.coordinates(self.motion(times))


def placed(motion: Motion, model: Model) -> Motion:
    """Return a motion of bending vectors as one of a robot's coordinates."""
    return _Placed(motion, model) if model.has_rods else motion
