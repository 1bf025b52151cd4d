"""Scenarios of several sections: what happens in them is what the mechanics says."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.scenarios.file.start import carrying
from cdcr.scenarios.metrics import run_metrics, settling_time, static_theta
from cdcr.scenarios.studies import three_sections
from cdcr.scenarios.studies.energy import cable_work, dissipated, energy_gap, fine_run
from cdcr.scenarios.studies.release import at_rest, distance
from scenario_runs import told

NAMES = ("three-sections", "hanging-arm", "payload-drop")

PAYLOAD = 0.015  # that falls off [kg]
ROUNDING = 1e-11  # solves of 6 x 6 systems whose inertias span three powers of ten, relative
BALANCE = 1e-6  # energy lost against damping and work of tensions, over the energy that moved
SETTLED = 2e-3  # of the first distance or goal: what the slowest mode leaves at the end
LEFT = 1e-4  # of the energy, in what still swings at the end
QUADRATURE = 1e-7  # cubic pieces of a smooth function, relative
HALVED = 1e-5  # the same from samples twice as far apart


@pytest.mark.parametrize("name", NAMES)
def test_they_run_to_the_end_and_are_none_of_the_papers(name: str) -> None:
    scenario, run, found = told(name)
    assert run.success
    assert run.t[-1] == scenario.t_end
    assert scenario.paper_figure is None
    assert len(scenario.robot.sections) == 3
    assert all(math.isfinite(value) for value in found.values())


@pytest.mark.parametrize("name", NAMES)
def test_energy_lost_is_damping_less_work_of_the_tensions(name: str) -> None:
    assert 0.0 < told(name)[2]["energy_gap"] < BALANCE


@pytest.mark.parametrize("name", NAMES[1:])
def test_damping_takes_all_that_is_between_start_and_rest(name: str) -> None:
    """Potential energy less that of constant cable forces, B F . q, is what there is to lose."""
    _, run, found = told(name)
    model = run.model
    rest = model.equilibrium(run.tension[0])
    force = model.actuation_matrix() @ run.tension[0]
    high = model.potential_energy(run.q[0]) - force @ run.q[0]
    low = model.potential_energy(rest) - force @ rest
    left = high - low - 1e-3 * found["dissipated_mJ"]
    assert 0.0 <= left < LEFT * (high - low)


def test_energy_of_a_ramp_does_not_depend_on_its_samples() -> None:
    """A kink in the tensions at a sample costs nothing."""
    model = cdcr.Model(cdcr.robots.amouri2020(damping=0.5))
    t = np.linspace(0.0, 2.0, 401)
    table = cdcr.TensionTable([0.0, 1.0, 2.0], np.outer([0.0, 4.0, 0.0], [1.0, 0.0, 0.0]))
    options: dict[str, Any] = {"method": "dopri5", "rtol": 1e-11, "atol": 1e-13}
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=t, tension=table, **options)
    assert energy_gap(run) < QUADRATURE
    coarse = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=t[::2], tension=table, **options)
    scale = float(dissipated(run)[-1])
    np.testing.assert_allclose(dissipated(run)[::2], dissipated(coarse), atol=HALVED * scale)
    np.testing.assert_allclose(cable_work(run)[::2], cable_work(coarse), atol=HALVED * scale)
    assert np.all(np.diff(dissipated(run)) >= 0.0)


def test_a_wrong_damping_shows_in_the_balance() -> None:
    _, run, _ = told("payload-drop")
    sections = tuple(replace(s, damping=1.01 * s.damping) for s in run.model.robot.sections)
    other = cdcr.Model(replace(run.model.robot, sections=sections))
    assert energy_gap(replace(run, model=other)) > 1e-3


@pytest.mark.parametrize("name", [*NAMES, "length-drive"])
def test_base_orientations_are_rotations(name: str) -> None:
    R = np.array(cdcr.scenarios.get(name).robot.base_orientation)
    np.testing.assert_array_equal(R @ R.T, np.eye(3))
    assert np.linalg.det(R) == pytest.approx(1.0, rel=1e-15)


# three-sections


def test_each_phase_comes_to_rest_in_its_goal() -> None:
    scenario, run, _ = told("three-sections")
    goals = three_sections.goals(scenario)
    for k, last in three_sections.ends(scenario, run):
        assert run.t[last] == 5.0 * (k + 1)
        theta = np.hypot(goals[k, 0::2], goals[k, 1::2])
        assert np.flatnonzero(theta).tolist() == [k]  # one section is bent
        assert np.max(np.abs(run.q[last] - goals[k])) < SETTLED * theta[k]


def test_goals_are_equilibria_of_the_tensions() -> None:
    scenario, run, _ = told("three-sections")
    ends, goals = three_sections.ends(scenario, run), three_sections.goals(scenario)
    for (_, last), goal in zip(ends, goals, strict=True):
        tension = run.tension[last]
        assert np.all(tension >= 0.0)
        np.testing.assert_allclose(run.model.equilibrium(tension), goal, atol=ROUNDING)
        # To rest as to the time average over the last second, in which the swing goes on.
        late = (run.t > run.t[last] - 1.0) & (run.t <= run.t[last])
        mean = run.q[late].mean(axis=0)
        assert np.max(np.abs(mean - goal)) < SETTLED * np.max(np.abs(goal))


def test_cables_of_a_section_bend_all_before_it() -> None:
    """Without gravity each section that a cable runs through gets the same moment r F."""
    model = cdcr.Model(cdcr.robots.three_sections())
    lengths = np.array([section.length for section in model.robot.sections])
    bending = model.robot.sections[0].stiffness * lengths[0]  # E I, the same for all
    for k in range(3):
        for j, cable in enumerate(model.robot.all_cables):
            if cable.end_section != k:
                continue
            q = model.equilibrium(2.0 * np.eye(9)[j])
            theta, phi = np.asarray(cdcr.polar(q))
            expected = np.where(np.arange(3) <= k, 2.0 * cable.radius * lengths / bending, 0.0)
            np.testing.assert_allclose(theta, expected, atol=ROUNDING)
            turn = np.exp(1j * (phi[: k + 1] - cable.angle))
            np.testing.assert_allclose(turn, 1.0, atol=ROUNDING)


def test_what_the_driven_cables_alone_would_do() -> None:
    """Cables that the others must pull against, or sections 1 and 2 would bend far."""
    scenario, run, found = told("three-sections")
    model = run.model
    _, last = three_sections.ends(scenario, run)[2]
    own = np.array([cable.end_section == 2 for cable in model.robot.all_cables])
    alone = np.rad2deg(cdcr.polar(model.equilibrium(np.where(own, run.tension[last], 0.0)))[0])
    assert found["section_3_alone_1_deg"] == pytest.approx(alone[0], rel=ROUNDING)
    assert found["section_3_alone_2_deg"] == pytest.approx(alone[1], rel=ROUNDING)
    assert min(alone[:2]) > 45.0
    assert "section_1_alone_1_deg" not in found


def test_a_run_cut_short_tells_of_the_phases_it_ended() -> None:
    scenario = cdcr.scenarios.get("three-sections")
    run = scenario.simulate(t_end=6.0, num_samples=2401)
    assert [k for k, _ in three_sections.ends(scenario, run)] == [0]
    keys = {metric.key for metric in scenario.summary(run)}
    assert "section_1_tip_mm" in keys
    assert "section_2_tip_mm" not in keys


# hanging-arm


def test_the_arm_rests_where_gravity_and_elasticity_balance() -> None:
    _, run, found = told("hanging-arm")
    rest = at_rest(run)
    still = np.zeros(6)
    np.testing.assert_allclose(run.model.inverse_dynamics(rest, still, still), 0.0, atol=ROUNDING)
    assert np.all(np.linalg.eigvals(run.model.linearize(rest, still, np.zeros(9))[0]).real < 0.0)
    away = distance(run, rest)
    assert away[-1] < SETTLED * away[0]
    assert run.model.tip(rest)[1][2] < 0.0  # it hangs below its base, in the plane of gravity
    np.testing.assert_allclose(rest[1::2], 0.0, atol=ROUNDING)
    assert found["settling_s"] == pytest.approx(settling_time(run.t, away, 0.02 * away[0]))
    assert 0.0 < found["settling_s"] < run.t[-1]


def test_settling_time_is_the_last_one_outside() -> None:
    t = np.linspace(0.0, 1.0, 11)
    away = np.array([1.0, 0.0, 0.5, 0.01, 0.03, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert settling_time(t, away, 0.02) == t[4]
    assert settling_time(t, np.ones(11), 0.02) is None


# payload-drop


def test_it_starts_where_it_holds_the_payload_at_rest() -> None:
    scenario, run, _ = told("payload-drop")
    start: Any = scenario.q0
    heavy = carrying(run.model, start.payload)
    assert heavy.robot.payload == PAYLOAD > scenario.robot.payload == 0.0
    q, still = run.q[0], np.zeros(6)
    assert np.all(run.tension == run.tension[0])
    held = heavy.forward_dynamics(q, still, run.tension[0])
    freed = run.model.forward_dynamics(q, still, run.tension[0])
    assert np.max(np.abs(held)) < ROUNDING * np.max(np.abs(freed))
    modes = np.linalg.eigvals(heavy.linearize(q, still, run.tension[0])[0])
    assert np.all(modes.real < 0.0)


def test_it_starts_with_the_acceleration_of_the_freed_robot() -> None:
    """What the payload's weight J^T m g held back accelerates the robot alone."""
    _, run, found = told("payload-drop")
    model = run.model
    J = model.jacobian(run.q[0], 2, 1.0)
    weight = PAYLOAD * J[:3].T @ np.array([0.0, 0.0, 9.81])
    expected = np.linalg.solve(model.mass_matrix(run.q[0]), weight)
    got = model.forward_dynamics(run.q[0], run.qd[0], run.tension[0])
    np.testing.assert_allclose(got, expected, atol=1e-9 * np.max(np.abs(expected)))
    assert found["lift_m_s2"] == pytest.approx((J @ expected)[2], rel=1e-9)
    # The run itself moves off so: q = q0 + qdd t^2 / 2, up to what is of third order in t.
    t = np.linspace(0.0, 1e-5, 3)
    options: dict[str, Any] = {"method": "dopri5", "rtol": 1e-12, "atol": 1e-18}
    first = cdcr.simulate(model, run.q[0], run.qd[0], t=t, tension=run.tension[0], **options)
    np.testing.assert_allclose(first.qd[-1] / t[-1], expected, atol=0.02 * np.max(np.abs(expected)))


def test_the_tip_is_thrown_beyond_its_rest() -> None:
    _, run, found = told("payload-drop")
    rest = run.model.tip(at_rest(run))[1]
    assert found["highest_m"] > rest[2] > run.tip[0, 2]
    assert distance(run, at_rest(run))[-1] * 1e3 == pytest.approx(found["end_distance_mm"])


def test_fine_samples_are_the_same_run() -> None:
    scenario, run, _ = told("payload-drop")
    fine = fine_run(scenario, run)
    assert np.all(np.diff(fine.t) > 0.0)
    assert (fine.t[0], fine.t[-1]) == (run.t[0], run.t[-1])
    np.testing.assert_allclose(fine.q[-1], run.q[-1], atol=1e-7)


# what every run tells


def test_wrenches_reach_run_and_findings() -> None:
    pull = cdcr.Wrench(section=0, force=(0.2, 0.0, 0.0))
    base = cdcr.scenarios.get("step-tension")
    scenario = replace(base, tension=(0.0, 0.0, 0.0), wrenches=(pull,), t_end=1.0, num_samples=101)
    run = scenario.simulate()
    direct = cdcr.simulate(scenario.model, (0.0, 0.0), base.qd0, t=run.t, wrenches=pull)
    np.testing.assert_array_equal(run.q, direct.q)
    rest = scenario.model.equilibrium([0.0, 0.0, 0.0], wrenches=pull)
    keys = {metric.key: metric.value for metric in run_metrics(scenario, run)}
    assert keys["theta_static_deg"] == pytest.approx(np.rad2deg(rest[0]), rel=ROUNDING)
    assert keys["theta_max_deg"] > keys["theta_static_deg"]
    assert "energy_drift" not in keys  # the pull feeds the robot
    changing = replace(pull, profile=([0.0, 1.0], [0.0, 1.0]))
    assert static_theta(run, [changing]) is None


def test_rubbing_cables_keep_no_energy() -> None:
    (section,) = cdcr.robots.amouri2020().sections
    rough = replace(section, cable_friction=0.1)
    scenario = replace(
        cdcr.scenarios.get("step-tension"),
        robot=cdcr.Robot(sections=[rough]),
        t_end=0.5,
        num_samples=51,
    )
    assert "energy_drift" not in {one.key for one in run_metrics(scenario, scenario.simulate())}
