"""The tensions that make the robot follow a reference, and the loop closed again.

The two motions of section 5.3 of Amouri, Mahfoudi, Zaatri (2020), doi 10.46604/ijeti.2020.4422,
on the robot of its Table 1: a circle (figure 12) and a plane motion from straight (figure 13).
"""

from __future__ import annotations

import dataclasses
import math
import warnings
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr
from cdcr.motion.inverse import InverseRun, inverse_run
from cdcr.motion.reference import Reference

FloatArray = NDArray[np.float64]

# Sums of a few products of numbers near one.
ROUNDING = 1e-14
# Feeding tensions back at rtol 1e-12: what the integrator leaves [rad]; 1.5e-12 was seen.
PATH = 2e-11

MODEL = cdcr.Model(cdcr.robots.amouri2020())
STEP = 0.2  # the paper's [s]
CIRCLE_TIMES: FloatArray = STEP * np.arange(51.0)  # 0 to 10 s
PLANE_TIMES: FloatArray = STEP * np.arange(13.0)  # to 2.4 s, where theta is 3 pi/5


def circle() -> Reference:
    return Reference.from_angles(CIRCLE_TIMES, math.pi / 12.0, lambda t: math.pi / 5.0 * t)


def plane() -> Reference:
    return Reference.from_angles(PLANE_TIMES, lambda t: math.pi / 4.0 * t, math.pi / 6.0)


# --- Inverse runs ---------------------------------------------------------------------------------


def test_figure_12_the_circle() -> None:
    run = inverse_run(MODEL, circle())
    assert run.tension.shape == (51, 3)
    assert [round(peak, 3) for peak in run.tension.max(axis=0)] == [5.754, 5.754, 5.754]
    assert [round(tension, 3) for tension in run.tension[0]] == [4.984, 0.0, 0.0]
    assert np.all(run.feasible)
    assert run.limiting == ((),) * 51
    assert np.max(run.force_error) < ROUNDING
    np.testing.assert_array_equal(run.tip, MODEL.tips(run.q))
    assert repr(run) == "<InverseRun: 51 samples, t = 0 to 10 s, 3 cables, up to 5.754 N>"


def test_figure_13_the_plane_motion() -> None:
    run = inverse_run(MODEL, plane())
    assert [round(tension, 1) for tension in run.tension[-1]] == [41.6, 20.8, 0.0]
    assert np.max(run.tension[0]) < 1e-12  # straight, at constant speed: nothing to hold


def test_tensions_are_the_least_that_do_it_in_every_direction() -> None:
    run = inverse_run(MODEL, circle().at(np.linspace(0.0, 10.0, 501)))
    B, tension = MODEL.actuation_matrix(), run.tension
    np.testing.assert_allclose(tension @ B.T, run.force, rtol=0.0, atol=ROUNDING)
    # Adding the same to all three changes nothing but the norm, so one of them is slack.
    np.testing.assert_allclose(tension.min(axis=1), 0.0, rtol=0.0, atol=ROUNDING)
    least = run.force @ np.linalg.pinv(B).T
    np.testing.assert_allclose(
        tension, least - least.min(axis=1, keepdims=True), rtol=0.0, atol=10 * ROUNDING
    )


def test_pretension_keeps_the_cables_taut() -> None:
    plain = inverse_run(MODEL, circle())
    taut = inverse_run(MODEL, circle(), min_tension=1.5, max_tension=20.0)
    np.testing.assert_allclose(taut.tension, plain.tension + 1.5, rtol=0.0, atol=10 * ROUNDING)
    assert np.max(taut.force_error) < ROUNDING


def test_limits_too_narrow_are_reported_with_time_and_cables() -> None:
    sentence = (
        r"at t = 0.4 s force .* cannot be met with tensions from 0 to 5.5 N: limited by cables "
        r"1, 3, .*; infeasible at 28 of 51 times; infeasible='nearest'"
    )
    with pytest.raises(cdcr.InfeasibleError, match=sentence) as caught:
        inverse_run(MODEL, circle(), max_tension=5.5)
    assert caught.value.limiting == (0, 2)
    assert caught.value.tension.max() == 5.5


def test_nearest_tensions_are_taken_where_asked() -> None:
    run = inverse_run(MODEL, circle(), max_tension=5.5, infeasible="nearest")
    assert np.sum(~run.feasible) == 28
    assert run.tension.max() == 5.5
    assert [not cables for cables in run.limiting] == list(run.feasible)
    assert np.max(run.force_error[run.feasible]) < ROUNDING
    assert np.min(run.force_error[~run.feasible]) > 1e-5
    assert repr(run).endswith("up to 5.5 N, 28 infeasible>")
    np.testing.assert_array_equal(run.tension_at(CIRCLE_TIMES[2]), run.tension[2])
    strict = dataclasses.replace(run, infeasible="raise")
    with pytest.raises(cdcr.InfeasibleError, match=r"at t = 0.4 s .* cables 1, 3"):
        strict.tension_at(0.4)


@pytest.mark.parametrize("formulation", ["exact", "taylor", "printed", "printed-taylor"])
def test_every_formulation_has_its_own_tensions(formulation: str) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020(), formulation)
    run = inverse_run(model, circle())
    i = 17
    expected = model.inverse_dynamics(run.q[i], run.reference.qd[i], run.reference.qdd[i])
    np.testing.assert_array_equal(run.force[i], expected)
    other = inverse_run(MODEL, circle())
    assert (formulation == "exact") == np.array_equal(run.tension, other.tension)


def test_a_taylor_formulation_warns_once_beyond_its_range() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020(), "taylor")
    far = Reference.from_angles(PLANE_TIMES, lambda t: 0.85 * t, 0.0)
    with pytest.warns(
        UserWarning, match=r"3 pi/5 = 1.8850 rad; this motion reaches 2.0400 rad"
    ) as w:
        inverse_run(model, far)
    assert len(w) == 1
    assert w[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        inverse_run(model, plane().at(PLANE_TIMES[:-1]))
        inverse_run(MODEL, far)


def test_friction_of_the_cables_is_left_out_with_a_warning() -> None:
    section = dataclasses.replace(cdcr.robots.amouri2020().sections[0], cable_entry_friction=0.3)
    model = cdcr.Model(cdcr.Robot(sections=[section]))
    reference = Reference.from_functions(np.linspace(0.0, 1.0, 11), lambda t: np.zeros(2))
    with pytest.warns(UserWarning, match="^inverse_run leaves out the friction of the cables"):
        inverse_run(model, reference)
    path = cdcr.ReferencePath.constant([0.1, 0.0])
    with pytest.warns(UserWarning, match="^check_path leaves out the friction of the cables"):
        cdcr.check_path(model, path, num_samples=5)


def test_bad_inverse_runs_are_refused() -> None:
    with pytest.raises(TypeError, match=r"reference must be a cdcr\.Reference, got ndarray"):
        inverse_run(MODEL, CIRCLE_TIMES)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="infeasible must be 'raise' or 'nearest', got 'skip'"):
        inverse_run(MODEL, circle(), infeasible="skip")  # type: ignore[arg-type]
    four = Reference.from_angles(CIRCLE_TIMES, np.ones((51, 2)), 0.0)
    with pytest.raises(ValueError, match=r"reference.q must have shape \(51, 2\) .* got \(51, 4\)"):
        inverse_run(MODEL, four)
    far = Reference.from_angles(CIRCLE_TIMES, CIRCLE_TIMES, 0.0)
    with pytest.raises(ValueError, match=r"bends section 1 by 9.6 rad at t = 9.6 s, beyond"):
        inverse_run(MODEL, far)
    with pytest.raises(ValueError, match="min_tension"):
        inverse_run(MODEL, circle(), min_tension=3.0, max_tension=1.0)


# --- The loop closed ------------------------------------------------------------------------------


def path_error(run: InverseRun, tension: Any) -> float:
    """Run the robot under the tensions from the reference's start; largest |q - q_ref| [rad]."""
    times = np.linspace(run.t[0], run.t[-1], 501)
    reference = run.reference
    followed = cdcr.simulate(
        run.model,
        reference.q[0],
        reference.qd[0],
        t=times,
        tension=tension,
        method="dopri5",
        rtol=1e-12,
    )
    assert followed.success
    q, _, _ = reference.evaluate(times)
    return float(np.max(np.linalg.norm(followed.q - q, axis=1)))


@pytest.mark.parametrize("reference", [circle(), plane()], ids=["circle", "plane"])
def test_the_tensions_make_the_robot_follow(reference: Reference) -> None:
    run = inverse_run(MODEL, reference)
    assert path_error(run, run.tension_at) < PATH


def test_they_do_so_with_weight_damping_and_pretension() -> None:
    robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, 9.81), payload=0.02, damping=2e-3)
    reference = Reference.from_angles(
        np.linspace(0.0, 2.0, 51), lambda t: 0.6 * math.sin(2.0 * t), lambda t: 0.3 + t**2
    )
    run = inverse_run(cdcr.Model(robot), reference, min_tension=2.0)
    assert path_error(run, run.tension_at) < PATH


def test_a_table_with_the_papers_step_strays() -> None:
    """A line between tensions 0.2 s apart is not the arc: 0.04 degrees on the circle."""
    run = inverse_run(MODEL, circle())
    assert f"{path_error(run, run.to_table()):.2e}" == "7.26e-04"
    assert f"{path_error(run, run.to_table('previous')):.3f}" == "0.034"


def test_a_finer_table_strays_less_with_the_square_of_its_step() -> None:
    errors = []
    for num in (101, 201):
        run = inverse_run(MODEL, circle().at(np.linspace(0.0, 10.0, num)))
        errors.append(path_error(run, run.to_table()))
    assert 3.8 < errors[0] / errors[1] < 4.2


def test_tensions_end_with_the_reference() -> None:
    run = inverse_run(MODEL, circle())
    with pytest.raises(ValueError, match=r"within the reference, 0 to 10 s, got 10\.5 s"):
        run.tension_at(10.5)
