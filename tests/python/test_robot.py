"""Descriptions of robots: what they accept, keep and refuse, and what follows from them."""

import array
import copy
import dataclasses
import math
import pickle
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr import _core
from description import refusal

# Products of five factors, each rounded once.
REL = 4e-15

REQUIRED: dict[str, Any] = {
    "length": 0.8,
    "backbone_mass": 0.03,
    "backbone_diameter": 0.005,
    "youngs_modulus": 9.5e9,
}
RODS: dict[str, Any] = {
    "bending_order": 0,
    "twist_order": None,
    "stretch_order": None,
    "backbone_inner_diameter": 0.0,
    "shear_modulus": None,
    "bending_stiffness": None,
    "twist_stiffness": None,
    "stretch_stiffness": None,
    "twist_damping": 0.0,
    "stretch_damping": 0.0,
    "material_damping": 0.0,
    "rest_bending": (0.0, 0.0),
    "rest_twist": 0.0,
    "nodes": None,
}
DRIVES: dict[str, Any] = {
    "cable_entry_friction": 0.0,
    "cable_sheath_friction": 0.0,
    "cable_viscosity": 0.0,
    "cable_pretension": 0.0,
    "cable_backlash": 0.0,
}
FULL: dict[str, Any] = REQUIRED | {
    "disk_mass": 0.008,
    "disk_diameter": 0.04,
    "num_disks": 10,
    "disk_positions": (),
    "disk_masses": (),
    "disk_diameters": (),
    "cable_radius": 0.019,
    "cable_angles": (0.0, 2.0, 4.0),
    "cable_stiffness": 1e4,
    "cable_damping": 2.0,
    "cable_friction": 0.1,
    "damping": 1e-3,
    **RODS,
    **DRIVES,
}
# But those whose range depends on another field, or that may be negative.
OTHER = ("backbone_inner_diameter", "rest_twist")
NUMBERS = [name for name in FULL if isinstance(FULL[name], float) and name not in OTHER]


def test_defaults() -> None:
    section = cdcr.Section(**REQUIRED)
    assert dataclasses.asdict(section) == RODS | DRIVES | REQUIRED | {
        "disk_mass": 0.0,
        "disk_diameter": 0.0,
        "num_disks": 0,
        "disk_positions": (),
        "disk_masses": (),
        "disk_diameters": (),
        "cable_radius": 0.0,
        "cable_angles": (),
        "cable_stiffness": 0.0,
        "cable_damping": 0.0,
        "cable_friction": 0.0,
        "damping": 0.0,
    }
    robot = cdcr.Robot(sections=[section])
    assert (robot.gravity, robot.payload) == ((0.0, 0.0, 0.0), 0.0)
    assert (robot.cables, robot.sliding_speed) == ((), 1e-3)
    assert robot.base_orientation == ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    assert robot.payload_position == (0.0, 0.0, 0.0)
    assert robot.payload_inertia == ((0.0, 0.0, 0.0),) * 3


@pytest.mark.parametrize(
    "angles",
    [[0, 2, 4], (0.0, 2.0, 4.0), range(0, 6, 2), np.array([0, 2, 4]), array.array("d", [0, 2, 4])],
    ids=["list", "tuple", "range", "numpy", "array"],
)
def test_any_sequence_of_angles(angles: Any) -> None:
    section = cdcr.Section(**FULL | {"cable_angles": angles})
    assert section.cable_angles == (0.0, 2.0, 4.0)
    assert all(type(angle) is float for angle in section.cable_angles)


@pytest.mark.parametrize("one", [1, np.float64(1), np.float32(1), np.int8(1), Fraction(1)])
def test_any_real_number_becomes_a_float(one: Any) -> None:
    section = cdcr.Section(**FULL | dict.fromkeys(NUMBERS, one))
    values = [getattr(section, name) for name in NUMBERS]
    assert values == [1.0] * len(NUMBERS)
    assert {type(value) for value in values} == {float}


@pytest.mark.parametrize("count", [7, np.int64(7), np.uint8(7)])
def test_any_whole_number_becomes_an_int(count: Any) -> None:
    section = cdcr.Section(**FULL | {"num_disks": count})
    assert section.num_disks == 7
    assert type(section.num_disks) is int


def test_sections_and_gravity_become_tuples() -> None:
    section = cdcr.Section(**FULL)
    robot = cdcr.Robot(sections=[section], gravity=np.array([0, 0, -9.81]), payload=1)
    assert robot.sections == (section,)
    assert robot.gravity == (0.0, 0.0, -9.81)
    assert [type(x) for x in (*robot.gravity, robot.payload)] == [float] * 4


def test_equality_hash_and_copies() -> None:
    one = cdcr.Robot(sections=[cdcr.Section(**FULL)], gravity=[0, 0, -9.81])
    same = cdcr.Robot(sections=(cdcr.Section(**FULL),), gravity=(0.0, 0.0, -9.81))
    nearly = dataclasses.replace(one, payload=math.ulp(0.0))
    assert one == same
    assert hash(one) == hash(same)
    assert one != nearly
    assert {one, same, nearly} == {one, nearly}
    for copied in (pickle.loads(pickle.dumps(one)), copy.deepcopy(one)):
        assert copied == one
        assert hash(copied) == hash(one)


def test_repr_is_what_one_would_type() -> None:
    robot = cdcr.robots.amouri2020(gravity=(0, 0, -9.81), payload=0.1)
    text = repr(robot)
    assert text.startswith("Robot(sections=(Section(length=0.802, backbone_mass=0.0326,")
    assert eval(text, {"Robot": cdcr.Robot, "Section": cdcr.Section}) == robot


def test_nothing_can_be_changed() -> None:
    robot = cdcr.robots.amouri2020()
    with pytest.raises(dataclasses.FrozenInstanceError):
        robot.payload = 1.0  # type: ignore[misc]
    with pytest.raises(dataclasses.FrozenInstanceError):
        robot.sections[0].length = 1.0  # type: ignore[misc]


def test_replace_checks_again() -> None:
    section = cdcr.Section(**FULL)
    assert dataclasses.replace(section, length=1).length == 1.0
    with pytest.raises(ValueError, match="length must be > 0 m and finite, got -1"):
        dataclasses.replace(section, length=-1)


@pytest.mark.parametrize("name", NUMBERS)
@pytest.mark.parametrize(
    ("value", "shown"),
    [
        ("long", "'long' (str)"),
        (True, "True (bool)"),
        (None, "None (NoneType)"),
        (1j, "1j (complex)"),
        ([1.0], "[1.0] (list)"),
        (np.True_, f"{np.True_!r} ({np.bool_.__name__})"),
    ],
)
def test_what_is_no_number_is_refused(name: str, value: Any, shown: str) -> None:
    (sentence,) = refusal(cdcr.Section, **FULL | {name: value})
    wanted = {f.name: f.metadata["requirement"] for f in dataclasses.fields(cdcr.Section)}[name]
    assert sentence == f"{name} must be {wanted}, got {shown}"


def test_a_number_too_large_for_a_float_is_refused() -> None:
    (sentence,) = refusal(cdcr.Section, **FULL | {"length": 10**400})
    assert sentence.startswith("length must be a number > 0 m and finite, got 1000")
    assert sentence.endswith("(int)")


@pytest.mark.parametrize("name", NUMBERS)
def test_refusals_name_the_ranges_of_the_core(name: str) -> None:
    """The range for wrong types, said in Python, and the one for wrong values, said in C++."""
    wanted = {f.name: f.metadata["requirement"] for f in dataclasses.fields(cdcr.Section)}[name]
    for value in (math.nan, math.inf, -1.0):
        (sentence,) = refusal(cdcr.Section, **FULL | {name: value})
        allowed = wanted.removeprefix("a number ").removesuffix(", or one (base, tip) pair")
        assert sentence == f"{name} must be {allowed}, got {value:g}"


@pytest.mark.parametrize("value", [10.0, "10", True, 2**31, 10**30])
def test_number_of_disks_must_be_whole(value: Any) -> None:
    (sentence,) = refusal(cdcr.Section, **FULL | {"num_disks": value})
    assert sentence.startswith("num_disks must be a whole number 0 to 64, got ")


@pytest.mark.parametrize(
    "value", ["012", b"012", 1.0, {0.0: 1}, {0.0, 1.0}, np.zeros((2, 2)), np.float64(1), None]
)
def test_cable_angles_must_be_a_sequence(value: Any) -> None:
    (sentence,) = refusal(cdcr.Section, **FULL | {"cable_angles": value})
    assert sentence.startswith("cable_angles must be a sequence of 0 to 16 numbers in rad, got "), (
        sentence
    )
    assert sentence.endswith(f"({type(value).__name__})")


def test_each_bad_cable_angle_is_named() -> None:
    assert refusal(cdcr.Section, **FULL | {"cable_angles": [0.0, "x", 1.0, False]}) == [
        "cable_angles[1] must be a finite number of rad, got 'x' (str)",
        "cable_angles[3] must be a finite number of rad, got False (bool)",
    ]


def test_all_violations_are_told_at_once() -> None:
    assert refusal(cdcr.Section, **FULL | {"length": -1, "num_disks": 99, "damping": -2}) == [
        "length must be > 0 m and finite, got -1",
        "num_disks must be 0 to 64, got 99",
        "damping must be >= 0 N m s/rad and finite, got -2",
    ]
    assert len(refusal(cdcr.Section, **FULL | {"length": "a", "damping": "b"})) == 2


def test_long_values_are_shown_short() -> None:
    (sentence,) = refusal(cdcr.Section, **FULL | {"length": "x" * 10_000})
    assert len(sentence) < 120


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"payload": "1"}, "payload must be a number >= 0 kg and finite, got '1' (str)"),
        ({"gravity": (0, 0)}, "gravity must be three numbers in m/s^2, got (0, 0) (tuple)"),
        ({"gravity": -9.81}, "gravity must be three numbers in m/s^2, got -9.81 (float)"),
        ({"gravity": "down"}, "gravity must be three numbers in m/s^2, got 'down' (str)"),
        ({"gravity": (0, 0, "g")}, "gravity[2] must be a number in m/s^2, got 'g' (str)"),
        ({"sections": []}, "the number of sections must be 1 to 32, got 0"),
        ({"sections": [{}]}, "section 1 must be a cdcr.Section, got {} (dict)"),
        ({"sections": 1}, "sections must be a sequence of 1 to 32 cdcr.Section, got 1 (int)"),
    ],
)
def test_refusals_of_a_robot(fields: dict[str, Any], sentence: str) -> None:
    good = {"sections": [cdcr.Section(**FULL)]}
    assert refusal(cdcr.Robot, **good | fields) == [sentence]


def test_a_single_section_must_still_be_in_a_list() -> None:
    (sentence,) = refusal(cdcr.Robot, sections=cdcr.Section(**FULL))
    assert sentence.startswith("sections must be a sequence of 1 to 32 cdcr.Section, got Section(")


def test_stiffness_by_hand() -> None:
    section = cdcr.robots.amouri2020().sections[0]
    area_moment = math.pi * (0.005 / 2) ** 4 / 4
    assert section.second_moment_of_area == pytest.approx(area_moment, rel=REL)
    assert section.stiffness == pytest.approx(9.5e9 * area_moment / 0.802, rel=REL)
    # The figures of Table 1: E I in N m^2 and E I / l in N m/rad, as many digits as are printed.
    assert f"{section.youngs_modulus * section.second_moment_of_area:.6f}" == "0.291456"
    assert f"{section.stiffness:.6f}" == "0.363412"


def test_the_core_has_the_same_fields_and_stiffness() -> None:
    section = cdcr.Section(**FULL)
    assert section._to_core().stiffness == pytest.approx(section.stiffness, rel=REL)
    assert _core.Section(**FULL | RODS).violations() == []
    assert [item.name for item in dataclasses.fields(section)] == list(FULL | RODS)


def test_masses_and_counts() -> None:
    section = cdcr.Section(**FULL)
    assert section.mass == pytest.approx(0.03 + 10 * 0.008, rel=REL)
    robot = cdcr.Robot(sections=[section, cdcr.Section(**REQUIRED)], payload=0.5)
    assert robot.mass == pytest.approx(0.03 + 10 * 0.008 + 0.03 + 0.5, rel=REL)
    assert robot.length == pytest.approx(1.6, rel=REL)
    assert robot.num_cables == 3
