"""The robots that come with the package, against their sources."""

import dataclasses
import math

import numpy as np
import pytest

import cdcr

# Products of five factors, each rounded once.
REL = 4e-15


# What a section of an arc leaves unsaid.
SAID = {"disk_positions", "disk_masses", "disk_diameters"} | {
    f"cable_{name}" for name in ("stiffness", "damping", "friction")
}
UNSAID = {
    item.name: item.default
    for item in dataclasses.fields(cdcr.Section)
    if item.metadata["advanced"] and item.name not in SAID
}


def test_table_1() -> None:
    robot = cdcr.robots.amouri2020()
    assert dataclasses.asdict(robot) == {
        "sections": (
            {
                "length": 0.802,
                "backbone_mass": 0.0326,
                "backbone_diameter": 0.005,
                "youngs_modulus": 9.5e9,
                "disk_mass": 0.0082,
                "disk_diameter": 0.04,
                "num_disks": 10,
                "disk_positions": (),
                "disk_masses": (),
                "disk_diameters": (),
                "cable_radius": 0.019,
                "cable_angles": (0.0, 2 * math.pi / 3, 4 * math.pi / 3),
                "cable_stiffness": 0.0,
                "cable_damping": 0.0,
                "cable_friction": 0.0,
                "damping": 0.0,
                **UNSAID,
            },
        ),
        "gravity": (0.0, 0.0, 0.0),
        "payload": 0.0,
        "cables": (),
        "base_orientation": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
        "base_position": (0.0, 0.0, 0.0),
        "payload_position": (0.0, 0.0, 0.0),
        "payload_inertia": ((0.0, 0.0, 0.0),) * 3,
        "sliding_speed": 1e-3,
        "tool": tuple(tuple(row) for row in np.eye(4).tolist()),
        "presliding_stiffness": 0.0,
    }


def test_options_of_the_papers_robot() -> None:
    robot = cdcr.robots.amouri2020(gravity=[0, 0, -9.81], payload=0.2, damping=1e-3)
    assert robot.gravity == (0.0, 0.0, -9.81)
    assert robot.payload == 0.2
    assert robot.sections[0].damping == 1e-3


def test_two_sections_of_rao_2021() -> None:
    robot = cdcr.robots.rao2021()
    assert [section.length for section in robot.sections] == [0.2, 0.2]
    assert robot.mass == 0.0
    assert robot.num_cables == 6
    # E I / l of a 1.4 mm wire of 54 GPa, and the turn of one pull of 4 N at 10 mm.
    stiffness = 54e9 * math.pi * 0.7e-3**4 / 4 / 0.2
    q = cdcr.Model(robot).actuation_matrix() @ [4.0, 0, 0, 0, 0, 0] / robot.sections[0].stiffness
    np.testing.assert_allclose(q, [0.04 / stiffness, 0.0, 0.0, 0.0], rtol=REL, atol=0.0)


def test_three_sections_by_hand() -> None:
    robot = cdcr.robots.three_sections(gravity=[0, 0, -9.81], payload=0.01, damping=2e-3)
    assert robot.gravity == (0.0, 0.0, -9.81)
    assert {section.damping for section in robot.sections} == {2e-3}
    assert [section.num_disks for section in robot.sections] == [6, 5, 4]
    wire = 6450 * math.pi * 0.001**2 * 0.75
    disks = 15 * 1040 * math.pi * 0.018**2 * 0.002
    assert robot.mass == pytest.approx(wire + disks + 0.01, rel=REL)
    turned = sorted(math.degrees(cable.angle) for cable in robot.all_cables)
    np.testing.assert_allclose(turned, np.arange(9) * 40.0, rtol=REL)


def test_robots_by_name() -> None:
    assert cdcr.robots.names() == ("amouri2020", "rao2021", "three_sections")
    for name in cdcr.robots.names():
        assert cdcr.robots.get(name) == getattr(cdcr.robots, name)()
    known = "amouri2020, rao2021, three_sections"
    with pytest.raises(ValueError, match=rf"^there is no robot 'x'\. Known: {known}$"):
        cdcr.robots.get("x")
    with pytest.raises(ValueError, match=r"Did you mean 'amouri2020'\?"):
        cdcr.robots.get("amouri")


def test_every_robot_says_where_it_comes_from() -> None:
    for name in cdcr.robots.names():
        doc = getattr(cdcr.robots, name).__doc__
        assert ("doi 10." in doc) != ("example design of this project" in doc), name
