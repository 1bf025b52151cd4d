"""Where the solids of the view stand, and which colours they have."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray

pytest.importorskip("matplotlib", reason="the view draws with the colours of pictures")

from cdcr.base.rotations import quaternions
from cdcr.view import Session
from cdcr.view.colors import legend, shaded, tension_colors
from cdcr.view.live import LiveModel
from cdcr.view.placement import along, cylinder, place, sizes

ROUNDING = 1e-12
ROBOT = cdcr.robots.three_sections()
Q = 0.4 * np.random.default_rng(3).normal(size=6)


def turned(wxyz: FloatArray, v: FloatArray) -> FloatArray:
    """A vector turned by a quaternion: v + 2 w (u x v) + 2 u x (u x v)."""
    w, u = wxyz[0], wxyz[1:]
    return np.asarray(v + 2.0 * w * np.cross(u, v) + 2.0 * np.cross(u, np.cross(u, v)))


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
    model = cdcr.Model(ROBOT)
    bent = [model.pose(size * Q, 2, 1.0)[0] for size in (0.0, 1.0, 4.0)]
    for R in (*half_turns, *bent):
        for axis in np.eye(3):
            np.testing.assert_allclose(turned(quaternions(R), axis), R @ axis, atol=1e-12)


def test_everything_stands_where_the_model_has_it() -> None:
    q, model, live = Q, cdcr.Model(ROBOT), LiveModel(ROBOT)
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
    np.testing.assert_allclose(ends[:-1], starts[1:], atol=1e-4 * ROBOT.length)
    np.testing.assert_allclose(ends[-1], at.tip, atol=1e-4 * ROBOT.length)


def test_base_and_tool_stand_where_they_are() -> None:
    base = (0.4, -0.1, 1.2)
    tool = (
        (0.0, 0.0, 1.0, 0.05),
        (1.0, 0.0, 0.0, 0.0),
        (0.0, 1.0, 0.0, 0.02),
        (0.0, 0.0, 0.0, 1.0),
    )
    live = LiveModel(replace(ROBOT, base_position=base, tool=tool))
    at, before = place(live, Q), place(LiveModel(ROBOT), Q)
    R, p = live.tip(Q)
    np.testing.assert_array_equal(at.tip, p)
    np.testing.assert_array_equal(at.frames.position[[0, -1]], [base, p])
    np.testing.assert_allclose(turned(at.frames.wxyz[-1], np.eye(3)[2]), R[:, 2], atol=1e-12)
    np.testing.assert_array_equal(at.tool, [[live.pose(Q, 2, 1.0)[1], p]])
    moved = at.backbone.position - before.backbone.position
    np.testing.assert_allclose(moved, np.tile(base, (len(moved), 1)), atol=ROUNDING)
    assert before.tool.shape == (0, 2, 3)


def test_cables_are_pieces_in_their_order() -> None:
    live, q = LiveModel(ROBOT), Q
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
