"""Controllers with a model, references and their feasibility, from Python."""

import copy
import math
import pickle
from typing import Any, cast

import numpy as np
import pytest

import cdcr

MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=0.02))
THREE = cdcr.Model(cdcr.robots.three_sections(damping=0.02))
# Off the paper's circle with commands held for 1 ms [rad]; ten times that seen.
ON_CIRCLE = 2e-6
ROUNDING = 1e-12


def controllers(model: cdcr.Model) -> dict[str, Any]:
    """One of each kind."""
    gain = np.zeros((model.num_cables, 2 * model.num_coordinates))
    return {
        "Pid": cdcr.Pid(model, kp=[1.0] * model.num_coordinates, ki=0.5, kd=0.1),
        "ComputedTorque": cdcr.ComputedTorque(model, kp=50.0, kd=15.0, min_tension=0.5),
        "StateFeedback": cdcr.StateFeedback(model, gain=gain, min_tension=0.2),
        "TaskSpace": cdcr.TaskSpace(model, damping=1e-3),
    }


def test_computed_torque_keeps_the_papers_circle() -> None:
    theta = math.pi / 12
    controller = cdcr.ComputedTorque(MODEL)
    controller.path = cdcr.ReferencePath.circle(
        [0, 0], [theta, 0], [0, theta], turns=1.0, duration=10.0, rest_to_rest=False
    )
    t = np.linspace(0.0, 10.0, 101)
    start = [0.0, theta * math.pi / 5]
    run = cdcr.simulate(MODEL, [theta, 0], start, t=t, controller=controller, method="dopri5")
    wanted = np.array([controller.path.evaluate(time)[0] for time in t])
    assert np.abs(run.q - wanted).max() < ON_CIRCLE


def test_state_feedback_of_lqr_settles_where_it_is_told_at_the_rate_of_its_poles() -> None:
    hold = np.full(3, 4.0)
    K = cdcr.control.lqr(MODEL, [0.0, 0.0], hold, Q=[100, 100, 1, 1], R=0.1, period=1e-3)
    A, B = MODEL.linearize([0.0, 0.0], [0.0, 0.0], hold)
    slowest = -np.linalg.eigvals(A - B @ K).real.max()
    controller = cdcr.StateFeedback(MODEL, gain=K, command=hold)
    run = cdcr.simulate(
        MODEL, [1e-3, 0], [0, 0], t=[0, 10 / slowest, 20 / slowest], controller=controller
    )
    left = np.linalg.norm(run.q, axis=1)
    assert left[1] < 1e-3 * math.exp(-8)
    assert left[2] < left[1]


@pytest.mark.parametrize("kind", controllers(MODEL))
def test_they_pickle_and_copy_with_their_path(kind: str) -> None:
    one = controllers(THREE)[kind]
    start, end = np.array(one.reference), np.array(one.reference) - 0.01
    one.path = cdcr.ReferencePath.spline([0.0, 1.0], [start, end])
    state = np.full(6, 0.02), np.full(6, -0.1)
    one.update(0.2, *state)
    for other in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one)):
        assert type(other) is type(one)
        np.testing.assert_array_equal(other.update(0.5, *state), one.update(0.5, *state))
        other.reset()
        one.reset()
        other.update(0.2, *state)
        one.update(0.2, *state)


@pytest.mark.parametrize("options", [{"filter": 0.05}, {"max_rate": 50.0}])
def test_copies_go_on_where_a_controller_filters_or_is_held_back(options: Any) -> None:
    states = 0.1 * np.random.default_rng(3).normal(size=(4, 2, 2))
    for one in (
        cdcr.Pid(MODEL, kp=1.0, ki=2.0, kd=0.1, **options),
        *([cdcr.ComputedTorque(MODEL, **options)] if "max_rate" in options else []),
    ):
        one.reference = [0.5, 0.1]
        for k in range(2):
            one.update(1e-3 * k, *states[k])
        others = pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)
        for k in range(2, 4):
            wanted = one.update(1e-3 * k, *states[k])
            for other in others:
                np.testing.assert_array_equal(other.update(1e-3 * k, *states[k]), wanted)


def test_the_time_of_an_update_is_finite() -> None:
    for time in (float("nan"), float("inf")):
        with pytest.raises(ValueError, match=r"t must be finite, got (nan|inf)"):
            cdcr.Pid(MODEL, kp=1.0).update(time, [0.0, 0.0], [0.0, 0.0])


def test_limits_hold_and_diagnostics_tell() -> None:
    pid = cdcr.Pid(MODEL, kp=50.0, pretension=[0.5, 0.6, 0.7], max_tension=4.0)
    pid.reference = [0.5, 0.0]
    tension = pid.update(0.0, [0.0, 0.0], [0.0, 0.0])
    np.testing.assert_allclose(tension, [4.0, 0.6, 0.7], atol=ROUNDING)
    found = pid.diagnostics
    assert found["updates"] == 1
    assert found["duration"] > 0.0
    assert found["error"] == 0.5
    assert found["missing"] > 1.0
    assert found["limited"] == 3


def test_a_circle_of_the_tip() -> None:
    start = [0.5, 0.1, 0.3, -0.2, 0.4, 0.1]
    place = THREE.tip(start)[1]
    controller = cdcr.TaskSpace(THREE, damping=1e-3, min_tension=0.5)
    controller.path = cdcr.ReferencePath.circle(
        place - [0.02, 0, 0], [0.02, 0, 0], [0, 0.02, 0], turns=1.0, duration=2.0
    )
    t = np.linspace(0, 2, 41)
    run = cdcr.simulate(THREE, start, [0] * 6, t=t, controller=controller, method="dopri5")
    wanted = np.array([controller.path.evaluate(time)[0] for time in t])
    assert np.linalg.norm(run.tip - wanted, axis=1).max() < 1e-3


def test_feasibility_is_told_before_the_run() -> None:
    theta = math.pi / 12
    circle = cdcr.ReferencePath.circle([0, 0], [theta, 0], [0, theta], 1.0, 10.0)
    report = cdcr.check_path(MODEL, circle)
    assert report.feasible
    assert report.tension.shape == (201, 3)
    most, rate = report.tension.max(), report.rate
    narrow = cdcr.check_path(MODEL, circle, max_tension=0.9 * most, max_rate=0.5 * rate)
    assert not narrow.feasible
    assert "cannot give the motion from t = " in narrow.sentences[0]
    assert "tensions would change by more than" in narrow.sentences[1]
    far = cdcr.check_path(THREE, cdcr.ReferencePath.constant([5.0, 0.0, 0.0]))
    assert far.sentences[0].startswith("the tip cannot reach the path at t = 0 s: ")
    place = THREE.tip([0.5, 0.1, 0.3, -0.2, 0.4, 0.1])[1]
    near = cdcr.check_path(THREE, cdcr.ReferencePath.constant(place), num_samples=5)
    assert near.feasible
    np.testing.assert_allclose(THREE.tip(near.q[2])[1], place, atol=1e-6)
    with pytest.raises(ValueError, match="path must have 6 values, or 3 of the tip, got 2"):
        cdcr.check_path(THREE, circle)


NONE = cast("Any", None)
REFUSALS: dict[str, tuple[Any, str]] = {
    "model": (lambda: cdcr.ComputedTorque(NONE), "model must be a cdcr.Model, got NoneType"),
    "gain": (
        lambda: cdcr.ComputedTorque(MODEL, kp=[1.0, 2.0, 3.0]),
        "kp must be a number, 2 numbers or a matrix of 2 by 2, got 3 by 1",
    ),
    "gain of feedback": (
        lambda: cdcr.StateFeedback(MODEL, gain=np.zeros((2, 2))),
        "gain must have shape (3, 4), got (2, 2)",
    ),
    "pushing cables": (
        lambda: cdcr.ComputedTorque(MODEL, min_tension=-math.inf, max_tension=-1.0),
        "max_tension must be >= 0 N (a cable cannot push), got -1",
    ),
    "a cable twice": (
        lambda: cdcr.Pid(MODEL, kp=1.0, cables=[0, 1, 0]),
        "cables must differ, got 0 2 times",
    ),
    "no cables": (
        lambda: cdcr.Pid(MODEL, kp=1.0, cables=[]),
        "cables must be a sequence of one index or more, got [] (list)",
    ),
    "a place beyond reach": (
        lambda: setattr(cdcr.TaskSpace(THREE), "reference", [5.0, 0.0, 0.0]),
        "reference must be at most 0.75 m from the base, as far as the tip reaches, got [5 0 0], "
        "which is 5 m away",
    ),
    "a path beyond reach": (
        lambda: setattr(
            cdcr.TaskSpace(THREE, orientation_weight=0.3),
            "path",
            cdcr.ReferencePath.spline([0, 1], [[0, 0, 0.7, 0, 0, 0], [0, 0, 0.8, 0, 0, 0]]),
        ),
        "reference must be at most 0.75 m from the base, as far as the tip reaches, got [       0"
        "        0 0.750732], which is 0.750732 m away",
    ),
    "period": (
        lambda: cdcr.TaskSpace(MODEL, period=0.0),
        "period must be > 0 s and finite, got 0",
    ),
    "pretension": (
        lambda: cdcr.Pid(MODEL, kp=1.0, pretension=[9.0] * 3, max_tension=5.0),
        "pretension of cable 1 must be finite and at most max_tension, 5 N, got 9",
    ),
    "reference of the tip": (
        lambda: setattr(cdcr.TaskSpace(MODEL), "reference", [0.0, 1.0]),
        "reference must have shape (3,), got (2,)",
    ),
    "path": (
        lambda: setattr(
            cdcr.ComputedTorque(MODEL), "path", cdcr.ReferencePath.constant([1.0, 2.0, 3.0])
        ),
        "reference must be 2 finite values that bend each section by at most 3 pi rad, got [1 2 3]",
    ),
}


@pytest.mark.parametrize("case", REFUSALS)
def test_what_does_not_fit_is_refused(case: str) -> None:
    run, sentence = REFUSALS[case]
    with pytest.raises((ValueError, TypeError)) as caught:
        run()
    assert str(caught.value) == sentence


@pytest.mark.parametrize(
    "made",
    [
        lambda: cdcr.Pid(MODEL, kp=1.0),
        lambda: cdcr.ComputedTorque(MODEL, kp=1.0),
        lambda: cdcr.StateFeedback(MODEL, gain=np.zeros((3, 4))),
        lambda: cdcr.TaskSpace(MODEL),
        lambda: cdcr.Loop(MODEL, cdcr.Pid(MODEL, kp=1.0), step=1e-3),
        lambda: cdcr.MomentumObserver(MODEL, force_at=(0, 1.0)),
        lambda: cdcr.ExtendedKalman(MODEL, sensors=cdcr.Sensor(kind="tip", noise=1e-3)),
        lambda: MODEL,
    ],
)
def test_an_attribute_that_there_is_not_is_an_error(made: Any) -> None:
    with pytest.raises(AttributeError, match="goal"):
        made().goal = [0.3, 0.0]


def test_a_class_of_ones_own_may_keep_what_it_likes() -> None:
    class Mine(cdcr.Pid):
        pass

    mine: Any = Mine(MODEL, kp=1.0)
    mine.note = "first"
    assert copy.copy(mine).note == "first"
