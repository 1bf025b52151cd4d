"""Natural frequencies and damping ratios of a robot at rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, count
from cdcr.identification.channels import (
    Channel,
    check_commands,
    measured,
    noise_levels,
    row_of,
)
from cdcr.identification.data import Noise
from cdcr.identification.loads import Wrenches, check_wrenches
from cdcr.identification.rest import AtRest
from cdcr.identification.setup import Place, Setup
from cdcr.model.model import Model

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot

_NAMES = ("frequency", "damping_ratio")


@dataclass(frozen=True, eq=False)
class Frequencies(AtRest):
    """How a robot vibrates about where it rests under constant commands.

    Parameters
    ----------
    frequency : (M,) array_like, optional
        Natural frequencies [Hz].
    damping_ratio : (M,) array_like, optional
        Of the same vibrations [1].
    command : (num_cables,) array_like
        Tensions [N], or lengths [m], meanwhile.
    mode : sequence of int, optional
        Which vibrations of the model these are, from 0, the slowest; a symmetric robot has two of
        each frequency. By default the first M.
    wrenches : Wrench or sequence of Wrench, optional
        What loads the robot.
    noise : float or mapping of str to float, optional
        Standard deviation of a frequency [Hz], of a damping ratio [1].
    name : str, optional
        For tables and refusals.

    Raises
    ------
    ValueError
        Naming what is no number, and arrays that do not fit together.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> hz = model.modes([0.0, 0.0], [0.0, 0.0, 0.0]).frequency / 6.283185307
    >>> len(cdcr.identification.Frequencies(hz, command=[0.0, 0.0, 0.0]))
    2
    """

    frequency: ArrayLike | None = None
    _: KW_ONLY
    damping_ratio: ArrayLike | None = None
    command: ArrayLike = ()
    mode: Sequence[int] | None = None
    wrenches: Wrenches = ()
    noise: Noise = None
    name: str = "frequencies"
    source: Mapping[str, Any] = field(default_factory=dict)
    channels: tuple[Channel, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Keep arrays of numbers, or refuse what is none."""
        given = {name: getattr(self, name) for name in _NAMES if getattr(self, name) is not None}
        if not given:
            raise ValueError("nothing was measured: give frequency or damping_ratio")
        where = row_of(self.name)
        arrays = {name: measured(name, one, (None,), where) for name, one in given.items()}
        for name, array in arrays.items():
            least = "> 0" if name == "frequency" else ">= 0"
            for row in np.flatnonzero((array < 0.0) | ((array == 0.0) & (name == "frequency")))[:1]:
                raise ValueError(f"{where(int(row), name)} must be {least}, got {array[row]:g}")
        if len({array.size for array in arrays.values()}) > 1:
            raise ValueError("frequency and damping_ratio must have the same shape")
        size = next(iter(arrays.values())).size
        check = Check()
        every = range(size) if self.mode is None else self.mode
        mode = check.items("mode", every, "a sequence of whole numbers >= 0")
        mode = tuple(
            check.whole(f"mode[{i}]", one, "a whole number >= 0", 0) for i, one in enumerate(mode)
        )
        check.done()
        if len(mode) != size:
            raise ValueError(f"mode must have {count(size, 'number')}, one each, got {len(mode)}")
        levels = noise_levels(self.noise, list(arrays))
        units = {"frequency": "Hz", "damping_ratio": ""}
        channels = tuple(
            Channel(name, units[name], array[:, None], levels.get(name))
            for name, array in arrays.items()
        )
        object.__setattr__(self, "mode", mode)
        object.__setattr__(self, "channels", channels)
        object.__setattr__(self, "command", measured("command", self.command, (None,), where))

    @property
    def places(self) -> tuple[Place, ...]:
        """Frequencies need no marker."""
        return ()

    def _named(self, row: int, column: str) -> str:
        """Name the one row of commands."""
        return f"{self.name}, {column}"

    def _check(self, robot: Robot) -> None:
        """Refuse what does not fit a robot."""
        command = np.asarray(self.command)
        if command.shape != (robot.num_cables,):
            raise ValueError(
                f"{self.name}: command must have shape ({robot.num_cables},), got {command.shape}"
            )
        check_commands(command[None, :], robot, self._named, self.name, pulled=False)
        check_wrenches(self.wrenches, robot)
        number = Model(robot).num_coordinates
        for i, mode in enumerate(self.mode or ()):
            if mode >= number:
                raise ValueError(
                    f"{self.name}: mode[{i}] asks for vibration {mode + 1}, and the robot has "
                    f"{number}"
                )
        if robot.mass == 0.0:
            raise ValueError(f"{self.name}: a robot without mass does not vibrate; give it a mass")

    def _told(self, setup: Setup) -> FloatArray:
        """Return what the cables are told (1, num_cables)."""
        return setup.commands(np.asarray(self.command)[None, :], pulled=False)

    def _at(self, setup: Setup, q: FloatArray) -> list[FloatArray]:
        """Return frequencies and damping ratios about the shape q (1, 2n)."""
        modes = setup.model.modes(q[0], self._told(setup)[0], self.wrenches)
        chosen = list(self.mode or ())
        answers = {
            "frequency": modes.frequency_hz[chosen],
            "damping_ratio": modes.damping_ratio[chosen],
        }
        return [answers[channel.name][:, None] for channel in self.channels]

    def _rows(self, chosen: FloatArray) -> Frequencies:
        """Return some of the vibrations."""
        pick = np.flatnonzero(chosen)
        noise = {one.name: one.noise for one in self.channels if one.noise is not None}
        given = {one.name: one.values[pick, 0] for one in self.channels}
        return replace(self, **given, mode=np.array(self.mode)[pick].tolist(), noise=noise)
