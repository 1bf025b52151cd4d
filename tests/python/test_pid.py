"""The PID controller from Python, and runs under it."""

import re
from typing import Any

import numpy as np
import pytest

import cdcr

# A handful of operations.
ROUNDING = 1e-14
# What is left of the motion at the end of a run [rad].
SETTLED = 1e-8


@pytest.fixture
def model() -> cdcr.Model:
    """Damped so that it comes to rest in a few seconds."""
    return cdcr.Model(cdcr.robots.amouri2020(damping=0.1))


def test_update_is_the_law_written_down(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=0.5, ki=2.0, kd=0.05, period=0.25)
    pid.reference = [0.2, 0.4]
    reference, q, qd = np.array([0.2, 0.4]), np.array([0.1, -0.1]), np.array([0.3, 0.6])
    hold = model.bias(reference, [0.0, 0.0])
    integral = np.zeros(2)
    for i in range(3):
        force = hold + 0.5 * (reference - q) + 2.0 * integral - 0.05 * qd
        np.testing.assert_allclose(
            pid.update(0.25 * i, q, qd), model.allocate(force), rtol=0.0, atol=100 * ROUNDING
        )
        integral += 0.25 * (reference - q)
        np.testing.assert_allclose(pid.integral, integral, rtol=ROUNDING)
    pid.reset()
    np.testing.assert_array_equal(pid.integral, [0.0, 0.0])
    np.testing.assert_array_equal(pid.reference, reference)


def test_arrays_are_copies(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=1.0)
    given = np.array([0.1, 0.2])
    pid.reference = given
    given[:] = 7.0
    pid.reference[:] = 7.0
    pid.integral[:] = 7.0
    np.testing.assert_array_equal(pid.reference, [0.1, 0.2])
    np.testing.assert_array_equal(pid.integral, [0.0, 0.0])


def test_it_outlives_the_model_it_was_made_from() -> None:
    pid = cdcr.Pid(cdcr.Model(cdcr.robots.amouri2020()), kp=1.0)
    assert pid.update(0.0, [0.1, 0.0], [0.0, 0.0]).shape == (3,)


def test_feed_forward_reaches_the_reference(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=0.5, period=0.01)
    pid.reference = cdcr.bending(np.radians(20.0), 1.0)
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=[0.0, 30.0], controller=pid)
    np.testing.assert_allclose(run.q[-1], pid.reference, atol=SETTLED)


def test_proportional_action_alone_falls_short(model: cdcr.Model) -> None:
    kp, K = 0.8, model.robot.sections[0].stiffness
    pid = cdcr.Pid(model, kp=kp, period=0.01, feed_forward=False)
    pid.reference = [0.6, 0.0]
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=[0.0, 30.0], controller=pid)
    np.testing.assert_allclose(run.q[-1], [kp / (K + kp) * 0.6, 0.0], atol=SETTLED)


@pytest.mark.parametrize("method", ["bdf", "adams", "dopri5", "dop853", "rk4"])
def test_tensions_are_held_over_each_period(model: cdcr.Model, method: Any) -> None:
    pid = cdcr.Pid(model, kp=0.8, ki=0.5, period=1.0 / 16.0)
    pid.reference = [0.3, -0.4]
    t = 2.0 + np.arange(65) / 64.0
    run = cdcr.simulate(model, [0.1, 0.0], [0.0, 1.0], t=t, controller=pid, method=method)
    held = run.tension[:64].reshape(16, 4, 3)
    assert (held == held[:, :1]).all()
    assert (np.diff(run.tension[::4], axis=0) != 0.0).any(axis=1).all()
    # The same run again is the same: the controller is reset.
    again = cdcr.simulate(model, [0.1, 0.0], [0.0, 1.0], t=t, controller=pid, method=method)
    np.testing.assert_array_equal(again.q, run.q)
    np.testing.assert_array_equal(again.tension, run.tension)


def test_a_run_that_ends_within_a_period_ends_under_the_tensions_held(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=0.8, ki=0.5, period=0.3)
    pid.reference = [0.3, -0.4]
    run = cdcr.simulate(model, [0.1, 0.0], [0.0, 1.0], t=[0.0, 0.3, 0.4, 0.5], controller=pid)
    np.testing.assert_array_equal(run.tension[2], run.tension[1])
    np.testing.assert_array_equal(run.tension[3], run.tension[1])
    assert (run.tension[1] != run.tension[0]).any()
    error = np.array([[0.3, -0.4]]) - run.q[:2]
    np.testing.assert_allclose(pid.integral, 0.3 * error.sum(axis=0), rtol=ROUNDING)


def test_sampled_twice_as_finely_the_run_is_the_same(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=0.8, ki=0.5, period=0.07)
    pid.reference = [0.3, -0.4]
    fine = np.linspace(0.0, 1.0, 41)
    runs = [
        cdcr.simulate(model, [0.1, 0.0], [0.0, 1.0], t=t, controller=pid) for t in (fine, fine[::2])
    ]
    np.testing.assert_array_equal(runs[0].q[::2], runs[1].q)
    np.testing.assert_array_equal(runs[0].tension[::2], runs[1].tension)


def test_limits_and_cables_are_kept(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=1.0, min_tension=0.4, max_tension=3.0, cables=[0, 1])
    pid.reference = [0.9, -0.8]
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=np.linspace(0.0, 1.0, 101), controller=pid)
    assert run.tension[:, :2].min() == 0.4
    assert run.tension.max() == 3.0
    assert not run.tension[:, 2].any()


def test_an_ideal_actuator_may_push(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=1.0, min_tension=-np.inf, feed_forward=False, cables=[0])
    pid.reference = [-0.019, 0.0]
    np.testing.assert_allclose(
        pid.update(0.0, [0.0, 0.0], [0.0, 0.0]), [-1.0, 0.0, 0.0], rtol=1e-12
    )


def test_it_is_a_controller(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=1.0, period=0.125)
    assert isinstance(pid, cdcr.Controller)
    assert pid.period == 0.125


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"kp": -1.0}, "kp must be >= 0 N m/rad and finite, got -1"),
        ({"kp": np.nan}, "kp must be >= 0 N m/rad and finite, got nan"),
        ({"ki": -2.0}, "ki must be >= 0 N m/(rad s) and finite, got -2"),
        ({"kd": np.inf}, "kd must be >= 0 N m s/rad and finite, got inf"),
        ({"period": 0.0}, "period must be > 0 s and finite, got 0"),
        (
            {"min_tension": 2.0, "max_tension": 1.0},
            "tension limits must satisfy min_tension <= max_tension, got min_tension 2 N and "
            "max_tension 1 N",
        ),
        ({"cables": [0, 3]}, "cables must be indices from 0 to 2, got 3"),
        ({"cables": [-1]}, "cables must be indices from 0 to 2, got -1"),
    ],
)
def test_options_out_of_range(model: cdcr.Model, options: dict[str, float], sentence: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        cdcr.Pid(model, **({"kp": 1.0} | options))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("reference", "sentence"),
    [
        ([0.1], "reference must have shape (2,), got (1,)"),
        ([0.1, np.nan], "reference[1] (section 1) must be finite, got nan"),
        (
            [0.0, 10.0],
            "reference must be 2 finite values that bend each section by at most 3 pi rad, "
            "got [ 0 10]",
        ),
    ],
)
def test_references_out_of_range(model: cdcr.Model, reference: list[float], sentence: str) -> None:
    pid = cdcr.Pid(model, kp=1.0)
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        pid.reference = reference
    np.testing.assert_array_equal(pid.reference, [0.0, 0.0])


def test_bad_measurements_are_refused(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=1.0, ki=1.0)
    with pytest.raises(ValueError, match=r"^q must have shape \(2,\), got \(3,\)$"):
        pid.update(0.0, [0.0, 0.0, 0.0], [0.0, 0.0])
    with pytest.raises(ValueError, match=r"^qd\[0\] \(section 1\) must be finite, got nan$"):
        pid.update(0.0, [0.0, 0.0], [np.nan, 0.0])
    np.testing.assert_array_equal(pid.integral, [0.0, 0.0])


def test_a_controller_for_other_cables_is_refused(model: cdcr.Model) -> None:
    robot = cdcr.Robot(
        sections=[
            cdcr.Section(
                length=1.0,
                backbone_mass=0.1,
                backbone_diameter=0.005,
                youngs_modulus=1e9,
                disk_mass=0.0,
                disk_diameter=0.0,
                num_disks=0,
                cable_radius=0.02,
                cable_angles=[0.0, 1.0],
            )
        ]
    )
    pid = cdcr.Pid(cdcr.Model(robot), kp=1.0)
    with pytest.raises(
        ValueError, match=r"^the controller was made for a robot of 2 coordinates and 2 cables, but"
    ):
        cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=[0.0, 1.0], controller=pid)
