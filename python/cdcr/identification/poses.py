"""Static poses: where tip and markers are when the robot rests under commands."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray
from cdcr.base.check import one_of, require_truth, short
from cdcr.identification.channels import (
    Channel,
    Where,
    check_commands,
    measured,
    row_of,
)
from cdcr.identification.data import (
    MEASURED,
    Noise,
    Side,
    answers_of,
    channels_of,
    check_channels,
    markers_of,
    measured_in,
)
from cdcr.identification.files import read_measured
from cdcr.identification.history import differences, follow
from cdcr.identification.loads import Wrenches
from cdcr.identification.rest import AtRest
from cdcr.identification.setup import Place, Setup

if TYPE_CHECKING:
    from os import PathLike

    from cdcr.robot.robot import Robot

Gaps = Literal["refuse", "skip"]


@dataclass(frozen=True, eq=False)
class Poses(AtRest):
    """Poses of a robot at rest, and what its cables were told.

    Parameters
    ----------
    command : (N, num_cables) array_like
        Tensions [N]; lengths [m] of cables driven by length, or what these are pulled by.
    tip : (N, 3) array_like, optional
        Positions of the tip, or of the robot's tool, in the base frame [m].
    markers : mapping of (int, float) to (N, 3) array_like, optional
        Positions [m] of other places, each a section from 0 and a fraction of its length.
    tension, length : (N, num_cables) array_like, optional
        Measured tensions [N] and lengths [m] of the cables.
    q : (N, d) array_like, optional
        Measured coordinates, in the order of `Model.coordinate_names` [rad], stretch [m].
    base_force, base_moment : (N, 3) array_like, optional
        What the robot does to its base [N], [N m], about where that is and in its frame; the
        drives of its cables stand on it.
    pulled : bool, default False
        Whether commands to cables driven by length say what these are pulled by [m], from where
        the robot is straight.
    wrenches : Wrench or sequence of Wrench, optional
        What loads the robot in all poses.
    history : bool, default False
        Whether the poses follow one another, so that friction remembers the way, as in
        `cdcr.quasi_static`; else each stands for itself, without friction.
    noise : float or mapping of str to float, optional
        Standard deviation of one number of each channel, or of all; found from what is left over
        where not given.
    gaps : {"refuse", "skip"}, optional
        What to do about NaN.
    name : str, optional
        For tables and refusals.

    Raises
    ------
    ValueError
        Naming row and column of what is no number, and arrays that do not fit together.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> command = [[2.0, 0.0, 0.0], [0.0, 4.0, 0.0]]
    >>> tip = [model.tip(model.equilibrium(one))[1] for one in command]
    >>> len(cdcr.identification.Poses(command, tip=tip))
    2
    """

    command: ArrayLike
    _: KW_ONLY
    tip: ArrayLike | None = None
    markers: Mapping[Place, ArrayLike] | None = None
    tension: ArrayLike | None = None
    length: ArrayLike | None = None
    q: ArrayLike | None = None
    base_force: ArrayLike | None = None
    base_moment: ArrayLike | None = None
    pulled: bool = False
    wrenches: Wrenches = ()
    history: bool = False
    noise: Noise = None
    gaps: Gaps = "refuse"
    name: str = "poses"
    where: Where | None = None
    source: Mapping[str, Any] = field(default_factory=dict)
    channels: tuple[Channel, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Keep arrays of numbers, or refuse what is none."""
        if not one_of(self.gaps, ("refuse", "skip")):
            raise ValueError(f"gaps must be 'refuse' or 'skip', got {short(self.gaps)}")
        for name in ("pulled", "history"):
            require_truth(name, getattr(self, name))
        command = measured("command", self.command, (None, None), self._named)
        markers = markers_of(self.markers)
        given = {name: getattr(self, name) for name in MEASURED}
        channels = channels_of(
            given, markers, len(command), self.noise, self._named, gaps=self.gaps == "skip"
        )
        plain = {"command": command, "markers": markers, "channels": channels}
        for name, value in plain.items():
            object.__setattr__(self, name, value)

    @classmethod
    def load(cls, path: str | PathLike[str], robot: Robot, **options: Any) -> Poses:
        """Read poses from a CSV file whose columns have names and units.

        Columns are ``cable 1 [N]`` and so on (``[m]`` for lengths, ``pull 1 [m]`` for what cables
        driven by length are pulled by), ``tip x [m]``, ``marker 1 x [m]``, ``tension 1 [N]``,
        ``length 1 [m]``, ``q1 x [rad]``, ``base force x [N]``, ``base moment x [N m]``; mm, deg
        and ms are read too.

        Parameters
        ----------
        path : path-like
            The file.
        robot : Robot
            Whose cables they are.
        **options
            ``columns``, a mapping of such names to those of the file, the others of which are then
            ignored; ``every``, to take one row of so many; ``markers``, the place of each, as
            (section, fraction); and the options of `Poses`.

        Returns
        -------
        Poses

        Raises
        ------
        FileNotFoundError
            Where there is no such file.
        ValueError
            With file, line and column of what is wrong.
        """
        return cls(**read_measured(path, robot, timed=False, **options))

    @property
    def places(self) -> tuple[Place, ...]:
        """Section and fraction of each marker."""
        return tuple(self.markers or ())

    def _check(self, robot: Robot) -> None:
        """Refuse what does not fit a robot."""
        command = np.asarray(self.command)
        check_commands(command, robot, self._named, self.name, pulled=self.pulled)
        check_channels(self, command, robot, self._named, self.wrenches)

    def _named(self, row: int, column: str) -> str:
        """Name a row and a column, those of the file where they come from one."""
        return (self.where or row_of(self.name))(row, column)

    def _told(self, setup: Setup) -> FloatArray:
        """Return what the cables are told (N, num_cables)."""
        return setup.commands(np.asarray(self.command), pulled=self.pulled)

    def _at(self, setup: Setup, q: FloatArray) -> list[FloatArray]:
        """Return what the model says at shapes q (N, 2n)."""
        return answers_of(
            setup, self.channels, self.places, q, self._told(setup), wrenches=self.wrenches
        )

    def _solve(self, setup: Setup, near: Any) -> FloatArray:
        """Return shapes (N, 2n) at rest."""
        if not self.history:
            return super()._solve(setup, near)
        return follow(setup, self._told(setup), self.wrenches).q

    def _slopes(self, setup: Setup, state: Any, sides: Sequence[Side]) -> list[FloatArray]:
        """Return the derivatives of the answers, (N, k, len(sides)) for each channel."""
        if not self.history:
            return super()._slopes(setup, state, sides)
        return differences(lambda there: self._at(there, self._solve(there, None)), sides)

    def _rows(self, chosen: FloatArray) -> Poses:
        """Return some of the poses; where they have a history, all of them, some measured."""
        if self.history:
            return replace(self, **measured_in(self, np.asarray(chosen, bool)))
        pick = np.flatnonzero(chosen)
        given: dict[str, Any] = {
            name: None if getattr(self, name) is None else np.asarray(getattr(self, name))[pick]
            for name in (*MEASURED, "command")
        }
        given["markers"] = {
            place: np.asarray(one)[pick] for place, one in (self.markers or {}).items()
        }
        given["where"] = lambda row, column: self._named(int(pick[row]), column)
        return replace(self, **given)
