"""Estimators from Python: the linear filter of books, loops by hand, what they refuse."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm, solve_discrete_are  # type: ignore[import-untyped]

import cdcr

T = 1e-3
MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=0.02))
LENGTHS = cdcr.Sensor(kind="lengths", noise=1e-5)


def linear() -> tuple[Any, Any]:
    """Transition and noise over a period of the straight robot, by Van Loan's exponential."""
    A, _ = MODEL.linearize([0.0, 0.0], [0.0, 0.0], np.zeros(3))
    W = np.diag([0.0, 0.0, 4.0, 4.0])
    whole = expm(T * np.block([[-A, W], [np.zeros((4, 4)), A.T]]))
    F = whole[4:, 4:].T
    return F, F @ whole[:4, 4:]


def test_small_motions_are_filtered_as_by_the_linear_filter() -> None:
    F, V = linear()
    H, R = np.eye(2, 4), 1e-4**2 * np.eye(2)
    kalman = cdcr.ExtendedKalman(
        MODEL,
        sensors=cdcr.Sensor(kind="coordinates", noise=1e-4),
        acceleration_noise=2.0,
        deviation=1e-3,
        rate_deviation=1e-2,
    )
    kalman.reset([0.0, 0.0], [0.0, 0.0])
    x, P = np.zeros(4), np.diag([1e-6, 1e-6, 1e-4, 1e-4])
    # Small, so that what is not linear is below rounding of the measurements.
    told = 1e-6 * np.random.default_rng(3).normal(size=(3000, 2))
    for k, z in enumerate(told):
        if k > 0:
            x, P = F @ x, F @ P @ F.T + V
        S = H @ P @ H.T + R
        K = np.linalg.solve(S, H @ P).T
        innovation = z - H @ x
        x, P = x + K @ innovation, P - K @ S @ K.T
        q, qd = kalman.update([z], np.zeros(3))
        if k in (0, 1, 10, 2999):
            np.testing.assert_allclose([*q, *qd], x, rtol=1e-6, atol=1e-12)
            np.testing.assert_allclose(kalman.covariance, P, rtol=5e-7, atol=1e-14)
            squares = innovation @ np.linalg.solve(S, innovation)
            np.testing.assert_allclose(kalman.diagnostics["innovation"], squares, rtol=1e-6)
    before = solve_discrete_are(F.T, H.T, V, R)
    gain = np.linalg.solve(H @ before @ H.T + R, H @ before).T
    np.testing.assert_allclose(kalman.covariance, before - gain @ H @ before, rtol=5e-7, atol=1e-14)


@pytest.mark.parametrize("kind", [cdcr.ExtendedKalman, cdcr.UnscentedKalman])
def test_a_loop_tells_what_the_filter_tells_by_hand(kind: Any) -> None:
    sensors = [LENGTHS, cdcr.Sensor(kind="orientation", noise=0.01, period=2e-3, delay=2e-3)]
    inside, outside = (kind(MODEL, sensors=sensors, force_at=(0, 1.0)) for _ in range(2))
    controller = cdcr.ComputedTorque(MODEL, min_tension=1.0)
    controller.reference = [0.2, 0.1]
    loop = cdcr.Loop(MODEL, controller, sensors=sensors, estimator=inside)
    loop.reset([0.0, 0.0], [0.0, 0.0])
    run = loop.run(0.1, wrenches=cdcr.Wrench(section=0, force=(0.1, 0.0, 0.0)))
    outside.reset([0.0, 0.0], [0.0, 0.0])
    asked = np.vstack([np.zeros(3), run.asked])  # over the step before
    for k in range(100):
        turned = run.measurements[1][k] if k >= 2 and k % 2 == 0 else None
        q, qd = outside.update([run.measurements[0][k], turned], asked[k])
        np.testing.assert_array_equal(q, run.told_q[k])
        np.testing.assert_array_equal(qd, run.told_qd[k])
        assert outside.values["force_x"] == run.estimated["force_x"][k]
        assert outside.deviations["force_x"] == run.deviations["force_x"][k]
        assert outside.diagnostics["innovation"] == run.innovation[k]
    assert run.measured[10] == 6
    assert run.measured[11] == 3


def test_an_observer_hears_a_force_by_hand_and_by_a_filter() -> None:
    kalman = cdcr.ExtendedKalman(MODEL, sensors=cdcr.Sensor(kind="coordinates", noise=1e-6))
    observer = cdcr.MomentumObserver(MODEL, force_at=(0, 1.0), states=kalman)
    loop = cdcr.Loop(
        MODEL,
        cdcr.ComputedTorque(MODEL, min_tension=1.0),
        sensors=cdcr.Sensor(kind="coordinates", noise=1e-6),
        estimator=observer,
    )
    loop.reset([0.1, 0.0], [0.0, 0.0])
    force = np.array([0.2, -0.1, 0.0])
    run = loop.run(1.0, wrenches=cdcr.Wrench(section=0, force=tuple(force)))
    assert list(run.estimated) == ["Q_q1_x", "Q_q1_y", "force_x", "force_y", "force_z"]
    np.testing.assert_allclose(observer.force[:2], force[:2], atol=0.02)
    Q = MODEL.jacobian(loop.q, 0, 1.0)[:3].T @ force
    np.testing.assert_allclose(observer.generalized_force, Q, atol=0.02 * np.abs(Q).max())

    alone = cdcr.MomentumObserver(MODEL)
    alone.reset([0.1, 0.0], [0.0, 0.0])
    q, qd = alone.update([], np.zeros(3), [0.1, 0.0], [0.3, 0.0])
    np.testing.assert_array_equal(q, [0.1, 0.0])
    np.testing.assert_array_equal(qd, [0.3, 0.0])


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: cdcr.ExtendedKalman(MODEL, sensors=[]), "an estimator needs sensors"),
        (
            lambda: cdcr.ExtendedKalman(MODEL, sensors=cdcr.Sensor(kind="tip")),
            "noise of sensor 1 must be > 0 for an estimator, got 0",
        ),
        (
            lambda: cdcr.ExtendedKalman(MODEL, sensors=LENGTHS, acceleration_noise=[1, 2, 3]),
            r"acceleration_noise must be one value, or 2, >= 0 rad/s\^1.5, got \[1 2 3\]",
        ),
        (
            lambda: cdcr.UnscentedKalman(MODEL, sensors=LENGTHS, spread=0.0),
            "spread must be > 0 1 and finite, got 0",
        ),
        (
            lambda: cdcr.ExtendedKalman(MODEL, sensors=LENGTHS, force_at=(0,)),  # type: ignore[arg-type]
            "force_at must be an index of a section and a fraction of its length",
        ),
        (lambda: cdcr.MomentumObserver(MODEL, bandwidth=-1.0), "bandwidth must be > 0 rad/s"),
    ],
)
def test_what_does_not_fit_is_refused(make: Any, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        make()


@pytest.mark.parametrize("kind", [cdcr.ExtendedKalman, cdcr.UnscentedKalman, cdcr.Loop])
@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"period": 1.5e-3}, "period of sensor 2,? .*must be a whole number of steps of 0.001 s"),
        ({"delay": 1.5e-3}, "delay of sensor 2,? .*must be a whole number of steps of 0.001 s"),
        ({"noise": -1.0}, "noise of sensor 2 must be "),
        ({"bias": np.inf}, "bias of sensor 2 must be finite, got inf"),
        ({"kind": "curvature"}, "sensor 2, of curvature, needs places"),
        ({"places": [(1, 0.5)]}, "places of sensor 2 must be sections 0 to 0 and fractions 0 to "),
    ],
)
def test_a_sensor_that_does_not_fit_is_named(kind: Any, given: dict[str, Any], words: str) -> None:
    others = (cdcr.Pid(MODEL, kp=1.0),) if kind is cdcr.Loop else ()
    usual: dict[str, Any] = {"kind": "tip", "noise": 1e-3}
    bad = cdcr.Sensor(**usual | given)
    with pytest.raises(ValueError, match=f"^{words}"):
        kind(MODEL, *others, sensors=[LENGTHS, bad])


def test_estimators_of_another_robot_are_refused() -> None:
    larger = cdcr.Model(cdcr.robots.three_sections())
    kalman = cdcr.ExtendedKalman(larger, sensors=LENGTHS)
    sizes = "was made for a robot of 6 coordinates and 9 cables, but the model has 2 coordinates"
    with pytest.raises(ValueError, match=f"the estimator {sizes}"):
        cdcr.MomentumObserver(MODEL, states=kalman)
    controller = cdcr.Pid(MODEL, kp=1.0)
    with pytest.raises(ValueError, match=f"the estimator {sizes}"):
        cdcr.Loop(MODEL, controller, sensors=LENGTHS, estimator=kalman)
    (section,) = MODEL.robot.sections
    driven = cdcr.Model(replace(MODEL.robot, sections=(replace(section, cable_stiffness=2e4),)))
    for by_tension in (
        cdcr.ExtendedKalman(MODEL, sensors=LENGTHS),
        cdcr.UnscentedKalman(MODEL, sensors=LENGTHS),
        cdcr.MomentumObserver(MODEL),
    ):
        with pytest.raises(
            ValueError, match="expects cables driven by tension, but cable 1 of the"
        ):
            cdcr.Loop(driven, cdcr.Pid(driven, kp=1.0), sensors=LENGTHS, estimator=by_tension)


def test_variants_must_be_driven_alike() -> None:
    (section,) = MODEL.robot.sections
    driven = cdcr.Model(replace(MODEL.robot, sections=(replace(section, cable_stiffness=2e4),)))
    with pytest.raises(
        ValueError, match=r"variants\[0\]: cable 1 must be driven by tension, got one driven by len"
    ):
        cdcr.ExtendedKalman(MODEL, sensors=LENGTHS, variants=driven)


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"cable_friction": 0.2}, "friction by the sliding speed in place of presliding_stiffness"),
        ({"cable_stiffness": 2e4, "cable_backlash": 1e-3}, "drives without their backlash"),
    ],
)
def test_what_estimators_know_nothing_of_is_told(changed: Any, told: str) -> None:
    (section,) = MODEL.robot.sections
    robot = replace(MODEL.robot, sections=(replace(section, **changed),), presliding_stiffness=1e4)
    model = cdcr.Model(robot)
    for kind in (cdcr.ExtendedKalman, cdcr.UnscentedKalman):
        with pytest.warns(UserWarning, match=f"the filter knows nothing of .*: it takes {told}$"):
            kind(model, sensors=LENGTHS)
    if not model.has_backlash:
        with pytest.warns(UserWarning, match=f"the filter knows nothing of .*: it takes {told}$"):
            cdcr.ExtendedKalman(MODEL, sensors=LENGTHS, variants=model)
    with pytest.warns(UserWarning, match=f"the observer knows nothing of .*: it takes {told}$"):
        cdcr.MomentumObserver(model)
    with pytest.warns(UserWarning, match=r"a system of python-control knows nothing of"):
        cdcr.control.nonlinear_system(model)


def test_steps_of_a_filter_that_are_too_long_are_told() -> None:
    with pytest.warns(
        UserWarning, match=r"the filter goes on by steps of 1 s, beyond the 0\.\d+ s"
    ):
        cdcr.ExtendedKalman(MODEL, sensors=LENGTHS, period=2.0, substeps=2)


def test_what_is_of_another_kind_is_refused() -> None:
    bad: Any = "lengths"
    with pytest.raises(TypeError, match=r"sensors\[0\] must be"):
        cdcr.ExtendedKalman(MODEL, sensors=[bad])
    with pytest.raises(TypeError, match=r"variants\[0\] must be"):
        cdcr.ExtendedKalman(MODEL, sensors=LENGTHS, variants=[bad])
    with pytest.raises(TypeError, match="estimator must be"):
        cdcr.Loop(MODEL, cdcr.Pid(MODEL, kp=1.0), estimator=bad)
    with pytest.raises(TypeError, match="states must be"):
        cdcr.MomentumObserver(MODEL, states=bad)


@pytest.mark.parametrize("kind", [cdcr.ExtendedKalman, cdcr.UnscentedKalman])
def test_a_covariance_beyond_doubles_ends_a_run(kind: Any) -> None:
    kalman = kind(MODEL, sensors=LENGTHS, acceleration_noise=1e200)
    kalman.reset([0.1, 0.0], [0.0, 0.0])
    seen = [MODEL.cable_lengths([0.1, 0.0])]
    kalman.update(seen, np.zeros(3))
    with pytest.raises(ValueError, match="became infinite or not a number"):
        kalman.update(seen, np.zeros(3))


def test_updates_are_looked_at() -> None:
    kalman = cdcr.ExtendedKalman(MODEL, sensors=LENGTHS)
    with pytest.raises(ValueError, match="reset"):
        kalman.update([None], np.zeros(3))
    kalman.reset([0.0, 0.0], [0.0, 0.0])
    with pytest.raises(ValueError, match=r"measurements\[0\] must have shape \(3,\), got \(2,\)"):
        kalman.update([np.zeros(2)], np.zeros(3))
    with pytest.raises(ValueError, match="measurements must have an array of its size, or None"):
        kalman.update([], np.zeros(3))
    with pytest.raises(ValueError, match="command"):
        kalman.update([None], np.zeros(2))
