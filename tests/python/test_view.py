"""The view without a browser: what is shown when, and how a live robot moves."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray

pytest.importorskip("matplotlib", reason="the view draws with the colours of pictures")

from cdcr.view import Session
from cdcr.view.live import PERIOD, LiveModel, LiveRobot, Pull, circling, command_ranges, round_up
from cdcr.view.session import TRAIL, TRAIL_POINTS

ROUNDING = 1e-12
SIMULATED = 1e-6  # RK4 in steps of a few ms at most, beside dopri5 at 1e-10 [rad]
AT_REST = 1e-6  # decayed for many time constants [rad]


def arm(**options: object) -> cdcr.Robot:
    return cdcr.robots.three_sections(gravity=(0.0, 0.0, 9.81), damping=0.02, **options)  # type: ignore[arg-type]


def state(robot: cdcr.Robot, size: float = 0.4) -> FloatArray:
    return size * np.random.default_rng(3).normal(size=2 * len(robot.sections))


# --- physics --------------------------------------------------------------------------------------


def test_a_live_robot_moves_as_a_run_does() -> None:
    robot = arm()
    live, tension = LiveRobot(robot, q=state(robot)), np.array([4.0, 0, 0, 0, 2, 0, 0, 0, 1])
    live.command = tension
    for _ in range(10):
        live.advance(0.05)
    model = cdcr.Model(robot)
    run = cdcr.simulate(
        model, state(robot), np.zeros(6), t=[0.0, 0.5], tension=tension, method="dopri5", rtol=1e-10
    )
    assert live.time == pytest.approx(0.5, abs=1e-9)
    np.testing.assert_allclose(live.q, run.q[-1], atol=SIMULATED)


def test_it_begins_at_rest_and_stays_there() -> None:
    live = LiveRobot(cdcr.robots.three_sections(gravity=(3.0, 0.0, 9.0)))
    expected = cdcr.Model(live.robot).equilibrium()
    np.testing.assert_allclose(live.q, expected, atol=1e-9)
    live.advance(0.2)
    np.testing.assert_allclose(live.q, expected, atol=1e-8)


def test_new_gravity_and_payload_lead_to_their_rest() -> None:
    live = LiveRobot(arm())
    live.change(gravity=(2.0, -1.0, 9.0), payload=0.02, added_damping=1.0)
    live.advance(30.0)
    robot = replace(arm(), gravity=(2.0, -1.0, 9.0), payload=0.02)
    np.testing.assert_allclose(live.q, cdcr.Model(robot).equilibrium(), atol=AT_REST)
    assert live.robot.payload == 0.02


def test_a_pull_balances() -> None:
    live = LiveRobot(arm())
    live.change(added_damping=1.0)
    live.pull = Pull(1, 0.5, (0.2, 0.1, 0.4), live.pull_stiffness)
    live.advance(30.0)
    force = live.pull.force(live.model, live.q)
    assert np.linalg.norm(force) > 0.01
    push = cdcr.Wrench(section=1, fraction=0.5, force=force)
    rest = cdcr.Model(arm()).equilibrium(wrenches=push)
    np.testing.assert_allclose(live.q, rest, atol=AT_REST)
    live.pull = None
    live.advance(30.0)
    np.testing.assert_allclose(live.q, cdcr.Model(arm()).equilibrium(), atol=AT_REST)


def test_a_robot_without_mass_is_at_rest_always() -> None:
    live = LiveRobot(cdcr.robots.rao2021())
    live.command = np.array([1.0, 0, 0, 0, 0.5, 0])
    live.advance(1.0)
    expected = cdcr.Model(live.robot).equilibrium(live.command)
    np.testing.assert_allclose(live.q, expected, atol=1e-9)
    assert live.time == 1.0


def test_an_undamped_robot_gets_a_share_of_critical_damping() -> None:
    live = LiveRobot(cdcr.robots.amouri2020())
    modes = cdcr.Model(live.robot).modes(np.zeros(2), np.zeros(3))
    ratio = -modes.eigenvalues.real / np.abs(modes.eigenvalues)
    np.testing.assert_allclose(ratio, live.added_damping, rtol=1e-9)
    live.change(added_damping=0.0)
    assert live.robot == cdcr.robots.amouri2020()


def test_it_holds_at_the_bending_limit() -> None:
    live = LiveRobot(cdcr.robots.amouri2020())
    live.command = np.array([5e3, 0.0, 0.0])
    live.advance(3.0)
    assert live.message == "bending limit"
    assert np.all(np.isfinite(live.q))
    live.command = np.zeros(3)
    live.advance(5 * PERIOD)
    assert live.message == ""


def test_a_budget_of_nothing_computes_nothing() -> None:
    live = LiveRobot(arm())
    live.advance(10.0, budget=0.0)
    assert live.time == 0.0


# --- sliders -------------------------------------------------------------------------------------


def test_a_full_slider_bends_well() -> None:
    for robot in (cdcr.robots.amouri2020(), cdcr.robots.three_sections()):
        model = LiveModel(robot)
        _, high = np.array(command_ranges(model, np.zeros((1, model.num_cables)))).T
        theta, _ = cdcr.polar(cdcr.Model(robot).equilibrium(high * np.eye(len(high))[0]))
        assert np.max(theta) >= 2.5


def test_sliders_of_lengths_reach_both_ways() -> None:
    scenario = cdcr.scenarios.get("length-drive")
    run = scenario.simulate(t_end=0.2)
    session = Session(scenario.robot, run=run)
    for (low, high), column in zip(session.ranges(), run.command.T, strict=True):
        assert 0.0 <= low <= column.min()
        assert column.max() <= high


def test_circling_stays_within_the_sliders() -> None:
    for robot in (cdcr.robots.three_sections(), cdcr.scenarios.get("length-drive").robot):
        session = Session(robot)
        low, high = np.array(session.ranges()).T
        commands = np.array(
            [circling(session.ranges(), session.model, t) for t in np.arange(0.0, 7.0, 0.1)]
        )
        np.testing.assert_array_equal(commands[0], session.model.rest_command())
        assert np.all((commands >= low) & (commands <= high))
        assert np.all(np.ptp(commands, axis=0) > 0.05 * (high - low))


def test_round_numbers() -> None:
    assert [round_up(x) for x in (0.011, 0.9, 1.0, 3.0, 7.0, 50.0)] == [0.02, 1, 1, 5, 10, 50]


# --- what is shown when ---------------------------------------------------------------------------


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    model = cdcr.Model(arm())
    t = np.linspace(1.0, 3.0, 201)
    return cdcr.simulate(model, state(arm()), np.zeros(6), t=t, tension=[2.0, *[0.0] * 8])


def test_a_run_is_played_at_its_speed_to_its_end(run: cdcr.Trajectory) -> None:
    session = Session(arm(), run=run, speed=0.5)
    assert session.advance(0.4) == pytest.approx(0.2)
    moment = session.moment()
    assert moment.time == pytest.approx(1.2)
    np.testing.assert_allclose(moment.q, run.q[20], atol=1e-9)
    np.testing.assert_array_equal(moment.tension, run.tension[20])
    session.advance(10.0)
    assert (session.time, session.playing) == (3.0, False)
    session.play()
    assert (session.time, session.playing) == (1.0, True)


def test_the_trail_is_the_path_of_the_tip(run: cdcr.Trajectory) -> None:
    session = Session(arm(), run=run)
    session.seek(2.9)
    trail = session.trail()
    assert trail.shape == (TRAIL_POINTS, 3)
    np.testing.assert_allclose(trail[-1], run.tip[190], atol=1e-9)
    np.testing.assert_allclose(trail[0], run.tip[0], atol=1e-9)  # TRAIL before is the start
    assert TRAIL > 1.9


def test_live_goes_on_from_what_is_shown(run: cdcr.Trajectory) -> None:
    session = Session(arm(), run=run)
    session.seek(1.5)
    session.go_live()
    assert session.live is not None
    assert session.moment().time == 1.5
    session.live_for(0.5)
    # Nothing changed, so the robot does what it did in the run.
    np.testing.assert_allclose(session.moment().q, run.q[100], atol=1e-4)
    np.testing.assert_allclose(session.moment().tension, run.tension[100])
    session.go_back()
    assert session.live is None
    assert session.time == 1.0


def test_looking_back_at_what_was_simulated() -> None:
    session = Session(arm())
    assert session.live is not None
    session.live.command = np.array([5.0, *[0.0] * 8])
    for _ in range(20):
        session.advance(0.02)
    now = session.moment()
    session.seek(0.2)
    assert session.advance(1.0) == 0.0  # paused
    before = session.moment()
    assert before.time == pytest.approx(0.2, abs=0.02)
    assert np.linalg.norm(before.q - now.q) > 1e-3
    session.play()
    np.testing.assert_array_equal(session.moment().q, now.q)


def test_a_pull_leaves_the_run(run: cdcr.Trajectory) -> None:
    session = Session(arm(), run=run)
    session.seek(2.0)
    session.pull_to(2, 1.0, (0.3, 0.0, 0.5))
    assert session.live is not None
    assert session.playing
    session.live_for(0.1)
    assert np.linalg.norm(session.moment().q - run.q[110]) > 1e-3
    session.let_go()
    assert session.live.pull is None


def test_a_reference_keeps_time(run: cdcr.Trajectory) -> None:
    other = cdcr.simulate(run.model, run.q[0], np.zeros(6), t=[1.0, 1.5, 2.0])
    session = Session(arm(), run=run, reference=other)
    session.seek(1.5)
    reference = session.moment().reference
    assert reference is not None
    np.testing.assert_allclose(reference, other.q[1], atol=ROUNDING)
    session.seek(3.0)  # where it is over, its end stays
    reference = session.moment().reference
    assert reference is not None
    np.testing.assert_allclose(reference, other.q[2], atol=ROUNDING)
    motion = cdcr.Reference.from_samples(run.t, run.q, run.qd, np.zeros_like(run.q))
    assert Session(arm(), run=run, reference=motion).moment().reference is not None


def test_refusals(run: cdcr.Trajectory) -> None:
    with pytest.raises(ValueError, match="speed must be a number > 0 and finite, got 0"):
        Session(arm(), speed=0)
    one = cdcr.simulate(cdcr.Model(cdcr.robots.amouri2020()), [0, 0], [0, 0], t=[0, 1])
    with pytest.raises(ValueError, match="reference must be of a robot of 6 coordinates, got"):
        Session(arm(), run=run, reference=one)
    with pytest.raises(TypeError, match=r"reference must be a cdcr\.Trajectory or .*, got 3 \(int"):
        Session(arm(), run=run, reference=3)  # type: ignore[arg-type]


@pytest.mark.parametrize("is_played", [True, False])
def test_times_that_are_none_are_refused(run: cdcr.Trajectory, is_played: bool) -> None:
    session = Session(arm(), run=run if is_played else None)
    for bad in (math.nan, "1", None, True):
        with pytest.raises(ValueError, match=r"^time must be a number in s, got "):
            session.seek(bad)  # type: ignore[arg-type]
        with pytest.raises(ValueError, match=r"^elapsed must be a number >= 0 in s, got "):
            session.advance(bad)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^elapsed must be a number >= 0 in s, got -1"):
        session.advance(-1.0)
    assert session.advance(0.1) > 0.0


def test_what_is_refused_of_a_live_robot_leaves_it_as_it_was() -> None:
    session = Session(arm())
    live = session.live
    assert live is not None
    for section, fraction, target in ((9, 1.0, [0, 0, 1]), (0, 2.0, [0, 0, 1]), (0, 1.0, [0, 0])):
        with pytest.raises(ValueError, match="must be"):
            session.pull_to(section, fraction, target)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^target must be three finite numbers in m, got "):
        session.pull_to(0, 1.0, (0.0, 0.0, math.nan))
    assert live.pull is None
    for share in (-1.0, math.nan):
        with pytest.raises(ValueError, match=r"^added_damping must be a number >= 0 and finite"):
            live.change(added_damping=share)
    live.change(payload=0.01)
    assert live.robot.payload == 0.01
    assert session.advance(0.1) > 0.0
