"""The node of the page on ROS 2, which is not here: it runs on stand-ins for what it imports.

They have the names and the fields of rclpy and of its messages, and no others.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]

import cdcr

PAGE = Path(__file__).parents[2] / "docs" / "howto" / "ros2.md"
NODE, REPLAY = re.findall(r"^```\{code-block\} python\n(.*?)^```", PAGE.read_text(), re.M | re.S)
TICKS = 50
STEPS = 1e-5  # of Runge-Kutta 4 at 1 ms, by which q is off by 7.5e-7 rad


@dataclass(slots=True)
class Numbers:
    """A point or a quaternion."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    w: float = 1.0


@dataclass(slots=True)
class Header:
    stamp: object = None
    frame_id: str = ""


@dataclass(slots=True)
class Pose:
    position: Numbers = field(default_factory=Numbers)
    orientation: Numbers = field(default_factory=Numbers)


@dataclass(slots=True)
class PoseStamped:
    header: Header = field(default_factory=Header)
    pose: Pose = field(default_factory=Pose)


@dataclass(slots=True)
class JointState:
    header: Header = field(default_factory=Header)
    name: list[str] = field(default_factory=list)
    position: list[float] = field(default_factory=list)
    velocity: list[float] = field(default_factory=list)


@dataclass(slots=True)
class Float64MultiArray:
    data: list[float] = field(default_factory=list)


class Node:
    """Keeps what is published, and what was asked for."""

    made: Node

    def __init__(self, name: str) -> None:
        Node.made = self
        self.published: dict[str, list[Any]] = {}
        self.subscribed: dict[str, Callable[[Any], None]] = {}
        self.timers: list[tuple[float, Callable[[], None]]] = []
        self.told: list[str] = []

    def create_publisher(self, kind: type, topic: str, depth: int) -> Any:
        messages = self.published.setdefault(topic, [])

        def publish(message: Any) -> None:
            assert type(message) is kind
            messages.append(message)

        return SimpleNamespace(publish=publish)

    def create_subscription(self, kind: type, topic: str, take: Any, depth: int) -> None:
        self.subscribed[topic] = take

    def create_timer(self, period: float, call: Callable[[], None]) -> None:
        self.timers.append((period, call))

    def get_logger(self) -> Any:
        return SimpleNamespace(warning=self.told.append, error=self.told.append)

    def get_clock(self) -> Any:
        return SimpleNamespace(now=lambda: SimpleNamespace(to_msg=lambda: "now"))

    def destroy_node(self) -> None:
        self.timers.clear()


@pytest.fixture
def stand_ins(monkeypatch: pytest.MonkeyPatch) -> None:
    modules: dict[str, dict[str, Any]] = {
        "rclpy": {"init": lambda: None, "spin": lambda node: None, "try_shutdown": lambda: None},
        "rclpy.node": {"Node": Node},
        "geometry_msgs.msg": {"PoseStamped": PoseStamped},
        "sensor_msgs.msg": {"JointState": JointState},
        "std_msgs.msg": {"Float64MultiArray": Float64MultiArray},
    }
    for name, contents in modules.items():
        module = ModuleType(name)
        vars(module).update(contents)
        monkeypatch.setitem(sys.modules, name, module)


@pytest.fixture
def page(stand_ins: None) -> dict[str, Any]:
    """Return what the page defines; its node is made, and its timer does not run by itself."""
    names: dict[str, Any] = {}
    exec(compile(NODE.replace("node.destroy_node()", "pass"), "ros2.md", "exec"), names)
    exec(compile(REPLAY, "ros2.md", "exec"), names)
    return names


def test_the_node_simulates_the_robot_and_publishes_it(page: dict[str, Any]) -> None:
    node = Node.made
    ((period, advance),) = node.timers
    tension = [4.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0]
    node.subscribed["~/tension"](Float64MultiArray(tension))
    for _ in range(TICKS):
        advance()
    states, tips = node.published["~/state"], node.published["~/tip"]
    model = cdcr.Model(cdcr.robots.three_sections())
    t = period * np.arange(TICKS + 1)
    run = cdcr.simulate(model, [0.0] * 6, [0.0] * 6, t=t, tension=tension)
    np.testing.assert_allclose([s.position for s in states], run.q[1:], rtol=0.0, atol=STEPS)
    assert np.abs(run.q[-1]).max() > 0.1
    assert all(s.name == ["q1_x", "q1_y", "q2_x", "q2_y", "q3_x", "q3_y"] for s in states)
    for state, tip in zip(states, tips, strict=True):
        R, p = model.tip(state.position)
        at, turn = tip.pose.position, tip.pose.orientation
        assert (tip.header.stamp, tip.header.frame_id) == ("now", "base")
        np.testing.assert_array_equal([at.x, at.y, at.z], p)
        found = Rotation.from_quat([turn.x, turn.y, turn.z, turn.w]).as_matrix()
        np.testing.assert_allclose(found, R, rtol=0.0, atol=1e-14)
        assert {type(value) for value in (at.x, turn.w, *state.position, *state.velocity)} == {
            float
        }
    assert node.told == []


def test_the_node_tells_wrong_tensions_and_goes_on(page: dict[str, Any]) -> None:
    node = Node.made
    for wrong in ([1.0], [-1.0] * 9, [np.nan] * 9):
        node.subscribed["~/tension"](Float64MultiArray(wrong))
    assert node.told == ["needs 9 tensions >= 0 N"] * 3
    node.timers[0][1]()
    assert node.published["~/state"][0].position == [0.0] * 6


def test_a_run_is_played_again_and_again(page: dict[str, Any]) -> None:
    node = Node.made
    model = cdcr.Model(cdcr.robots.three_sections())
    run = cdcr.simulate(model, [0.1] * 6, [0.0] * 6, t=[0.0, 0.1, 0.2])
    page["replay"](node, run)
    period, play = node.timers[-1]
    assert period == 0.1
    for _ in range(4):
        play()
    states = [state.position for state in node.published["~/state"]]
    np.testing.assert_array_equal(states, run.q[[0, 1, 2, 0]])
