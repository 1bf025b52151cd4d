"""Scenarios: their registry, what they find out about a run, and their pictures."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.scenarios import Scenario
from cdcr.scenarios.metrics import (
    energy_drift,
    oscillation_period,
    static_theta,
    swing_times,
    time_mean,
)

REL = 1e-13  # closed forms of a few operations
PERIOD_REL = 1e-5  # rises between samples 10 ms apart are found by straight lines
DRIFT = 1e-5  # of the energy over 10 s at the default tolerances, with room


@pytest.fixture(scope="module")
def scenario() -> Scenario:
    return cdcr.scenarios.get("step-tension")


@pytest.fixture(scope="module")
def run(scenario: Scenario) -> cdcr.Trajectory:
    return scenario.simulate()


def variant(scenario: Scenario, **changes: Any) -> cdcr.Trajectory:
    return dataclasses.replace(scenario, **changes).simulate()


def values(scenario: Scenario, run: cdcr.Trajectory) -> dict[str, float]:
    return {metric.key: metric.value for metric in scenario.summary(run)}


def test_every_scenario_is_complete() -> None:
    assert "step-tension" in cdcr.scenarios.names()
    for name in cdcr.scenarios.names():
        scenario = cdcr.scenarios.get(name)
        assert scenario.name == name
        assert scenario.title
        assert scenario.description
        assert scenario.source


def test_an_unknown_name_is_refused_with_the_known_ones() -> None:
    known = ", ".join(cdcr.scenarios.names())
    assert "free-oscillation, step-tension, two-cables" in known
    with pytest.raises(ValueError, match=rf"^there is no scenario 'x'\. Known: {known}$"):
        cdcr.scenarios.get("x")
    with pytest.raises(ValueError, match=r"Did you mean 'step-tension'\?"):
        cdcr.scenarios.get("step_tensoin")


def test_step_tension_is_the_papers_example(scenario: Scenario) -> None:
    assert scenario.robot == cdcr.robots.amouri2020()
    assert (scenario.q0, scenario.qd0) == ((0.0, 0.0), (0.0, 0.0))
    assert scenario.tension == (5.0, 0.0, 0.0)
    times = scenario.times()
    assert (times[0], times[-1], len(times)) == (0.0, 10.0, 1001)
    assert "Fig. 9" in scenario.source


def test_step_tension_swings_between_straight_and_twice_its_rest(
    scenario: Scenario, run: cdcr.Trajectory
) -> None:
    found = values(scenario, run)
    section = scenario.robot.sections[0]
    static = math.degrees(5.0 * section.cable_radius / section.stiffness)  # F r l / (E I)
    assert found["theta_static_deg"] == pytest.approx(static, rel=REL)
    assert f"{static:.2f} deg" in scenario.description
    # Without damping the work of the cable, F r theta, is all elastic energy at the turning
    # point: K theta^2 / 2 = F r theta. The largest sample lies within half a sample of it.
    near = 1.0 - math.cos(math.pi * 0.01 / found["period_s"])
    assert found["theta_max_deg"] <= 2.0 * static * (1.0 + DRIFT)
    assert found["theta_max_deg"] >= 2.0 * static * (1.0 - near)
    assert -2.0 * static * DRIFT <= found["theta_min_deg"] <= 2.0 * static * near
    assert found["phi_min_deg"] == found["phi_max_deg"] == 0.0


def test_period_of_step_tension_by_quadrature(scenario: Scenario, run: cdcr.Trajectory) -> None:
    """With theta = theta_s (1 - cos psi), energy gives dt = sqrt(M(theta) / K) d psi."""
    found = values(scenario, run)
    section = scenario.robot.sections[0]
    psi = (np.arange(64) + 0.5) * math.pi / 64  # midpoints: exact to rounding, as all is periodic
    theta = math.radians(found["theta_static_deg"]) * (1.0 - np.cos(psi))
    inertia = np.array([run.model.mass_matrix([angle, 0.0])[0, 0] for angle in theta])
    period = 2.0 * math.pi * np.mean(np.sqrt(inertia / section.stiffness))
    assert found["period_s"] == pytest.approx(period, rel=PERIOD_REL)


def test_energy_drift_is_that_of_robot_and_pulled_cables(
    scenario: Scenario, run: cdcr.Trajectory
) -> None:
    lengths = np.array([run.model.cable_lengths(q) for q in run.q])
    kept = run.energy + lengths @ np.array(scenario.tension)
    drift = np.max(np.abs(kept - kept[0])) / np.max(run.kinetic_energy)
    found = values(scenario, run)["energy_drift"]
    assert found == pytest.approx(drift, abs=1e-12)
    assert 0.0 < found < DRIFT


def test_mean_of_theta_over_whole_periods(scenario: Scenario, run: cdcr.Trajectory) -> None:
    found = values(scenario, run)
    assert found["theta_mean_deg"] == pytest.approx(found["theta_static_deg"], rel=0.01)


@pytest.mark.parametrize("method", ["bdf", "adams", "dopri5", "dop853", "rk4"])
def test_overrides_reach_the_integrator(scenario: Scenario, method: Any) -> None:
    assert isinstance(scenario.tension, tuple)
    assert isinstance(scenario.q0, tuple)
    run = scenario.simulate(method=method, t_end=0.1, num_samples=3)
    plain = cdcr.simulate(
        cdcr.Model(scenario.robot),
        scenario.q0,
        scenario.qd0,
        t=[0.0, 0.05, 0.1],
        tension=scenario.tension,
        method=method,
    )
    np.testing.assert_array_equal(run.q, plain.q)
    assert run.stats.steps == plain.stats.steps


@pytest.mark.parametrize(
    "options",
    [
        {"method": "rk4"},
        {"rtol": 1e-5},
        {"atol": 1e-3},
        {"method": "rk4", "step": 0.02},
        {"max_step": 1e-3},
        {"max_steps": 5},
    ],
    ids=lambda options: ", ".join(options),
)
def test_options_may_stand_in_the_scenario_or_in_the_call(
    scenario: Scenario, options: dict[str, Any]
) -> None:
    run = variant(scenario, t_end=1.0, **options)
    assert run.stats.steps == scenario.simulate(t_end=1.0, **options).stats.steps
    assert run.stats.steps != scenario.simulate(t_end=1.0).stats.steps


def test_progress_is_told(scenario: Scenario) -> None:
    told: list[float] = []
    scenario.simulate(progress=told.append, rtol=1e-12)
    assert told
    assert told == sorted(told)
    assert 0.0 < told[-1] <= 10.0


def test_another_end_alone_keeps_the_spacing(scenario: Scenario) -> None:
    assert len(scenario.times(t_end=2.0)) == 201
    assert scenario.times(t_end=1e-9).tolist() == [0.0, 1e-9]
    assert scenario.times(t_end=2.0, num_samples=5).tolist() == [0.0, 0.5, 1.0, 1.5, 2.0]
    assert scenario.times(num_samples=2).tolist() == [0.0, 10.0]


@pytest.mark.parametrize("t_end", [0.0, -1.0, math.inf, math.nan, "10", True])
def test_bad_ends_are_refused(scenario: Scenario, t_end: Any) -> None:
    with pytest.raises(ValueError, match=r"^t_end must be a number > 0 s and finite, got "):
        scenario.times(t_end=t_end)


@pytest.mark.parametrize("num_samples", [1, 0, -3, 2.0, 10_000_001])
def test_bad_numbers_of_samples_are_refused(scenario: Scenario, num_samples: Any) -> None:
    with pytest.raises(
        ValueError, match=r"^num_samples must be a whole number 2 to 10000000, got "
    ):
        scenario.times(num_samples=num_samples)


def test_an_end_too_far_for_its_samples_is_refused(scenario: Scenario) -> None:
    with pytest.raises(ValueError, match=r"^t_end must be at most .* s apart reach, got 1e\+09 s$"):
        scenario.times(t_end=1e9)


@pytest.mark.parametrize("phase", [0.0, 0.3, 1.7, 3.0, 5.9])
@pytest.mark.parametrize("period", [0.1, 0.691, 3.7])
def test_period_of_a_sine(period: float, phase: float) -> None:
    t = np.linspace(0.0, 10.0, 1001)
    y = 3.0 + 0.5 * np.sin(2.0 * math.pi * t / period + phase)
    # A straight line over 10 ms misses a rise by at most h^2 y'' / (8 y') of both ends.
    assert oscillation_period(t, y) == pytest.approx(period, rel=2e-3)


def test_period_ignores_ripple_about_the_mean() -> None:
    t = np.linspace(0.0, 10.0, 100_001)
    y = np.sin(2.0 * math.pi * t) + 0.03 * np.sin(2.0 * math.pi * 397.0 * t)
    assert oscillation_period(t, y) == pytest.approx(1.0, rel=5e-3)


@pytest.mark.parametrize(
    "y",
    [
        np.zeros(101),
        np.linspace(0.0, 1.0, 101),
        -np.cos(np.linspace(0.0, 6.0, 101)),  # rises through its mean only once
        np.sin(np.linspace(0.0, 200.0, 101)),  # three samples a period
    ],
    ids=["rest", "ramp", "one rise", "too coarse"],
)
def test_no_period_where_there_is_none_to_see(y: np.ndarray[Any, Any]) -> None:
    assert oscillation_period(np.linspace(0.0, 1.0, 101), y) is None


def test_time_mean_of_uneven_samples() -> None:
    t = np.array([0.0, 1.0, 3.0])
    assert time_mean(t, 2.0 * t + 1.0) == pytest.approx(4.0, rel=REL)


def test_static_angle_has_the_sign_of_the_run(scenario: Scenario) -> None:
    toward = variant(scenario, q0=(0.1, 0.0), t_end=0.05)
    away = variant(scenario, q0=(-0.1, 0.0), t_end=0.05)
    plus, minus = static_theta(toward), static_theta(away)
    assert plus is not None
    assert minus is not None
    assert plus == pytest.approx([14.9778], abs=1e-4)
    np.testing.assert_array_equal(minus, -plus)


def test_no_static_angle_where_tensions_change_or_none_exists(scenario: Scenario) -> None:
    table = cdcr.TensionTable([0.0, 0.1], [[0.0, 0.0, 0.0], [5.0, 0.0, 0.0]])
    changing = variant(scenario, tension=table, t_end=0.2)
    assert static_theta(changing) is None
    assert energy_drift(changing) is None
    assert {"theta_static_deg", "period_s", "energy_drift"}.isdisjoint(values(scenario, changing))
    too_strong = variant(scenario, tension=(500.0, 0.0, 0.0), t_end=0.01, num_samples=2)
    assert static_theta(too_strong) is None


def test_no_energy_drift_with_damping(scenario: Scenario) -> None:
    robot = cdcr.robots.amouri2020(damping=1e-3)
    assert energy_drift(variant(scenario, robot=robot, t_end=0.1)) is None


@pytest.mark.parametrize("rubs", ["friction", "entry_friction", "viscosity"])
def test_no_energy_drift_where_cables_rub(rubs: str) -> None:
    section = dataclasses.replace(cdcr.robots.amouri2020().sections[0], cable_angles=())
    friction: dict[str, Any] = {rubs: 0.1}
    cable = cdcr.Cable(radius=0.008, angle=0.0, end_section=0, **friction)
    model = cdcr.Model(cdcr.Robot(sections=[section], cables=[cable]))
    run = cdcr.simulate(model, [0.1, 0.0], [0.0, 0.0], t=[0.0, 0.1], tension=[1.0])
    assert energy_drift(run) is None


def test_energy_drift_of_a_robot_at_rest_is_zero(scenario: Scenario) -> None:
    assert energy_drift(variant(scenario, tension=(0.0, 0.0, 0.0), t_end=0.1)) == 0.0


def test_shapes_are_shown_over_the_first_half_swing(
    scenario: Scenario, run: cdcr.Trajectory
) -> None:
    period = values(scenario, run)["period_s"]
    assert period == pytest.approx(0.689, abs=1e-3)
    np.testing.assert_allclose(swing_times(run, 3), [0.0, 0.17, 0.34], rtol=REL)  # as people say
    short = variant(scenario, t_end=0.2)
    np.testing.assert_allclose(swing_times(short, 3), [0.0, 0.1, 0.2], rtol=REL)


def test_the_picture_shows_robot_angles_and_tensions(
    scenario: Scenario, run: cdcr.Trajectory
) -> None:
    pytest.importorskip("matplotlib")
    figure = scenario.figure(run)
    space, theta, tension = figure.axes  # none for phi, which does not move
    assert space.name == "3d"
    assert theta.get_ylabel() == r"bending angle $\theta$ [deg]"
    assert tension.get_title("left") == r"$\varphi$ stays 0 deg"
    assert tension.get_ylabel() == "tension [N]"
    assert tension.get_xlabel() == "time [s]"
    curve, static, paper = theta.get_lines()
    assert np.asarray(paper.get_ydata()) == pytest.approx(15.53)
    np.testing.assert_array_equal(np.asarray(curve.get_ydata()), np.rad2deg(run.theta[:, 0]))
    assert np.asarray(static.get_ydata()) == pytest.approx(14.9778, abs=1e-4)
    assert "14.98 deg" in theta.get_title("left")
    (legend,) = figure.legends
    assert [text.get_text() for text in legend.get_texts()][-3:] == [
        "cable 1",
        "cable 2",
        "cable 3",
    ]


def test_texts_of_the_picture_do_not_overlap(scenario: Scenario, run: cdcr.Trajectory) -> None:
    pytest.importorskip("matplotlib")
    from matplotlib.text import Text

    figure: Any = scenario.figure(run)
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text()]
    # The box round a slanted text says nothing about where its letters are.
    texts = [text for text in texts if text.get_rotation() % 90.0 == 0.0]
    boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts]
    assert len(boxes) > 30
    for i, (name, box) in enumerate(boxes):
        assert box.x0 >= 0.0, name
        assert box.y0 >= 0.0, name
        assert box.x1 <= figure.bbox.x1, name
        assert box.y1 <= figure.bbox.y1, name
        for other_name, other in boxes[i + 1 :]:
            assert not box.overlaps(other), (name, other_name)


def test_a_scenario_may_tell_and_draw_what_it_likes(
    scenario: Scenario, run: cdcr.Trajectory
) -> None:
    picture: Any = object()
    own = dataclasses.replace(scenario, summarize=lambda s, r: (), plot=lambda s, r: picture)
    assert own.summary(run) == ()
    assert own.figure(run) is picture
