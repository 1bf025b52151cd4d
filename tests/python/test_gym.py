"""Environments of Gymnasium: what they compute, that they repeat, and what their checker says."""

from __future__ import annotations

import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("gymnasium", reason="the extra gym is not installed")
import gymnasium
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

from cdcr.gym import RobotEnv, RobotVectorEnv
from cdcr.gym._randomization import draw_robot

NAMES = ["Reach-v0", "Track-v0", "ReachThreeSections-v0", "TrackThreeSections-v0"]
STEPS = 1e-3  # of the fixed step that an environment takes, tensions; error of q [rad]
FLOAT32 = 1e-5  # of observations
RANDOM = {
    "stiffness": (0.8, 1.25),
    "damping": (0.5, 2.0),
    "mass": (0.9, 1.1),
    "payload": (0.0, 0.02),
}

# States that a batch computes in lanes, beside one by itself.
ROUNDING = 1e-12


def actions_of(env: Any, count: int, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return rng.uniform(-1.0, 1.0, (count, env.action_space.shape[-1])).astype(np.float32)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("action", ["tension", "length"])
def test_the_checker_has_nothing_to_say(name: str, action: str) -> None:
    env = gymnasium.make(f"cdcr/{name}", action=action, randomization=RANDOM)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped, skip_render_check=True)


@pytest.mark.parametrize("name", NAMES)
def test_a_seed_repeats_everything(name: str) -> None:
    def told(seed: int) -> list[Any]:
        env = gymnasium.make(f"cdcr/{name}", randomization=RANDOM)
        found: list[Any] = []
        for begin in (seed, None):
            found.append(env.reset(seed=begin)[0])
            for action in actions_of(env, 5):
                observation, reward, *_ = env.step(action)
                found += [observation, reward]
        return found

    first, again, other = told(3), told(3), told(4)
    for one, two in zip(first, again, strict=True):
        np.testing.assert_array_equal(one, two)
    assert not np.array_equal(first[0], other[0])
    assert not np.array_equal(first[0], first[11])  # the second episode is another


@pytest.mark.parametrize("task", ["reach", "track"])
def test_the_vector_environment_is_that_many_environments(task: str) -> None:
    options: dict[str, Any] = {"task": task, "action": "length", "randomization": RANDOM}
    many = RobotVectorEnv(3, max_episode_steps=4, **options)
    single = [RobotEnv(**options) for _ in range(3)]
    observations, infos = many.reset(seed=5)
    for i, env in enumerate(single):
        observation, info = env.reset(seed=5 + i)
        np.testing.assert_allclose(observations[i], observation, rtol=0.0, atol=ROUNDING)
        assert infos["distance"][i] == pytest.approx(info["distance"], rel=0.0, abs=ROUNDING)
    over = [0, 0, 0]
    for k, action in enumerate(actions_of(many, 11)):
        observations, rewards, failed, truncated, infos = many.step(np.stack([action] * 3))
        for i, env in enumerate(single):
            if k in (4, 9):  # a new episode
                observation, info = env.reset()
                reward = 0.0
                assert not infos["_reward_control"][i]
            else:
                observation, reward, *_, info = env.step(action)
                assert infos["_reward_control"][i]
                assert infos["reward_control"][i] == info["reward_control"]
            np.testing.assert_allclose(observations[i], observation, rtol=0.0, atol=ROUNDING)
            assert rewards[i] == pytest.approx(reward, rel=0.0, abs=ROUNDING)
            assert infos["is_success"][i] == info["is_success"]
            over[i] += int(truncated[i])
        assert not np.any(failed)
        assert np.all(truncated == (k in (3, 8)))
    assert over == [2, 2, 2]


@pytest.mark.parametrize("kind", ["sticking cables", "drives with play"])
def test_a_vector_environment_remembers(kind: str) -> None:
    robot = cdcr.robots.amouri2020(damping=0.05)
    if kind == "sticking cables":
        section = replace(robot.sections[0], cable_friction=0.3)
        robot, action = replace(robot, sections=(section,), presliding_stiffness=1e4), "tension"
    else:
        section = replace(robot.sections[0], cable_stiffness=2e4, cable_backlash=1e-3)
        robot, action = replace(robot, sections=(section,)), "length"
    envs, env = RobotVectorEnv(2, robot=robot, action=action), RobotEnv(robot=robot, action=action)
    envs.reset(seed=4)
    env.reset(seed=5)
    for actions in np.random.default_rng(0).uniform(-1.0, 1.0, (10, 2, 3)).astype(np.float32):
        np.testing.assert_array_equal(envs.step(actions)[0][1], env.step(actions[1])[0])


def test_gymnasium_makes_them_by_name() -> None:
    env = gymnasium.make("cdcr/TrackThreeSections-v0", action="length")
    assert isinstance(env.unwrapped, RobotEnv)
    assert env.unwrapped.model.num_cables == 9
    env.reset(seed=0)
    ends = [env.step(action)[3] for action in actions_of(env, 200)]
    assert ends == [False] * 199 + [True]
    many = gymnasium.make_vec("cdcr/Reach-v0", num_envs=2)
    assert isinstance(many, RobotVectorEnv)
    assert many.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    assert many.observation_space.shape == (2, 10)
    assert many.action_space.shape == (2, 3)
    many.reset(seed=[7, 7])
    actions = np.zeros((2, 3), dtype=np.float32)
    both = [many.step(actions)[3] for _ in range(200)]
    np.testing.assert_array_equal(np.any(both, axis=1), [False] * 199 + [True])
    assert gymnasium.make_vec("cdcr/Reach-v0", 2, vectorization_mode="sync").num_envs == 2
    assert gymnasium.spec("cdcr/Track-v0").to_json()


def test_steps_are_those_of_a_run() -> None:
    env = RobotEnv(robot="three_sections")
    env.reset(seed=1)
    q, qd = env.q, env.qd
    actions = actions_of(env, 20)
    t = 0.02 * np.arange(21)
    rows = np.array([env.command(action) for action in actions])
    table = cdcr.TensionTable(t[:20], rows, "previous")
    run = cdcr.simulate(env.model, q, qd, t=t, tension=table, method="dopri5")
    for k, action in enumerate(actions):
        observation, *_ = env.step(action)
        np.testing.assert_allclose(env.q, run.q[k + 1], rtol=0.0, atol=STEPS)
        np.testing.assert_allclose(observation[:6], env.q, rtol=FLOAT32, atol=FLOAT32)
        np.testing.assert_allclose(observation[6:12], env.qd, rtol=FLOAT32, atol=FLOAT32)
        tip = env.model.tip(env.q)[1] / 0.75  # lengths of the robot
        np.testing.assert_allclose(observation[12:15], tip, rtol=0.0, atol=FLOAT32)
        away = env.target / 0.75 - tip
        np.testing.assert_allclose(observation[15:], away, rtol=0.0, atol=FLOAT32)


def test_a_robot_elsewhere_is_seen_as_at_the_origin() -> None:
    tool = ((1.0, 0.0, 0.0, 0.2), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.3), (0.0, 0.0, 0.0, 1.0))
    arm = replace(cdcr.robots.amouri2020(damping=0.01), tool=tool)
    here, there = (RobotEnv(robot=one) for one in (arm, replace(arm, base_position=(0, 0, 9.0))))
    (seen, _), (same, _) = here.reset(seed=3), there.reset(seed=3)
    np.testing.assert_allclose(same, seen, rtol=0.0, atol=FLOAT32)
    tip = here.model.tip(here.q)[1] / arm.length
    np.testing.assert_allclose(seen[4:7], tip, rtol=0.0, atol=FLOAT32)  # nothing is cut off
    assert here.observation_space.contains(seen)


@pytest.mark.parametrize(
    ("action", "ends"), [("tension", [0.0, 6.0, 12.0]), ("length", [0.01, 0.0, -0.01])]
)
def test_actions_are_commands_and_rewards_add_up(action: str, ends: list[float]) -> None:
    env = RobotEnv(action=action, limit=12.0 if action == "tension" else 0.01, control_cost=0.3)
    asked = [env.command(share * np.ones(3)) for share in (-1.0, 0.0, 1.0)]
    rest = 0.0 if action == "tension" else 0.802
    np.testing.assert_allclose(asked, rest + np.outer(ends, np.ones(3)), rtol=0.0, atol=1e-15)
    np.testing.assert_array_equal(env.command([2.0, -3.0, 0.0]), env.command([1.0, -1.0, 0.0]))
    env.reset(seed=2)
    _, reward, _, _, info = env.step(np.array([1.0, -0.5, 0.2], dtype=np.float32))
    distance = np.linalg.norm(env.model.tip(env.q)[1] - env.target)
    share = np.array([1.0, -0.5, 0.2]) if action == "length" else np.array([1.0, 0.25, 0.6])
    expected = -distance / 0.802 - 0.3 * np.mean(share**2)
    np.testing.assert_allclose(reward, expected, rtol=1e-6)
    np.testing.assert_allclose(info["distance"], distance, rtol=1e-12)
    assert reward == info["reward_distance"] + info["reward_control"]


@pytest.mark.parametrize("action", ["tension", "length"])
def test_who_holds_the_right_command_arrives(action: str) -> None:
    env = RobotEnv(action=action)
    hold = np.array([0.3, -0.4, -0.6], dtype=np.float32)
    target = env.model.tip(env.model.equilibrium(env.command(hold)))[1]
    env.reset(seed=1, options={"target": target, "q": [0.0, 0.0]})
    np.testing.assert_array_equal(env.target, target)
    assert not env.step(hold)[4]["is_success"]
    for _ in range(300):
        info = env.step(hold)[4]
    assert info["is_success"]
    assert info["distance"] < 0.02 * 0.802


def test_targets_that_move_go_round_where_the_tip_can_be() -> None:
    env = RobotEnv("track", "three_sections")
    observation, _ = env.reset(seed=4)
    places, speeds = [env.target], [observation[18:]]
    for _ in range(320):
        observation, *_ = env.step(np.zeros(9, dtype=np.float32))
        places.append(env.target)
        speeds.append(observation[18:])
    moved = np.diff(places, axis=0) / 0.02 / 0.75  # lengths of the robot in a second
    np.testing.assert_allclose(speeds[:-1], moved, rtol=0.0, atol=1e-4)
    assert np.max(np.linalg.norm(moved, axis=1)) > 0.05
    back = np.linalg.norm(np.array(places[150:]) - places[0], axis=1)  # after 3 to 6 s
    assert np.min(back) < 0.02 * np.max(back)
    found = [env.model.inverse_kinematics(place) for place in places[::80]]
    assert all(one.reachable for one in found)


def test_episodes_differ_by_what_is_drawn() -> None:
    env = RobotEnv(robot="three_sections", randomization=RANDOM)
    usual = RobotEnv(robot="three_sections").model.robot
    drawn = []
    for k in range(30):
        env.reset(seed=k)
        robot = env.model.robot
        for section, plain in zip(robot.sections, usual.sections, strict=True):
            shared = section.youngs_modulus / plain.youngs_modulus
            assert shared == robot.sections[0].youngs_modulus / usual.sections[0].youngs_modulus
            assert section.cable_angles == plain.cable_angles
        first, plain = robot.sections[0], usual.sections[0]
        drawn.append(
            (
                first.stiffness / plain.stiffness,
                first.damping / plain.damping,
                first.mass / plain.mass,
                robot.payload,
            )
        )
    for values, (low, high) in zip(np.transpose(drawn), RANDOM.values(), strict=True):
        assert low <= np.min(values) < low + 0.2 * (high - low)
        assert high >= np.max(values) > high - 0.2 * (high - low)


def test_a_robot_that_bends_too_far_ends_the_episode() -> None:
    env = RobotEnv(limit=400.0)
    env.reset(seed=0)
    pull = np.array([1.0, -1.0, -1.0], dtype=np.float32)
    for _ in range(200):
        observation, reward, terminated, truncated, _ = env.step(pull)
        assert env.observation_space.contains(observation)
        assert not truncated
        if terminated:
            break
    assert terminated
    assert reward == -100.0
    many = RobotVectorEnv(2, limit=400.0)
    many.reset(seed=0)
    actions = np.array([[-1.0, -1.0, -1.0], pull], dtype=np.float32)
    steps = [many.step(actions)[1:3] for _ in range(60)]
    ended = np.array([failed for _, failed in steps])
    assert not np.any(ended[:, 0])
    first = int(np.argmax(ended[:, 1]))
    assert ended[first, 1]
    assert not ended[first + 1, 1]
    assert [float(reward[1]) for reward, _ in steps[first : first + 2]] == [-100.0, 0.0]


def test_cables_that_have_a_length_drive_keep_it() -> None:
    section = replace(cdcr.robots.amouri2020().sections[0], cable_stiffness=5e3, damping=0.02)
    robot = cdcr.Robot(sections=[section])
    assert RobotEnv(robot=robot, action="length").model.robot == robot
    driven = RobotEnv(action="length").model.robot
    assert all(cable.length_driven for cable in driven.all_cables)
    with pytest.raises(ValueError, match="action must be 'length' for a robot whose cables"):
        RobotEnv(robot=robot)


def test_pictures_show_what_has_moved() -> None:
    pytest.importorskip("matplotlib")
    env = RobotEnv(render_mode="rgb_array")
    options = {"target": [0.3, 0.0, 0.7], "q": [0.0, 0.0], "qd": [0.0, 0.0]}
    pictures = []
    for _ in range(2):
        env.reset(options=options)
        pictures.append(env.render())
        for _ in range(3):
            env.step(np.array([1.0, -1.0, -1.0], dtype=np.float32))
        pictures.append(env.render())
    first, moved, again, _ = pictures
    assert first is not None
    assert moved is not None
    assert first.shape == (480, 480, 3)
    assert first.dtype == np.uint8
    np.testing.assert_array_equal(first, again)  # no trail of the episode before
    assert 100 < np.count_nonzero(np.any(first != moved, axis=2)) < 20_000
    target = np.all(first == [0xD5, 0x5E, 0x00], axis=2)  # also in the legend
    assert np.count_nonzero(target[60:]) > 10
    env.close()
    many = RobotVectorEnv(2, render_mode="rgb_array")
    many.reset(seed=0)
    frames = many.render()
    assert frames is not None
    assert [frame.shape for frame in frames] == [(480, 480, 3)] * 2


def test_a_window_without_a_screen_is_a_warning(monkeypatch: pytest.MonkeyPatch) -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    before = pyplot.get_backend()
    pyplot.switch_backend("agg")
    try:
        env = RobotEnv(render_mode="human")
        with pytest.warns(UserWarning, match="'human' shows nothing: it needs a screen"):
            env.reset(seed=0)
        assert env.render() is None  # and says so once
        env.close()
        assert pyplot.get_fignums() == []
    finally:
        pyplot.switch_backend(before)


def test_every_strain_of_a_rod_is_drawn() -> None:
    rod = cdcr.Section(
        length=0.3,
        backbone_mass=0.02,
        backbone_diameter=0.006,
        youngs_modulus=2e8,
        shear_modulus=7e7,
        bending_stiffness=0.01,
        bending_order=1,
        twist_order=0,
        stretch_order=0,
        damping=1e-3,
        twist_damping=1e-4,
        material_damping=0.01,
    )
    robot = cdcr.Robot(sections=[rod])
    factors = {"stiffness": 1.3, "damping": 0.6, "mass": 0.9}
    ranges = {name: (factor, factor) for name, factor in factors.items()}
    drawn = draw_robot(robot, ranges, np.random.default_rng(0))
    q, qd = np.array([0.3, 0.1, 0.05, -0.02, 0.1, 1e-3]), np.ones(6)

    def parts(of: cdcr.Robot) -> list[np.ndarray]:
        model = cdcr.Model(of)
        damping = model.bias(q, qd) - model.bias(q, -qd)
        return [model.static_stiffness(q, []), damping, model.mass_matrix(q)]

    for found, plain, factor in zip(parts(drawn), parts(robot), factors.values(), strict=True):
        assert np.abs(found - factor * plain).max() <= 1e-12 * np.abs(found).max()
