"""The scenarios of closed loops against what must hold of them."""

import numpy as np
import pytest

import cdcr
import cdcr.scenarios

# Computed torque with commands held for 1 ms [rad]; the figure of the chapter.
ON_CIRCLE = 1e-6


def found(name: str) -> tuple[cdcr.Trajectory, dict[str, float]]:
    scenario = cdcr.scenarios.get(name)
    run = scenario.simulate()
    assert run.success
    return run, {one.key: one.value for one in scenario.summary(run)}


def test_regulation_settles_with_noise_and_late_motors() -> None:
    run, metrics = found("regulation")
    assert metrics["settling_s"] < 0.5
    assert np.rad2deg(run.theta[-1, 0]) == pytest.approx(30.0, abs=0.1)
    assert (run.command * 100 % 1.0).max() > 0.1  # the lag is between the steps of the motors


def test_circle_control_ranks_the_three_controllers() -> None:
    pytest.importorskip("scipy", reason="the extra control")
    run, metrics = found("circle-control")
    assert metrics["error_computed_torque_rad"] < ON_CIRCLE
    assert 20 * metrics["error_computed_torque_rad"] < metrics["error_pid_rad"]
    assert metrics["error_pid_rad"] < metrics["error_lqr_rad"] < 1e-3
    # The run is that of computed torque: its error dies away as e'' + 16 e' + 64 e = 0.
    path = cdcr.scenarios.get("circle-control").controller.path  # type: ignore[union-attr]
    first, rate = run.q[0] - path.evaluate(0.0)[0], run.qd[0] - path.evaluate(0.0)[1]
    for i in (20, 50, 100):
        t = run.t[i]
        expected = (first + (rate + 8.0 * first) * t) * np.exp(-8.0 * t)
        np.testing.assert_allclose(run.q[i] - path.evaluate(t)[0], expected, atol=1e-5)


def test_three_section_tracking_goes_round_the_square() -> None:
    run, metrics = found("three-section-tracking")
    assert metrics["error_max_mm"] < 1.0
    assert run.tension.min() == pytest.approx(1.0)
    sides = np.ptp(run.tip[:, :2], axis=0)
    np.testing.assert_allclose(sides, 0.08, atol=1e-3)


def test_motor_limits_anti_windup_halves_the_overshoot() -> None:
    run, metrics = found("motor-limits")
    assert metrics["overshoot_limits_anti_windup_deg"] < 0.5 * metrics["overshoot_limits_deg"]
    assert run.tension.max() <= 7.0
    fastest = np.abs(np.diff(run.command, axis=0)).max() / np.diff(run.t)[0]
    assert fastest <= 5.0 * (1 + 1e-9)
    from cdcr.scenarios.studies.motor_limits import NAMES, runs

    same = runs(6.0)[NAMES[0]]
    np.testing.assert_array_equal(same.q, run.q)


def test_estimator_is_honest_and_a_late_camera_helps() -> None:
    _, metrics = found("estimator")
    assert metrics["error_extended_deg"] < 0.6 * metrics["error_lengths_deg"]
    assert metrics["error_unscented_deg"] == pytest.approx(metrics["error_extended_deg"], rel=0.05)
    values = 3000 * 9 + 300 * 3
    assert abs(metrics["innovation"] - 1.0) < 5.0 * np.sqrt(2.0 / (values / 2.0))


def test_contact_force_is_found_within_a_tenth() -> None:
    _, metrics = found("contact-force")
    assert metrics["error_observer_percent"] < 10.0
    assert metrics["error_filter_percent"] < 10.0
