"""Rollouts: every motion is that of `simulate`, whoever commands it and whatever else fails."""

from __future__ import annotations

import pickle
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray
from interruption import interrupt_soon
from pull_back import Spring, pull_back

MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
N, STEPS, STEP = 5, 20, 2.0**-7
RNG = np.random.default_rng(1)
Q0, QD0 = 0.3 * RNG.normal(size=(N, 2)), RNG.normal(size=(N, 2))
PULLS = RNG.uniform(0.0, 3.0, (N, STEPS, 3))
RUN: dict[str, Any] = {"step": STEP, "steps": STEPS}
SAME: dict[str, Any] = {"rtol": 0.0, "atol": 1e-12}


def alone(i: int, t: FloatArray, method: Any = "rk4", model: cdcr.Model = MODEL) -> Any:
    table = cdcr.TensionTable(STEP * np.arange(STEPS), PULLS[i], "previous")
    return cdcr.simulate(model, Q0[i], QD0[i], t=t, tension=table, method=method, step=STEP)


METHODS = ("rk4", "rosenbrock", "auto", "dopri5", "dop853", "bdf", "adams")


@pytest.mark.parametrize("method", METHODS)
def test_every_motion_is_that_of_simulate(method: Any) -> None:
    runs = cdcr.rollout(MODEL, Q0, QD0, tension=PULLS, method=method, record_every=4, **RUN)
    assert runs.success
    assert runs.q.shape == runs.qd.shape == (N, 6, 2)
    np.testing.assert_allclose(runs.t, STEP * np.arange(0, 21, 4), rtol=1e-15)
    for i, run in enumerate(runs):
        expected = alone(i, runs.t, method)
        np.testing.assert_allclose(run.q, expected.q, **SAME)
        np.testing.assert_allclose(run.qd, expected.qd, **SAME)
        np.testing.assert_array_equal(run.command, expected.command)
        np.testing.assert_array_equal(run.tension, expected.tension)
        assert run.success


def test_each_motion_may_have_a_robot_of_its_own() -> None:
    models = [cdcr.Model(cdcr.robots.amouri2020(damping=0.01 * i)) for i in range(N)]
    runs = cdcr.rollout(models, Q0, QD0, PULLS, **RUN)  # tensions may go without their name
    for i, model in enumerate(models):
        np.testing.assert_allclose(runs.q[i], alone(i, runs.t, model=model).q, **SAME)
        assert runs[i].model is model


def test_numbers_of_the_robot_may_differ_by_path() -> None:
    robot = cdcr.robots.three_sections(damping=5e-3)
    model = cdcr.Model(robot)
    moduli = np.linspace(0.8, 1.2, N) * robot.sections[0].youngs_modulus
    parameters = {
        "sections.*.youngs_modulus": moduli,
        "sections.2.disk_mass": np.linspace(0.001, 0.004, N),
        "payload": np.linspace(0.0, 0.01, N),
        "gravity.z": np.linspace(-9.81, 9.81, N),
    }
    run: dict[str, Any] = {"step": 1e-3, "steps": 20, "tension": np.arange(9.0) / 9.0}
    start = 0.1 * np.ones(6), np.zeros(6)
    runs = cdcr.rollout(model, *start, parameters=parameters, **run)
    described = []
    for i in range(N):
        sections = [replace(one, youngs_modulus=moduli[i]) for one in robot.sections]
        sections[1] = replace(sections[1], disk_mass=parameters["sections.2.disk_mass"][i])
        described.append(
            replace(
                robot,
                sections=tuple(sections),
                payload=parameters["payload"][i],
                gravity=(0.0, 0.0, parameters["gravity.z"][i]),
            )
        )
        assert runs[i].model.robot == described[i]
    expected = cdcr.rollout([cdcr.Model(one) for one in described], *start, **run)
    np.testing.assert_array_equal(runs.q, expected.q)
    assert runs.success
    assert not np.allclose(runs.q[0, -1], runs.q[1, -1])
    np.testing.assert_array_equal(runs.parameters["payload"], parameters["payload"])


def test_payloads_of_one_section_differ() -> None:
    payloads = np.array([0.0, 0.01, 0.0])
    runs = cdcr.rollout(MODEL, Q0[0], QD0[0], parameters={"payload": payloads}, **RUN)
    for i, payload in enumerate(payloads):
        model = cdcr.Model(replace(MODEL.robot, payload=payload))
        expected = cdcr.simulate(model, Q0[0], QD0[0], t=runs.t, method="rk4", step=STEP)
        np.testing.assert_allclose(runs.q[i], expected.q, **SAME)


def test_one_start_serves_all_and_one_command_too() -> None:
    pulls = PULLS[:, 0]
    runs = cdcr.rollout(MODEL, Q0[0], QD0[0], tension=pulls, **RUN)
    turned = cdcr.rollout(MODEL, Q0, QD0, command=pulls[0], **RUN)
    for i in range(N):
        for run, q0, qd0, pull in (
            (runs, Q0[0], QD0[0], pulls[i]),
            (turned, Q0[i], QD0[i], pulls[0]),
        ):
            expected = cdcr.simulate(MODEL, q0, qd0, t=run.t, tension=pull, method="rk4", step=STEP)
            np.testing.assert_allclose(run.q[i], expected.q, **SAME)
    assert cdcr.rollout(MODEL, Q0[0], QD0[0], **RUN).num_motions == 1


def test_length_driven_robots_under_wrenches() -> None:
    robot = cdcr.robots.three_sections()
    stiff = [replace(one, cable_stiffness=2e4, cable_damping=20.0) for one in robot.sections]
    model = cdcr.Model(replace(robot, sections=tuple(stiff)))
    lengths = model.rest_command() - 1e-3 * np.arange(9) / 9 * np.arange(3)[:, None]
    pull = cdcr.Wrench(section=2, force=(0.1, 0.0, 0.0), profile=([0.0, 0.01], [0.0, 1.0]))
    start: dict[str, Any] = {"wrenches": pull, "method": "dopri5"}
    runs = cdcr.rollout(
        model, np.zeros(6), np.zeros(6), command=lengths, step=0.01, steps=2, **start
    )
    for i in range(3):
        expected = cdcr.simulate(
            model, np.zeros(6), np.zeros(6), t=runs.t, command=lengths[i], **start
        )
        np.testing.assert_allclose(runs.q[i], expected.q, **SAME)
        np.testing.assert_allclose(runs[i].tension, expected.tension, rtol=1e-9, atol=1e-9)


def test_a_pid_for_each() -> None:
    pid = cdcr.Pid(MODEL, kp=2.0, ki=4.0, kd=0.3, period=0.005)
    pid.reference = [0.3, 0.1]
    one = cdcr.rollout(MODEL, Q0, QD0, controller=pid, **RUN)
    each = cdcr.rollout(
        MODEL,
        Q0,
        QD0,
        controller=[pickle.loads(pickle.dumps(pid)) for _ in range(N)],
        **RUN,
    )
    for i in range(N):
        expected = cdcr.simulate(
            MODEL, Q0[i], QD0[i], t=one.t, controller=pid, method="rk4", step=STEP
        )
        for runs in (one, each):
            np.testing.assert_allclose(runs.q[i], expected.q, **SAME)
            np.testing.assert_allclose(runs.command[i], expected.command, **SAME)


@pytest.mark.parametrize(
    ("control_every", "record_every"), [(1, 1), (5, 1), (1, 5), (2, 4), (4, 2)]
)
def test_a_function_commands_all_motions(control_every: int, record_every: int) -> None:
    every: dict[str, Any] = {"control_every": control_every, "record_every": record_every}
    runs = cdcr.rollout(MODEL, Q0, QD0, controller=pull_back, **every, **RUN)
    for i in range(N):
        expected = cdcr.simulate(
            MODEL,
            Q0[i],
            QD0[i],
            t=runs.t,
            controller=Spring(control_every * STEP),
            method="rk4",
            step=STEP,
        )
        np.testing.assert_allclose(runs.q[i], expected.q, **SAME)
        # The last row has the command before it: nothing is asked at the end.
        np.testing.assert_allclose(runs.command[i, :-1], expected.command[:-1], **SAME)


def test_motions_that_fail_leave_the_others_alone() -> None:
    fast = np.array(QD0)
    fast[3] *= 1e5
    sound = cdcr.rollout(MODEL, Q0, QD0, tension=PULLS, **RUN)
    runs = cdcr.rollout(MODEL, Q0, fast, tension=PULLS, **RUN)
    (failure,) = runs.failures
    assert (failure.motion, failure.status) == (3, cdcr.Status.bending_limit)
    assert failure.message.startswith("Stopped at t = 0 s (bending_limit).")
    assert list(runs.status == cdcr.Status.ok) == [i != 3 for i in range(N)]
    np.testing.assert_array_equal(np.delete(runs.q, 3, 0), np.delete(sound.q, 3, 0))
    assert len(runs[3]) == 1
    assert np.isnan(runs.q[3, 1:]).all()
    together = cdcr.rollout(MODEL, Q0, fast, controller=pull_back, **RUN)
    assert [one.motion for one in together.failures] == [3]
    assert np.isnan(together.q[3, 1:]).all()
    assert np.isfinite(np.delete(together.q, 3, 0)).all()


def test_the_bits_do_not_depend_on_threads() -> None:
    many: dict[str, Any] = {
        "q0": np.tile(Q0, (20, 1)),
        "qd0": np.tile(QD0, (20, 1)),
        "method": "dopri5",
    }
    one, four = (cdcr.rollout(MODEL, threads=count, **many, **RUN) for count in (1, 4))
    np.testing.assert_array_equal(one.q, four.q)
    np.testing.assert_array_equal(one.qd, four.qd)


@pytest.mark.parametrize(
    "given",
    [{}, {"controller": pull_back}, {"parameters": {"payload": []}}, {"tension": PULLS[:0]}],
)
def test_no_motions_are_a_rollout(given: dict[str, Any]) -> None:
    none = np.zeros((0, 2))
    runs = cdcr.rollout(MODEL, none, none, **given, **RUN)
    assert runs.q.shape == (0, 21, 2)
    assert len(list(runs)) == 0
    pytest.importorskip("xarray")
    assert runs.to_xarray().q.shape == (0, 21, 1, 2)


@pytest.mark.parametrize("tension", [None, PULLS[:, 0], PULLS[:, :0]])
def test_no_steps_are_a_rollout(tension: Any) -> None:
    runs = cdcr.rollout(MODEL, Q0, QD0, tension, step=STEP, steps=0)
    assert (runs.q.shape, runs.command.shape) == ((N, 1, 2), (N, 1, 3))


def test_one_value_of_a_parameter_serves_all() -> None:
    runs = cdcr.rollout(MODEL, Q0, QD0, parameters={"payload": [0.01]}, **RUN)
    np.testing.assert_array_equal(runs.parameters["payload"], np.full(N, 0.01))
    assert runs[N - 1].model.robot.payload == 0.01


def test_commands_to_motions_that_failed_are_not_used() -> None:
    fast = np.array(QD0)
    fast[3] *= 1e5

    def policy(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        return np.abs(q @ np.ones((2, 3)))  # NaN where q is

    runs = cdcr.rollout(MODEL, Q0, fast, controller=policy, **RUN)
    assert [one.motion for one in runs.failures] == [3]
    sound = cdcr.rollout(MODEL, Q0, QD0, controller=policy, **RUN)
    np.testing.assert_array_equal(np.delete(runs.q, 3, 0), np.delete(sound.q, 3, 0))

    def pushing(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        command = np.zeros((N, 3))
        command[4, 1] = -1.0 if t > 2.5 * STEP else 0.0
        return command

    with pytest.raises(ValueError, match="of motion 5, step 4, cable 2 must be finite and >= 0"):
        cdcr.rollout(MODEL, Q0, fast, controller=pushing, **RUN)


def test_tensions_behind_a_drive_with_play_are_not_told() -> None:
    section = replace(
        MODEL.robot.sections[0], cable_stiffness=2e4, cable_backlash=1e-3, cable_pretension=1.0
    )
    model = cdcr.Model(replace(MODEL.robot, sections=(section,)))
    runs = cdcr.rollout(model, Q0, QD0, **RUN)
    assert np.isnan(runs[0].tension).all()
    with pytest.raises(ValueError, match="must not be a function where cables or drives remember"):
        cdcr.rollout(model, Q0, QD0, controller=pull_back, **RUN)


@pytest.mark.parametrize("method", ["rk4", "dopri5"])
def test_control_c_returns_what_is_done(method: Any) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020(damping=0.0))
    q0 = np.full((3, 2), 0.3)
    long: dict[str, Any] = {"steps": 2**30, "record_every": 2**29, "max_steps": 2**50}
    with interrupt_soon() as since:
        runs = cdcr.rollout(model, q0, 0 * q0, step=1e-3, method=method, threads=2, **long)
        assert since() < 5.0
    assert [one.status for one in runs.failures] == 3 * [cdcr.Status.interrupted]
    np.testing.assert_array_equal(runs.q[0, 0], q0[0])
    assert np.isnan(runs.q[:, 1:]).all()


def test_control_c_ends_motions_that_go_on_together() -> None:
    with interrupt_soon() as since:
        runs = cdcr.rollout(
            MODEL, Q0, QD0, controller=pull_back, step=1e-4, steps=10**9, record_every=10**8
        )
        assert since() < 5.0
    assert [one.motion for one in runs.failures] == list(range(N))
    assert {one.status for one in runs.failures} == {cdcr.Status.interrupted}


def test_control_c_within_a_period_ends_all_of_them() -> None:
    asked = []

    def policy(t: float, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        asked.append(t)
        return np.zeros((len(q), 3))

    q0 = np.full((1000, 2), 0.3)
    run: dict[str, Any] = {"step": 1e-3, "steps": 10**7, "control_every": 10**6}
    with interrupt_soon() as since:
        runs = cdcr.rollout(
            MODEL, q0, [0, 0], controller=policy, record_every=10**6, threads=1, **run
        )
        assert since() < 5.0
    assert asked == [0.0]
    assert {one.status for one in runs.failures} == {cdcr.Status.interrupted}
    assert len(runs.failures) == len(q0)


def test_progress_is_told_and_what_it_raises_is_raised() -> None:
    told: list[int] = []
    cdcr.rollout(MODEL, Q0, QD0, progress=told.append, threads=1, **RUN)
    assert told == sorted(told)
    assert told[-1] == N

    def stop(ended: int) -> None:
        raise LookupError(ended)

    with pytest.raises(LookupError):
        cdcr.rollout(MODEL, Q0, QD0, progress=stop, **RUN)


def test_a_dataset_says_what_there_is() -> None:
    pytest.importorskip("xarray")
    fast = np.array(QD0)
    fast[1] *= 1e5
    runs = cdcr.rollout(MODEL, Q0, fast, tension=PULLS, record_every=5, **RUN)
    data = runs.to_xarray()
    assert dict(data.sizes) == {"motion": N, "time": 5, "section": 1, "component": 2, "cable": 3}
    np.testing.assert_array_equal(data.q.values.reshape(runs.q.shape), runs.q)
    np.testing.assert_array_equal(data.command.values, runs.command)
    assert list(data.status.values) == ["ok", "bending_limit", "ok", "ok", "ok"]
    assert data.qd.attrs["units"] == "rad/s"


@pytest.mark.parametrize("index", [slice(2), 1.0, "a", np.array([0, 1])])
def test_a_motion_is_asked_for_by_its_index(index: Any) -> None:
    runs = cdcr.rollout(MODEL, Q0, QD0, **RUN)
    with pytest.raises(TypeError, match="a motion is asked for by its index, a whole number, got"):
        runs[index]


def test_results_pickle_and_print() -> None:
    runs = cdcr.rollout(MODEL, Q0, QD0, **RUN)
    again = pickle.loads(pickle.dumps(runs))
    np.testing.assert_array_equal(again.q, runs.q)
    assert not again.q.flags.writeable
    assert repr(again) == (
        "<Rollout: 5 motions, 21 rows each, t = 0 to 0.15625 s, 1 robot, rk4, all ok>"
    )
    with pytest.raises(IndexError, match="there are 5 motions, got index 5"):
        runs[5]
