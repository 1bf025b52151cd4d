"""What a run must not miss and where it must not stop; times counted from anywhere."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr import _core

METHODS = ("auto", "bdf", "adams", "dopri5", "dop853", "rk4")
ADAPTIVE = METHODS[:4]
ZEROS = [0.0, 0.0]


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020())


@pytest.mark.parametrize("method", ADAPTIVE)
@pytest.mark.parametrize("samples", [2, 2001])
def test_a_short_pulse_of_a_function_moves_the_robot(
    model: cdcr.Model, method: Any, samples: int
) -> None:
    t = np.linspace(0.0, 20.0, samples)

    def pulse(t: float) -> Any:
        return [20.0 * (10.0 <= t < 10.05), 0.0, 0.0]

    asked: dict[str, Any] = {"t": t, "method": method}
    told = cdcr.simulate(
        model, ZEROS, ZEROS, **asked, tension=pulse, break_points=[10.0, 10.05], throw=True
    )
    run = cdcr.simulate(model, ZEROS, ZEROS, **asked, tension=pulse, throw=True)
    np.testing.assert_allclose(run.q, told.q, atol=1e-6)
    push = cdcr.Wrench(
        section=0, fraction=1.0, force=(1.0, 0.0, 0.0), profile=lambda t: float(10.0 <= t < 10.05)
    )
    pushed = cdcr.simulate(model, ZEROS, ZEROS, **asked, wrenches=push, throw=True)
    assert abs(pushed.q[-1, 0]) > 0.05


@pytest.mark.parametrize("method", METHODS)
def test_the_zero_of_time_does_not_matter(model: cdcr.Model, method: Any) -> None:
    # Multiples of 1/64 s are exact at both zeros.
    t, origin = np.arange(129) / 64.0, float(2**31)
    driven = replace(model.robot.sections[0], cable_stiffness=500.0)
    by_length = cdcr.Model(replace(model.robot, sections=(driven,)))

    def pull(t: float) -> Any:
        return [5.0 + (t % 2.0), 0.0, 0.0]

    table = cdcr.TensionTable([0.5, 1.0], [[1.0, 0.0, 0.0], [4.0, 0.0, 0.0]])
    later = cdcr.TensionTable(np.array(table.t) + origin, table.tension)
    push = [
        cdcr.Wrench(section=0, fraction=1.0, force=(0.1, 0.0, 0.0), profile=([a, a + 0.5], [0, 1]))
        for a in (0.25, 0.25 + origin)
    ]
    pid = cdcr.Pid(model, kp=0.1, ki=0.1, kd=0.01, period=1.0 / 64.0)
    pairs: list[tuple[cdcr.Model, dict[str, Any], dict[str, Any]]] = [
        (model, {"tension": [5.0, 0.0, 0.0]}, {"tension": [5.0, 0.0, 0.0]}),
        (model, {"tension": table}, {"tension": later}),
        (model, {"tension": pull}, {"tension": pull}),
        (model, {"wrenches": push[0]}, {"wrenches": push[1]}),
        (model, {"controller": pid}, {"controller": pid}),
        (by_length, {}, {}),
    ]
    for robot, first, second in pairs:
        shared: dict[str, Any] = {"method": method, "step": 1.0 / 1024.0}
        now = cdcr.simulate(robot, [0.3, 0.1], ZEROS, t=t, **shared, **first)
        then = cdcr.simulate(robot, [0.3, 0.1], ZEROS, t=t + origin, **shared, **second)
        atol = 1e-6 if first.get("tension") is pull else 0.0  # it is given rounded times
        assert now.success
        np.testing.assert_allclose(then.q, now.q, rtol=0.0, atol=atol)
        np.testing.assert_array_equal(then.t, t + origin)
        turns = [turn.time - origin for turn in then.slack_events]
        np.testing.assert_allclose(turns, [turn.time for turn in now.slack_events], atol=1e-6)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("q0", "qd0", "tension"), [([3.0, 0.0], [100.0, 0.0], 0.0), ([9.42, 0.0], ZEROS, 400.0)]
)
def test_a_run_into_the_bending_limit_ends_there(
    model: cdcr.Model, method: Any, q0: list[float], qd0: list[float], tension: float
) -> None:
    run = cdcr.simulate(model, q0, qd0, t=[0.0, 1.0], tension=[tension, 0.0, 0.0], method=method)
    assert run.status is cdcr.Status.bending_limit
    assert run.stats.steps < 2000


def test_a_long_table_does_not_exhaust_bdf(model: cdcr.Model) -> None:
    t = np.arange(0.0, 55.0, 1e-3)
    rows = np.zeros((len(t), 3))
    rows[:, 0] = 3.0 + 3.0 * np.sin(2.0 * t)
    drive: dict[str, Any] = {"tension": (t, rows), "method": "bdf", "rtol": 1e-10}
    run = cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, t[-1]], **drive, throw=True)
    assert run.stats.steps > 1_000_000
    asked = cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 1.0], **drive, max_steps=100)
    assert asked.status is cdcr.Status.step_limit


@pytest.mark.skipif(not _core.with_cvode, reason="needs CVODE: too many steps for dop853")
def test_bdf_passes_the_kinks_of_friction() -> None:
    section = cdcr.Section(
        length=0.06,
        backbone_mass=3e-4,
        backbone_diameter=1e-3,
        youngs_modulus=50e9,
        damping=4e-4,
        cable_radius=0.0045,
        cable_angles=tuple(2.0 * math.pi * np.arange(3) / 3.0),
        cable_stiffness=8e3,
        cable_friction=0.7,
    )
    model = cdcr.Model(cdcr.Robot(sections=(section,) * 3, sliding_speed=1e-5))
    t = 15.0 * np.arange(3)
    shorter = 4e-3 * np.outer([0.0, 1.0, 0.0], [1.0, 0.0, 0.0] * 3)
    command = cdcr.TensionTable(t, model.rest_command() - shorter)
    zeros = np.zeros(6)
    coarse, fine = (
        cdcr.simulate(
            model, zeros, zeros, t=[0.0, 15.0, 30.0], command=command, rtol=rtol, throw=True
        )
        for rtol in (1e-8, 1e-10)
    )
    np.testing.assert_allclose(coarse.q, fine.q, atol=1e-5)


@pytest.mark.parametrize("method", METHODS)
def test_a_time_given_twice_is_a_jump(model: cdcr.Model, method: Any) -> None:
    t = [0.0, 0.25, 0.25, 0.5]
    rows = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]])
    out = [0.0, 0.125, 0.25, 0.5]
    whole = cdcr.simulate(model, ZEROS, ZEROS, t=out, tension=(t, rows), method=method)
    first = cdcr.simulate(model, ZEROS, ZEROS, t=out[:3], tension=(t[:2], rows[:2]), method=method)
    second = cdcr.simulate(
        model, first.q[-1], first.qd[-1], t=out[2:], tension=(t[2:], rows[2:]), method=method
    )
    np.testing.assert_allclose(whole.q[:3], first.q, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(whole.q[3], second.q[1], rtol=0.0, atol=1e-12)
    np.testing.assert_array_equal(whole.tension[2], rows[2])
    push: dict[str, Any] = {"section": 0, "force": (0.2, 0.0, 0.0)}
    bent = cdcr.simulate(
        model,
        ZEROS,
        ZEROS,
        t=out,
        wrenches=cdcr.Wrench(**push, profile=(t, [0.0, 1.0, 0.0, 0.0])),
        method=method,
    )
    alone = cdcr.simulate(
        model,
        ZEROS,
        ZEROS,
        t=out[:3],
        wrenches=cdcr.Wrench(**push, profile=(t[:2], [0.0, 1.0])),
        method=method,
    )
    np.testing.assert_allclose(bent.q[:3], alone.q, rtol=0.0, atol=1e-15)
