"""Sizes far from one: forces that overflow, forces of rounding, numbers of few digits."""

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020())


@pytest.mark.parametrize("force", [[1e154, 0.2], [1e308, 1e308], [-1e200, 1e-200], [1e9, 0.0]])
def test_forces_beyond_all_limits_are_not_met(model: cdcr.Model, force: list[float]) -> None:
    found = model.find_tension(force, 0.0, 10.0)
    assert not found.feasible
    # The nearest is where the pull along the force is largest: a corner of the box of tensions.
    B = model.actuation_matrix()
    along = B.T @ (np.array(force) / np.max(np.abs(force)))
    np.testing.assert_array_equal(found.tension, np.where(along > 1e-12, 10.0, 0.0))
    assert np.all(np.isfinite(found.force))


@pytest.mark.parametrize("size", [1e120, 1e200, 1e300])
def test_huge_forces_without_limits_grow_the_tensions_alike(model: cdcr.Model, size: float) -> None:
    force = np.array([0.6, 0.3])
    found = model.find_tension(size * force)
    assert found.feasible
    np.testing.assert_allclose(found.tension / size, model.allocate(force), rtol=1e-12)


def test_gains_that_overflow_end_the_run(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=1e308, ki=1e308, period=1e-3)
    run = cdcr.simulate(model, [2.0, 0.5], [0.0, 0.0], t=[0.0, 0.1], controller=pid)
    assert run.status is cdcr.Status.non_finite_state
    np.testing.assert_array_equal(run.q, [[2.0, 0.5]])
    with pytest.raises(ValueError, match="The state became infinite or not a number"):
        pid.update(0.0, [0.2, 0.0], [0.0, 0.0])


USUAL: dict[str, Any] = {
    "length": 0.3,
    "backbone_mass": 0.01,
    "backbone_diameter": 1e-3,
    "youngs_modulus": 1e10,
}


@pytest.mark.filterwarnings("ignore:section")
@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"length": 1.7e308}, "the robot must be 1e-150 to 1e+150 m long in all, got 1.7e+308"),
        ({"length": 1e-160}, "the robot must be 1e-150 to 1e+150 m long in all, got 1e-160"),
        ({"backbone_diameter": 1e80}, "the stiffness of the robot must be > 0 and finite, got inf"),
        ({"backbone_diameter": 1e-90}, "the stiffness of the robot must be > 0 and finite, got 0"),
        (
            {"backbone_mass": 1e308, "length": 1e3},
            "the inertia of the robot must be finite, got a ",
        ),
        (
            {"disk_mass": 1.0, "disk_diameter": 1e160, "num_disks": 1},
            "the inertia of the robot must be finite, got a mass of 1.01 kg and a size of 1e+160 m",
        ),
    ],
)
def test_a_robot_beyond_all_sizes_has_no_model(given: dict[str, Any], sentence: str) -> None:
    robot = cdcr.Robot(sections=(cdcr.Section(**USUAL | given),))
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}"):
        cdcr.Model(robot)


@pytest.mark.filterwarnings("ignore:section")
@pytest.mark.parametrize("length", [1e-60, 1e60])
def test_a_robot_far_from_all_sizes_has_finite_answers(length: float) -> None:
    scale = length / USUAL["length"]
    given = {"length": length, "backbone_diameter": 1e-3 * scale, "youngs_modulus": 1e10 / scale}
    model = cdcr.Model(cdcr.Robot(sections=(cdcr.Section(**USUAL | given),)))
    assert model.equilibrium().tolist() == [0.0, 0.0]
    assert np.isfinite(model.kinematic_hessian([0.3, 0.2], 0, 1.0)).all()
    assert np.isfinite(model.mass_matrix([0.3, 0.2])).all()


@pytest.mark.parametrize("scale", [1e-5, 5.0])
def test_friction_that_remembers_knows_no_size_of_forces(scale: float) -> None:
    """All forces and masses in other units, and the motion is the same."""
    robot = cdcr.robots.amouri2020(damping=0.02, gravity=(0.0, 0.0, 0.0))
    (section,) = robot.sections
    forces = ("backbone_mass", "disk_mass", "youngs_modulus", "damping")

    def run(by: float) -> cdcr.Trajectory:
        other = replace(
            section, cable_entry_friction=0.1 * by, cable_friction=0.2,
            **{name: by * getattr(section, name) for name in forces},
        )  # fmt: skip
        rubbing = replace(robot, sections=(other,), presliding_stiffness=1e4 * by)
        tension = cdcr.TensionTable([0.0, 0.5, 1.0], by * np.outer([0.0, 3.0, 1.0], [1.0, 0.2, 0]))
        model, t = cdcr.Model(rubbing), np.linspace(0.0, 1.0, 21)
        return cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=t, tension=tension, rtol=1e-9)

    one, other = run(1.0), run(scale)
    assert np.ptp(one.q[:, 0]) > 0.1
    np.testing.assert_allclose(other.q, one.q, atol=1e-6)


def test_a_force_of_rounding_is_met() -> None:
    section = cdcr.Section(
        length=0.2,
        backbone_mass=0.01,
        backbone_diameter=0.002,
        youngs_modulus=1e10,
        cable_radius=0.0347,
        cable_angles=(1.1, 1.1 + math.pi),
    )
    model = cdcr.Model(cdcr.Robot(sections=(section, section)))
    balanced = model.actuation_matrix() @ np.full(4, 20.0)
    assert np.max(np.abs(balanced)) < 1e-14
    assert np.max(model.allocate(balanced)) < 1e-9
    with pytest.raises(cdcr.InfeasibleError):  # across the plane of the cables, a thousand times
        model.allocate([math.sin(1.1) * 1e-11, -math.cos(1.1) * 1e-11, 0.0, 0.0])


def rotation(seed: int) -> Any:
    return np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]


@pytest.mark.parametrize("digits", ["float32", "printed"])
def test_rotations_of_few_digits_are_taken(digits: str) -> None:
    for seed in range(20):
        R = rotation(seed)
        R *= np.sign(np.linalg.det(R))
        given = R.astype(np.float32) if digits == "float32" else np.round(R, 6)
        robot = replace(cdcr.robots.amouri2020(), base_orientation=given.astype(float).tolist())
        found = cdcr.Model(robot).tip([0.0, 0.0])[0]
        np.testing.assert_allclose(found, R, atol=2e-6)
        np.testing.assert_allclose(found.T @ found, np.eye(3), atol=1e-15)


def test_a_target_of_few_digits_is_reached() -> None:
    for robot, section_count in ((cdcr.robots.amouri2020(), 1), (cdcr.robots.three_sections(), 3)):
        model = cdcr.Model(robot)
        rng = np.random.default_rng(5)
        for _ in range(20):
            q = rng.uniform(-0.8, 0.8, model.num_coordinates)
            R, p = model.tip(q)
            single = p.astype(np.float32).astype(float)
            assert model.inverse_kinematics(single).reachable
            if section_count == 3:
                turned = R.astype(np.float32).astype(float)
                assert model.inverse_kinematics(single, turned, q0=q + 0.05).reachable
                assert model.inverse_kinematics(np.round(p, 6), np.round(R, 6), q).reachable
        away = model.tip(q)[1] + [0.0, 0.0, robot.length]
        assert not model.inverse_kinematics(away).reachable


def test_no_command_is_that_of_the_straight_robot_at_rest(model: cdcr.Model) -> None:
    bare = cdcr.Model(
        cdcr.Robot(
            sections=(
                cdcr.Section(
                    length=0.2, backbone_mass=0.01, backbone_diameter=1e-3, youngs_modulus=1e10
                ),
            )
        )
    )
    push = cdcr.Wrench(section=0, force=(0.05, 0.0, 0.0))
    np.testing.assert_array_equal(
        bare.equilibrium(wrenches=push), bare.equilibrium([], wrenches=push)
    )
    np.testing.assert_array_equal(model.equilibrium(None), model.equilibrium(np.zeros(3)))
    assert bare.find_equilibrium().status is cdcr.Status.ok
    q, qd = [0.1, 0.0], [0.2, 0.3]
    for ask in (bare.forward_dynamics, bare.linearize, bare.derivatives):
        for mine, given in zip(ask(q, qd), ask(q, qd, []), strict=True):
            np.testing.assert_array_equal(mine, given)
    np.testing.assert_array_equal(model.static_stiffness(q), model.static_stiffness(q, np.zeros(3)))
    np.testing.assert_array_equal(
        model.modes([0.1, 0.0]).frequency, model.modes([0.1, 0.0], np.zeros(3)).frequency
    )


def test_an_equilibrium_tells_that_friction_was_left_out() -> None:
    rubbing = cdcr.Model(cdcr.scenarios.get("pull-release").robot)
    found = rubbing.find_equilibrium()
    assert found.friction_left_out
    assert repr(found).endswith("friction left out>")
    plain = cdcr.Model(cdcr.robots.amouri2020()).find_equilibrium()
    assert not plain.friction_left_out


@pytest.mark.parametrize("parts", [1, 3, [2, 1, 4]])
def test_wrenches_of_a_subdivided_robot_act_on_the_same_places(parts: Any) -> None:
    robot = cdcr.robots.three_sections()
    model = cdcr.Model(robot)
    fine = cdcr.Model(robot.subdivide(parts))
    q = np.linspace(-0.5, 0.7, model.num_coordinates)
    at = cdcr.subdivide_state(robot, parts, q)
    for section in range(3):
        for fraction in (0.0, 0.2, 0.5, 2.0 / 3.0, 1.0):
            wrench = cdcr.Wrench(section=section, fraction=fraction, force=(1.0, 0.0, 0.0))
            moved = cdcr.subdivide_wrench(robot, parts, wrench)
            for one, other in zip(
                model.pose(q, section, fraction),
                fine.pose(at, moved.section, moved.fraction),
                strict=True,
            ):
                np.testing.assert_allclose(one, other, atol=1e-13)
    with pytest.raises(ValueError, match="section of the wrench must be 0 to 2, got 3"):
        cdcr.subdivide_wrench(robot, parts, cdcr.Wrench(section=3))
