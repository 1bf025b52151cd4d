"""The wrench on the base: along a run against the robot's momentum, told by loops, in files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray
from cdcr.scenarios.file.reader import load_scenario

ROUNDING = 1e-12
# Momentum of slices and disks, by differences of positions half a millisecond apart.
SUMMED = 1e-5
ROBOT = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), damping=5e-3, payload=0.02)
MODEL = cdcr.Model(ROBOT)


def momentum(model: cdcr.Model, q: Any, qd: Any) -> FloatArray:
    """Linear momentum of a robot of thin sections: of points along the backbone, and disks."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    total = np.zeros(3)
    for i, section in enumerate(model.robot.sections):
        shares = zip((nodes + 1) / 2, weights / 2 * section.backbone_mass, strict=True)
        disks = [
            (k / section.num_disks, section.disk_mass) for k in range(1, section.num_disks + 1)
        ]
        for place, mass in (*shares, *disks):
            total += mass * (model.jacobian(q, i, place)[:3] @ qd)
    return np.asarray(total + model.robot.payload * (model.tip_jacobian(q)[:3] @ qd))


def test_the_force_is_the_weight_less_the_change_of_momentum_along_a_run() -> None:
    h = 5e-4
    push = cdcr.Wrench(section=2, force=(0.1, -0.2, 0.05))
    t = 0.2 + h * np.arange(-2, 3)
    pull = [4.0, 0, 0, 0, 2, 0, 0, 0, 1]
    run = cdcr.simulate(
        MODEL, [0.3] * 6, [0] * 6, t=[0.0, *t], tension=pull, wrenches=push, method="dopri5",
        rtol=1e-11, atol=1e-13,
    )  # fmt: skip
    p = np.array([momentum(MODEL, q, qd) for q, qd in zip(run.q[1:], run.qd[1:], strict=True)])
    change = (8 * (p[3] - p[1]) - (p[4] - p[0])) / (12 * h)
    q, qd = run.q[3], run.qd[3]
    qdd = MODEL.forward_dynamics(q, qd, pull, push)
    found = MODEL.base_wrench(q, qd, qdd, push)
    wanted = ROBOT.mass * np.array(ROBOT.gravity) + push.force - change
    np.testing.assert_allclose(found[:3], wanted, atol=SUMMED * np.abs(wanted).max())
    # All states of a run at once, and no wrench unless it is given.
    many = MODEL.base_wrench(run.q, run.qd, MODEL.forward_dynamics(run.q, run.qd, pull, push), push)
    np.testing.assert_allclose(many[3], found, atol=ROUNDING)
    without = MODEL.base_wrench(q, qd, qdd)
    arm = MODEL.tip(q)[1]
    added = np.concatenate([push.force, np.cross(arm, push.force)])
    np.testing.assert_allclose(found - without, added, atol=ROUNDING)


def test_a_loop_tells_what_the_model_reckons_with_bias_and_delay() -> None:
    robot = replace(ROBOT, base_position=(0.1, 0.2, 0.3))
    model = cdcr.Model(robot)
    controller = cdcr.ComputedTorque(model, min_tension=0.5)
    controller.reference = [0.2] * 6
    sensors = [
        cdcr.Sensor(kind="base_force"),
        cdcr.Sensor(kind="base_moment", bias=0.5, delay=1e-3),
    ]
    loop = cdcr.Loop(model, controller, sensors=sensors)
    loop.reset([0.1] * 6, [0.0] * 6)
    run = loop.run(0.05)
    motion = run.trajectory
    for k in (10, 30):
        # Measured at the beginning of a step, under the commands of the one before.
        qdd = model.forward_dynamics(motion.q[k], motion.qd[k], motion.command[k - 1])
        now = model.base_wrench(motion.q[k], motion.qd[k], qdd)
        np.testing.assert_allclose(run.measurements[0][k], now[:3], atol=ROUNDING)
        np.testing.assert_allclose(run.measurements[1][k + 1], now[3:] + 0.5, atol=ROUNDING)


def test_scenario_files_have_such_sensors_and_variants_of_the_robot(tmp_path: Path) -> None:
    file = tmp_path / "felt.toml"
    text = """
t_end = 0.5
robot = {name = "amouri2020", gravity = [0.0, 0.0, -9.81], payload = 0.03}
controller = {type = "computed-torque", min_tension = 0.5, reference = {q = [0.3, 0.1]}}
[output]
num_samples = 51
[[loop.sensors]]
kind = "lengths"
noise = 1e-5
[[loop.sensors]]
kind = "base_force"
noise = 0.02
[loop.estimator]
type = "extended-kalman"
acceleration_noise = 0.1
variants = [{payload = 0.05}]
share_deviation = 1.0
"""
    file.write_text(text)
    scenario = load_scenario(file)
    source: Any = scenario.input_source
    model = scenario.model
    run = source.run_loop(model, scenario.start(model), scenario.qd0, scenario.times())
    assert run.trajectory.success
    # The filter knows the payload: no share of the heavier one.
    share, spread = run.estimated["share_1"][-1], run.deviations["share_1"][-1]
    assert spread < 0.2
    assert abs(share) < 5.0 * spread
    for wrong, told in (
        ('{"sections.9.length" = 1.0}', "variants[0]"),
        ("{}", "variants[0] must have a number of the robot"),
        ("{payload = -1.0}", "payload"),
    ):
        file.write_text(text.replace("{payload = 0.05}", wrong))
        with pytest.raises(ValueError, match=r"felt\.toml") as caught:
            load_scenario(file)
        assert told in str(caught.value)
