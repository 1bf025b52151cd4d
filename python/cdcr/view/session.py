"""What is shown when: a run played back, or a robot simulated now. Knows no browser."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, count, format_value
from cdcr.plotting.geometry import Motion, states_at
from cdcr.view.live import (
    LiveModel,
    LiveRobot,
    command_ranges,
    first_damping,
    round_up,
    seconds_of,
)
from cdcr.view.live_loop import LiveLoop, LoopMaker
from cdcr.view.markers import Markers

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot
    from cdcr.runs.trajectory import Trajectory

KEPT = 60.0  # of what was simulated, to look back at [s]
TRAIL, TRAIL_POINTS = 2.0, 60  # how far back the path of the tip is shown [s]
BUDGET = 0.03  # most computing for one picture [s]
DIMMED = 10.0  # full range of a slider over the scale of colours at first


class Moment(NamedTuple):
    """All that is drawn of one time."""

    time: float  # [s]
    q: FloatArray  # (d,)
    tension: FloatArray  # (num_cables,) [N]
    reference: FloatArray | None = None  # (d,)
    estimate: FloatArray | None = None  # (d,)
    markers: FloatArray | None = None  # (k, 3) [m]


class Session:
    """A run that is played, or a robot that is simulated, and the clock of both.

    Parameters
    ----------
    robot : Robot
        The robot.
    formulation : str
        Of the equations of motion.
    run : Trajectory, optional
        The run to play; without one the robot is simulated.
    reference : Trajectory or Reference, optional
        What is shown beside it: anything with times `t`, states `q` and rates `qd`.
    estimate : Trajectory, Reference or LoopRun.told, optional
        What was taken for its state, likewise.
    markers : optional
        What was measured, shown beside it; as `Markers` takes it.
    loop : callable, optional
        Makes the closed loop of the run, which then goes on where the robot is simulated from it.
    speed : float, default 1
        Time simulated or played over real time.
    """

    def __init__(
        self,
        robot: Robot,
        formulation: str = "exact",
        *,
        run: Trajectory | None = None,
        reference: Motion | None = None,
        estimate: Motion | None = None,
        markers: Any = None,
        loop: LoopMaker | None = None,
        speed: float = 1.0,
    ) -> None:
        check = Check()
        self.speed = check.number("speed", speed, "a number > 0 and finite", above=0.0)
        check.done()
        self.run, self.reference, self.estimate = run, reference, estimate
        self.markers = None if markers is None else Markers(markers)
        self.playing, self.time = True, 0.0 if run is None else float(run.t[0])
        self.refusal = ""  # of what was asked last
        self._robot, self._formulation, self._loop = robot, formulation, loop
        self._still = LiveModel(robot, formulation)
        self._require_motion("reference", reference)
        self._require_motion("estimate", estimate)
        self._kept: deque[Moment] = deque()
        self.live: LiveRobot | None = None
        if run is None:
            self.restart()

    def _require_motion(self, name: str, motion: Motion | None) -> None:
        """Refuse what is no motion of this robot."""
        if motion is None:
            return
        if not all(hasattr(motion, part) for part in ("t", "q", "qd")):
            got = format_value(motion)
            raise TypeError(f"{name} must be a cdcr.Trajectory or a cdcr.Reference, got {got}")
        size = self._still.num_coordinates
        if motion.q.shape[1] != size:
            raise ValueError(
                f"{name} must be of a robot of {count(size, 'coordinate')}, got one of "
                f"{motion.q.shape[1]}"
            )

    @property
    def model(self) -> LiveModel:
        """The model of what is shown."""
        return self._still if self.live is None else self.live.model

    @property
    def span(self) -> tuple[float, float]:
        """First and last time that can be shown [s]."""
        if self.live is None:
            assert self.run is not None
            return float(self.run.t[0]), float(self.run.t[-1])
        return self._kept[0].time, self._kept[-1].time

    @property
    def added_damping(self) -> float:
        """Share of critical damping that is added where the robot is simulated."""
        if self.live is not None:
            return self.live.added_damping
        return first_damping(self._robot) if self._loop is None else 0.0

    @property
    def command(self) -> FloatArray:
        """Commands of the cables in what is shown (num_cables,) [N], [m] where by length."""
        if self.live is not None:
            return self.live.command
        assert self.run is not None
        return np.asarray(self.run.command[self._sample(self.time)])

    def ranges(self) -> list[tuple[float, float]]:
        """Range of the command of each cable."""
        commands = self.model.rest_command()[None] if self.run is None else self.run.command
        return command_ranges(self.model, commands)

    @property
    def scale(self) -> float:
        """Tension at the end of a scale of colours: a run's largest, or a share of a slider [N]."""
        tensions = [] if self.run is None else [*self.run.tension.ravel()]
        if not any(tensions):
            driven = [not cable.length_driven for cable in self.model.robot.all_cables]
            tensions = [
                high / DIMMED
                for (_, high), by_tension in zip(self.ranges(), driven, strict=True)
                if by_tension
            ]
        return round_up(max(tensions, default=1.0))

    def attempt(self, task: Callable[[], object]) -> None:
        """Do something that was asked; where a value is refused, keep the sentence and go on.

        Parameters
        ----------
        task : callable
            What to do; a ValueError of it becomes `refusal`.
        """
        self.refusal = ""
        try:
            task()
        except ValueError as refused:
            self.refusal = str(refused)

    def play(self) -> None:
        """Go on; from the start where the end of a run is shown."""
        self.playing = True
        if self.live is not None:
            self.time = self.live.time
        elif self.time >= self.span[1]:
            self.time = self.span[0]

    def seek(self, time: float) -> None:
        """Show another time, and stay there.

        Parameters
        ----------
        time : float
            The time [s]; the nearest in `span` where it lies outside.
        """
        self.time = float(np.clip(seconds_of("time", time), *self.span))
        self.playing = False

    def restart(self) -> None:
        """Begin anew: the run, or the robot at rest without tension, or as the run began."""
        if self.run is not None and self.live is None:
            self.time = self.span[0]
        elif self.run is not None:
            self.time = float(self.run.t[0])
            self.live = None
            self.go_live()
        else:
            self.live = LiveRobot(self._robot, self._formulation)
            self._kept.clear()
            self._keep()
        self.playing = True

    def go_live(self) -> None:
        """Simulate from what is shown of the run."""
        if self.live is not None or self.run is None:
            return
        q, rate = self.moment().q, _rates_at(self.run, self.time)
        state: Any = {"q": q, "qd": rate, "command": self.command, "start": self.time}
        kind = LiveRobot if self._loop is None else partial(LiveLoop, self._loop)
        self.live = kind(self._robot, self._formulation, **state)
        self._kept.clear()
        self._keep()
        self.playing = True

    def go_back(self) -> None:
        """Play the run again, from its start."""
        if self.run is not None:
            self.live = None
            self.restart()

    def pull_to(self, section: int, fraction: float, target: tuple[float, ...]) -> None:
        """Pull a point of the backbone towards a point in space; all goes on live.

        Parameters
        ----------
        section : int
            Index of the section.
        fraction : float
            Fraction of its length.
        target : tuple of float
            The point in space [m].
        """
        self.go_live()
        assert self.live is not None
        self.live.pull_to(section, fraction, target)
        if not self.playing:
            self.play()

    def let_go(self) -> None:
        """Pull no more."""
        if self.live is not None:
            self.live.pull = None

    def advance(self, elapsed: float) -> float:
        """Go on, as fast as `speed` says; a command that is refused is kept out.

        Parameters
        ----------
        elapsed : float
            Real time since the last call [s].

        Returns
        -------
        float
            Time simulated or played [s].
        """
        elapsed = seconds_of("elapsed", elapsed, low=0.0)
        if not self.playing:
            return 0.0
        before = self.time
        if self.live is None:
            self.time = min(self.time + self.speed * elapsed, self.span[1])
            self.playing = self.time < self.span[1]
        else:
            try:
                self.live.advance(self.speed * elapsed, BUDGET)
            except ValueError as refused:
                self.refusal = str(refused)
            self.time = self.live.time
            if self.time > self._kept[-1].time:
                self._keep()
        return self.time - before

    def live_for(self, seconds: float) -> None:
        """Simulate, however long it takes.

        Parameters
        ----------
        seconds : float
            How far [s].
        """
        assert self.live is not None
        self.live.advance(seconds_of("seconds", seconds, low=0.0))
        self.time = self.live.time
        self._keep()

    def moment(self) -> Moment:
        """Return what is shown now."""
        if self.live is not None:
            return self._latest if self.playing else self._at(self.time)
        assert self.run is not None
        q = states_at(self.run, np.array([self.time]))[0]
        tension = self.run.tension[self._sample(self.time)]
        return Moment(self.time, q, tension, *self._beside(self.time))

    def trail(self) -> FloatArray:
        """Return where the tip was lately (TRAIL_POINTS, 3), oldest first [m]."""
        times = np.linspace(max(self.span[0], self.time - TRAIL), self.time, TRAIL_POINTS)
        if self.live is None:
            assert self.run is not None
            return self.model.tips(states_at(self.run, times))
        kept = [m for m in self._kept if times[0] <= m.time <= self.time] or [self.moment()]
        chosen = np.rint(np.linspace(0, len(kept) - 1, TRAIL_POINTS)).astype(int)
        return self.model.tips(np.array([kept[k].q for k in chosen]))

    @property
    def _latest(self) -> Moment:
        assert self.live is not None
        live = self.live
        found = Moment(live.time, live.q, live.tension, *self._beside(live.time))
        unknown = self.estimate is None or live.told is None
        return found if unknown else found._replace(estimate=live.told)

    def _keep(self) -> None:
        self._kept.append(self._latest)
        while self._kept[-1].time - self._kept[0].time > KEPT:
            self._kept.popleft()

    def _at(self, time: float) -> Moment:
        return min(self._kept, key=lambda moment: abs(moment.time - time))

    def _sample(self, time: float) -> int:
        """Return which sample of the run holds at a time."""
        assert self.run is not None
        return max(0, int(np.searchsorted(self.run.t, time, side="right")) - 1)

    def _beside(self, time: float) -> tuple[FloatArray | None, ...]:
        """Return reference, estimate and markers at a time."""
        markers = None if self.markers is None else self.markers.at(time)
        return _state(self.reference, time), _state(self.estimate, time), markers


def _state(motion: Motion | None, time: float) -> FloatArray | None:
    """Return q (d,) at a time, that of the nearer end before and after."""
    if motion is None:
        return None
    return np.asarray(states_at(motion, np.clip([time], motion.t[0], motion.t[-1]))[0])


def _rates_at(run: Trajectory, time: float) -> FloatArray:
    """Return qd (d,) at a time, on a line between samples."""
    return np.array([np.interp(time, run.t, rates) for rates in run.qd.T])
