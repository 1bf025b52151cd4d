"""Disks anywhere, cables of their own, payloads with a body, and the way the base stands."""

import copy
import dataclasses
import math
import pickle
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.robot.section import Disk
from description import refusal

# Sums of a few products of numbers below 1, each rounded once.
ROUNDING = 4e-16

BACKBONE: dict[str, Any] = {
    "length": 0.8,
    "backbone_mass": 0.03,
    "backbone_diameter": 0.005,
    "youngs_modulus": 9.5e9,
}
SECTION = cdcr.Section(**BACKBONE, num_disks=4, cable_radius=0.02, cable_angles=[0, 2])
CABLE: dict[str, Any] = {
    "radius": 0.01,
    "angle": 0.5,
    "end_section": 0,
    "stiffness": 1e4,
    "damping": 2.0,
    "friction": 0.1,
    "start_section": 0,
}
TILTED = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
INERTIA = [[2e-5, 1e-6, 0], [1e-6, 2e-5, 0], [0, 0, 3e-5]]


# --- Disks ----------------------------------------------------------------------------------------


def test_equally_spaced_disks() -> None:
    section = cdcr.Section(**BACKBONE, num_disks=3, disk_mass=0.01, disk_diameter=0.04)
    assert section.disks == ((1 / 3, 0.01, 0.04), (2 / 3, 0.01, 0.04), (1.0, 0.01, 0.04))
    assert isinstance(section.disks[0], Disk)
    assert section.disks[0].position == 1 / 3


def test_disks_anywhere_in_any_order() -> None:
    section = cdcr.Section(**BACKBONE, disk_positions=np.array([1.0, 0.0, 0.3]), disk_mass=0.01)
    assert section.disk_positions == (1.0, 0.0, 0.3)
    assert section.num_disks == 3
    assert [disk.position for disk in section.disks] == [1.0, 0.0, 0.3]
    assert dataclasses.replace(section, num_disks=3) == section
    assert dataclasses.replace(section, num_disks=0) == section


@pytest.mark.parametrize("spacing", [{"num_disks": 2}, {"disk_positions": (0.5, 1.0)}])
def test_each_disk_may_have_its_own_mass_and_diameter(spacing: dict[str, Any]) -> None:
    section = cdcr.Section(
        **BACKBONE, **spacing, disk_mass=1.0, disk_masses=[0.01, 0.02], disk_diameters=[0.03, 0.04]
    )
    assert section.disks == ((0.5, 0.01, 0.03), (1.0, 0.02, 0.04))
    assert section.mass == pytest.approx(0.03 + 0.01 + 0.02, rel=ROUNDING)


def test_given_positions_mean_the_same_as_equal_spacing() -> None:
    equal = cdcr.Section(**BACKBONE, num_disks=4, disk_mass=0.01)
    given = cdcr.Section(**BACKBONE, disk_positions=(0.25, 0.5, 0.75, 1.0), disk_mass=0.01)
    one, other = (cdcr.Model(cdcr.Robot(sections=[s])) for s in (equal, given))
    np.testing.assert_array_equal(one.mass_matrix([0.5, 0.2]), other.mass_matrix([0.5, 0.2]))


@pytest.mark.parametrize(
    ("fields", "sentences"),
    [
        (
            {"disk_positions": (0.5, 1.5, math.nan)},
            [
                "disk_positions[1] must be 0 to 1, got 1.5",
                "disk_positions[2] must be 0 to 1, got nan",
            ],
        ),
        (
            {"disk_positions": 0.5},
            ["disk_positions must be a sequence of 0 to 64 numbers 0 to 1, got 0.5 (float)"],
        ),
        (
            {"num_disks": 1, "disk_masses": ["1"]},
            ["disk_masses[0] must be a number >= 0 kg and finite, got '1' (str)"],
        ),
        (
            {"num_disks": 1, "disk_diameters": {0.1}},
            ["disk_diameters must be a sequence of 0 to 64 numbers in m, got {0.1} (set)"],
        ),
    ],
)
def test_refusals_of_disks(fields: dict[str, Any], sentences: list[str]) -> None:
    assert refusal(cdcr.Section, **BACKBONE, **fields) == sentences


# --- Cables ---------------------------------------------------------------------------------------


def test_defaults_of_a_cable() -> None:
    cable = cdcr.Cable(radius=0.01, angle=0, end_section=np.int64(2))
    assert (cable.stiffness, cable.damping, cable.friction) == (0.0, 0.0, None)
    assert [type(x) for x in (cable.angle, cable.end_section)] == [float, int]
    assert not cable.length_driven
    assert dataclasses.replace(cable, stiffness=1).length_driven


def test_the_core_has_the_same_cable() -> None:
    for cable in (cdcr.Cable(**CABLE), cdcr.Cable(**CABLE | {"friction": None})):
        core = cable._to_core()
        names = [field.name for field in dataclasses.fields(cable)]
        assert {name: getattr(core, name) for name in names} == dataclasses.asdict(cable)


@pytest.mark.parametrize("name", CABLE)
def test_what_is_no_number_is_refused(name: str) -> None:
    (sentence,) = refusal(cdcr.Cable, **CABLE | {name: "1"})
    wanted = {f.name: f.metadata["requirement"] for f in dataclasses.fields(cdcr.Cable)}[name]
    assert sentence == f"{name} must be {wanted}, got '1' (str)"


@pytest.mark.parametrize(
    ("field", "sentence"),
    [
        ({"radius": 0}, "radius must be > 0 m and finite, got 0"),
        ({"end_section": 2}, "end_section must be 0 to 1, got 2"),
    ],
)
def test_a_robot_refuses_cables_that_do_not_fit_it(field: dict[str, Any], sentence: str) -> None:
    cables = [cdcr.Cable(**CABLE), cdcr.Cable(**CABLE | field)]
    assert refusal(cdcr.Robot, sections=[SECTION, SECTION], cables=cables) == [
        f"cable 2 of cables: {sentence}"
    ]


def test_all_cables_in_the_order_of_the_actuation_matrix() -> None:
    stiff = dataclasses.replace(SECTION, cable_stiffness=5.0, cable_damping=0.1, cable_friction=0.3)
    cable = cdcr.Cable(**CABLE)
    robot = cdcr.Robot(sections=[SECTION, stiff], cables=[cable])
    assert robot.all_cables == (
        cdcr.Cable(radius=0.02, angle=0.0, end_section=0),
        cdcr.Cable(radius=0.02, angle=2.0, end_section=0),
        cdcr.Cable(radius=0.02, angle=0.0, end_section=1, stiffness=5.0, damping=0.1),
        cdcr.Cable(radius=0.02, angle=2.0, end_section=1, stiffness=5.0, damping=0.1),
        cable,
    )
    model = cdcr.Model(robot)
    assert robot.num_cables == model.num_cables == 5
    arms = [
        [one.radius * (k <= one.end_section) * turn(one.angle) for one in robot.all_cables]
        for k in (0, 1)
        for turn in (math.cos, math.sin)
    ]
    np.testing.assert_allclose(model.actuation_matrix(), arms, rtol=ROUNDING, atol=0.0)


def test_a_robot_may_have_many_cables() -> None:
    robot = cdcr.Robot(sections=[SECTION], cables=[cdcr.Cable(**CABLE)] * 64)
    assert cdcr.Model(robot).num_cables == 66


# --- Robot ----------------------------------------------------------------------------------------


def full_robot() -> cdcr.Robot:
    return cdcr.Robot(
        sections=[SECTION],
        payload=0.1,
        cables=[cdcr.Cable(**CABLE)],
        base_orientation=np.array(TILTED),
        payload_position=[0, 0, 0.02],
        payload_inertia=INERTIA,
        sliding_speed=1,
    )


@pytest.mark.parametrize("kind", [list, tuple, np.array, np.float32])
def test_matrices_of_any_kind_become_rows(kind: Any) -> None:
    robot = cdcr.Robot(sections=[SECTION], base_orientation=kind(TILTED))
    assert robot.base_orientation == ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    assert {type(x) for row in robot.base_orientation for x in row} == {float}


def test_equality_hash_copies_and_repr() -> None:
    robot = full_robot()
    assert hash(robot) == hash(full_robot())
    names = {"Robot": cdcr.Robot, "Section": cdcr.Section, "Cable": cdcr.Cable}
    for same in (
        full_robot(),
        pickle.loads(pickle.dumps(robot)),
        copy.deepcopy(robot),
        dataclasses.replace(robot),
        eval(repr(robot), names),
    ):
        assert same == robot
    assert dataclasses.replace(robot, sliding_speed=2) != robot
    assert pickle.loads(pickle.dumps(cdcr.Model(robot))).robot == robot


def test_the_base_turns_the_whole_robot() -> None:
    upright = cdcr.Model(cdcr.Robot(sections=[SECTION]))
    tilted = cdcr.Model(cdcr.Robot(sections=[SECTION], base_orientation=TILTED))
    R, p = upright.tip([0.5, 0.3])
    turned_R, turned_p = tilted.tip([0.5, 0.3])
    np.testing.assert_array_equal(turned_R, np.array(TILTED) @ R)
    np.testing.assert_array_equal(turned_p, np.array(TILTED) @ p)


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        (
            {"base_orientation": [[1, 0, 0], [0, 1, 0], [0, 0, -1]]},
            "base_orientation must be a right-handed rotation matrix, to 1e-5, "
            "got [[1, 0, 0], [0, 1, 0], [0, 0, -1]]",
        ),
        (
            {"base_orientation": 1.0},
            "base_orientation must be three rows of three numbers, got 1.0 (float)",
        ),
        (
            {"base_orientation": np.eye(2)[:1]},
            "base_orientation[0] must be three numbers, got array([1., 0.]) (ndarray)",
        ),
        (
            {"base_orientation": [[1, 0, 0]]},
            "base_orientation must be three rows of three numbers, got [[1, 0, 0]] (list)",
        ),
        (
            {"base_orientation": [[1, 0, 0], [0, "1", 0], [0, 0, 1]]},
            "base_orientation[1][1] must be a number, got '1' (str)",
        ),
        (
            {"payload": 1, "payload_position": [0, 0]},
            "payload_position must be three numbers in m, got [0, 0] (list)",
        ),
        (
            {"payload_inertia": np.eye(3)},
            "payload_inertia must be zero where the payload is zero, "
            "got [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
        ),
        (
            {"base_position": [0, 0]},
            "base_position must be three numbers in m, got [0, 0] (list)",
        ),
        (
            {"tool": 0.1},
            "tool must be four rows of four numbers, got 0.1 (float)",
        ),
        (
            {"tool": np.eye(3)[:1]},
            "tool[0] must be four numbers, got array([1., 0., 0.]) (ndarray)",
        ),
        (
            {"tool": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]},
            "tool must be a frame: a right-handed rotation matrix, to 1e-5, with a position "
            "beside it and 0, 0, 0, 1 below, "
            "got [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]",
        ),
        ({"cables": [1]}, "cable 1 of cables must be a cdcr.Cable, got 1 (int)"),
        ({"cables": None}, "cables must be a sequence of 0 to 64 cdcr.Cable, got None (NoneType)"),
    ],
)
def test_refusals_of_a_robot(fields: dict[str, Any], sentence: str) -> None:
    assert refusal(cdcr.Robot, sections=[SECTION], **fields) == [sentence]


def test_the_paper_has_none_of_this() -> None:
    for robot, name in (
        (full_robot(), "cables"),
        (cdcr.Robot(sections=[dataclasses.replace(SECTION, cable_friction=1)]), "cable_friction"),
    ):
        with pytest.raises(ValueError, match=f"^the paper's equations have no {name}, got "):
            cdcr.paper.inertia(0.5, robot)
