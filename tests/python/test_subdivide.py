"""A subdivided robot is the same robot: disks, masses, cables and shapes stay where they were."""

import dataclasses
import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import cdcr

# A pose and a cable's length are sums over up to 15 parts of products of numbers below 10, each
# rounded a dozen times.
ROUNDING = 1e-13
# Sums of up to forty terms of one sign, each rounded once.
REL = 1e-14
# Five parts, each off by half of the smallest number there is.
SMALLEST = 3e-323
# A disk this near to the border of a part is put on it [m], for parts of up to 1 m.
ON_BORDER = 1.1e-12

SECTION = cdcr.Section(
    length=0.8,
    backbone_mass=0.03,
    backbone_diameter=0.005,
    youngs_modulus=9.5e9,
    disk_mass=0.008,
    disk_diameter=0.04,
    num_disks=10,
    cable_radius=0.019,
    cable_angles=(0.0, 2.0, 4.0),
    cable_stiffness=1e4,
    cable_damping=2.0,
    cable_friction=0.1,
    damping=1e-3,
)
CABLE = cdcr.Cable(radius=0.01, angle=0.5, end_section=0, stiffness=5e3, damping=1, friction=0.2)


def places(robot: cdcr.Robot) -> list[float]:
    """Where the disks of a robot are along it [m]."""
    bases = np.cumsum([0.0] + [section.length for section in robot.sections])
    return [
        float(base) + disk.position * section.length
        for base, section in zip(bases[:-1], robot.sections, strict=True)
        for disk in section.disks
    ]


angles = st.floats(-math.pi, math.pi)
lengths = st.floats(0.05, 1.0)


@st.composite
def sections(draw: st.DrawFn) -> cdcr.Section:
    positions = draw(st.lists(st.floats(0.0, 1.0), max_size=8).map(sorted))
    count = len(positions) or draw(st.integers(0, 12))
    one_each = st.lists(st.floats(0.0, 0.1), min_size=count, max_size=count).map(tuple)
    return dataclasses.replace(
        SECTION,
        length=draw(lengths),
        num_disks=count,
        disk_positions=tuple(positions),
        disk_masses=draw(one_each) if draw(st.booleans()) else (),
        disk_diameters=draw(one_each) if draw(st.booleans()) else (),
        cable_angles=draw(st.lists(angles, max_size=4).map(tuple)),
    )


@st.composite
def robots(draw: st.DrawFn) -> cdcr.Robot:
    several = draw(st.lists(sections(), min_size=1, max_size=3))
    ends = st.integers(0, len(several) - 1)
    cable = st.builds(cdcr.Cable, radius=st.floats(0.005, 0.05), angle=angles, end_section=ends)
    return cdcr.Robot(
        sections=several,
        cables=draw(st.lists(cable, max_size=3)),
        base_orientation=draw(st.permutations(np.eye(3).tolist()).map(right_handed)),
    )


def right_handed(rows: list[list[float]]) -> list[list[float]]:
    if np.linalg.det(rows) < 0.0:
        rows[0] = [-x for x in rows[0]]
    return rows


@st.composite
def subdivisions(draw: st.DrawFn) -> tuple[cdcr.Robot, list[int], list[float]]:
    """A robot, the parts of each of its sections, and a bent state."""
    robot = draw(robots())
    n = len(robot.sections)
    parts = draw(st.lists(st.integers(1, 5), min_size=n, max_size=n))
    q = draw(st.lists(st.floats(-2.0, 2.0), min_size=2 * n, max_size=2 * n))
    return robot, parts, q


@given(case=subdivisions(), fraction=st.floats(0.0, 1.0))
def test_shape_and_cables_stay_the_same(
    case: tuple[cdcr.Robot, list[int], list[float]], fraction: float
) -> None:
    robot, parts, q = case
    whole, cut = cdcr.Model(robot), cdcr.Model(robot.subdivide(parts))
    state = cdcr.subdivide_state(robot, parts, q)
    first = 0
    for i, count in enumerate(parts):
        for k in range(count):
            R, p = whole.pose(q, i, (k + fraction) / count)
            R_part, p_part = cut.pose(state, first + k, fraction)
            np.testing.assert_allclose(R_part, R, rtol=0.0, atol=ROUNDING)
            np.testing.assert_allclose(p_part, p, rtol=0.0, atol=ROUNDING)
        first += count
    np.testing.assert_allclose(
        cut.cable_lengths(state), whole.cable_lengths(q), rtol=0.0, atol=ROUNDING
    )


@given(case=subdivisions())
def test_disks_and_masses_stay_where_they_are(
    case: tuple[cdcr.Robot, list[int], list[float]],
) -> None:
    robot, parts, _ = case
    cut = robot.subdivide(parts)
    np.testing.assert_allclose(places(cut), places(robot), rtol=0.0, atol=ON_BORDER)
    for name in ("mass", "diameter"):
        assert [getattr(disk, name) for section in cut.sections for disk in section.disks] == [
            getattr(disk, name) for section in robot.sections for disk in section.disks
        ]
    assert cut.length == pytest.approx(robot.length, rel=REL)
    assert cut.mass == pytest.approx(robot.mass, rel=REL)


@given(case=subdivisions())
def test_commands_keep_their_order(case: tuple[cdcr.Robot, list[int], list[float]]) -> None:
    robot, parts, _ = case
    ends = np.cumsum(parts) - 1
    assert robot.subdivide(parts).all_cables == tuple(
        dataclasses.replace(cable, end_section=ends[cable.end_section])
        for cable in robot.all_cables
    )


@given(case=subdivisions())
def test_states_go_there_and_back(case: tuple[cdcr.Robot, list[int], list[float]]) -> None:
    robot, parts, q = case
    state = cdcr.subdivide_state(robot, parts, q)
    np.testing.assert_allclose(cdcr.merge_state(robot, parts, state), q, rtol=REL, atol=SMALLEST)


def test_the_parts_of_a_section() -> None:
    robot = cdcr.Robot(sections=[SECTION], cables=[CABLE], gravity=(0, 0, -9.81), payload=0.2)
    cut = robot.subdivide(4)
    for section in cut.sections:
        assert section.length == 0.2
        assert section.backbone_mass == 0.03 / 4
        assert section.damping == 4e-3
        assert section.cable_friction == 0.1
        assert section.stiffness == pytest.approx(4 * SECTION.stiffness, rel=REL)
    for section in cut.sections[:-1]:
        assert section.cable_angles == ()
        assert section.cable_radius == section.cable_stiffness == section.cable_damping == 0.0
    for name in ("cable_angles", "cable_radius", "cable_stiffness", "cable_damping"):
        assert getattr(cut.sections[-1], name) == getattr(SECTION, name)
    assert cut.cables == (dataclasses.replace(CABLE, end_section=3),)
    assert dataclasses.replace(cut, sections=robot.sections, cables=robot.cables) == robot


def test_a_uniform_bend_is_damped_the_same() -> None:
    cut = cdcr.Robot(sections=[SECTION]).subdivide(3)
    rate = cdcr.subdivide_state(cdcr.Robot(sections=[SECTION]), 3, [0.7, 0.0])
    power = sum(s.damping * rate[2 * i] ** 2 for i, s in enumerate(cut.sections))
    assert power == pytest.approx(SECTION.damping * 0.7**2, rel=REL)


@pytest.mark.parametrize("count", range(1, 33))
@pytest.mark.parametrize("disks", [1, 3, 7, 10, 64])
def test_equally_spaced_disks_fall_exactly_right(count: int, disks: int) -> None:
    section = dataclasses.replace(SECTION, num_disks=disks)
    cut = cdcr.Robot(sections=[section]).subdivide(count)
    for i, part in enumerate(cut.sections):
        expected = [
            Fraction(k, disks) * count - i
            for k in range(1, disks + 1)
            if i < Fraction(k, disks) * count <= i + 1
        ]
        assert [disk.position for disk in part.disks] == [float(x) for x in expected]
    if disks % count == 0:
        assert {part.disk_positions for part in cut.sections} == {()}


def test_a_disk_on_a_border_belongs_to_the_part_that_ends_there() -> None:
    positions = (0.0, 0.1 + 0.2, 0.6, 0.6000001, 1.0)  # 0.1 + 0.2 is a little more than 0.3
    section = dataclasses.replace(SECTION, num_disks=0, disk_positions=positions)
    cut = cdcr.Robot(sections=[section]).subdivide(10)
    at = {i: part.disk_positions for i, part in enumerate(cut.sections) if part.num_disks}
    assert at == {
        0: (0.0,),
        2: (),  # one disk at the end: equally spaced
        5: (),
        6: (pytest.approx(1e-6, rel=1e-8),),
        9: (),
    }
    assert places(cut) == pytest.approx(places(cdcr.Robot(sections=[section])), rel=REL)


def test_one_part_is_the_same_robot() -> None:
    robot = cdcr.Robot(sections=[SECTION, SECTION], cables=[CABLE])
    assert robot.subdivide(1) == robot
    assert robot.subdivide([1, 1]) == robot
    q = [0.1, 0.2, 0.3, 0.4]
    np.testing.assert_array_equal(cdcr.subdivide_state(robot, 1, q), q)
    np.testing.assert_array_equal(cdcr.merge_state(robot, 1, q), q)


def test_subdividing_twice_is_subdividing_once() -> None:
    robot = cdcr.Robot(sections=[SECTION], cables=[CABLE])
    twice, once = robot.subdivide(2).subdivide(4), robot.subdivide(8)
    assert twice == once  # powers of two: nothing is rounded
    assert len(once.sections) == 8


def test_parts_of_any_kind() -> None:
    robot = cdcr.Robot(sections=[SECTION, SECTION])
    wanted = robot.subdivide([2, 2])
    assert robot.subdivide(2) == robot.subdivide(np.int64(2)) == wanted
    assert robot.subdivide(np.array([2, 2])) == robot.subdivide((2, 2)) == wanted


def test_states_of_any_shape() -> None:
    robot = cdcr.Robot(sections=[SECTION, SECTION])
    q = np.arange(24.0).reshape(2, 3, 4)
    state = cdcr.subdivide_state(robot, [2, 1], q)
    assert state.shape == (2, 3, 6)
    np.testing.assert_array_equal(state[1, 2], [10.0, 10.5, 10.0, 10.5, 22.0, 23.0])
    np.testing.assert_array_equal(cdcr.merge_state(robot, [2, 1], state), q)
    assert cdcr.merge_state(robot, [2, 1], np.zeros((0, 6))).shape == (0, 4)


@pytest.mark.parametrize(
    ("parts", "sentence"),
    [
        (0, "parts must be a whole number 1 to 32, or one for each of 2 sections, got 0 (int)"),
        (33, "parts must be a whole number 1 to 32, or one for each of 2 sections, got 33 (int)"),
        (
            2.0,
            "parts must be a whole number 1 to 32, or one for each of 2 sections, got 2.0 (float)",
        ),
        (
            True,
            "parts must be a whole number 1 to 32, or one for each of 2 sections, got True (bool)",
        ),
        ("2", "parts must be a whole number 1 to 32, or one for each of 2 sections, got '2' (str)"),
        (
            [2],
            "parts must be a whole number 1 to 32, or one for each of 2 sections, got [2] (list)",
        ),
        ([2, 1.5], "parts[1] must be a whole number 1 to 32, got 1.5 (float)"),
        (17, "parts must give a robot of at most 32 sections, got 17 + 17 = 34"),
        ([32, 1], "parts must give a robot of at most 32 sections, got 32 + 1 = 33"),
    ],
)
def test_refusals_of_parts(parts: Any, sentence: str) -> None:
    robot = cdcr.Robot(sections=[SECTION, SECTION])
    for call in (
        lambda: robot.subdivide(parts),
        lambda: cdcr.subdivide_state(robot, parts, np.zeros(4)),
        lambda: cdcr.merge_state(robot, parts, np.zeros(4)),
    ):
        with pytest.raises(ValueError) as caught:  # noqa: PT011 - the text is what counts
            call()
        assert str(caught.value) == sentence


def test_refusals_of_states() -> None:
    robot = cdcr.Robot(sections=[SECTION])
    with pytest.raises(ValueError, match=r"^q must have shape \(\.\.\., 2\), got \(4,\)$"):
        cdcr.subdivide_state(robot, 2, np.zeros(4))
    with pytest.raises(ValueError, match=r"^q must have shape \(\.\.\., 4\), got \(3, 2\)$"):
        cdcr.merge_state(robot, 2, np.zeros((3, 2)))
    with pytest.raises(ValueError, match=r"^q\[0\] must be finite, got "):
        cdcr.merge_state(robot, 1, [math.nan, 0.0])
    model: Any = cdcr.Model(robot)
    with pytest.raises(TypeError, match=r"^robot must be a cdcr\.Robot, got Model$"):
        cdcr.subdivide_state(model, 1, np.zeros(2))
