"""A closed loop simulated now: its controller goes on, until somebody takes the cables over."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.view.live import PERIOD, LiveRobot

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot

SOON = 1e-9  # [s]
# A loop around a robot, with what stands in the place of its controller.
LoopMaker = Callable[["Robot", Callable[[_core.TrackingController], _core.Controller]], _core.Loop]


class ByHand(_core.Controller):
    """What a controller asks for, or what a person does.

    Parameters
    ----------
    controller : TrackingController
        The controller.
    """

    def __init__(self, controller: _core.TrackingController) -> None:
        super().__init__(controller.period)
        self._controller = controller
        self.command: FloatArray | None = None

    def reset(self) -> None:
        """Begin a run."""
        self._controller.reset()

    def update(self, t: float, q: FloatArray, qd: FloatArray) -> FloatArray:
        """Return commands (num_cables,) for the next period."""
        return self._controller.update(t, q, qd) if self.command is None else self.command


class LiveLoop(LiveRobot):
    """A closed loop that goes on, with its sensors and its estimator.

    Controller and estimator go on believing in the robot that they were made for, whatever is
    changed of the one that moves; at each such change the estimator begins anew.

    Parameters
    ----------
    make : callable
        Makes the loop around a robot.
    robot, formulation, q, qd, command, start
        As of `LiveRobot`.
    """

    def __init__(self, make: LoopMaker, robot: Robot, formulation: str, **state: Any) -> None:
        self._make, self._by_hand = make, False
        super().__init__(robot, formulation, added_damping=0.0, **state)

    @property
    def steered(self) -> bool:
        """Whether the controller moves the cables, and no person."""
        return not self._by_hand

    @property
    def told(self) -> FloatArray | None:
        """State that the controller is told (d,)."""
        return self._loop.told_q

    def steer(self, cable: int, value: float) -> None:
        """Take the cables over, where they are, and set the command of one."""
        super().steer(cable, value)
        self._by_hand = True
        self._hand.command = self.command

    def _go_on(self, seconds: float, budget: float) -> None:
        end, patience = self.time + seconds, time.perf_counter() + budget
        loop = self._loop
        while loop.time < end - SOON and time.perf_counter() < patience:
            status = loop.step(self._wrenches(loop.q))
            self.message = "" if status.name == "ok" else status.name.replace("_", " ")
            if self.message:  # held where it is
                loop.reset(loop.q, np.zeros_like(loop.q), time=loop.time + PERIOD)
        self.q, self.qd, self.time = loop.q, loop.qd, loop.time
        if not self._by_hand:
            self.command = loop.given

    def _build(self) -> None:
        """Make the loop around the robot as it is now, in the state reached."""
        super()._build()
        hands: list[ByHand] = []

        def around(controller: _core.TrackingController) -> _core.Controller:
            hands.append(ByHand(controller))
            return hands[0]

        self._loop: _core.Loop = self._make(self.robot, around)
        self._hand = hands[0]
        if self._by_hand:
            self._hand.command = self.command
        self._loop.reset(self.q, self.qd, time=self.time)
