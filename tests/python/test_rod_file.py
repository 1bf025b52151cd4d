"""Robot files of rods: every field comes back, and what cannot be has one sentence."""

from pathlib import Path
from typing import Any

import pytest

import cdcr
from description import refusal, without_lines
from robot_file import load

SECTION: dict[str, Any] = {
    "length": 0.3,
    "backbone_mass": 0.02,
    "backbone_diameter": 0.004,
    "youngs_modulus": 2e9,
}
ROD = cdcr.Section(
    **SECTION | {"backbone_diameter": (0.004, 0.003)},
    backbone_inner_diameter=0.001,
    bending_order=2,
    twist_order=0,
    stretch_order=1,
    shear_modulus=7e8,
    bending_stiffness=0.02,
    twist_stiffness=0.01,
    stretch_stiffness=900.0,
    twist_damping=1e-3,
    stretch_damping=0.5,
    material_damping=0.1,
    rest_bending=(0.1, -0.2),
    rest_twist=0.3,
    nodes=9,
)
LOCKED = cdcr.Section(**SECTION, bending_order=None)
CABLES = (
    cdcr.Cable(radius=[(0.01, 0.02), (0.02, 0.02)], angle=[(0, 1), (1, 7)], end_section=1),
    cdcr.Cable(radius=0.01, angle=1.0, start_section=1, end_section=1),
)
ROBOT = cdcr.Robot(sections=[ROD, LOCKED], cables=CABLES)
FILE = """\
[[sections]]
length = 0.3
backbone_mass = 0.02
backbone_diameter = 0.004
youngs_modulus = 2e9
cable_angles = []
"""
CABLE = "\n[[cables]]\nend_section = 1\n"


def test_every_field_comes_back(tmp_path: Path) -> None:
    ROBOT.save(tmp_path / "rod.toml")
    assert cdcr.Robot.load(tmp_path / "rod.toml") == ROBOT
    text = (tmp_path / "rod.toml").read_text()
    assert "bending_order = 'locked'" in text
    assert "start_section = 2 " in text
    assert text.count("twist_order") == 1  # the other is at its default


def test_angles_of_a_route_may_be_in_degrees(tmp_path: Path) -> None:
    cable = f"{CABLE}radius = 0.01\nangle_deg = [0, 180]\n"
    robot = load(tmp_path, f"{FILE}rest_bending_deg = [90, 0]\n{cable}")
    assert robot.cables[0].angle == ((0.0, pytest.approx(3.14159265)),)
    assert robot.sections[0].rest_bending == pytest.approx((1.57079633, 0.0))


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        (
            "bending_order = 5",
            'section 1: bending_order must be a whole number 0 to 4, or "locked"',
        ),
        (
            "stretch_order = -1",
            'section 1: stretch_order must be a whole number 0 to 4, or "locked"',
        ),
        ("twist_order = 0", "section 1: a section that twists must have a shear_modulus [Pa] or a"),
        ("backbone_inner_diameter = 0.004", "section 1: backbone_inner_diameter must be below the"),
        ("nodes = 2", "section 1: nodes must be 3 to 32, got 2"),
        ("rest_twist = 10.0", "section 1: rest_bending and rest_twist must be together at most 3"),
        ("rest_twist = 0\nrest_twist_deg = 0", "section 1 must have rest_twist or rest_twist_deg"),
        (
            f"{CABLE}radius = [0.01, -0.01]\nangle = 0",
            "cable 1 of cables: radius[0][1] must be > 0",
        ),
        (f"{CABLE}radius = 0.01\nangle = [0, 1, 2]", "cable 1 of cables: angle must be a number"),
        (f"{CABLE}radius = 0.01\nangle_deg = []", "cable 1 of cables: angle_deg must be a number"),
        (
            f"{CABLE}radius = []\nangle = 0",
            "cable 1 of cables: radius must be a number [m], or one",
        ),
        (f"{CABLE}radius = 0.01\nangle = 0\nstart_section = 2", "cable 1 of cables: start_section"),
    ],
)
def test_what_cannot_be_is_told(lines: str, sentence: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"robot\.toml") as caught:
        load(tmp_path, f"{FILE}{lines}\n")
    (found,) = without_lines(caught.value, tmp_path / "robot.toml")
    assert found.startswith(f"{tmp_path / 'robot.toml'}: {sentence}")


@pytest.mark.parametrize(
    ("fields", "sentence"),
    [
        ({"bending_order": -1}, "bending_order must be a whole number 0 to 4, or None to lock it"),
        ({"twist_order": 1.0}, "twist_order must be a whole number 0 to 4, or None to lock it"),
        (
            {"backbone_diameter": (0.1,)},
            "backbone_diameter must be a number > 0 m and finite, or one",
        ),
        ({"rest_bending": (0.1, 0.2, 0.3)}, "rest_bending must be two numbers of rad"),
    ],
)
def test_python_refuses_it_too(fields: dict[str, Any], sentence: str) -> None:
    (found,) = refusal(cdcr.Section, **SECTION | fields)
    assert found.startswith(sentence)


def test_a_repr_says_no_more_than_was_said() -> None:
    assert "order" not in repr(cdcr.Section(**SECTION))
    assert repr(CABLES[1]) == "Cable(radius=0.01, angle=1.0, end_section=1, start_section=1)"
    assert "bending_order=None" in repr(LOCKED)
