"""One robot as an environment."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import ArrayLike, NDArray

from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import Check, one_of, short
from cdcr.gym._picture import Picture, Window
from cdcr.gym._randomization import Ranges
from cdcr.gym._task import FAILED, Task
from cdcr.model.model import Model
from cdcr.robot.robot import Robot

Observation = NDArray[np.float32]
Action = NDArray[np.float32]
RENDER_MODES = ("human", "rgb_array")


class RobotEnv(gymnasium.Env[Observation, Action]):
    """A robot whose tip is to reach a target, or to follow one that moves.

    Each step takes the robot through one period of `cdcr.Simulator`, commands held. The target is
    where the tip would be if the robot rested under commands drawn from all that there are; one
    that moves goes round a closed way within three such shapes, in 3 to 6 s. An episode begins
    near rest, up to 0.05 rad and rad/s off it.

    **Action**, -1 to 1 for each cable: none to the largest tension; or, by length, let out to
    pulled in by the largest stroke. **Observation**: q [rad], qd [rad/s], tip, target minus tip,
    and in "track" the velocity of the target; lengths in lengths of the robot, rates clipped at
    100. **Reward** of a step: minus the distance of tip and target, in lengths of the robot, minus
    `control_cost` times the mean square of the commands as shares of their largest. A robot that
    bends beyond 3 pi, or faster than a step can follow, ends the episode with -100; nothing else
    ends it but its number of steps, 200 where Gymnasium makes it by name. **Info**: ``distance``
    [m], ``is_success``, whether that is below 2 % of the robot's length, and the two parts of the
    reward.

    ``reset(options=...)`` takes ``q``, ``qd`` and, in "reach", ``target``, its place [m].

    Parameters
    ----------
    task : {"reach", "track"}, optional
        A target at rest, or one that moves.
    robot : Robot or {"amouri2020", "three_sections"}, optional
        The robot; these two are damped more than those of `cdcr.robots`.
    action : {"tension", "length"}, optional
        What an action is. For lengths, cables that are driven by tension get a stiff drive.
    render_mode : {"rgb_array", "human"}, optional
        Pictures as arrays, or in a window after each step. Needs the extra ``plot``.
    limit : float or (num_cables,) array_like, optional
        Largest tension [N], or largest stroke to either side [m], of all or of each cable; by
        default what bends a cable's last section by 90 degrees, over the number of sections.
    control_cost : float, optional
        Weight of the commands in the reward.
    period : float, optional
        Time of a step [s].
    randomization : mapping, optional
        What differs between episodes, and from where to where it is drawn evenly: factors of
        ``"stiffness"``, ``"damping"`` and ``"mass"``, and ``"payload"`` [kg], such as
        ``{"damping": (0.5, 2.0), "payload": (0.0, 0.02)}``.

    Raises
    ------
    ValueError
        For an argument out of range; the sentence names it.

    Examples
    --------
    >>> from cdcr.gym import RobotEnv
    >>> env = RobotEnv("track", "three_sections")
    >>> observation, info = env.reset(seed=1)
    >>> observation.shape, env.action_space.shape
    ((21,), (9,))
    """

    #: What Gymnasium asks about pictures.
    metadata: dict[str, Any] = {"render_modes": list(RENDER_MODES), "render_fps": 50}  # noqa: RUF012

    def __init__(
        self,
        task: str = "reach",
        robot: str | Robot = "amouri2020",
        action: str = "tension",
        *,
        render_mode: str | None = None,
        limit: ArrayLike | None = None,
        control_cost: float = 0.01,
        period: float = 0.02,
        randomization: Ranges | None = None,
    ) -> None:
        if render_mode is not None and not one_of(render_mode, RENDER_MODES):
            raise ValueError(f"render_mode must be one of {RENDER_MODES}, got {short(render_mode)}")
        self._task = Task(
            1,
            task=task,
            robot=robot,
            action=action,
            limit=limit,
            control_cost=control_cost,
            period=period,
            randomization=randomization,
        )
        self.action_space, self.observation_space = spaces(self._task)
        self.render_mode = render_mode
        self.metadata = self.metadata | {"render_fps": round(1.0 / period)}
        self._active = np.ones(1, dtype=bool)
        self._picture: Picture | None = None
        self._window: Window | None = None

    @property
    def model(self) -> Model:
        """The robot of this episode."""
        return self._task.model_of(0)

    @property
    def q(self) -> FloatArray:
        """Coordinates (d,) [rad, m]."""
        return np.array(self._task.q[0])

    @property
    def qd(self) -> FloatArray:
        """Their rates (d,) [rad/s, m/s]."""
        return np.array(self._task.qd[0])

    @property
    def target(self) -> FloatArray:
        """Where the tip should be (3,) [m]."""
        return np.array(self._task.target[0])

    def command(self, action: ArrayLike) -> FloatArray:
        """Return what an action asks of the cables.

        Parameters
        ----------
        action : (num_cables,) array_like
            -1 to 1 for each cable [-].

        Returns
        -------
        (num_cables,) array
            Tensions [N], or lengths [m].

        Raises
        ------
        ValueError
            For an action of another shape, or that holds anything but numbers.
        """
        drive = self._task.drive
        return drive.command(drive.share(self._checked(action)))

    def _checked(self, action: ArrayLike) -> FloatArray:
        """Return an action as numbers, one for each cable, or refuse it."""
        given = finite(action, "action")
        if given.shape != self.action_space.shape:
            raise ValueError(f"action must have shape {self.action_space.shape}, got {given.shape}")
        return given

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """Begin an episode.

        Parameters
        ----------
        seed : int, optional
            Of the episodes from here on.
        options : dict, optional
            What is given in place of drawn: ``q`` [rad], ``qd`` [rad/s], ``target`` [m].

        Returns
        -------
        tuple
            Observation and info.

        Raises
        ------
        ValueError
            For a seed that is none, and options that are none of those.
        """
        super().reset(seed=seed_of(seed))
        self._task.reset([0], [self.np_random], options)
        if self.render_mode == "human":
            self.render()
        return self._task.observe()[0], self._info()

    def step(self, action: Action) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Take the robot through one period.

        Parameters
        ----------
        action : (num_cables,) array_like
            -1 to 1 for each cable [-]; clipped.

        Returns
        -------
        tuple
            Observation, reward, whether the robot failed, False, and info.

        Raises
        ------
        RuntimeError
            Before the first `reset`.
        ValueError
            For an action of another shape, or that holds anything but numbers.
        """
        parts, failed = self._task.step(self._checked(action)[None], self._active)
        told = {name: float(value[0]) for name, value in parts.items()}
        fails = bool(failed[0])
        reward = FAILED if fails else sum(told.values())
        if self.render_mode == "human":
            self.render()
        return self._task.observe()[0], reward, fails, False, self._info() | told

    def render(self) -> NDArray[np.uint8] | None:
        """Draw the robot, its target and the way of its tip.

        Returns
        -------
        (height, width, 3) array of uint8 or None
            The picture, red, green, blue [0 to 255]; None where it is shown in a window.
        """
        if self.render_mode is None:
            gymnasium.logger.warn("render() shows nothing without a render_mode")
            return None
        self._picture = self._picture or Picture(self._task)
        frame = self._picture.frame(self._task)
        if self.render_mode == "rgb_array":
            return frame
        self._window = self._window or Window(1.0 / self.metadata["render_fps"])
        self._window.show(frame)
        return None

    def close(self) -> None:
        """Close the window."""
        if self._window is not None:
            self._window.close()
        self._picture = self._window = None

    def _info(self) -> dict[str, Any]:
        task = self._task
        return {"distance": float(task.distance[0]), "is_success": bool(task.reached[0])}


def seed_of(seed: object, item: str = "seed") -> int | None:
    """Return a seed, of NumPy too, as Gymnasium takes it, or refuse it."""
    if seed is None:
        return None
    if type(seed) is int and seed >= 0:
        return seed  # of any size, as Gymnasium allows
    check = Check()
    found = check.whole(item, seed, "a whole number >= 0", low=0)
    check.done()
    return found


def spaces(task: Task) -> tuple[Any, Any]:
    """Return the spaces of actions and observations of one robot."""
    bounds = task.bounds.astype(np.float32)
    return Box(-1.0, 1.0, (task.model.num_cables,), np.float32), Box(-bounds, bounds)
