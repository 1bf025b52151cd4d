"""Examples of control and estimation: each runs, and finds what other means find."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm  # type: ignore[import-untyped]
from scipy.optimize import root  # type: ignore[import-untyped]

import cdcr
from example_script import Example


def test_closed_loop(example: Example) -> None:
    found = example(21)
    errors = {name: error.max() for name, error in found["errors"].items()}
    assert errors["ideal"] < 2e-6
    assert errors["late, and known to be"] < 0.2 * errors["late"]
    # The same loop by hand: a lag, a delay, a controller asked each millisecond.
    model, circle = found["model"], found["circle"]
    simulator = cdcr.Simulator(model, step=1e-3)
    simulator.reset([0.3, 0], [0, 0])
    controller = cdcr.ComputedTorque(model, kp=64.0, kd=16.0, min_tension=1.0)
    controller.path = circle
    seen, value = (simulator.q, simulator.qd), found["hold"]
    worst, share = 0.0, 1.0 - np.exp(-0.5)
    for _ in range(4000):
        command = controller.update(simulator.time, *seen)
        seen = simulator.q, simulator.qd
        after = value + share * (command - value)
        simulator.step((value + after) / 2.0)
        value = after
        error = simulator.q - circle.evaluate(simulator.time)[0]
        worst = max(worst, float(np.linalg.norm(error)))
    assert worst == pytest.approx(errors["late"], rel=1e-3)


def test_estimation(example: Example) -> None:
    found = example(22)
    assert found["off"][1] == pytest.approx(0.05, rel=0.02)  # where the filter begins
    assert found["off"][-500:].max() < 0.01
    # The force that bends the robot as it stands at the end, by statics.
    model, loop = found["model"], found["loop"]
    at_rest = model.inverse_dynamics(loop.q, loop.qd * 0.0, np.zeros(6))
    pulled = model.actuation_matrix() @ loop.given
    J = model.jacobian(loop.q, 2, 1.0)[:3]
    by_statics = np.linalg.lstsq(J.T, at_rest - pulled, rcond=None)[0]
    np.testing.assert_allclose(found["force"][-200:].mean(axis=0), by_statics, atol=0.05)
    np.testing.assert_allclose(found["force"][-200:].mean(axis=0), found["push"], atol=0.03)


def test_lqr(example: Example) -> None:
    pytest.importorskip("control", reason="the extra control")
    found = example(7)
    A, B, Q, K = found["system"].A, found["system"].B, np.diag(found["Q"]), found["K"]
    # The poles of the loop are the stable ones of the Hamiltonian matrix.
    poles = np.linalg.eigvals(np.block([[A, -B @ B.T], [-Q, -A.T]]))
    expected = np.sort_complex(poles[poles.real < 0.0])
    assert len(expected) == 12
    np.testing.assert_allclose(np.sort_complex(found["closed"].poles()), expected, rtol=1e-8)
    # After the knock the run decays as the linear loop does.
    t, run = found["t"], found["runs"]["LQR"]
    early, late = np.searchsorted(t, [1.0, 1.5])
    x = np.hstack([run.q - found["shape"], run.qd])
    decayed = expm((A - B @ K) * (t[late] - t[early])) @ x[early]
    np.testing.assert_allclose(x[late], decayed, rtol=0, atol=0.05 * np.abs(x[early]).max())
    off, expected = found["off"]["LQR"][found["after"] :], found["expected"]
    np.testing.assert_allclose(off, expected, rtol=0, atol=0.1 * expected.max())
    assert found["off"]["held"][t >= 2].max() > 100.0 > 1.0 > found["off"]["LQR"][t >= 2].max()


def test_own_controller(example: Example) -> None:
    found = example(8)
    w, run, reference = found["w"], found["run"], found["reference"]
    # The error equation integrated: e'' = -2 w e' - w^2 e.
    A = np.kron([[0.0, 1.0], [-(w**2), -2.0 * w]], np.eye(2))
    e0 = -np.concatenate([reference.q[0], reference.qd[0]])
    for row in (10, 30, 60):
        error = (expm(A * run.t[row]) @ e0)[:2]
        atol = 0.01 * np.linalg.norm(e0)
        np.testing.assert_allclose(run.q[row] - reference.q[row], error, rtol=0, atol=atol)
    assert found["late"] < 2.0
    assert run.tension.min() >= 0.5


def test_pid(example: Example) -> None:
    found = example(6)
    real, known, goal = found["real"], found["known"], found["goal"]
    hold = known.potential_gradient(goal)
    # Without an integral it rests where the robot's own moment is the controller's.
    offset = root(lambda q: real.potential_gradient(q) - hold - (goal - q), goal).x
    np.testing.assert_allclose(found["runs"]["kp, kd"].q[-1], offset, rtol=0, atol=1e-6)
    np.testing.assert_allclose(found["runs"]["kp, ki, kd"].q[-1], goal, rtol=0, atol=1e-6)


def test_control_loop(example: Example) -> None:
    found = example(12)
    model, goal = found["model"], found["goal"]

    class Loop(cdcr.Controller):
        def update(self, t: float, q: Any, qd: Any) -> Any:
            moment = found["hold"] + found["KP"] * (goal - q) - found["KD"] * qd
            return model.allocate(moment, min_tension=0.5)

    # The same in one run.
    push = cdcr.Wrench(
        section=0,
        force=(0.0, 0.5, 0.0),
        profile=([0.0, 1.0, 2.0], [0.0, 1.0, 0.0]),
        interpolation="previous",
    )
    run = cdcr.simulate(
        model,
        goal,
        [0, 0],
        t=np.arange(3001) * 1e-3,
        controller=Loop(1e-3),
        wrenches=push,
        method="rk4",
        step=1e-3,
    )
    np.testing.assert_allclose(found["q"], run.q[1:], rtol=0, atol=1e-9)
    # Pushed, it rests where push, moment and robot are in balance.
    push = cdcr.Wrench(section=0, force=(0.0, 0.5, 0.0))

    def balance(q: Any) -> Any:
        given = found["hold"] + found["KP"] * (goal - q) + model.wrench_force(q, push)
        return model.potential_gradient(q) - given

    np.testing.assert_allclose(found["q"][1999], root(balance, goal).x, rtol=0, atol=1e-3)


def test_predictive_control(example: Example) -> None:
    pytest.importorskip("piqp", reason="needs PIQP, extra mpc")
    found = example(25)
    model, circle, start = found["model"], found["circle"], found["start"]
    free = cdcr.TaskSpace(model, posture=start, damping=1e-3)
    free.path = circle
    run = cdcr.simulate(model, start, np.zeros(6), t=found["t"], controller=free, method="rk4")
    assert np.linalg.norm(run.tip - found["wanted"], axis=1).max() < 1e-4  # the motion exists,
    assert run.tension.max() > 1.5 * found["most"]  # and needs more
    assert found["runs"]["predictive"].tension.max() <= found["most"]
    assert found["errors"]["predictive"].max() < 8.0  # [mm]
    assert found["errors"]["task space"].max() > 50.0
