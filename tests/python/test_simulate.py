"""Runs: what may drive them, how exact they are, how they end, what they refuse."""

import functools
import pickle
import re
import warnings
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.runs.simulate import DEFAULT_METHOD
from interruption import interrupt_soon

METHODS = ["bdf", "adams", "dopri5", "dop853", "rk4"]
# Error of q [rad] over a second or two at the tight tolerances below; CVODE's steps add up.
TIGHT = {"bdf": 3e-10, "adams": 3e-10, "dopri5": 1e-11, "dop853": 1e-11, "rk4": 1e-10}
OPTIONS: dict[str, dict[str, float]] = {
    "bdf": {"rtol": 1e-12, "atol": 1e-14},
    "adams": {"rtol": 1e-12, "atol": 1e-14},
    "dopri5": {"rtol": 1e-12, "atol": 1e-14},
    "dop853": {"rtol": 1e-12, "atol": 1e-14},
    "rk4": {"step": 2e-4},
}
# What the default tolerances promise of the paper's step of tension over 10 s [rad].
DEFAULT = 1e-6

Q0, QD0 = [0.4, -0.3], [1.0, 2.0]
PULL = [3.0, 1.0, 0.5]
TIMES = np.array([0.1, 0.25, 0.6])
ROWS = np.array([[2.0, 0.0, 1.0], [0.0, 6.0, 0.5], [4.0, 0.0, 0.0]])


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020(gravity=(2.0, -1.0, -9.0), payload=0.01, damping=2e-3))


def run(model: cdcr.Model, tension: Any = None, **options: Any) -> cdcr.Trajectory:
    t = options.pop("t", np.linspace(0.0, 1.0, 51))
    found = cdcr.simulate(model, Q0, QD0, t=t, tension=tension, **options)
    assert found.success, found.message
    return found


def same(a: cdcr.Trajectory, b: cdcr.Trajectory) -> bool:
    return bool((a.q == b.q).all() and (a.qd == b.qd).all() and (a.tension == b.tension).all())


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("interpolation", ["linear", "previous"])
def test_methods_agree(model: cdcr.Model, method: str, interpolation: Any) -> None:
    table = cdcr.TensionTable(TIMES, ROWS, interpolation)
    truth = run(model, table, method="dopri5", rtol=1e-13, atol=1e-15)
    found = run(model, table, method=method, **OPTIONS[method])
    np.testing.assert_allclose(found.q, truth.q, rtol=0.0, atol=TIGHT[method])
    np.testing.assert_array_equal(found.tension, truth.tension)


def test_the_default_tolerances_keep_their_promise() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    drive: dict[str, Any] = {"t": np.linspace(0.0, 10.0, 1001), "tension": [5.0, 0.0, 0.0]}
    start: Any = ([0.0, 0.0], [0.0, 0.0])
    truth = cdcr.simulate(model, *start, **drive, method="dopri5", rtol=1e-13, atol=1e-15)
    found = cdcr.simulate(model, *start, **drive)
    assert np.abs(found.theta - truth.theta).max() < DEFAULT


@pytest.mark.parametrize("method", METHODS)
def test_a_run_does_not_depend_on_where_it_is_sampled(model: cdcr.Model, method: Any) -> None:
    fine = np.linspace(0.0, 1.0, 401)
    table = cdcr.TensionTable(TIMES, ROWS)
    runs = [run(model, table, t=t, method=method) for t in (fine, fine[::8], fine[[0, 104, 400]])]
    np.testing.assert_array_equal(runs[0].q[::8], runs[1].q)
    np.testing.assert_array_equal(runs[0].qd[::8], runs[1].qd)
    np.testing.assert_array_equal(runs[0].q[[0, 104, 400]], runs[2].q)


@pytest.mark.parametrize("method", METHODS)
def test_break_points_are_hit_exactly(model: cdcr.Model, method: Any) -> None:
    table = cdcr.TensionTable([0.0, 0.3], [PULL, ROWS[1]], "previous")
    whole = run(model, table, t=[0.0, 0.2, 0.3, 0.5], method=method)
    first = run(model, PULL, t=[0.0, 0.2, 0.3], method=method)
    second = cdcr.simulate(
        model, first.q[-1], first.qd[-1], t=[0.3, 0.5], tension=ROWS[1], method=method
    )
    np.testing.assert_array_equal(whole.q[:3], first.q)
    # Time counts from the start of each run.
    np.testing.assert_allclose(whole.q[2:], second.q, rtol=0.0, atol=1e-12)
    np.testing.assert_array_equal(whole.tension, [PULL, PULL, ROWS[1], ROWS[1]])


@pytest.mark.parametrize("method", METHODS)
def test_constant_tensions_in_every_form(model: cdcr.Model, method: Any) -> None:
    limit = {"method": method, "max_step": 0.01}  # that of a function would be a thousandth
    expected = run(model, PULL, **limit)
    assert (expected.tension == PULL).all()
    forms: list[Any] = [
        tuple(PULL),
        np.array(PULL),
        lambda t: PULL,
        lambda t, q, qd: np.array(PULL, dtype=np.float32),
        lambda *state: PULL,
        lambda t, gain=1.0: [gain * pull for pull in PULL],
        functools.partial(lambda pull, t: pull, PULL),
    ]
    for form in forms:
        assert same(run(model, form, **limit), expected)
    table = ([0.0, 2.0], [PULL, PULL])
    np.testing.assert_allclose(run(model, table, method=method).q, expected.q, atol=1e-7)


def test_none_is_no_tension(model: cdcr.Model) -> None:
    assert same(run(model), run(model, [0.0, 0.0, 0.0]))


def test_a_pair_is_a_linear_table(model: cdcr.Model) -> None:
    expected = run(model, cdcr.TensionTable(TIMES, ROWS, "linear"))
    assert same(run(model, (TIMES, ROWS)), expected)
    assert same(run(model, (list(TIMES), ROWS.tolist())), expected)
    wanted = [np.interp(expected.t, TIMES, column) for column in ROWS.T]
    np.testing.assert_allclose(expected.tension, np.transpose(wanted), atol=1e-14)


@pytest.mark.parametrize("method", METHODS)
def test_a_function_with_break_points_is_as_good_as_a_table(model: cdcr.Model, method: Any) -> None:
    def jump(t: float) -> Any:
        return ROWS[0] if t < 0.4 else ROWS[1]

    def ramp(t: float) -> Any:
        return [np.interp(t, TIMES, column) for column in ROWS.T]

    for function, table in (
        (jump, cdcr.TensionTable([0.0, 0.4], ROWS[:2], "previous")),
        (ramp, cdcr.TensionTable(TIMES, ROWS)),
    ):
        breaks: Any = table.t
        found = run(model, function, break_points=breaks, method=method, **OPTIONS[method])
        expected = run(model, table, method=method, **OPTIONS[method])
        np.testing.assert_allclose(found.q, expected.q, rtol=0.0, atol=2.0 * TIGHT[method])
        np.testing.assert_allclose(found.tension, expected.tension, atol=1e-14)


def test_feedback_sees_the_state(model: cdcr.Model) -> None:
    def pull_back(t: float, q: Any, qd: Any) -> Any:
        assert q.shape == qd.shape == (2,)
        return [max(0.0, 2.0 - 5.0 * q[0] - qd[0]), t, 0.0]

    found = run(model, pull_back)
    expected = [pull_back(*row) for row in zip(found.t, found.q, found.qd, strict=True)]
    np.testing.assert_array_equal(found.tension, expected)


def test_one_time_is_enough(model: cdcr.Model) -> None:
    found = run(model, PULL, t=[3.0])
    np.testing.assert_array_equal(found.q, [Q0])
    np.testing.assert_array_equal(found.tension, [PULL])


def test_a_step_limit_keeps_what_was_reached(model: cdcr.Model) -> None:
    full = run(model)
    cut = cdcr.simulate(model, Q0, QD0, t=full.t, max_steps=10)
    assert cut.status is cdcr.Status.step_limit
    assert cut.stats.steps == 10
    assert 0 < len(cut) < len(full)
    np.testing.assert_array_equal(cut.q, full.q[: len(cut)])
    assert re.match(r"^Stopped at t = [\d.]+ s \(step_limit\)\. The run needed more", cut.message)


@pytest.mark.parametrize("method", METHODS)
def test_bending_too_far_ends_the_run(method: Any) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    arguments: dict[str, Any] = {"tension": [300.0, 0.0, 0.0], "method": method}
    t = np.linspace(0.0, 5.0, 501)
    found = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=t, **arguments)
    assert found.status is cdcr.Status.bending_limit
    assert "(bending_limit). A section bent beyond 3 pi rad" in found.message
    assert found.theta.max() <= cdcr.max_bending
    with pytest.raises(RuntimeError, match=re.escape(found.message)):
        cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=t, throw=True, **arguments)


def test_progress_is_told_increasing_times(model: cdcr.Model) -> None:
    told: list[float] = []
    run(model, (TIMES, ROWS), method="rk4", step=1e-4, progress=told.append)
    assert told[0] == 0.0
    assert 10 < len(told) < 100
    assert (np.diff(told) > 0.0).all()
    assert told[-1] <= 1.0


class OutOfPatienceError(Exception):
    pass


@pytest.mark.parametrize("method", METHODS)
def test_what_a_callable_raises_comes_out_unchanged(model: cdcr.Model, method: Any) -> None:
    error = OutOfPatienceError("no more")

    def tension(t: float) -> Any:
        if t > 0.2:
            raise error
        return PULL

    def progress(t: float) -> None:
        raise error

    for arguments in ({"tension": tension}, {"progress": progress}):
        with pytest.raises(OutOfPatienceError) as caught:
            cdcr.simulate(model, Q0, QD0, t=[0.0, 1.0], method=method, **arguments)
        assert caught.value is error
    assert same(run(model, PULL, method=method), run(model, PULL, method=method))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("tension", [None, lambda t: PULL])
def test_control_c_stops_a_long_run(method: Any, tension: Any) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    with interrupt_soon() as since:
        with pytest.raises(KeyboardInterrupt):
            cdcr.simulate(
                model, Q0, QD0, t=[0.0, 1e5], tension=tension, method=method, max_steps=10**9
            )
        assert since() < 1.0


def test_taylor_warns_once_beyond_its_range() -> None:
    for formulation in ("taylor", "printed-taylor"):
        model = cdcr.Model(cdcr.robots.amouri2020(), formulation)
        with pytest.warns(UserWarning, match=r"up to 3 pi/5") as caught:
            cdcr.simulate(model, [2.0, 0.0], [0.0, 0.0], t=np.linspace(0.0, 1.0, 50))
        assert [str(warning.message) for warning in caught] == [
            f"formulation {formulation!r} holds for |theta| up to 3 pi/5 = 1.8850 rad; this motion "
            "reaches 2.0000 rad"
        ]
        assert caught[0].filename == __file__


def test_no_warning_within_the_range_or_where_there_is_none() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for formulation, bend in (("taylor", 1.8), ("exact", 2.0), ("printed", 2.0)):
            model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01), formulation)
            cdcr.simulate(model, [bend, 0.0], [0.0, 0.0], t=[0.0, 1.0])


def test_pickle(model: cdcr.Model) -> None:
    found = run(model, PULL)
    again = pickle.loads(pickle.dumps(found))
    assert same(again, found)
    assert (again.status, again.message, again.method) == (found.status, "", DEFAULT_METHOD)
    assert repr(again) == repr(found)
    assert repr(again.stats) == repr(found.stats)
    assert re.match(
        r"^Stats\(steps=\d+, rejected=\d+, evaluations=\d+, jacobians=\d+, newton_failures=\d+, "
        r"switches=0, method=dop853\)$",
        repr(found.stats),
    )
    np.testing.assert_array_equal(again.model.tip(Q0)[1], model.tip(Q0)[1])
