"""A scenario of a user's file: what drives it may be more than a table of tensions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from cdcr.model.model import Model
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.scenario import Scenario

FILES = {"picture": ".png", "csv": ".csv", "nc": ".nc"}
_OPTIONS = ("method", "rtol", "atol", "step", "max_step", "max_steps")


class Drive(Protocol):
    """Something that takes the robot through a run on its own."""

    @property
    def integrates(self) -> bool:
        """Whether equations of motion are integrated."""

    def run(
        self,
        model: Model,
        q0: tuple[float, ...],
        qd0: tuple[float, ...],
        t: NDArray[np.float64],
        **options: Any,
    ) -> Trajectory:
        """Run the robot from a state and sample it at output times (N,) [s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FileScenario(Scenario):
    """A `Scenario` read from a file.

    Parameters
    ----------
    drive : Drive, optional
        In place of tension and controller.
    files : tuple of str
        Suffixes of the files that the command line writes.
    """

    drive: Drive | None = None
    files: tuple[str, ...] = tuple(FILES.values())

    def simulate(
        self, *, t_end: float | None = None, num_samples: int | None = None, **options: Any
    ) -> Trajectory:
        """Run the scenario; see `Scenario.simulate`."""
        if self.drive is None:
            return super().simulate(t_end=t_end, num_samples=num_samples, **options)
        given = [name for name in _OPTIONS if options.get(name) is not None]
        if given and not self.drive.integrates:
            raise ValueError(
                "nothing is integrated along a trajectory without feed_back = true, so it takes "
                f"no {', '.join(given)}"
            )
        times = self.times(t_end, num_samples)
        own = {name: getattr(self, name) for name in _OPTIONS if name not in given}
        if self.wrenches:
            own["wrenches"] = self.wrenches
        model = self.model
        return self.drive.run(model, self.start(model), self.qd0, times, **{**options, **own})
