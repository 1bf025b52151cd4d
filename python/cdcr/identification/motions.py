"""Motions: tracks of tip and markers in time under commands in time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, numbers
from cdcr.base.check import Check, format_value, one_of, require_truth
from cdcr.identification.channels import (
    Channel,
    Where,
    ask_about_times,
    check_commands,
    increasing,
    measured,
    of_numbers,
    row_of,
)
from cdcr.identification.data import (
    MEASURED,
    Data,
    Noise,
    Side,
    UnsolvedError,
    answers_of,
    channels_of,
    check_channels,
    markers_of,
    measured_in,
)
from cdcr.identification.files import read_measured
from cdcr.identification.loads import Wrenches, wrenches_at
from cdcr.identification.motion_slopes import NOTHING, Samples, motion_slopes
from cdcr.identification.setup import Place, Setup
from cdcr.model.memory import remembers
from cdcr.model.model import Model
from cdcr.runs.command import TensionTable
from cdcr.runs.simulate import (
    DEFAULT_METHOD,
    FIXED_STEP,
    MethodName,
    integrator_options,
    simulate,
)

if TYPE_CHECKING:
    from os import PathLike

    from cdcr.identification.poses import Gaps
    from cdcr.robot.robot import Robot
    from cdcr.runs.sensitivities import Asked
    from cdcr.runs.trajectory import Trajectory

SMOOTH = 1e-10  # rtol, so that steps do not show in differences of two runs
# rtol of a run that is asked for its sensitivities. Errors of a run bias the estimates; those of
# its derivatives, a ten-thousandth and less here, move them by as small a share of what noise does.
ROUGH = 1e-5


@dataclass(frozen=True, eq=False)
class Motion(Data):
    """A motion of a robot, sampled, and what its cables were told meanwhile.

    Parameters
    ----------
    t : (N,) array_like
        Times, increasing [s].
    command : (N, num_cables) or (num_cables,) array_like
        Tensions [N], or lengths [m], at these times, or all the time.
    tip, markers, tension, length, q, base_force, base_moment, pulled, wrenches, noise, gaps, name
        As in `Poses`; tensions are those at the base, and wrenches may have profiles over the time.
    start : optional
        How the motion begins: None at rest under the first command; (num_cables,) numbers at rest
        under these commands, which are then let go; a pair ``(q0, qd0)`` [rad], [rad/s] as it says.
    interpolation : {"linear", "previous"}, optional
        Of the commands between the times.
    method, rtol, step : optional
        As in `simulate`, but for an rtol of 1e-10 by default where friction remembers.

    Raises
    ------
    ValueError
        Naming row and column of what is no number, times that do not increase, and arrays that do
        not fit together.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> run = cdcr.simulate(model, [0.5, 0.0], [0.0, 0.0], t=np.linspace(0, 1, 61))
    >>> swing = cdcr.identification.Motion(run.t, [0.0, 0.0, 0.0], tip=run.tip,
    ...                                    start=([0.5, 0.0], [0.0, 0.0]))
    >>> len(swing)
    61
    """

    t: ArrayLike
    command: ArrayLike
    _: KW_ONLY
    tip: ArrayLike | None = None
    markers: Mapping[Place, ArrayLike] | None = None
    tension: ArrayLike | None = None
    length: ArrayLike | None = None
    q: ArrayLike | None = None
    base_force: ArrayLike | None = None
    base_moment: ArrayLike | None = None
    start: Any = None
    pulled: bool = False
    wrenches: Wrenches = ()
    noise: Noise = None
    gaps: Gaps = "refuse"
    interpolation: Literal["linear", "previous"] = "linear"
    method: MethodName = DEFAULT_METHOD
    rtol: float | None = None
    step: float | None = None
    name: str = "motion"
    where: Where | None = None
    source: Mapping[str, Any] = field(default_factory=dict)
    channels: tuple[Channel, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Keep arrays of numbers, or refuse what is none."""
        for name, known in (
            ("gaps", ("refuse", "skip")),
            ("interpolation", ("linear", "previous")),
        ):
            if not one_of(getattr(self, name), known):
                raise ValueError(
                    f"{name} must be {known[0]!r} or {known[1]!r}, got {getattr(self, name)!r}"
                )
        integrator_options(self.method, rtol=self.rtol, step=self.step)
        require_truth("pulled", self.pulled)
        where = self._named
        t = measured("t", self.t, (None,), where)
        if t.size < 2:
            raise ValueError(f"{self.name}: a motion must have at least two times, got {t.size}")
        increasing(t, where)
        ask_about_times(t, where)
        given_command = numbers(self.command, "command must be an array of numbers")
        if given_command.ndim == 1:
            given_command = np.tile(given_command, (len(t), 1))
        command = measured("command", given_command, (len(t), None), where)
        markers = markers_of(self.markers)
        given = {name: getattr(self, name) for name in MEASURED}
        channels = channels_of(given, markers, len(t), self.noise, where, gaps=self.gaps == "skip")
        plain = {"t": t, "command": command, "markers": markers, "channels": channels}
        for name, value in plain.items():
            object.__setattr__(self, name, value)

    @classmethod
    def load(cls, path: str | PathLike[str], robot: Robot, **options: Any) -> Motion:
        """Read a motion from a CSV file; as `Poses.load`, with a column ``t [s]``.

        The file of a run that `Trajectory.save` writes can be read too.

        Parameters
        ----------
        path : path-like
            The file.
        robot : Robot
            Whose cables they are.
        **options
            As in `Poses.load`, and the options of `Motion`.

        Returns
        -------
        Motion

        Raises
        ------
        FileNotFoundError
            Where there is no such file.
        ValueError
            With file, line and column of what is wrong.
        """
        return cls(**read_measured(path, robot, timed=True, **options))

    def until(self, time: float) -> Motion:
        """Return the beginning of the motion: swings of later are easily taken for one another.

        Parameters
        ----------
        time : float
            How long it lasts [s].

        Returns
        -------
        Motion
        """
        t = cast("FloatArray", self.t)
        check = Check()
        time = check.number("time", time, "a number of seconds > 0", above=0.0)
        check.done()
        count = int(np.searchsorted(t, t[0] + time, side="right"))
        names = ("t", "command", *MEASURED)
        given: dict[str, Any] = {
            name: None if getattr(self, name) is None else np.asarray(getattr(self, name))[:count]
            for name in names
        }
        given["markers"] = {
            place: np.asarray(one)[:count] for place, one in (self.markers or {}).items()
        }
        return replace(self, **given)

    @property
    def places(self) -> tuple[Place, ...]:
        """Section and fraction of each marker."""
        return tuple(self.markers or ())

    def _check(self, robot: Robot) -> None:
        """Refuse what does not fit a robot."""
        command = np.asarray(self.command)
        check_commands(command, robot, self._named, self.name, pulled=self.pulled)
        check_channels(self, command, robot, self._named, self.wrenches, over_time=True)
        self._check_start(robot)

    def _check_start(self, robot: Robot) -> None:
        """Refuse commands held before, or a state, that the robot cannot have."""
        kind, value = self._start(robot, Model(robot).num_coordinates)
        if kind == "state":
            for name, one in zip(("q0", "qd0"), value, strict=True):
                measured(name, one, (None,), lambda k, item: f"{self.name}, start, {item}[{k}]")
            return

        def named(_: int, column: str) -> str:
            return f"{self.name}, start, {column}"

        held = measured("command", value[None, :], (None, None), named)
        check_commands(held, robot, named, self.name, pulled=self.pulled)

    def _named(self, row: int, column: str) -> str:
        """Name a row and a column, those of the file where they come from one."""
        return (self.where or row_of(self.name))(row, column)

    def _start(self, robot: Robot, num_q: int) -> tuple[str, Any]:
        """Return how the motion begins: 'held' with commands, or 'state' with q0 and qd0."""
        if self.start is None:
            return "held", np.asarray(self.command)[0]
        if of_numbers(self.start) and np.shape(self.start) == (robot.num_cables,):
            return "held", np.asarray(self.start, float)
        if isinstance(self.start, tuple) and all(map(of_numbers, self.start)):
            state = tuple(np.asarray(one, float) for one in self.start)
            if [one.shape for one in state] == [(num_q,), (num_q,)]:
                return "state", state
        raise ValueError(
            f"{self.name}: start must be None, {robot.num_cables} commands, or a pair (q0, qd0) of "
            f"{num_q} numbers each, got {format_value(self.start)}"
        )

    def _solve(self, setup: Setup, near: Any) -> Samples:
        """Return shapes, rates, tensions and commands at the times measured."""
        return Samples.of(*self._run(setup))

    def _told(self, setup: Setup) -> FloatArray:
        """Return what the cables are told (N, num_cables)."""
        return setup.commands(np.asarray(self.command), pulled=self.pulled)

    def _held(self, setup: Setup) -> FloatArray | None:
        """Return the commands under which the robot rests at the start; None where it does not."""
        kind, value = self._start(setup.robot, setup.model.num_coordinates)
        return setup.commands(value, pulled=self.pulled) if kind == "held" else None

    def _times(self, setup: Setup) -> FloatArray:
        """Return the time of the run at which each row was measured [s]."""
        t = cast("FloatArray", self.t)
        times: FloatArray = np.maximum(t - setup.time_shift, t[0])
        return times  # before the start it is as it begins

    @property
    def _wrenches_at_start(self) -> Wrenches:
        return wrenches_at(self.wrenches, float(np.asarray(self.t)[0]))

    def _run(self, setup: Setup, by: Asked = NOTHING) -> tuple[Trajectory, FloatArray]:
        """Return a run, and which of its rows each time measured is."""
        model = setup.model
        held = self._held(setup)
        if held is not None:
            found = model.find_equilibrium(held, None, self._wrenches_at_start)
            if found.status is not _core.Status.ok:
                raise UnsolvedError(f"{self._named(0, 'equilibrium')}: no start at rest was found")
            q0, qd0 = found.q, np.zeros(model.num_coordinates)
        else:
            q0, qd0 = self._start(setup.robot, model.num_coordinates)[1]
        t = cast("FloatArray", self.t)
        commands = self._told(setup)
        wanted = self._times(setup)
        moving = wanted > t[0]
        times = np.concatenate([[t[0]], wanted[moving]])
        if not np.ptp(commands, axis=0).any():
            asked: Any = commands[0]
        else:
            asked = TensionTable(t, commands, self.interpolation)
        fixed = self.method in FIXED_STEP
        step = self.step if fixed else None
        rtol = None if fixed else self.rtol or (SMOOTH if remembers(model) else None)
        if by.names and not fixed:
            rtol = max(self.rtol or ROUGH, ROUGH)
        run = simulate(
            model, q0, qd0, t=times, command=asked, wrenches=self.wrenches,
            method=self.method, rtol=rtol, step=step, sensitivities=by,
        )  # fmt: skip
        if not run.success:
            raise UnsolvedError(f"{self.name}: {run.message}")
        return run, np.where(moving, np.cumsum(moving), 0)

    def _answers(self, setup: Setup, state: Samples) -> list[FloatArray]:
        """Return what the model says, an array for each channel."""
        return answers_of(
            setup, self.channels, self.places, state.q, state.command, state.tension, state.qd,
            self.wrenches, self._times(setup),
        )  # fmt: skip

    def _slopes(self, setup: Setup, state: Samples, sides: Sequence[Side]) -> list[FloatArray]:
        """Return the derivatives of the answers, from one run with its sensitivities.

        By differences of runs where friction or play remembers, of which there are none.
        """
        if not remembers(setup.model):
            return motion_slopes(self, setup, state, sides)
        here = self._answers(setup, state)
        found: list[list[FloatArray]] = []
        for side in sides:
            there = self._answers(side.above, self._solve(side.above, None))
            found.append([(a - b) / side.step for a, b in zip(there, here, strict=True)])
        return [np.stack(columns, axis=-1) for columns in zip(*found, strict=True)]

    def _rows(self, chosen: FloatArray) -> Motion:
        """Return the same motion, measured at some times alone."""
        return replace(self, **measured_in(self, np.asarray(chosen, bool)))
