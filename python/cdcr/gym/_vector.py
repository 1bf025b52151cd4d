"""Many robots as one environment."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import ArrayLike, NDArray

from cdcr.base.check import Check, short
from cdcr.gym._env import Observation, seed_of, spaces
from cdcr.gym._picture import Picture
from cdcr.gym._randomization import Ranges
from cdcr.gym._task import FAILED, Task
from cdcr.model.model import Model
from cdcr.robot.robot import Robot

Bools = NDArray[np.bool_]


class RobotVectorEnv(VectorEnv[Observation, NDArray[np.float32], NDArray[Any]]):
    """Many robots, each as in `RobotEnv`, whose rewards and observations are computed at once.

    Robot i of a vector environment with seed s goes through the same episodes as a `RobotEnv` with
    seed s + i. A robot whose episode has ended begins anew in the next step, which ignores its
    action (``AutoresetMode.NEXT_STEP``).

    Parameters
    ----------
    num_envs : int, optional
        Number of robots.
    task, robot, action, limit, control_cost, period, randomization : optional
        As in `RobotEnv`.
    max_episode_steps : int, optional
        Steps after which an episode is truncated.
    threads : int, optional
        How many take the robots through a step; 0 for one for each processor. More than one pays
        where steps are long: thousands of robots, or many sections.
    render_mode : {"rgb_array"}, optional
        Pictures as arrays, of each robot. Needs the extra ``plot``.

    Raises
    ------
    ValueError
        For an argument out of range; the sentence names it.

    Examples
    --------
    >>> import gymnasium
    >>> import cdcr.gym
    >>> envs = gymnasium.make_vec("cdcr/Reach-v0", num_envs=8)
    >>> observations, infos = envs.reset(seed=1)
    >>> observations, rewards, terminated, truncated, infos = envs.step(envs.action_space.sample())
    >>> rewards.shape
    (8,)
    """

    #: What Gymnasium asks about pictures and new episodes.
    metadata: dict[str, Any] = {  # noqa: RUF012
        "render_modes": ["rgb_array"],
        "render_fps": 50,
        "autoreset_mode": AutoresetMode.NEXT_STEP,
    }

    def __init__(
        self,
        num_envs: int = 1,
        task: str = "reach",
        robot: str | Robot = "amouri2020",
        action: str = "tension",
        *,
        max_episode_steps: int | None = None,
        render_mode: str | None = None,
        limit: ArrayLike | None = None,
        control_cost: float = 0.01,
        period: float = 0.02,
        randomization: Ranges | None = None,
        threads: int = 1,
    ) -> None:
        check = Check()
        self.num_envs = check.whole("num_envs", num_envs, "a whole number >= 1", low=1)
        if max_episode_steps is not None:
            check.whole("max_episode_steps", max_episode_steps, "a whole number >= 1", low=1)
        check.whole("threads", threads, "a whole number >= 0", low=0)
        check.done()
        if render_mode not in (None, "rgb_array"):
            raise ValueError(f"render_mode must be 'rgb_array' or None, got {short(render_mode)}")
        self._task = Task(
            self.num_envs,
            task=task,
            robot=robot,
            action=action,
            limit=limit,
            control_cost=control_cost,
            period=period,
            randomization=randomization,
            threads=threads,
        )
        self.render_mode = render_mode
        self.metadata = self.metadata | {"render_fps": round(1.0 / period)}
        self.single_action_space, self.single_observation_space = spaces(self._task)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self._most = max_episode_steps or np.iinfo(np.int64).max
        self._steps = np.zeros(self.num_envs, dtype=np.int64)
        self._done = np.zeros(self.num_envs, dtype=bool)
        self._rngs = [seeding.np_random()[0] for _ in range(self.num_envs)]
        self._pictures: list[Picture] = []

    @property
    def model(self) -> Model:
        """The robot without what differs between episodes."""
        return self._task.model

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode of every robot.

        Parameters
        ----------
        seed : int or sequence of int, optional
            Of robot 0, the next number for robot 1, and so on; or one of each robot.
        options : dict, optional
            What is given in place of drawn, to all robots: as in `RobotEnv.reset`.

        Returns
        -------
        tuple
            Observations and infos.
        """
        seeds: list[int | None]
        several: Any = seed  # of any kind, as users may give
        if seed is None or isinstance(seed, (int, np.integer)):
            first = seed_of(seed)
            seeds = [None if first is None else first + i for i in range(self.num_envs)]
        elif isinstance(several, (Sequence, np.ndarray)) and not isinstance(several, (str, bytes)):
            seeds = [seed_of(one, f"seed[{i}]") for i, one in enumerate(several)]
        else:
            raise TypeError(f"seed must be a whole number or one of each robot, got {short(seed)}")
        if len(seeds) != self.num_envs:
            raise ValueError(f"seed must be one number or {self.num_envs}, got {len(seeds)}")
        for i, one in enumerate(seeds):
            if one is not None:
                self._rngs[i] = seeding.np_random(one)[0]
        self._task.reset(range(self.num_envs), self._rngs, options)
        self._steps[:], self._done[:] = 0, False
        return self._task.observe(), self._infos()

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[Observation, NDArray[np.float64], Bools, Bools, dict[str, Any]]:
        """Take every robot through one period, or to a new beginning.

        Parameters
        ----------
        actions : (num_envs, num_cables) array_like
            -1 to 1 for each cable [-]; clipped.

        Returns
        -------
        tuple
            Observations, rewards, which robots failed, whose episodes are over, and infos.

        Raises
        ------
        RuntimeError
            Before the first `reset`.
        ValueError
            For actions of another shape, or that hold anything but numbers.
        """
        again = self._done
        parts, failed = self._task.step(actions, ~again)
        begun = np.flatnonzero(again).tolist()
        self._task.reset(begun, [self._rngs[i] for i in begun], None)
        reward = np.where(failed, FAILED, sum(parts.values()))
        reward[again] = 0.0
        self._steps = np.where(again, 0, self._steps + 1)
        truncated = self._steps >= self._most
        self._done = failed | truncated
        return self._task.observe(), reward, failed, truncated, self._infos(~again, **parts)

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """Draw every robot.

        Returns
        -------
        tuple of (height, width, 3) array of uint8
            The pictures, red, green, blue [0 to 255].
        """
        if self.render_mode is None:
            return None
        self._pictures = self._pictures or [Picture(self._task, i) for i in range(self.num_envs)]
        return tuple(one.frame(self._task) for one in self._pictures)

    def _infos(self, stepped: Bools | None = None, **parts: NDArray[Any]) -> dict[str, Any]:
        """Return what is known of every robot, each with a mask of where it is known."""
        everywhere = np.ones(self.num_envs, dtype=bool)
        infos: dict[str, Any] = {}
        for name, values in {
            "distance": self._task.distance,
            "is_success": self._task.reached,
        }.items():
            infos |= {name: values, f"_{name}": everywhere}
        for name, values in parts.items():
            infos |= {name: values, f"_{name}": stepped}
        return infos
