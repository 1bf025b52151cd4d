"""The tip's position and orientation, followed: by hand, in loops, in files; refusals."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]

import cdcr
from cdcr.base.arrays import FloatArray
from cdcr.base.rotations import rotation_of
from cdcr.scenarios.file.reader import load_scenario

MODEL = cdcr.Model(cdcr.robots.three_sections(damping=5e-4))
GOAL = [0.5, 0.2, 0.5, 0.1, 0.1, 0.4]
HELD = 4e-3  # of commands held for 1 ms, ten times that seen: of the turns [rad], places less [m]
REACHED = 1e-5  # after a second and a half of a loop with poles at 10/s [m], [rad]


def pose(model: cdcr.Model, q: Any) -> FloatArray:
    R, p = model.tip(q)
    return np.concatenate([p, cdcr.rotation_vector(R)])


def controller(model: cdcr.Model, **options: Any) -> cdcr.TaskSpace:
    return cdcr.TaskSpace(model, damping=1e-4, min_tension=1.0, **options)


def test_rotation_vectors_are_those_of_the_exponential() -> None:
    rng = np.random.default_rng(1)
    vectors = rng.normal(size=(200, 3)) * rng.choice([1e-9, 1e-3, 1.0], size=(200, 1))
    for v in vectors:
        np.testing.assert_allclose(rotation_of(v), Rotation.from_rotvec(v).as_matrix(), atol=1e-14)
    R = Rotation.from_rotvec(vectors).as_matrix()
    expected = Rotation.from_matrix(R).as_rotvec()
    np.testing.assert_allclose(cdcr.rotation_vector(R), expected, atol=1e-13)
    half = cdcr.rotation_vector(np.diag([1.0, -1.0, -1.0]))
    np.testing.assert_allclose(np.abs(half), [np.pi, 0.0, 0.0], atol=1e-14)
    np.testing.assert_array_equal(cdcr.rotation_vector(np.eye(3)), 0.0)
    for wrong, told in (
        (np.eye(2), r"^R must have shape \(\.\.\., 3, 3\), got \(2, 2\)$"),
        (np.eye(3) + 1e-4, "^R must be a rotation matrix"),
        (2.0 * np.eye(3), "^R must be a rotation matrix"),
        (np.diag([1.0, 1.0, -1.0]), "^R must be a rotation matrix"),
    ):
        with pytest.raises(ValueError, match=told):
            cdcr.rotation_vector(wrong)


def test_a_loop_follows_a_path_of_poses_that_check_path_finds_feasible() -> None:
    start = [0.4, 0.1, 0.4, 0.0, 0.2, 0.3]
    path = cdcr.ReferencePath.spline([0.0, 1.0], [pose(MODEL, start), pose(MODEL, GOAL)])
    report = cdcr.check_path(MODEL, path, orientation=True, num_samples=11)
    assert report.feasible
    np.testing.assert_allclose(pose(MODEL, report.q[-1]), pose(MODEL, GOAL), atol=1e-6)
    moving = controller(MODEL, orientation_weight=0.3)
    moving.path = path
    loop = cdcr.Loop(MODEL, pickle.loads(pickle.dumps(moving)))
    hold = MODEL.commands(start, MODEL.allocate(MODEL.potential_gradient(start)))
    loop.reset(start, [0.0] * 6, command=hold)
    run = loop.run(2.5, record_every=100).trajectory
    for t, q in zip(run.t[::5], run.q[::5], strict=True):
        off = pose(MODEL, q) - path.evaluate(t)[0]
        assert np.abs(off).max() < HELD
    np.testing.assert_allclose(pose(MODEL, run.q[-1]), pose(MODEL, GOAL), atol=REACHED)
    with pytest.raises(ValueError, match=r"^path must have 6 values of the tip's pose, got 3$"):
        cdcr.check_path(MODEL, cdcr.ReferencePath.constant([0, 0, 0.3]), orientation=True)


def test_a_scenario_file_may_ask_for_a_pose(tmp_path: Path) -> None:
    wanted = pose(MODEL, GOAL)
    text = f"""
t_end = 1.0
robot = {{name = "three-sections", each_section = {{damping = 0.005}}}}
initial = {{q = [0.5, 0.1, 0.5, 0.1, 0.1, 0.4]}}
[controller]
type = "task-space"
damping = 1e-4
min_tension = 1.0
orientation_weight = [0.3, 0.3, 0.3]
tip = {wanted.tolist()}
[loop]
step = 0.001
[output]
num_samples = 11
"""
    file = tmp_path / "pose.toml"
    file.write_text(text)
    scenario = load_scenario(file)
    run = scenario.simulate()
    np.testing.assert_allclose(pose(MODEL, run.q[-1]), wanted, atol=1e-3)
    values = {metric.key: metric.value for metric in scenario.summary(run)}
    turned = rotation_of(pose(MODEL, run.q[-1])[3:]).T @ rotation_of(wanted[3:])
    off = np.degrees(np.linalg.norm(cdcr.rotation_vector(turned)))
    assert values["turn_end_deg"] == pytest.approx(off, abs=1e-9)
    poses = f"tip = {wanted.tolist()}"
    motion = 'motion = {shape = "spline", t = [0, 1], points = [[0], [1]]}'
    for change, told in (
        (("orientation_weight = [0.3, 0.3, 0.3]\n", ""), "tip must be three numbers, got 6"),
        ((str(wanted.tolist()), "[0.0, 0.0, 0.3]"), "six numbers with orientation_weight, got 3"),
        (("[0.3, 0.3, 0.3]", "[0.3, 0.3]"), "orientation_weight must be one number or three"),
        (("[0.3, 0.3, 0.3]", "-1.0"), "orientation_weight must be >= 0 m/rad and finite, got -1"),
        (
            (poses, motion),
            "controller.motion.points must have rows of 6, as the reference has",
        ),
    ):  # fmt: skip
        file.write_text(text.replace(*change))
        with pytest.raises(ValueError, match=r"pose\.toml") as caught:
            load_scenario(file)
        assert told in str(caught.value)


@pytest.mark.parametrize(
    ("weight", "told"),
    [
        ([1.0, 2.0], "orientation_weight must be one number or three [m/rad], got 2"),
        ([1.0, -1.0, 0.0], "orientation_weight must be >= 0 m/rad and finite, got -1"),
        ("much", "orientation_weight must be numbers, got"),
        (float("nan"), "orientation_weight must be finite, got nan"),
    ],
)
def test_weights_that_do_not_fit(weight: Any, told: str) -> None:
    with pytest.raises(ValueError, match=r"^orientation_weight") as caught:
        cdcr.TaskSpace(MODEL, orientation_weight=weight)
    assert str(caught.value).startswith(told)


def test_rotations_of_few_digits() -> None:
    """Of float32 and of six digits, as `base_orientation` and inverse kinematics take them."""
    vector = np.array([0.4, -0.3, 0.8])
    R = rotation_of(vector)
    for given in (np.float32(R), np.round(R, 6)):
        np.testing.assert_allclose(cdcr.rotation_vector(given), vector, atol=1e-6)
