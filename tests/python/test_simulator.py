"""The simulator for loops written in Python."""

import math
import re
from typing import Any

import numpy as np
import pytest

import cdcr

Q0, QD0 = [0.4, -0.1], [0.5, 2.0]
PULL = [3.0, 1.0, 0.0]
# A power of two, so that sums of periods are exact and simulate makes the very same steps.
PERIOD = 1.0 / 512.0


@pytest.fixture
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020(gravity=(0.0, 0.0, -9.81), damping=1e-3))


@pytest.mark.parametrize("substeps", [1, 3])
def test_steps_are_those_of_simulate(model: cdcr.Model, substeps: int) -> None:
    sim = cdcr.Simulator(model, step=PERIOD, substeps=substeps)
    sim.reset(Q0, QD0)
    t = PERIOD * np.arange(257)
    run = cdcr.simulate(model, Q0, QD0, t=t, tension=PULL, method="rk4", step=PERIOD / substeps)
    for i in range(1, 257):
        assert sim.step(PULL) is cdcr.Status.ok
        assert sim.time == t[i]
        if substeps == 1:
            np.testing.assert_array_equal(sim.q, run.q[i])
            np.testing.assert_array_equal(sim.qd, run.qd[i])
    np.testing.assert_allclose(sim.q, run.q[-1], rtol=1e-12)


def test_before_reset_there_is_nothing_to_step(model: cdcr.Model) -> None:
    sim = cdcr.Simulator(model)
    assert sim.step(PULL) is cdcr.Status.not_started
    assert sim.time == 0.0
    assert sim.period == 1e-3


def test_reset_sets_state_and_time(model: cdcr.Model) -> None:
    sim = cdcr.Simulator(model)
    sim.reset(Q0, QD0, 5.0)
    for _ in range(10):
        sim.step(PULL)
    first = sim.q
    assert sim.time == 5.01
    sim.reset(Q0, QD0)
    np.testing.assert_array_equal(sim.q, Q0)
    np.testing.assert_array_equal(sim.qd, QD0)
    assert sim.time == 0.0
    for _ in range(10):
        sim.step(PULL)
    np.testing.assert_array_equal(sim.q, first)


def test_a_failed_step_leaves_the_last_good_state(model: cdcr.Model) -> None:
    sim = cdcr.Simulator(model, step=0.01)
    sim.reset([9.0, 0.0], [0.0, 0.0])
    status = cdcr.Status.ok
    while status is cdcr.Status.ok:
        before = sim.q, sim.qd, sim.time
        status = sim.step([200.0, 0.0, 0.0])
    assert status is cdcr.Status.bending_limit
    for kept, last in zip((sim.q, sim.qd, sim.time), before, strict=True):
        np.testing.assert_array_equal(kept, last)
    sim.reset(Q0, QD0)
    assert sim.step(PULL) is cdcr.Status.ok


def test_arrays_are_copies(model: cdcr.Model) -> None:
    sim = cdcr.Simulator(model)
    sim.reset(Q0, QD0)
    sim.q[:] = 7.0
    sim.qd[:] = 7.0
    np.testing.assert_array_equal(sim.q, Q0)
    np.testing.assert_array_equal(sim.qd, QD0)


def test_it_outlives_its_model() -> None:
    sim = cdcr.Simulator(cdcr.Model(cdcr.robots.amouri2020()))
    sim.reset(Q0, QD0)
    assert sim.step(PULL) is cdcr.Status.ok


def refuses(sentence: str) -> Any:
    return pytest.raises(ValueError, match=f"^{re.escape(sentence)}$")


def test_bad_tensions_are_refused_and_change_nothing(model: cdcr.Model) -> None:
    sim = cdcr.Simulator(model)
    sim.reset(Q0, QD0)
    with refuses("tension must have shape (3,), got (2,)"):
        sim.step([1.0, 2.0])
    with refuses("tension[0] (cable 1) must be finite, got inf"):
        sim.step([math.inf, 0.0, 0.0])
    with refuses("tension[2] (cable 3) must be >= 0 N (a cable cannot push), got -1"):
        sim.step([0.0, 0.0, -1.0])
    np.testing.assert_array_equal(sim.q, Q0)
    assert sim.time == 0.0


def test_bad_states_are_refused_and_change_nothing(model: cdcr.Model) -> None:
    sim = cdcr.Simulator(model)
    sim.reset(Q0, QD0)
    with refuses("q must have shape (2,), got (1,)"):
        sim.reset([0.0], QD0)
    with refuses("q must bend each section by at most 3 pi rad, got 10 rad in section 1"):
        sim.reset([10.0, 0.0], QD0)
    with refuses("qd[1] (section 1) must be finite, got nan"):
        sim.reset(Q0, [0.0, math.nan])
    with refuses("time must be finite, got nan"):
        sim.reset(Q0, QD0, math.nan)
    np.testing.assert_array_equal(sim.q, Q0)


def test_bad_periods_are_refused(model: cdcr.Model) -> None:
    with refuses("step must be > 0 s and finite, got 0"):
        cdcr.Simulator(model, step=0.0)
    with refuses("step must be > 0 s and finite, got nan"):
        cdcr.Simulator(model, step=math.nan)
    with refuses("substeps must be at least 1, got 0"):
        cdcr.Simulator(model, substeps=0)


def test_tension_and_command_are_two_names_for_one_argument() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    one, other = cdcr.Simulator(model), cdcr.Simulator(model)
    for sim in (one, other):
        sim.reset([0.1, 0.2], [0.0, 0.0])
    assert one.step(tension=PULL) is other.step(command=PULL) is cdcr.Status.ok
    assert np.array_equal(one.qd, other.qd)
    sentence = "give either tension or command, two names for one thing, not both or none"
    for given in (None, PULL):
        with pytest.raises(ValueError, match=sentence):
            one.step(tension=given, command=given)
