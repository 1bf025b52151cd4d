"""Where a robot stands, what its tip carries, and places by arc length."""

import json
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray
from scipy.linalg import expm  # type: ignore[import-untyped]
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]

import cdcr
from description import refusal

Frame = NDArray[np.float64]

# Products of a few matrices, an exponential among them, of numbers near one.
ROUNDING = 1e-13
# Central differences with a step of 1e-5: its square, and rounding over it.
STEP, DIFFERENCES = 1e-5, 1e-9
# Where a search for shapes ends, in lengths of the robot.
REACHED = 1e-8

TURN = Rotation.from_rotvec([0.4, -1.1, 0.7]).as_matrix()
BASE = (0.3, -0.2, 1.5)
Q = np.array([0.5, 0.3, -0.8, 0.4, 0.2, -1.1])


def frame(R: Frame, p: ArrayLike) -> Frame:
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = R, p
    return made


TOOL = frame(Rotation.from_rotvec([-0.3, 0.9, 0.5]).as_matrix(), (0.01, -0.02, 0.06))


def robot(n: int = 3, **fields: Any) -> cdcr.Robot:
    """Return n sections that differ, turned; with base and tool unless other fields say so."""
    whole = cdcr.robots.three_sections(gravity=(1.0, -2.0, -9.0), payload=0.01)
    chosen: dict[str, Any] = {"base_orientation": TURN, "base_position": BASE, "tool": TOOL}
    return replace(whole, sections=whole.sections[:n], **chosen | fields)


def arc(section: cdcr.Section, q: Frame, fraction: float) -> Frame:
    """Frame along a section, the exponential of its constant twist: no formula of the package."""
    twist = np.zeros((4, 4))
    u = np.array([-q[1], q[0], 0.0])
    twist[:3, :3] = np.cross(np.eye(3), u)
    twist[2, 3] = section.length
    return np.asarray(expm(fraction * twist))


def backbone(robot: cdcr.Robot, q: Frame, section: int, fraction: float) -> Frame:
    at = frame(np.array(robot.base_orientation), robot.base_position)
    for i, one in enumerate(robot.sections[: section + 1]):
        at = at @ arc(one, q[2 * i : 2 * i + 2], fraction if i == section else 1.0)
    return at


# --- Base and tool --------------------------------------------------------------------------------


def test_frames_are_products_of_transforms() -> None:
    whole = robot()
    model = cdcr.Model(whole)
    for section, fraction in [(0, 0.0), (0, 0.7), (1, 0.2), (2, 1.0)]:
        found = frame(*model.pose(Q, section, fraction))
        expected = backbone(whole, Q, section, fraction)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=ROUNDING)
    expected = backbone(whole, Q, 2, 1.0) @ TOOL
    np.testing.assert_allclose(frame(*model.tip(Q)), expected, rtol=0.0, atol=ROUNDING)
    np.testing.assert_allclose(model.tips([Q, Q])[1], expected[:3, 3], rtol=0.0, atol=ROUNDING)


def test_the_jacobian_of_the_tip_is_that_of_the_tool() -> None:
    model = cdcr.Model(robot())
    J, R = model.tip_jacobian([Q, 0.5 * Q]), model.tip(Q)[0]
    assert J.shape == (2, 6, 6)
    for k, change in enumerate(STEP * np.eye(6)):
        (R_ahead, p_ahead), (R_behind, p_behind) = model.tip(Q + change), model.tip(Q - change)
        np.testing.assert_allclose(J[0, :3, k], (p_ahead - p_behind) / (2 * STEP), atol=DIFFERENCES)
        spin = (R_ahead - R_behind) / (2 * STEP) @ R.T
        omega = [spin[2, 1], spin[0, 2], spin[1, 0]]
        np.testing.assert_allclose(J[0, 3:, k], omega, atol=DIFFERENCES)


def test_the_energy_of_weight_counts_from_the_origin() -> None:
    """By the places of masses: the backbone in fine slices, disks and payload where they are."""
    whole = robot(2, payload=0.05, payload_position=(0.0, 0.01, 0.02))
    q, energy = Q[:4], 0.0
    nodes, weights = np.polynomial.legendre.leggauss(20)
    for i, section in enumerate(whole.sections):
        pieces = [(d.mass, d.position) for d in section.disks]
        shares = zip(weights / 2, (nodes + 1) / 2, strict=True)
        pieces += [(section.backbone_mass * share, place) for share, place in shares]
        for mass, place in pieces:
            energy -= mass * np.dot(whole.gravity, backbone(whole, q, i, place)[:3, 3])
        energy += 0.5 * section.stiffness * np.sum(q[2 * i : 2 * i + 2] ** 2)
    center = backbone(whole, q, 1, 1.0) @ [*whole.payload_position, 1.0]
    energy -= whole.payload * np.dot(whole.gravity, center[:3])
    assert cdcr.Model(whole).potential_energy(q) == pytest.approx(energy, rel=ROUNDING)


@pytest.mark.parametrize("n", [1, 3])
def test_motion_and_statics_do_not_depend_on_base_and_tool(n: int) -> None:
    here, there = (
        cdcr.Model(one) for one in (robot(n), robot(n, base_position=(0, 0, 0), tool=np.eye(4)))
    )
    wrench = cdcr.Wrench(section=n - 1, fraction=0.6, force=(0.1, 0.2, -0.1))
    tension = np.linspace(0.0, 1.0, here.num_cables)
    force, same = (m.wrench_force(Q[: 2 * n], wrench) for m in (here, there))
    np.testing.assert_array_equal(force, same)
    rest, same = (m.equilibrium(tension, wrenches=wrench) for m in (here, there))
    np.testing.assert_allclose(rest, same, rtol=0.0, atol=ROUNDING)
    run = cdcr.simulate(here, np.zeros(2 * n), np.zeros(2 * n), t=np.linspace(0, 0.2, 5))
    other = cdcr.simulate(there, np.zeros(2 * n), np.zeros(2 * n), t=run.t)
    np.testing.assert_array_equal(run.q, other.q)
    change, same = (one.energy - one.energy[0] for one in (run, other))
    np.testing.assert_allclose(change, same, rtol=0.0, atol=ROUNDING)
    np.testing.assert_array_equal(run.tip, here.tips(run.q))


@pytest.mark.parametrize("n", [1, 3])
@pytest.mark.parametrize("with_rotation", [False, True])
def test_inverse_kinematics_leads_the_tool_there_and_back(n: int, with_rotation: bool) -> None:
    model, random = cdcr.Model(robot(n)), np.random.default_rng(n)
    for _ in range(10):
        R, p = model.tip(random.uniform(-1.2, 1.2, 2 * n))
        found = model.inverse_kinematics(p, R if with_rotation else None)
        assert found.reachable
        reached_R, reached_p = model.tip(found.q)
        assert np.linalg.norm(reached_p - p) < REACHED * model.robot.length
        np.testing.assert_array_equal(found.position, reached_p)
        if with_rotation:
            np.testing.assert_allclose(reached_R, R, rtol=0.0, atol=1e-7)


def test_one_section_far_away_reaches_as_well_as_at_the_origin() -> None:
    away = cdcr.Model(replace(cdcr.robots.amouri2020(), base_position=(0.0, 0.0, 7.0)))
    here = cdcr.Model(cdcr.robots.amouri2020())
    x, y, z = here.tip([0.9, -0.3])[1]
    found = away.inverse_kinematics([x, y, z + 7.0])
    assert found.seeds == 0  # by the closed form
    np.testing.assert_allclose(found.q, [0.9, -0.3], rtol=0.0, atol=1e-12)
    told = away.inverse_kinematics([0.0, 0.0, 8.0]).message
    assert told.startswith("p is 1 m from the base, farther than the robot's 0.802 m; ")


def test_parts_keep_base_and_tool() -> None:
    whole = robot()
    cut = whole.subdivide([2, 1, 3])
    assert (cut.base_position, cut.tool) == (whole.base_position, whole.tool)
    q = cdcr.subdivide_state(whole, [2, 1, 3], Q)
    for found, expected in zip(cdcr.Model(cut).tip(q), cdcr.Model(whole).tip(Q), strict=True):
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=ROUNDING)


def test_a_tool_of_few_digits_becomes_a_rotation() -> None:
    tool = np.round(TOOL, 6)
    R, _ = cdcr.Model(robot(tool=tool)).tip(Q)
    np.testing.assert_allclose(R @ R.T, np.eye(3), rtol=0.0, atol=1e-14)


def test_tip_of_systems_and_of_the_robot_at_rest_is_the_tool() -> None:
    from cdcr.model.rest import at_rest
    from cdcr.model.signals import find_outputs

    model = cdcr.Model(robot())
    (tip,) = find_outputs("tip")
    np.testing.assert_array_equal(tip.derivative(model, Q)[:, :6], model.tip_jacobian(Q)[:3])
    # A long tool gives way more to the same force.
    arm = cdcr.robots.amouri2020()
    longer = replace(arm, tool=frame(np.eye(3), (0.0, 0.0, 0.4)))  # type: ignore[arg-type]
    assert at_rest(longer).tip_stiffness[0] < 0.5 * at_rest(arm).tip_stiffness[0]


def test_a_log_has_the_tool_as_its_tip() -> None:
    pytest.importorskip("mcap")
    from cdcr.runs.mcap_log import _channels

    model = cdcr.Model(robot())
    run = cdcr.simulate(model, Q, np.zeros(6), t=[0.0, 0.01])
    channels = {channel.topic: channel for channel in _channels(run, [{}, {}])}
    (first, _) = channels["/tip_pose"].messages
    assert list(first["pose"]["position"].values()) == pytest.approx(model.tip(Q)[1], abs=1e-14)
    (first, _) = channels["/backbone"].messages
    start = first["entities"][0]["lines"][0]["points"][0]
    assert list(start.values()) == list(BASE)
    json.dumps(first)


# --- Places ---------------------------------------------------------------------------------------


def test_a_place_by_arc_length_goes_wherever_a_place_goes() -> None:
    whole = robot()
    model, lengths = cdcr.Model(whole), [section.length for section in whole.sections]
    assert whole.locate(0.0) == (0, 0.0)
    assert whole.locate(lengths[0]) == (0, 1.0)
    assert whole.locate(np.float64(sum(lengths))) == (2, 1.0)
    section, fraction = whole.locate(lengths[0] + 0.25 * lengths[1])
    assert section == 1
    assert fraction == pytest.approx(0.25, rel=1e-14)
    p = np.array([model.pose(Q, *whole.locate(s))[1] for s in np.linspace(0, whole.length, 400)])
    walked = np.linalg.norm(np.diff(p, axis=0), axis=1)
    np.testing.assert_allclose(walked, whole.length / 399, rtol=1e-4)  # chords of bent pieces
    assert model.jacobian(Q, *whole.locate(0.1)).shape == (6, 6)


@pytest.mark.parametrize("s", [-0.1, 0.803, math.inf, math.nan])
def test_there_is_no_place_beyond_the_robot(s: float) -> None:
    told = f"s must be 0 to 0.802 m, the length of the robot, got {s:g}"
    assert refusal(lambda s: cdcr.robots.amouri2020().locate(s), s=s) == [told]


def test_an_arc_length_is_a_number() -> None:
    said = ["s must be a number in m, got 'tip' (str)"]
    assert refusal(lambda s: cdcr.robots.amouri2020().locate(s), s="tip") == said


# --- The actuation matrix at a shape --------------------------------------------------------------


def test_the_actuation_matrix_takes_arrays_of_states() -> None:
    model = cdcr.Model(robot())
    states = np.stack([Q, 0.5 * Q, 0.0 * Q])[:, None]
    B = model.actuation_matrix(states)
    assert B.shape == (3, 1, 6, model.num_cables)
    np.testing.assert_array_equal(B[1, 0], model.actuation_matrix())
    for k, change in enumerate(STEP * np.eye(6)):
        ahead, behind = model.cable_lengths(Q + change), model.cable_lengths(Q - change)
        np.testing.assert_allclose(B[0, 0, k], (behind - ahead) / (2 * STEP), atol=DIFFERENCES)
    with pytest.raises(ValueError, match=r"^q must have shape"):
        model.actuation_matrix([0.0])
