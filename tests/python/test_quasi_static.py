"""Rest with a history from Python: what it returns, refuses, and what friction in motion keeps."""

from __future__ import annotations

import os
import pickle
import signal
import threading
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.model import maps

SAME = 1e-9  # [rad]: two searches for one rest


def rubbing(mu: float = 0.3, **fields: Any) -> cdcr.Robot:
    robot = cdcr.robots.amouri2020(damping=0.05)
    section = replace(robot.sections[0], cable_friction=mu)
    return replace(robot, sections=(section,), **fields)


def pulls(*tensions: float) -> Any:
    return np.array([[one, 0.0, 0.0] for one in tensions])


def test_without_friction_it_is_the_equilibrium() -> None:
    model = cdcr.Model(cdcr.robots.three_sections())
    command = np.random.default_rng(1).uniform(0.0, 4.0, (20, 9))
    run = cdcr.quasi_static(model, command)
    assert len(run) == 20
    assert run.status is cdcr.Status.ok
    for q, one in zip(run.q, command, strict=True):
        np.testing.assert_allclose(q, model.equilibrium(one, q), rtol=0.0, atol=SAME)
    np.testing.assert_array_equal(run.tension, run.end_tension)
    np.testing.assert_allclose(run.tip, model.tips(run.q))


def test_it_goes_on_after_another_run() -> None:
    model = cdcr.Model(rubbing())
    whole = cdcr.quasi_static(model, pulls(0.0, 8.0, 4.0, 6.0, 7.0))
    first = cdcr.quasi_static(model, pulls(0.0, 8.0, 4.0))
    rest = cdcr.quasi_static(model, pulls(6.0, 7.0), after=first)
    np.testing.assert_allclose(rest.q, whole.q[3:], rtol=0.0, atol=SAME)
    assert whole.sliding[:, 0].tolist() == [0, 1, -1, 1, 1]
    np.testing.assert_allclose(whole.friction, whole.tension - whole.end_tension, atol=1e-12)
    copy = pickle.loads(pickle.dumps(whole))
    np.testing.assert_array_equal(copy.q, whole.q)
    assert not copy.q.flags.writeable
    assert repr(whole) == "<QuasiStatic: 5 samples, status ok>"


def test_it_says_what_it_does_not_take() -> None:
    model = cdcr.Model(rubbing())
    with pytest.raises(ValueError, match="command must have shape"):
        cdcr.quasi_static(model, [[1.0, 2.0]])
    with pytest.raises(ValueError, match=r"sample 2 of 2: tension must be .* >= 0 N"):
        cdcr.quasi_static(model, pulls(1.0, -1.0))
    with pytest.raises(ValueError, match="give either q0 or after, not both"):
        cdcr.quasi_static(
            model, pulls(1.0), q0=[0.0, 0.0], after=cdcr.quasi_static(model, pulls(0.0))
        )
    with pytest.raises(cdcr.ConvergenceError, match="Stopped before sample 2 of 2"):
        cdcr.quasi_static(model, pulls(1.0, 5e3))
    with pytest.raises(ValueError, match="after must have reached a sample to go on from"):
        cdcr.quasi_static(
            model, pulls(1.0), after=cdcr.quasi_static(model, pulls(5e3), throw=False)
        )
    with pytest.raises(ValueError, match="after must be a run of this robot, got one of 6 coord"):
        cdcr.quasi_static(
            model,
            pulls(1.0),
            after=cdcr.quasi_static(cdcr.Model(cdcr.robots.three_sections()), np.zeros((1, 9))),
        )
    run = cdcr.quasi_static(model, pulls(1.0, 5e3), throw=False)
    assert len(run) == 1
    assert run.status is cdcr.Status.not_converged


def test_equilibrium_warns_that_friction_is_left_out() -> None:
    model = cdcr.Model(rubbing())
    with pytest.warns(UserWarning, match="equilibrium leaves out the friction of the cables"):
        model.equilibrium([1.0, 0.0, 0.0])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert model.equilibrium([1.0, 0.0, 0.0], throw=False).friction_left_out
        cdcr.Model(rubbing(0.0)).equilibrium([1.0, 0.0, 0.0])


def test_fields_of_friction_stand_in_files(tmp_path: Path) -> None:
    section = replace(
        rubbing().sections[0], cable_stiffness=1e4, cable_entry_friction=0.5,
        cable_sheath_friction=0.1, cable_viscosity=2.0, cable_pretension=3.0, cable_backlash=1e-4,
    )  # fmt: skip
    cable = cdcr.Cable(radius=0.01, angle=1.0, end_section=0, entry_friction=0.25)
    robot = replace(rubbing(presliding_stiffness=1e4), sections=(section,), cables=(cable,))
    robot.save(tmp_path / "robot.toml")
    assert cdcr.Robot.load(tmp_path / "robot.toml") == robot
    assert robot.all_cables[0].pretension == 3.0
    assert robot.subdivide(3).all_cables[0].backlash == 1e-4
    with pytest.raises(ValueError, match="cable_backlash must be 0 m where the stiffness is 0"):
        replace(section, cable_stiffness=0.0, cable_pretension=0.0)
    with pytest.raises(ValueError, match="cable 1 of cables: entry_friction must be >= 0 N"):
        replace(robot, cables=(replace(cable, entry_friction=-1.0),))
    with pytest.raises(ValueError, match="presliding_stiffness must be >= 0 N/m"):
        replace(robot, presliding_stiffness=-1.0)


@pytest.mark.parametrize("method", ["rk4", "dopri5", "bdf"])
def test_motion_remembers_by_every_method(method: Any) -> None:
    model = cdcr.Model(rubbing(presliding_stiffness=2e4))
    table = cdcr.TensionTable([0.0, 10.0, 20.0], pulls(0.0, 10.0, 3.0))
    options: dict[str, Any] = {"step": 2e-3} if method == "rk4" else {"rtol": 1e-7, "atol": 1e-9}
    run = cdcr.simulate(model, [0, 0], [0, 0], t=np.linspace(0, 25, 51), tension=table,
                        method=method, **options)  # fmt: skip
    assert run.success
    assert run.deflection is not None
    assert run.deflection.shape == (51, 3)
    assert np.min(run.friction_power) >= -1e-12
    rest = cdcr.quasi_static(model, run.command)
    assert np.max(np.abs(rest.q - run.q)) < 0.03


@pytest.mark.parametrize("suffix", ["nc", "csv"])
def test_files_keep_what_friction_remembers(tmp_path: Path, suffix: str) -> None:
    model = cdcr.Model(rubbing(presliding_stiffness=2e4))
    t = np.linspace(0.0, 2.0, 21)
    run = cdcr.simulate(model, [0.3, 0.0], [0, 0], t=t, tension=[5.0, 0.0, 0.0])
    if suffix == "nc":
        pytest.importorskip("xarray")
    file = run.save(tmp_path / f"run.{suffix}")
    again = cdcr.Trajectory.load(file, model=model)
    assert run.deflection is not None
    np.testing.assert_array_equal(again.deflection, run.deflection)
    np.testing.assert_array_equal(again.friction_power, run.friction_power)
    if suffix == "csv":
        assert len(cdcr.identification.Motion.load(file, model.robot)) == 21
    with pytest.raises(ValueError, match=r"deflection must have shape \(21, 3\), got \(21, 2\)"):
        replace(run, deflection=run.deflection[:, :2])


def test_a_drive_with_play_takes_no_function() -> None:
    robot = rubbing()
    section = replace(robot.sections[0], cable_stiffness=1e4, cable_backlash=1e-3)
    model = cdcr.Model(replace(robot, sections=(section,)))
    with pytest.raises(ValueError, match="a drive with backlash takes tables and constants"):
        cdcr.simulate(model, [0, 0], [0, 0], t=[0.0, 1.0], command=lambda t, q, qd: [0.8] * 3)


def test_poses_with_a_history_find_friction() -> None:
    known = rubbing(0.25)
    rng = np.random.default_rng(2)
    command = rng.uniform(0.5, 8.0, (60, 3))
    tip = cdcr.quasi_static(cdcr.Model(known), command).tip + rng.normal(0.0, 1e-5, (60, 3))
    poses = cdcr.identification.Poses(command, tip=tip, history=True)
    found = cdcr.identify(poses, rubbing(0.1), {"sections[0].cable_friction": None})
    assert found["sections[0].cable_friction"] == pytest.approx(0.25, abs=2e-3)
    assert found.cross_validate(3).held_out["poses: tip"] < 4e-5


def test_it_goes_on_from_a_robot_that_is_driven_alike() -> None:
    model = cdcr.Model(rubbing())
    (section,) = model.robot.sections
    driven = cdcr.Model(replace(model.robot, sections=(replace(section, cable_stiffness=2e4),)))
    before = cdcr.quasi_static(driven, [driven.rest_command()])
    with pytest.raises(ValueError, match="cable 1 must be driven by tension, got one driven by le"):
        cdcr.quasi_static(model, np.zeros((1, model.num_cables)), after=before)


def test_a_step_for_optimisers_knows_nothing_of_it() -> None:
    with pytest.warns(
        UserWarning, match="a step of the state knows nothing of what cables and dri"
    ):
        maps.step(cdcr.Model(rubbing(presliding_stiffness=1e4)), 1e-3)


def test_an_fmu_has_no_memory(tmp_path: Path) -> None:
    robot = rubbing(presliding_stiffness=1e4)
    with pytest.raises(ValueError, match="an FMU keeps no memory of friction and of play"):
        cdcr.export.write_fmu(robot, tmp_path / "robot.fmu")


@pytest.mark.parametrize("presliding_stiffness", [0.0, 2e4])
def test_bdf_goes_past_the_turns_of_drives_that_rub(presliding_stiffness: float) -> None:
    # Triangles of three lengths under much friction, which turns over a range of 10 um/s.
    robot = cdcr.robots.three_sections()
    sections = [
        replace(one, cable_stiffness=2e4, cable_damping=20.0, cable_friction=0.7)
        for one in robot.sections
    ]
    robot = replace(
        robot, sections=tuple(sections), sliding_speed=1e-5,
        presliding_stiffness=presliding_stiffness,
    )  # fmt: skip
    model = cdcr.Model(robot)
    lengths = np.tile(model.rest_command() - 1e-4, (4, 1))
    lengths[1::2, [0, 4]] -= [4e-3, 3e-3]
    table = cdcr.TensionTable([0.0, 4.0, 8.0, 12.0], lengths)
    run = cdcr.simulate(model, np.zeros(6), np.zeros(6), t=[0.0, 12.0], command=table, method="bdf")
    assert run.success
    assert run.t[-1] == 12.0


def test_cables_that_are_slack_and_straight_begin_smoothly() -> None:
    section = replace(rubbing().sections[0], cable_entry_friction=0.1)
    model = cdcr.Model(replace(rubbing(presliding_stiffness=2e3), sections=(section,)))
    table = cdcr.TensionTable([0.0, 2.0, 4.0], [[0, 0, 0], [8, 0, 0], [0, 3, 0]])
    run = cdcr.simulate(model, [0, 0], [0, 0], t=np.linspace(0, 4, 41), tension=table,
                        method="bdf", rtol=1e-6, atol=1e-8)  # fmt: skip
    assert run.success
    assert run.stats.steps < 20000


def test_ctrl_c_ends_it() -> None:
    model = cdcr.Model(rubbing())
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
    timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        cdcr.quasi_static(model, np.tile(pulls(1.0, 2.0), (500_000, 1)))
