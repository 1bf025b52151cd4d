"""Forces and moments on the base as measurements: what they tell, their slopes, files."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray
from cdcr.identification import Motion, Poses
from cdcr.identification.data import Data
from cdcr.identification.fit import prepared
from measured import ROBOT, pulls

FORCE, MOMENT = 1e-3, 1e-4  # noise [N], [N m]
SLOPE = 1e-6  # relative, of slopes against solved rests
SLOPE_RUN = 1e-4  # and against runs
COMMANDS = pulls(12)
TRUE = replace(
    ROBOT, sections=tuple(replace(one, disk_mass=0.003) for one in ROBOT.sections), payload=0.02
)


def on_base(robot: cdcr.Robot, commands: FloatArray) -> FloatArray:
    """Return what a robot at rest does to its base (N, 6) [N], [N m]."""
    model = cdcr.Model(robot)
    still = np.zeros(model.num_coordinates)
    return np.array([
        model.base_wrench(model.equilibrium(one), still, still) for one in commands
    ])  # fmt: skip


def test_the_base_tells_weight_and_where_it_is() -> None:
    """Tensions and stiffness alone tell neither; the force tells the sum, the moment the rest."""
    draw = np.random.default_rng(7)
    seen = on_base(TRUE, COMMANDS) + draw.normal(size=(12, 6)) * np.repeat([FORCE, MOMENT], 3)
    noise = {"base_force": FORCE, "base_moment": MOMENT}
    poses = Poses(COMMANDS, base_force=seen[:, :3], base_moment=seen[:, 3:], noise=noise)
    found = cdcr.identify(poses, ROBOT, {"sections[*].disk_mass": None, "payload": None})
    for one, true in zip(found.estimates, (0.003, 0.02), strict=True):
        assert abs(one.value - true) < 4.5 * one.standard_error < true / 10.0
    weight = -9.81 * TRUE.mass
    assert seen[:, 2] == pytest.approx(weight, abs=5.0 * FORCE)
    assert [one.unit for one in found.residuals] == ["N", "N m"]


def motion() -> Motion:
    t = np.linspace(0.0, 0.3, 16)
    zeros = np.zeros((16, 3))
    return Motion(
        t, np.zeros(6), base_force=zeros, base_moment=zeros, start=[3.0, 0, 0, 0, 0, 0], rtol=1e-10,
        noise={"base_force": FORCE, "base_moment": MOMENT},
    )  # fmt: skip


@pytest.mark.parametrize(
    ("data", "margin"),
    [
        (Poses(COMMANDS, base_force=np.zeros((12, 3)), base_moment=np.zeros((12, 3))), SLOPE),
        (motion(), SLOPE_RUN),
    ],
)
def test_slopes_are_those_of_solved_answers(data: Data, margin: float) -> None:
    sought = ["sections[*].youngs_modulus", "payload", "base tilt x", "sections[*].damping"]
    problem = prepared(data, TRUE, dict.fromkeys(sought), enough=False)
    x, h = np.zeros(4), 1e-4
    found = problem.jacobian(x)
    for k in range(4):
        step = h * np.eye(4)[k]
        solved = (problem.residuals(x + step) - problem.residuals(x - step)) / (2.0 * h)
        assert np.abs(found[:, k] - solved).max() <= margin * (1.0 + np.abs(solved).max()), k


def test_a_push_over_time_is_known_in_motions_and_refused_at_rest() -> None:
    t = np.linspace(2.0, 2.3, 16)
    times, factors = [2.0, 2.1, 2.3], [1.0, -1.0, 0.5]
    push = cdcr.Wrench(section=1, force=(0.1, 0.05, 0.0), profile=(times, factors))
    model, told = cdcr.Model(TRUE), np.zeros(6)
    q0 = model.equilibrium(told, wrenches=push.at(2.0))
    run = cdcr.simulate(
        model, q0, 0.0 * q0, t=t, tension=told, wrenches=push, rtol=1e-10, method="dop853"
    )
    seen = []
    for now, q, qd in zip(t, run.q, run.qd, strict=True):
        pushed = replace(push.at(now), force=np.interp(now, times, factors) * np.array(push.force))
        qdd = model.forward_dynamics(q, qd, told, pushed)
        seen.append(model.base_wrench(q, qd, qdd, pushed))
    measured = Motion(
        t, told, tip=run.tip, base_force=np.array(seen)[:, :3], wrenches=push, rtol=1e-10,
        noise={"tip": 1e-4, "base_force": FORCE},
    )  # fmt: skip
    sought = dict.fromkeys(["sections[*].youngs_modulus", "payload", "time shift"])
    problem = prepared(measured, TRUE, sought, enough=False)
    x = np.zeros(3)
    assert np.abs(problem.residuals(x)).max() < 1e-3  # of the noise
    x[2], h = 0.013, 1e-5  # between the samples
    found = problem.jacobian(x)
    for k in range(3):
        step = h * np.eye(3)[k]
        solved = (problem.residuals(x + step) - problem.residuals(x - step)) / (2.0 * h)
        assert np.abs(found[:, k] - solved).max() <= SLOPE_RUN * (1.0 + np.abs(solved).max()), k
    bad: Any = 5
    with pytest.raises(ValueError, match="wrenches must be"):
        cdcr.identify(replace(measured, wrenches=bad), TRUE, {"payload": None})
    with pytest.raises(ValueError, match="has a profile, which a run follows"):
        cdcr.identify(
            Poses(COMMANDS, tip=np.zeros((12, 3)), wrenches=push), ROBOT, {"payload": None}
        )


def test_a_file_has_them_and_friction_with_a_memory_is_refused(tmp_path: Path) -> None:
    names = [*(f"cable {j} [N]" for j in range(1, 7)), *(f"base force {one} [mN]" for one in "xyz")]
    table = np.hstack([COMMANDS, 1e3 * on_base(ROBOT, COMMANDS)[:, :3]])
    file = tmp_path / "base.csv"
    np.savetxt(file, table, delimiter=",", header=",".join(names), comments="")
    (channel,) = Poses.load(file, ROBOT).channels
    assert (channel.name, channel.unit) == ("base_force", "N")
    assert channel.values[:, 2] == pytest.approx(-9.81 * ROBOT.mass)
    rubs = replace(
        ROBOT, presliding_stiffness=1e3,
        sections=tuple(replace(one, cable_entry_friction=0.1) for one in ROBOT.sections),
    )  # fmt: skip
    with pytest.raises(ValueError, match="not known where friction or play remembers"):
        cdcr.identify(motion(), rubs, {"payload": None})
