"""Where pictures and the view draw what rods have more: cables that wind, and disks that turn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import cdcr

pytest.importorskip("matplotlib")

from cdcr.plotting import plot_robot, plot_run
from cdcr.plotting.geometry import robot_shape

ROUNDING = 1e-12  # sums of products of numbers of about 1, in metres
LENGTH, TURNS = 0.3, 3.0
SECTION = cdcr.Section(
    length=LENGTH,
    backbone_mass=0.01,
    backbone_diameter=(0.004, 0.002),
    youngs_modulus=60e9,
    shear_modulus=23e9,
    num_disks=3,
    disk_mass=0.002,
    disk_diameter=0.04,
    bending_order=1,
    twist_order=0,
    stretch_order=0,
)
HELIX = cdcr.Cable(radius=0.012, angle=[(0.4, 0.4 + 2.0 * np.pi * TURNS)], end_section=0)
CONE = cdcr.Cable(radius=[(0.015, 0.005)], angle=2.0, end_section=1, start_section=1)
STRAIGHT = cdcr.Cable(radius=0.01, angle=1.0, end_section=1)
ROBOT = cdcr.Robot(
    sections=[SECTION, replace(SECTION, twist_order=None)], cables=[HELIX, CONE, STRAIGHT]
)
MODEL = cdcr.Model(ROBOT)
TWIST = MODEL.coordinate_names.index("t1")
STRETCH = MODEL.coordinate_names.index("e1")
BENT = 0.3 * np.random.default_rng(5).normal(size=MODEL.num_coordinates) * 0.1


def test_a_helical_cable_is_a_helix_about_the_straight_robot() -> None:
    line = robot_shape(MODEL, np.zeros(MODEL.num_coordinates)).cables[0]
    x = line[:, 2] / LENGTH
    assert np.max(np.diff(2.0 * np.pi * TURNS * x)) < 2.0 * np.pi / 20.0  # it looks smooth
    angle = 0.4 + 2.0 * np.pi * TURNS * x
    helix = np.stack([0.012 * np.cos(angle), 0.012 * np.sin(angle), LENGTH * x], axis=1)
    np.testing.assert_allclose(line, helix, rtol=0.0, atol=ROUNDING)
    assert (x[0], x[-1]) == (0.0, pytest.approx(1.0))


def test_cables_run_where_their_holes_are() -> None:
    shape = robot_shape(MODEL, BENT)
    _, cone, straight = shape.cables
    for k in (0, 7, len(cone) - 1):
        fraction = k / (len(cone) - 1)
        R, p = MODEL.pose(BENT, 1, fraction)
        r = 0.015 - 0.01 * fraction
        hole = p + R @ [r * np.cos(2.0), r * np.sin(2.0), 0.0]
        np.testing.assert_allclose(cone[k], hole, rtol=0.0, atol=ROUNDING)
    R, p = MODEL.pose(BENT, 1, 2.0 / 3.0)
    hole = p + R @ [0.01 * np.cos(1.0), 0.01 * np.sin(1.0), 0.0]
    np.testing.assert_allclose(straight[5], hole, rtol=0.0, atol=ROUNDING)
    assert len(straight) == 7  # base and disks
    assert len(plot_robot(MODEL, BENT).lines) == 2 + 3 + 3  # backbones, cables, marks


def test_marks_turn_with_the_twist() -> None:
    q = np.zeros(MODEL.num_coordinates)
    q[TWIST] = 0.9
    marks = robot_shape(MODEL, q).marks
    assert len(marks) == 3  # the second section cannot twist
    for x, (center, rim) in zip((1 / 3, 2 / 3, 1.0), marks, strict=True):
        arm = [0.02 * np.cos(0.9 * x), 0.02 * np.sin(0.9 * x), 0.0]
        np.testing.assert_allclose(rim - center, arm, rtol=0.0, atol=ROUNDING)
    still = cdcr.Model(replace(ROBOT, sections=(replace(SECTION, twist_order=None),) * 2))
    assert not robot_shape(still, np.zeros(still.num_coordinates)).marks


def test_solids_of_the_view_taper_turn_and_stretch() -> None:
    from cdcr.view.live import LiveModel
    from cdcr.view.placement import OVERLAP, place, sizes

    live, q = LiveModel(ROBOT), np.zeros(MODEL.num_coordinates)
    q[TWIST], q[STRETCH] = 0.9, 0.03
    at, size = place(live, q), sizes(live)
    radius = size.backbone[:, 0].reshape(2, -1)
    np.testing.assert_allclose(radius[0, 0] / radius[0, -1], (4 - 1 / 24) / (2 + 1 / 24), rtol=1e-9)
    assert size.stretches
    np.testing.assert_allclose(at.lengths[:24].sum(), LENGTH + 0.03, rtol=1e-9)
    np.testing.assert_allclose(size.backbone[:24, 2].sum(), OVERLAP * LENGTH, rtol=1e-9)
    assert len(size.marks) == len(at.marks.position) == 3
    x, y, _ = at.marks.position[-1]
    assert np.arctan2(y, x) == pytest.approx(0.9)


def test_a_rod_lives_in_the_view() -> None:
    from cdcr.view.live import LiveRobot

    rod = cdcr.Robot(sections=[replace(SECTION, stretch_order=None)], cables=[HELIX])
    robot, twist = LiveRobot(rod), cdcr.Model(rod).coordinate_names.index("t1")
    assert robot.added_damping > 0.0
    added = robot.robot.sections[0]
    assert min(added.damping, added.twist_damping) > added.stretch_damping == 0.0
    robot.command[0] = 2.0
    robot.advance(0.02)
    assert robot.message == ""
    rest = cdcr.Model(rod).equilibrium([2.0])
    assert 0.0 < robot.q[twist] / rest[twist] < 2.0


def test_runs_of_rods_have_panels_of_twist_and_stretch() -> None:
    zero = np.zeros(MODEL.num_coordinates)
    run = cdcr.simulate(MODEL, BENT, zero, t=np.linspace(0.0, 0.01, 5))
    axes = {panel.get_ylabel(): panel for panel in plot_run(run).axes}
    twist, stretch = axes["twist [deg]"].lines, axes["stretch [mm]"].lines
    np.testing.assert_array_equal(twist[0].get_ydata(), np.rad2deg(run.q[:, TWIST]))
    np.testing.assert_array_equal(stretch[0].get_ydata(), 1e3 * run.q[:, STRETCH])
    assert (len(twist), len(stretch)) == (1, 2)
