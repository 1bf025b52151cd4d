"""Where pictures draw disks and cables, for any robot."""

import dataclasses

import numpy as np
import pytest

import cdcr

pytest.importorskip("matplotlib")

from cdcr.plotting import plot_robot
from cdcr.plotting.geometry import base_plate, robot_shape

# Sums of a few products of numbers below 1 [m].
ROUNDING = 1e-14

SECTION = cdcr.Section(
    length=0.3,
    backbone_mass=0.01,
    backbone_diameter=0.002,
    youngs_modulus=60e9,
    disk_positions=[0.6, 0.2],
    disk_diameters=[0.05, 0.03],
    cable_radius=0.01,
    cable_angles=[0.0],
)
CABLES = [
    cdcr.Cable(radius=0.012, angle=1.0, end_section=1),
    cdcr.Cable(radius=0.014, angle=2.0, end_section=0),
]
ROBOT = cdcr.Robot(sections=[SECTION, SECTION], cables=CABLES)
Q = np.array([0.5, 0.3, -0.4, 0.8])
TILTED = ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def test_disks_are_drawn_where_they_are_with_their_own_diameters() -> None:
    model = cdcr.Model(ROBOT)
    drawn = robot_shape(model, Q).disks
    places = [(i, x, d) for i in (0, 1) for x, d in ((0.2, 0.03), (0.6, 0.05))]
    for rim, (section, fraction, diameter) in zip(drawn, places, strict=True):
        _, p = model.pose(Q, section, fraction)
        np.testing.assert_allclose(rim.mean(axis=0), p, rtol=0.0, atol=ROUNDING)
        distances = np.linalg.norm(rim - p, axis=1)
        np.testing.assert_allclose(distances, diameter / 2, rtol=0.0, atol=ROUNDING)


def test_each_cable_runs_through_the_disks_to_its_own_end() -> None:
    model = cdcr.Model(ROBOT)
    drawn = robot_shape(model, Q).cables
    assert len(drawn) == model.num_cables == 4
    for line, cable in zip(drawn, ROBOT.all_cables, strict=True):
        hole = cable.radius * np.array([np.cos(cable.angle), np.sin(cable.angle), 0.0])
        through = [(0, 0.0), (0, 0.2), (0, 0.6), (1, 0.2), (1, 0.6)][: 3 + 2 * cable.end_section]
        frames = [model.pose(Q, *place) for place in [*through, (cable.end_section, 1.0)]]
        expected = [p + R @ hole for R, p in frames]
        np.testing.assert_allclose(line, expected, rtol=0.0, atol=ROUNDING)


def test_a_tilted_base_tilts_the_picture() -> None:
    upright = cdcr.Model(ROBOT)
    tilted = cdcr.Model(dataclasses.replace(ROBOT, base_orientation=TILTED))
    turn = np.array(TILTED).T
    np.testing.assert_allclose(
        robot_shape(tilted, Q).points,
        robot_shape(upright, Q).points @ turn,
        rtol=0.0,
        atol=ROUNDING,
    )
    np.testing.assert_allclose(
        base_plate(tilted), base_plate(upright) @ turn, rtol=0.0, atol=ROUNDING
    )
    assert plot_robot(tilted, Q, tension=[1.0, 0.0, 2.0, 0.0]).lines


def test_base_and_tool_stand_in_the_picture_where_they_are() -> None:
    upright, base = cdcr.Model(ROBOT), (0.3, -0.2, 0.5)
    tool = (
        (1.0, 0.0, 0.0, 0.01),
        (0.0, 1.0, 0.0, 0.0),
        (0.0, 0.0, 1.0, 0.04),
        (0.0, 0.0, 0.0, 1.0),
    )
    other = cdcr.Model(dataclasses.replace(ROBOT, base_position=base, tool=tool))
    shape = robot_shape(other, Q)
    (line,) = shape.tool
    np.testing.assert_allclose(line[1], other.tip(Q)[1], rtol=0.0, atol=ROUNDING)
    np.testing.assert_array_equal(line[0], shape.backbone[-1])
    expected = robot_shape(upright, Q).points + base
    np.testing.assert_allclose(shape.points[:-2], expected, rtol=0.0, atol=ROUNDING)
    moved = base_plate(upright) + base
    np.testing.assert_allclose(base_plate(other), moved, rtol=0.0, atol=ROUNDING)
    axes = plot_robot(other, Q)
    assert len(axes.lines) == len(plot_robot(upright, Q).lines) + 1
    limits = [axes.get_xlim(), axes.get_ylim(), axes.get_zlim()]
    assert all(
        low - ROUNDING <= x <= high + ROUNDING
        for (low, high), x in zip(limits, line[1], strict=True)
    )


@pytest.mark.parametrize("parts", [2, [3, 1]])
def test_a_subdivided_robot_has_the_same_picture(parts: int | list[int]) -> None:
    whole = cdcr.Model(ROBOT)
    cut = cdcr.Model(ROBOT.subdivide(parts))
    one = robot_shape(whole, Q)
    other = robot_shape(cut, cdcr.subdivide_state(ROBOT, parts, Q))
    np.testing.assert_allclose(other.disks, one.disks, rtol=0.0, atol=ROUNDING)
    for line, whole_line in zip(other.cables, one.cables, strict=True):
        np.testing.assert_allclose(line[[0, -1]], whole_line[[0, -1]], rtol=0.0, atol=ROUNDING)
    np.testing.assert_array_equal(base_plate(cut), base_plate(whole))
