"""What is to be done: robots whose tips follow targets, any number of them at once."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import Check, known_name, require_kind, short
from cdcr.gym._drive import Drive
from cdcr.gym._randomization import Ranges, checked_ranges, draw_robot
from cdcr.model.memory import remembers
from cdcr.model.model import Model
from cdcr.model.stability import stable_step
from cdcr.robot.robot import Robot
from cdcr.robots import amouri2020, three_sections

# Damped so that they come to rest within an episode.
ROBOTS = {"amouri2020": amouri2020(damping=0.02), "three_sections": three_sections(damping=5e-3)}
TASKS, ACTIONS = ("reach", "track"), ("tension", "length")

MAX_RATE = 100.0  # of observed rates [rad/s]; those of targets [robot lengths/s]
NOISE = 0.05  # of the first state, about rest [rad], [rad/s]
REACHED = 0.02  # distance that counts as success [robot lengths]
FAILED = -100.0  # reward where the robot bends beyond what the model allows
CYCLE = (3.0, 6.0)  # range of the time in which a target goes round its path [s]
LEAST_STEPS = 5  # of Runge-Kutta in a period
SHORTEST, LONGEST = 1e-9, 1e3  # period [s]
STABLE_SHARE = 3.0  # the largest stable step over the one taken
MAX_DRAWS = 20  # of commands, until the robot rests under one
OPTIONS, NO_LOADS = _core.Options(), _core.Loads()
THIRDS = 2.0 * math.pi / 3.0 * np.arange(3)


class Task:
    """Robots after their targets, all of one kind; arrays have a row for each of them.

    The parameters are those of `RobotEnv`.
    """

    def __init__(
        self,
        count: int,
        *,
        task: str,
        robot: str | Robot,
        action: str,
        limit: ArrayLike | None,
        control_cost: float,
        period: float,
        randomization: Ranges | None,
        threads: int = 1,
    ) -> None:
        self.moving = known_name("task", task, TASKS) == "track"
        if isinstance(robot, str):
            robot = ROBOTS[known_name("robot", robot, tuple(ROBOTS))]
        require_kind("robot", robot, Robot)
        self.drive = Drive(robot, known_name("action", action, ACTIONS) == "length", limit)
        check = Check()
        self._cost = check.number("control_cost", control_cost, "a number >= 0 and finite")
        seconds = f"a number {SHORTEST:g} to {LONGEST:g} s"
        self._period = check.number("period", period, seconds)
        if not SHORTEST <= self._period <= LONGEST and not check.sentences:
            check.refuse("period", seconds, period)
        check.done()
        if not 0.0 <= self._cost < math.inf:
            must = "a number >= 0 and finite"
            raise ValueError(f"control_cost must be {must}, got {short(control_cost)}")
        self._ranges = checked_ranges(randomization)
        self.model = Model(self.drive.robot)  # not randomised; its geometry is that of all
        self._length = self.drive.robot.length
        self._base: FloatArray = np.array(self.drive.robot.base_position, dtype=np.float64)
        tool = np.linalg.norm(np.array(self.drive.robot.tool)[:3, 3])
        self._reach = 1.0 + float(tool) / self._length
        self._models = [self.model] * count
        self._substeps = np.full(count, self._substeps_of(self.model))
        self._periods = np.zeros(count, dtype=int)  # since the episode began
        # Of a robot that is the only one, and of those that a rollout would make forget.
        self._by_themselves = count == 1 or remembers(self.model)
        self._simulators: dict[int, _core.Simulator] = {}
        self._threads = threads
        self._bounds = self.bounds
        size = self.model.num_coordinates
        self.q, self.qd = np.zeros((count, size)), np.zeros((count, size))
        self._corners = np.zeros((count, 3, size))  # shapes on the way of the target
        self._phase, self._rate = np.zeros(count), np.zeros(count)
        self.tip, self.target = np.zeros((count, 3)), np.zeros((count, 3))
        self._velocity, self._away = np.zeros((count, 3)), np.zeros((count, 3))
        self.distance = np.zeros(count)  # of tips and targets [m]
        self.episode = np.zeros(count, dtype=int)  # number of the one that each robot is in

    @property
    def bounds(self) -> FloatArray:
        """Largest magnitudes of the numbers of an observation."""
        size = self.model.num_coordinates
        parts = [
            (size, _core.max_bending),
            (size, MAX_RATE),
            (3, self._reach),
            (3, 2.0 * self._reach),
        ]
        parts += [(3, MAX_RATE)] if self.moving else []
        return np.concatenate([np.full(*part) for part in parts])

    def model_of(self, i: int) -> Model:
        """Return the model of a robot in its episode."""
        return self._models[i]

    def reset(
        self,
        robots: Iterable[int],
        rngs: Iterable[np.random.Generator],
        options: Mapping[str, Any] | None,
    ) -> None:
        """Begin an episode of some robots, each with numbers of its own."""
        given = self._checked(options or {})
        for i, rng in zip(robots, rngs, strict=True):
            self._begin(i, rng, given)
        self._update()

    def _begin(self, i: int, rng: np.random.Generator, given: Mapping[str, FloatArray]) -> None:
        if self._ranges:
            self._models[i] = Model(draw_robot(self.drive.robot, self._ranges, rng))
            self._substeps[i] = self._substeps_of(self._models[i])
        rest = self._rest(i, self.model.rest_command())
        self.q[i] = rest + rng.uniform(-NOISE, NOISE, rest.shape)
        self.qd[i] = rng.uniform(-NOISE, NOISE, rest.shape)
        self._corners[i] = [self._drawn_shape(i, rng) for _ in range(3 if self.moving else 1)]
        self._phase[i] = rng.uniform(0.0, 2.0 * math.pi)
        self._rate[i] = 2.0 * math.pi / rng.uniform(*CYCLE)
        self.target[i] = given.get("target", self.model.tips(self._corners[i, 0]))
        self.q[i], self.qd[i] = given.get("q", self.q[i]), given.get("qd", self.qd[i])
        self._periods[i] = 0
        if self._by_themselves:
            steps = int(self._substeps[i])
            simulator = _core.Simulator(self._models[i], step=self._period, substeps=steps)
            simulator.reset(self.q[i], self.qd[i])
            self._simulators[i] = simulator
        self.episode[i] += 1

    def step(
        self, action: ArrayLike, active: NDArray[np.bool_]
    ) -> tuple[dict[str, FloatArray], NDArray[np.bool_]]:
        """Take the active robots through a period; return parts of rewards, and which failed."""
        failed = np.zeros(len(self.q), dtype=bool)
        if not np.all(self.episode):
            raise RuntimeError("reset() must be called before the first step()")
        given = finite(action, "action")
        if given.shape != (len(self.q), self.model.num_cables):
            shape = f"({len(self.q)}, {self.model.num_cables})"
            raise ValueError(f"action must have shape {shape}, got {given.shape}")
        share = self.drive.share(given)
        commands = self.drive.command(share)
        if self._by_themselves:
            for i in np.flatnonzero(active):
                simulator = self._simulators[int(i)]
                failed[i] = simulator.step(commands[i]) != _core.Status.ok
                self.q[i], self.qd[i] = simulator.q, simulator.qd
        else:
            for these in self._groups(active):
                failed[these] = self._advance(these, commands[these])
        self._periods += active & ~failed
        self._update()
        cost = self._cost / share.shape[1]
        parts = {
            "reward_distance": -self.distance / self._length,
            "reward_control": -cost * np.einsum("ij,ij->i", share, share),
        }
        return parts, failed

    def _groups(self, active: NDArray[np.bool_]) -> Iterator[slice | NDArray[np.intp]]:
        """Yield the active robots, those together that take as many Runge-Kutta steps a period."""
        if not self._ranges:
            yield slice(None) if active.all() else np.flatnonzero(active)
            return
        for substeps in np.unique(self._substeps[active]):
            yield np.flatnonzero(active & (self._substeps == substeps))

    def _advance(self, these: slice | NDArray[np.intp], commands: FloatArray) -> Any:
        """Take some robots through a period; return which failed, and stay where they were."""
        alike = isinstance(these, slice) or not self._ranges
        models = [self.model] if alike else [self._models[i] for i in np.asarray(these)]
        q, qd = self.q[these], self.qd[these]
        if len(q) == 0:
            return False
        steps = int(self._substeps[these][0])
        *after, _, failures, _ = _core.rollout(
            models,
            q,
            qd,
            commands[:, None],
            None,
            NO_LOADS,
            _core.Method.rk4,
            OPTIONS,
            self._period / steps,
            steps,
            steps,
            0.0,
            self._threads,
            None,
        )
        if not failures:
            self.q[these], self.qd[these] = after[0][:, -1], after[1][:, -1]
            return False
        if any(status is _core.Status.interrupted for _, status, _ in failures):
            raise KeyboardInterrupt
        failed = np.zeros((len(q), 1), dtype=bool)
        failed[[i for i, _, _ in failures]] = True
        for state, before, rows in ((self.q, q, after[0]), (self.qd, qd, after[1])):
            state[these] = np.where(failed, before, rows[:, -1])
        return failed[:, 0]

    @property
    def reached(self) -> NDArray[np.bool_]:
        """Whether each tip is at its target."""
        return np.asarray(self.distance < REACHED * self._length)

    def observe(self) -> NDArray[np.float32]:
        """Return what is seen of each robot (count, k)."""
        from_base = (self.tip - self._base) / self._length
        parts = [self.q, self.qd, from_base, self._away / self._length]
        parts += [self._velocity / self._length] if self.moving else []
        seen = np.concatenate(parts, axis=1)
        return np.maximum(np.minimum(seen, self._bounds), -self._bounds).astype(np.float32)

    def shapes(self, count: int, rng: np.random.Generator) -> FloatArray:
        """Return shapes (count, d) in which robot 0 may rest [rad]."""
        return np.array([self._drawn_shape(0, rng) for _ in range(count)])

    def _update(self) -> None:
        """Bring tips and targets to the time and state of the robots."""
        self.tip = self.model.tips(self.q)
        if self.moving:
            time = self._periods * self._period
            now, soon = (self._shapes_at(time + ahead) for ahead in (0.0, self._period))
            self.target, later = self.model.tips(np.stack([now, soon]))
            self._velocity = (later - self.target) / self._period
        self._away = self.target - self.tip
        self.distance = np.sqrt(np.einsum("ij,ij->i", self._away, self._away))

    def _shapes_at(self, time: FloatArray) -> FloatArray:
        """Return the shapes (count, d) whose tips the targets are, within their corners."""
        angle = (self._phase + self._rate * time)[:, None] + THIRDS
        weights = (1.0 + np.cos(angle)) / 3.0
        return np.asarray(np.einsum("ik,ikj->ij", weights, self._corners))

    def _drawn_shape(self, i: int, rng: np.random.Generator) -> FloatArray:
        """Return a shape (d,) in which robot i rests under some command."""
        actions = rng.uniform(-1.0, 1.0, (MAX_DRAWS, self.model.num_cables))
        return self._rest(i, *self.drive.command(self.drive.share(actions)))

    def _rest(self, i: int, *commands: FloatArray) -> FloatArray:
        """Return the shape (d,) in which robot i rests under the first of some that has one."""
        for command in commands:
            found = self.model_of(i).find_equilibrium(command)
            if found.status == _core.Status.ok:
                return found.q
        raise ValueError(
            "the robot rests under none of the commands that were tried: choose a smaller limit"
        )

    def _substeps_of(self, model: Model) -> int:
        """Return the Runge-Kutta steps of a period: well below what is stable, all cables taut."""
        taut = self.drive.command(np.full(model.num_cables, 0.5))
        largest = stable_step(model, np.zeros(model.num_coordinates), taut)
        return max(LEAST_STEPS, math.ceil(STABLE_SHARE * self._period / largest))

    def _checked(self, options: Mapping[str, Any]) -> dict[str, FloatArray]:
        """Return the options of `reset`, or refuse them."""
        if not isinstance(options, Mapping):
            raise TypeError(f"options must be a mapping, got {type(options).__name__}")
        size = self.model.num_coordinates
        shapes = {"q": (size,), "qd": (size,)} | ({} if self.moving else {"target": (3,)})
        given = {}
        for name, value in options.items():
            known_name("option of reset", name, tuple(shapes))
            given[name] = finite(value, f"options[{name!r}]")
            if given[name].shape != shapes[name]:
                raise ValueError(
                    f"options[{name!r}] must have shape {shapes[name]}, got {given[name].shape}"
                )
        if "q" in given:
            self.model.tips(given["q"])  # refuses what bends too far, before anything has changed
        return given
