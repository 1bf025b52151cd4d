"""The view without a browser: where things stand, what is shown when, and how it moves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray

pytest.importorskip("matplotlib", reason="the view draws with the colours of pictures")

from cdcr.view import Session
from cdcr.view.colors import legend, shaded, tension_colors
from cdcr.view.live import PERIOD, LiveModel, LiveRobot, Pull, command_ranges, round_up
from cdcr.view.placement import along, cylinder, place, quaternion, sizes
from cdcr.view.session import TRAIL, TRAIL_POINTS, circling

ROUNDING = 1e-12
SIMULATED = 1e-6  # RK4 in steps of a few ms at most, beside dopri5 at 1e-10 [rad]
AT_REST = 1e-6  # decayed for many time constants [rad]


def arm(**options: object) -> cdcr.Robot:
    return cdcr.robots.three_sections(gravity=(0.0, 0.0, 9.81), damping=0.02, **options)  # type: ignore[arg-type]


def state(robot: cdcr.Robot, size: float = 0.4) -> FloatArray:
    return size * np.random.default_rng(3).normal(size=2 * len(robot.sections))


def turned(wxyz: FloatArray, v: FloatArray) -> FloatArray:
    """A vector turned by a quaternion: v + 2 w (u x v) + 2 u x (u x v)."""
    w, u = wxyz[0], wxyz[1:]
    return np.asarray(v + 2.0 * w * np.cross(u, v) + 2.0 * np.cross(u, np.cross(u, v)))


# --- where things stand -----------------------------------------------------------------------


def test_quaternions_turn_z_to_every_direction() -> None:
    directions = np.random.default_rng(1).normal(size=(50, 3))
    directions = np.concatenate([directions, np.eye(3), -np.eye(3)])
    for wxyz, d in zip(along(directions), directions, strict=True):
        assert np.linalg.norm(wxyz) == pytest.approx(1.0, abs=ROUNDING)
        np.testing.assert_allclose(
            turned(wxyz, np.array([0.0, 0.0, 1.0])), d / np.linalg.norm(d), atol=1e-6
        )


def test_quaternion_of_a_matrix_does_what_the_matrix_does() -> None:
    half_turns = [np.diag(signs) for signs in ((1.0, -1, -1), (-1.0, 1, -1), (-1.0, -1, 1))]
    model = cdcr.Model(arm())
    bent = [model.pose(size * state(arm()), 2, 1.0)[0] for size in (0.0, 1.0, 4.0)]
    for R in (*half_turns, *bent):
        for axis in np.eye(3):
            np.testing.assert_allclose(turned(quaternion(R), axis), R @ axis, atol=1e-12)


def test_everything_stands_where_the_model_has_it() -> None:
    robot = arm()
    q, model, live = state(robot), cdcr.Model(robot), LiveModel(robot)
    at, size = place(live, q), sizes(live)
    R, p = model.tip(q)
    np.testing.assert_allclose(at.tip, p, atol=ROUNDING)
    np.testing.assert_allclose(at.frames.position[-1], p, atol=ROUNDING)
    np.testing.assert_allclose(
        turned(at.frames.wxyz[-1], np.array([1.0, 0.0, 0.0])), R[:, 0], atol=1e-12
    )
    assert len(at.frames.wxyz) == 4
    for place_, wxyz, position in zip(size.disk_place, *at.disks, strict=True):
        R, p = model.pose(q, *place_)
        np.testing.assert_allclose(position, p, atol=ROUNDING)
        np.testing.assert_allclose(turned(wxyz, np.array([0, 0, 1.0])), R[:, 2], atol=1e-9)
    # The cylinders of the backbone follow it: their ends meet on it.
    half = size.backbone[:, 2:] / 2 / 1.03
    z = np.array([turned(wxyz, np.array([0, 0, 1.0])) for wxyz in at.backbone.wxyz])
    ends, starts = at.backbone.position + half * z, at.backbone.position - half * z
    np.testing.assert_allclose(ends[:-1], starts[1:], atol=1e-4 * robot.length)
    np.testing.assert_allclose(ends[-1], at.tip, atol=1e-4 * robot.length)


def test_cables_are_pieces_in_their_order() -> None:
    live = LiveModel(arm())
    q = state(arm())
    at, size = place(live, q), sizes(live)
    ends = [at.cables[np.flatnonzero(size.pieces == j)[-1], 1] for j in range(9)]
    for cable, end in zip(live.robot.all_cables, ends, strict=True):
        R, p = live.pose(q, cable.end_section, 1.0)
        hole = cable.radius * np.array([np.cos(cable.angle), np.sin(cable.angle), 0.0])
        np.testing.assert_allclose(end, p + R @ hole, atol=ROUNDING)


def test_robots_without_cables_or_disks() -> None:
    section = replace(
        cdcr.robots.amouri2020().sections[0], cable_angles=(), num_disks=0, disk_mass=0.0
    )
    session = Session(cdcr.Robot(sections=[section]))
    session.advance(0.1)
    at = place(session.model, session.moment().q)
    assert at.cables.shape == (0, 2, 3)
    assert at.disks.position.shape == (0, 3)
    assert session.ranges() == []
    assert session.scale == 1.0


def test_a_cylinder_is_closed_and_looks_outward() -> None:
    vertices, faces = cylinder()
    corners = vertices[faces.astype(int)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert np.all(np.sum(normals * corners.mean(axis=1), axis=1) > 0.0)
    volume = np.sum(corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])) / 6.0
    assert volume == pytest.approx(12 * np.sin(2 * np.pi / 24), rel=1e-12)  # of a prism of 24 sides


# --- colours ------------------------------------------------------------------------------------


def test_the_scale_darkens_all_the_way() -> None:
    # Relative luminance of sRGB: what everybody sees, whatever colours they tell apart.
    share = shaded(tension_colors(np.linspace(0.0, 2.0, 40), 2.0)) / 255
    luminance = share @ [0.2126, 0.7152, 0.0722]
    assert np.all(np.diff(luminance) < 1e-3)
    assert luminance[0] - luminance[-1] > 0.5
    assert (tension_colors(np.array([3.0]), 2.0) == tension_colors(np.array([2.0]), 2.0)).all()


def test_the_legend_names_newtons() -> None:
    text = legend(20.0)
    assert "[N]" in text
    for tick in ("0", "5", "10", "15", "20"):
        assert f"<span>{tick}</span>" in text


def test_light_of_colours() -> None:
    assert shaded([0, 255, 188]).tolist() == [0, 255, 128]  # half the light of white is 188


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
    with pytest.raises(ValueError, match="reference must be of a robot of 3 sections, got one of"):
        Session(arm(), run=run, reference=one)
