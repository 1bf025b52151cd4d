"""Runs under wrenches: profiles, jumps, controllers, and exceptions that come through."""

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr

METHODS = ("rk4", "dopri5", "dop853", "bdf", "adams")
Q, QD = np.array([0.3, -0.2]), np.array([1.0, 0.5])
# bdf and adams: errors of thousands of steps at rtol 1e-12 add up; the others repeat their steps.
GLUED = {"rk4": 1e-12, "dopri5": 1e-12, "dop853": 1e-12, "bdf": 1e-9, "adams": 1e-9}
OPTIONS: dict[str, Any] = {"rtol": 1e-12, "atol": 1e-14, "step": 2.0**-11}
SIDE = cdcr.Wrench(section=0, fraction=0.7, force=(0.3, -0.1, 0.2), moment=(0.02, 0.05, 0.0))


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020(damping=5e-3, gravity=(0.0, 0.0, 9.81)))


def scaled(factor: float) -> cdcr.Wrench:
    return cdcr.Wrench(
        section=SIDE.section,
        fraction=SIDE.fraction,
        force=np.multiply(SIDE.force, factor),
        moment=np.multiply(SIDE.moment, factor),
    )


@pytest.mark.parametrize("method", METHODS)
def test_jumps_are_hit_exactly(model: cdcr.Model, method: Any) -> None:
    q, qd = Q, QD
    for start, end, factor in ((0.0, 0.40625, 0.0), (0.40625, 0.75, 1.0), (0.75, 1.0, -2.0)):
        piece = cdcr.simulate(
            model, q, qd, t=[start, end], wrenches=scaled(factor), method=method, **OPTIONS
        )
        q, qd = piece.q[-1], piece.qd[-1]
    table = replace(
        SIDE, profile=([0.0, 0.40625, 0.75], [0.0, 1.0, -2.0]), interpolation="previous"
    )
    function = replace(
        SIDE,
        profile=lambda t: 0.0 if t < 0.40625 else 1.0 if t < 0.75 else -2.0,
        break_points=(0.40625, 0.75),
    )
    for wrench in (table, function):
        run = cdcr.simulate(model, Q, QD, t=[0.0, 1.0], wrenches=[wrench], method=method, **OPTIONS)
        np.testing.assert_allclose(run.q[-1], q, rtol=0, atol=GLUED[method])
        np.testing.assert_allclose(run.qd[-1], qd, rtol=0, atol=100 * GLUED[method])


def test_linear_table_is_the_function_of_the_same_slope(model: cdcr.Model) -> None:
    ramp = replace(SIDE, profile=([0.0, 1.0], [0.0, 2.0]))
    called = replace(SIDE, profile=lambda t: 2.0 * t, break_points=(0.0, 1.0))
    runs = [
        cdcr.simulate(model, Q, QD, t=[0.0, 0.5, 1.0], wrenches=w, method="dopri5", **OPTIONS)
        for w in (ramp, called)
    ]
    np.testing.assert_allclose(runs[0].q, runs[1].q, rtol=0, atol=1e-12)


def test_several_wrenches_add_up(model: cdcr.Model) -> None:
    both = cdcr.simulate(
        model, Q, QD, t=[0.0, 0.5], wrenches=[scaled(0.25), scaled(0.75)], method="dopri5"
    )
    one = cdcr.simulate(model, Q, QD, t=[0.0, 0.5], wrenches=SIDE, method="dopri5")
    np.testing.assert_allclose(both.q, one.q, rtol=0, atol=1e-10)


def test_a_controller_works_against_a_wrench(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=1.0, ki=2.0, kd=0.1, period=1e-2)
    pid.reference = [0.2, 0.1]
    push = cdcr.Wrench(section=0, force=(0.05, 0.0, 0.0))
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=[0.0, 15.0], controller=pid, wrenches=push)
    assert run.success
    np.testing.assert_allclose(run.q[-1], [0.2, 0.1], rtol=0, atol=1e-3)


def test_the_simulator_takes_the_steps_of_rk4(model: cdcr.Model) -> None:
    sim = cdcr.Simulator(model, step=2.0**-10)
    sim.reset(Q, QD)
    t = np.arange(65) * 2.0**-10
    run = cdcr.simulate(model, Q, QD, t=t, wrenches=SIDE, method="rk4", step=2.0**-10)
    for i in range(1, 65):
        assert sim.step(np.zeros(3), [SIDE]) == cdcr.Status.ok
        np.testing.assert_array_equal(sim.q, run.q[i])


@pytest.mark.parametrize("method", METHODS)
def test_an_exception_of_a_profile_comes_through(model: cdcr.Model, method: Any) -> None:
    def profile(t: float) -> float:
        if t > 0.05:
            raise LookupError("no such time")
        return 1.0

    with pytest.raises(LookupError, match=r"^no such time$"):
        cdcr.simulate(
            model, Q, QD, t=[0.0, 0.1], wrenches=replace(SIDE, profile=profile), method=method
        )
    assert cdcr.simulate(model, Q, QD, t=[0.0, 0.1], wrenches=SIDE, method=method).success


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("value", [np.nan, np.inf, None, "big", [1.0, 2.0]])
def test_a_profile_must_give_a_finite_number(model: cdcr.Model, method: Any, value: Any) -> None:
    with pytest.raises(ValueError, match="the value of a wrench's profile"):
        cdcr.simulate(
            model,
            Q,
            QD,
            t=[0.0, 0.1],
            wrenches=replace(SIDE, profile=lambda t: value),
            method=method,
        )


@pytest.mark.parametrize(
    ("profile", "sentence"),
    [
        (
            ([0.0, 1.0, 0.5], [1.0, 1.0, 1.0]),
            "the times of a wrench's profile must be finite and strictly increasing, "
            "got 0.5 s at index 2 after 1 s",
        ),
        (([0.0, 1.0], [1.0]), "the factors of a wrench's profile must have shape (2,), got (1,)"),
        (([0.0, np.nan], [1.0, 1.0]), "the times of a wrench's profile[1] must be finite, got nan"),
        (
            ([0.0], ["x"]),
            "the factors of a wrench's profile must be numbers of shape (1,), got list of text",
        ),
    ],
)
def test_bad_tables_are_refused(model: cdcr.Model, profile: Any, sentence: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        cdcr.simulate(model, Q, QD, t=[0.0, 0.1], wrenches=replace(SIDE, profile=profile))


def test_unsorted_break_points_are_refused(model: cdcr.Model) -> None:
    wrench = replace(SIDE, profile=lambda t: 1.0, break_points=(0.5, 0.25))
    with pytest.raises(ValueError, match=r"strictly increasing, got 0.25 s at index 1 after "):
        cdcr.simulate(model, Q, QD, t=[0.0, 0.1], wrenches=wrench)
