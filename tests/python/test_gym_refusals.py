"""What environments of Gymnasium refuse, in a sentence that names the item."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("gymnasium", reason="the extra gym is not installed")

from cdcr.gym import RobotEnv, RobotVectorEnv


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"task": "reech"}, "there is no task 'reech'. Did you mean 'reach'?"),
        ({"robot": "rao2021"}, "there is no robot 'rao2021'. Known: amouri2020, three_sections"),
        ({"action": "force"}, "there is no action 'force'."),
        ({"limit": -1.0}, "limit must be one number > 0 N or 3 of them, got -1.0"),
        ({"limit": [1.0, 2.0]}, "limit must be one number > 0 N or 3 of them, got [1.0, 2.0]"),
        ({"action": "length", "limit": 0.0}, "limit must be one number > 0 m or 3 of them, got 0"),
        (
            {"action": "length", "limit": 20.0},
            "limit must be at most 0.802 m for cable 1, its length on the straight robot, got 20 m",
        ),
        ({"action": "length", "limit": [0.1, 0.2, 0.81]}, "at most 0.802 m for cable 3, its"),
        ({"control_cost": -0.1}, "control_cost must be a number >= 0 and finite, got -0.1"),
        ({"period": 0.0}, "period must be a number 1e-09 to 1000 s, got 0.0"),
        ({"randomization": {"colour": (1, 2)}}, "there is no range of randomization 'colour'."),
        ({"randomization": {"mass": (0.0, 1.0)}}, "must be two numbers > 0, from low to high"),
        ({"randomization": {"payload": (0.2, 0.1)}}, "must be two numbers >= 0, from low to high"),
        ({"randomization": {"payload": 0.2}}, "randomization['payload'] must be two numbers"),
        ({"render_mode": "ascii"}, "render_mode must be one of"),
    ],
)
def test_refusals(given: dict[str, Any], sentence: str) -> None:
    with pytest.raises(ValueError) as refusal:  # noqa: PT011 - what it says is looked at below
        RobotEnv(**given)
    assert sentence in str(refusal.value)


def test_more_refusals() -> None:
    with pytest.raises(TypeError, match=r"robot must be a cdcr\.Robot, got int"):
        RobotEnv(robot=3)  # type: ignore[arg-type]
    bare = replace(cdcr.robots.amouri2020().sections[0], cable_angles=())
    with pytest.raises(ValueError, match="needs cables, and this robot has none"):
        RobotEnv(robot=cdcr.Robot(sections=[bare]))
    env = RobotEnv("track")
    with pytest.raises(ValueError, match="there is no option of reset 'target'"):
        env.reset(options={"target": [0.0, 0.0, 0.8]})
    with pytest.raises(ValueError, match=r"options\['q'\] must have shape \(2,\), got \(3,\)"):
        env.reset(options={"q": [0.0, 0.0, 0.8]})
    env.reset(seed=0)
    for action in ([0.0], np.zeros(4), np.zeros((1, 3)), 0.0):
        with pytest.raises(ValueError, match=r"action must have shape \(3,\), got"):
            env.step(action)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"action\[0\] must be finite, got nan"):
        env.step(np.array([np.nan, 0.0, 0.0], dtype=np.float32))
    with pytest.raises(ValueError, match="num_envs must be a whole number >= 1, got 0"):
        RobotVectorEnv(0)
    with pytest.raises(ValueError, match="max_episode_steps must be a whole number >= 1"):
        RobotVectorEnv(1, max_episode_steps=0)
    with pytest.raises(ValueError, match="render_mode must be 'rgb_array' or None"):
        RobotVectorEnv(1, render_mode="human")
    with pytest.raises(ValueError, match="seed must be one number or 2, got 3"):
        RobotVectorEnv(2).reset(seed=[1, 2, 3])


def test_the_extra_is_named_where_it_is_missing() -> None:
    code = "import sys; sys.modules['gymnasium'] = None; import cdcr; cdcr.gym"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert 'gymnasium is needed for this and could not be imported: pip install "cdcr[gym]"' in (
        run.stderr
    )


def test_a_step_before_the_first_reset() -> None:
    for env in (RobotEnv(), RobotVectorEnv(2)):
        with pytest.raises(RuntimeError, match=r"reset\(\) must be called before the first step"):
            env.step(env.action_space.sample())


def test_actions_and_ranges_that_are_none() -> None:
    env = RobotEnv()
    env.reset(seed=0)
    with pytest.raises(ValueError, match="action must"):
        env.step("a")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"action must have shape \(3,\), got \(2,\)"):
        env.step(np.zeros(2, dtype=np.float32))
    with pytest.raises(ValueError, match=r"randomization must be a mapping .*, got \[1\] \(list\)"):
        RobotEnv(randomization=[1])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("given", "kind", "told"),
    [
        ({"seed": 1.5}, TypeError, r"seed must be a whole number or one of each robot, got 1\.5"),
        ({"seed": "ab"}, TypeError, "seed must be a whole number or one of each robot, got 'ab'"),
        ({"seed": [1]}, ValueError, "seed must be one number or 2, got 1"),
        ({"options": 3}, TypeError, "options must be a mapping, got int"),
        ({"options": {"q": [9.5, 0.0]}}, ValueError, "must bend each section by at most 3 pi"),
    ],
)
def test_a_refused_reset_changes_nothing(
    given: dict[str, Any], kind: type[Exception], told: str
) -> None:
    envs, others = RobotVectorEnv(2), RobotVectorEnv(2)
    for one in (envs, others):
        one.reset(seed=1)
    with pytest.raises(kind, match=told):
        envs.reset(**given)
    still = np.zeros((2, 3), dtype=np.float32)
    np.testing.assert_array_equal(envs.step(still)[0], others.step(still)[0])


@pytest.mark.parametrize("seed", [True, 1.0, -1, "1"])
def test_seeds_are_whole_numbers(seed: Any) -> None:
    with pytest.raises(ValueError, match=r"seed must be a whole number >= 0, got "):
        RobotEnv().reset(seed=seed)
    envs = RobotVectorEnv(2)
    with pytest.raises(ValueError, match=r"seed\[1\] must be a whole number >= 0, got "):
        envs.reset(seed=[1, seed])


def test_seeds_may_be_of_numpy() -> None:
    env, envs = RobotEnv(), RobotVectorEnv(2)
    expected = [env.reset(seed=k)[0] for k in (3, 4)]
    np.testing.assert_array_equal(env.reset(seed=np.int64(3))[0], expected[0])
    np.testing.assert_array_equal(envs.reset(seed=np.array([3, 4]))[0], expected)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^seed must be a whole number >= 0, got True"):
        envs.reset(seed=True)
