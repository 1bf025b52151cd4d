"""Closed loops from Python: the same as by hand, what they record, what they refuse."""

import dataclasses
import re
from typing import Any, cast

import numpy as np
import pytest

import cdcr
from refusals import is_refused

MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=0.02))
PATH = cdcr.ReferencePath.spline([0.0, 0.1, 0.3], [[0.0, 0.0], [0.2, 0.1], [-0.1, 0.2]])


class Push(cdcr.Controller):
    """Pulls cable 1 for ever, or fails."""

    def __init__(self, tension: float) -> None:
        super().__init__(period=2e-3)
        self.tension = tension
        self.calls: list[float] = []

    def update(self, t: float, q: Any, qd: Any) -> list[float]:
        """Return the same tensions."""
        self.calls.append(t)
        if self.tension < 0.0:
            raise ArithmeticError("no tension")
        return [self.tension, 0.0, 0.0]


def test_a_loop_in_cpp_is_the_loop_by_hand_bit_for_bit() -> None:
    inside, outside = cdcr.ComputedTorque(MODEL), cdcr.ComputedTorque(MODEL)
    inside.path = outside.path = PATH
    loop = cdcr.Loop(MODEL, inside)
    loop.reset([0.05, 0.0], [0.0, 0.0])
    run = loop.run(0.3)
    simulator = cdcr.Simulator(MODEL, step=1e-3)
    simulator.reset([0.05, 0.0], [0.0, 0.0])
    for i in range(300):
        np.testing.assert_array_equal(run.trajectory.q[i], simulator.q)
        command = outside.update(simulator.time, simulator.q, simulator.qd)
        np.testing.assert_array_equal(run.asked[i], command)
        simulator.step(command)
    np.testing.assert_array_equal(run.trajectory.q[300], simulator.q)
    np.testing.assert_array_equal(loop.qd, simulator.qd)
    by_hand = cdcr.Loop(MODEL, inside)
    by_hand.reset([0.05, 0.0], [0.0, 0.0])
    for _ in range(300):
        assert by_hand.step() == cdcr.Status.ok
    np.testing.assert_array_equal(by_hand.q, loop.q)


def test_actuators_and_sensors_change_what_is_given_and_told() -> None:
    controller = cdcr.Pid(MODEL, kp=1.0, kd=0.1)
    controller.path = PATH
    loop = cdcr.Loop(
        MODEL,
        controller,
        actuators=[
            cdcr.Actuator(time_constant=0.01),
            cdcr.Actuator(dead_time=5e-3),
            cdcr.Actuator(resolution=0.5),
        ],
        sensors=[
            cdcr.Sensor(kind="coordinates", delay=3e-3, noise=1e-4, seed=3),
            cdcr.Sensor(kind="tip", period=5e-3, bias=0.01),
            cdcr.Sensor(kind="curvature", places=[(0, 0.5)]),
        ],
    )
    loop.reset([0.1, 0.0], [0.0, 0.0])
    run = loop.run(0.3, record_every=5)
    assert run.trajectory.success
    assert len(run.trajectory) == 61
    np.testing.assert_array_equal(run.trajectory.command[:, 2] % 0.5, 0.0)
    assert not np.array_equal(run.told_q, run.trajectory.q)
    np.testing.assert_array_equal(run.told_qd[:-1], run.trajectory.qd[:-1])
    np.testing.assert_allclose(run.measurements[1][:-1], run.trajectory.tip[:-1] + 0.01, rtol=1e-12)
    length = MODEL.robot.sections[0].length
    np.testing.assert_allclose(
        run.measurements[2][:-1], run.trajectory.q[:-1] / length, rtol=1e-12, atol=1e-12
    )
    assert (run.durations > 0.0).all()
    loop.reset([0.1, 0.0], [0.0, 0.0])
    np.testing.assert_array_equal(loop.run(0.3, record_every=5).told_q, run.told_q)


def test_a_controller_in_python_is_asked_at_its_period_and_its_exceptions_come_out() -> None:
    push = Push(2.0)
    loop = cdcr.Loop(MODEL, push)
    loop.reset([0.0, 0.0], [0.0, 0.0], time=1.0)
    run = loop.run(0.01)
    np.testing.assert_allclose(push.calls, [1.0, 1.002, 1.004, 1.006, 1.008])
    np.testing.assert_array_equal(run.trajectory.command[:, 0], 2.0)
    push.tension = -1.0
    with pytest.raises(ArithmeticError, match="no tension"):
        loop.run(0.01)
    loop.reset([0.0, 0.0], [0.0, 0.0])
    with pytest.raises(ArithmeticError, match="no tension"):
        loop.step()


def test_after_a_failure_the_last_good_state_stays() -> None:
    loop = cdcr.Loop(MODEL, Push(4000.0))
    with pytest.raises(ValueError, match="the loop has no state: call reset"):
        loop.run(0.1)
    loop.reset([0.0, 0.0], [0.0, 0.0])
    run = loop.run(5.0)
    assert run.trajectory.status == cdcr.Status.bending_limit
    assert run.trajectory.message.startswith("stopped at t = ")
    assert np.isfinite(loop.q).all()
    assert loop.step() == cdcr.Status.bending_limit
    with pytest.raises(ValueError, match=r"the loop has ended \(bending_limit\): call reset"):
        loop.run(0.1)
    loop.reset([0.0, 0.0], [0.0, 0.0])
    with pytest.raises(RuntimeError, match="stopped at t = "):
        loop.run(5.0, throw=True)


def test_a_step_too_large_for_rk4_is_told() -> None:
    (section,) = MODEL.robot.sections
    soft = cdcr.Model(cdcr.Robot(sections=[dataclasses.replace(section, damping=30.0)]))
    told = r"Or the step of 0\.001 s is too large: here rk4 is stable up to 0\.000\d+ s\.$"
    for substeps, success in ((1, False), (5, True)):
        loop = cdcr.Loop(soft, Push(4.0), substeps=substeps)
        loop.reset([0.1, 0.0], [0.0, 0.0])
        run = loop.run(0.5).trajectory
        assert run.success is success
        assert success or re.search(told, run.message)


def test_a_run_that_fails_at_once_keeps_its_start() -> None:
    loop = cdcr.Loop(MODEL, Push(1e300))
    loop.reset([0.1, 0.0], [0.0, 0.0], time=2.0)
    run = loop.run(0.1)
    assert not run.trajectory.success
    np.testing.assert_array_equal(run.trajectory.t, [2.0])
    np.testing.assert_array_equal(run.trajectory.q, [[0.1, 0.0]])


def test_a_loop_refuses_to_go_on_with_a_controller_that_others_drove_since() -> None:
    pid = cdcr.Pid(MODEL, kp=1.0, ki=5.0)
    pid.reference = [0.4, 0.1]
    loop, other = cdcr.Loop(MODEL, pid), cdcr.Loop(MODEL, pid)
    start = np.zeros(2), np.zeros(2)

    def half() -> Any:
        return loop.run(0.1).trajectory.q[-1]

    loop.reset(*start)
    half()
    alone = half()
    others = (
        lambda: other.reset(*start),
        lambda: cdcr.simulate(MODEL, *start, t=[0.0, 0.1], controller=pid),
        lambda: cdcr.rollout(MODEL, *start, step=1e-3, steps=9, controller=[pid]),
    )
    for drive in others:
        loop.reset(*start)
        half()
        drive()
        for go_on in (half, loop.step):
            with pytest.raises(ValueError, match="has driven another run since this loop was res"):
                go_on()
    loop.reset(*start)
    half()
    cdcr.rollout(MODEL, *start, step=1e-3, steps=9, controller=pid)  # which drives a copy
    np.testing.assert_array_equal(half(), alone)


class Meddler(cdcr.Controller):
    """Does something while it drives a loop."""

    def __init__(self, deed: Any) -> None:
        super().__init__(period=1e-3)
        self.deed = deed

    def update(self, t: float, q: Any, qd: Any) -> list[float]:
        """Do it."""
        self.deed()
        return [0.0, 0.0, 0.0]


def test_an_estimator_serves_one_loop_at_a_time() -> None:
    sensor = cdcr.Sensor(kind="coordinates", noise=1e-3, period=1e-3)
    kalman = cdcr.ExtendedKalman(MODEL, sensors=sensor)

    def loop_of(controller: cdcr.Controller) -> cdcr.Loop:
        loop = cdcr.Loop(MODEL, controller, sensors=[sensor], estimator=kalman)
        loop.reset([0.0, 0.0], [0.0, 0.0])
        return loop

    first, second = loop_of(cdcr.Pid(MODEL, kp=1.0)), loop_of(cdcr.Pid(MODEL, kp=1.0))
    second.step()
    with pytest.raises(ValueError, match="the estimator has served another run since this loop"):
        first.step()
    second.step()
    meddling = loop_of(Meddler(second.step))
    with pytest.raises(ValueError, match="the estimator serves another run at this moment"):
        meddling.step()


def test_what_drives_a_run_is_left_alone_meanwhile() -> None:
    loops: list[cdcr.Loop] = []
    meddler = Meddler(lambda: loops[0].step())
    loops.append(cdcr.Loop(MODEL, meddler))
    loops[0].reset([0.0, 0.0], [0.0, 0.0])
    with pytest.raises(ValueError, match="the controller drives another run at this moment"):
        loops[0].step()
    pid = cdcr.Pid(MODEL, kp=1.0)
    deeds = (
        lambda now: setattr(pid, "path", PATH),
        lambda now: setattr(pid, "reference", [0.1, 0.0]),
        lambda now: pid.update(now, [0.0, 0.0], [0.0, 0.0]),
    )
    for deed in deeds:
        with pytest.raises(ValueError, match="the controller drives a run at this moment"):
            cdcr.simulate(
                MODEL, [0, 0], [0, 0], t=[0.0, 0.1], controller=pid, progress=cast("Any", deed)
            )
        deed(0.0)  # after it, as one likes
    with pytest.raises(TypeError, match=r"path must be a cdcr\.ReferencePath, got None"):
        pid.path = cast("Any", None)


NONE = cast("Any", None)
PID = cdcr.Pid(MODEL, kp=1.0)
REFUSALS: dict[str, tuple[Any, str]] = {
    "model": (lambda: cdcr.Loop(NONE, PID), "model must be a cdcr.Model, got NoneType"),
    "controller": (lambda: cdcr.Loop(MODEL, NONE), "controller must be a cdcr.Controller, got"),
    "actuator": (lambda: cdcr.Loop(MODEL, PID, actuators=[NONE]), "actuators[0] must be a cdcr."),
    "period": (
        lambda: cdcr.Loop(MODEL, PID, step=7e-4),
        "the controller's period must be a whole number of steps of 0.0007 s, 1 to 1e9, got",
    ),
    "kind": (
        lambda: cdcr.Sensor(kind=cast("Any", "gps")),
        "kind must be one of 'coordinates', 'rates', 'lengths', 'tensions', 'tip', 'orientation', "
        "'curvature', 'base_force', 'base_moment', got 'gps'",
    ),
    "noise": (lambda: cdcr.Sensor(kind="tip", noise=NONE), "noise must be a number, got None"),
    "places": (
        lambda: cdcr.Sensor(kind="curvature", places=cast("Any", [3])),
        "places[0] must be an index of a section and a fraction, got 3 (int)",
    ),
    "one place": (
        lambda: cdcr.Sensor(kind="curvature", places=cast("Any", 3)),
        "places must be a sequence of places, got 3 (int)",
    ),
    "no actuators": (
        lambda: cdcr.Loop(MODEL, PID, actuators=NONE),
        "actuators must be a cdcr.Actuator or a sequence of them, got None",
    ),
    "no sensors": (
        lambda: cdcr.Loop(MODEL, PID, sensors=cast("Any", 3)),
        "sensors must be a cdcr.Sensor or a sequence of them, got 3 (int)",
    ),
    "ragged gain": (
        lambda: cdcr.Pid(MODEL, kp=cast("Any", [[1.0], [2.0, 3.0]])),
        "kp must be numbers, got",
    ),
    "no time": (lambda: PATH.evaluate(float("nan")), "t must be a number [s], got nan"),
    "rest": (
        lambda: cdcr.ReferencePath.circle([0], [1], [2], 1.0, 1.0, cast("Any", float("nan"))),
        "rest_to_rest must be True or False, got nan (float)",
    ),
    "winch": (
        lambda: cdcr.Actuator(winch=cast("Any", 3.0)),
        "winch must be a cdcr.Winch, got float",
    ),
    "other robot": (
        lambda: cdcr.Loop(cdcr.Model(cdcr.robots.three_sections()), PID),
        "the controller was made for a robot of 2 coordinates and 3 cables, but the model has 6",
    ),
}


@pytest.mark.parametrize("case", REFUSALS)
def test_what_does_not_fit_is_refused(case: str) -> None:
    is_refused(*REFUSALS[case])
