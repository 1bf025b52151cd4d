"""Robot files: they come back exactly, and what is wrong in them is said in one sentence."""

import dataclasses
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import cdcr
from cdcr.robot.file import robot_text
from cdcr.robot.schema import table_of
from robot_file import FILE, load, replaced

not_negative = st.floats(min_value=0.0, allow_infinity=False)
positive = st.floats(min_value=0.0, exclude_min=True, allow_infinity=False)
finite = st.floats(allow_nan=False, allow_infinity=False)
fractions = st.floats(0.0, 1.0)


@st.composite
def sections(draw: st.DrawFn) -> cdcr.Section:
    """Any section; disks equally spaced or not, alike or not."""
    positions = draw(st.lists(fractions, max_size=8))
    count = len(positions) or draw(st.integers(0, 64))
    one_each = st.lists(not_negative, min_size=count, max_size=count)
    return cdcr.Section(
        length=draw(positive),
        backbone_mass=draw(not_negative),
        backbone_diameter=draw(positive),
        youngs_modulus=draw(positive),
        disk_mass=draw(not_negative),
        disk_diameter=draw(not_negative),
        num_disks=count,
        disk_positions=positions,
        disk_masses=draw(one_each) if draw(st.booleans()) else (),
        disk_diameters=draw(one_each) if draw(st.booleans()) else (),
        cable_radius=draw(positive),
        cable_angles=draw(st.lists(finite, max_size=16)),
        cable_stiffness=draw(not_negative),
        cable_damping=draw(not_negative),
        cable_friction=draw(not_negative),
        damping=draw(not_negative),
    )


def rotation(quaternion: tuple[int, int, int, int]) -> NDArray[np.float64]:
    w, *v = np.array(quaternion) / np.linalg.norm(quaternion)
    x, y, z = v
    hat = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.array(np.eye(3) + 2 * w * hat + 2 * hat @ hat)


whole = st.integers(-9, 9)
at = st.tuples(finite, finite, finite)
rotations = st.tuples(whole, whole, whole, whole).filter(any).map(rotation)


@st.composite
def robots(draw: st.DrawFn) -> cdcr.Robot:
    several = draw(st.lists(sections(), min_size=1, max_size=3))
    cable = st.builds(
        cdcr.Cable,
        radius=positive,
        angle=finite,
        end_section=st.integers(0, len(several) - 1),
        stiffness=not_negative,
        damping=not_negative,
        friction=st.none() | not_negative,
    )
    body: dict[str, Any] = {}
    if draw(st.booleans()):  # one of points on the axes, turned: any moments they have are sound
        x, y, z = draw(st.tuples(*[st.floats(0.0, 1e6)] * 3))
        turn = draw(rotations)
        inertia = turn @ np.diag([y + z, z + x, x + y]) @ turn.T
        body = {
            "payload": draw(positive),
            "payload_position": draw(at),
            "payload_inertia": inertia,
        }
    return cdcr.Robot(
        sections=several,
        gravity=draw(at),
        cables=draw(st.lists(cable, max_size=3)),
        base_orientation=draw(rotations),
        base_position=draw(at),
        tool=np.vstack([np.column_stack([draw(rotations), draw(at)]), [0.0, 0.0, 0.0, 1.0]]),
        sliding_speed=draw(positive),
        **body,
    )


FULL = cdcr.Robot(
    sections=[
        cdcr.Section(
            length=0.8,
            backbone_mass=0.03,
            backbone_diameter=0.005,
            youngs_modulus=9.5e9,
            disk_positions=[0.5],
            disk_masses=[0.01],
            disk_diameters=[0.04],
            cable_radius=0.019,
            cable_angles=[1.0],
            cable_stiffness=1e4,
            cable_damping=1.0,
            cable_friction=0.1,
            cable_entry_friction=0.5,
            cable_sheath_friction=0.05,
            cable_viscosity=0.3,
            cable_pretension=2.0,
            cable_backlash=1e-4,
        )
    ],
    payload=0.1,
    cables=[
        cdcr.Cable(
            radius=0.01,
            angle=0.5,
            end_section=0,
            stiffness=1e4,
            damping=1,
            friction=0.2,
            entry_friction=0.1,
            sheath_friction=0.2,
            viscosity=0.3,
            pretension=0.4,
            backlash=0.5e-3,
        )
    ],
    presliding_stiffness=1e4,
    base_orientation=[[0, 0, 1], [1, 0, 0], [0, 1, 0]],
    payload_position=[0, 0, 0.02],
    payload_inertia=[[2e-5, 0, 0], [0, 2e-5, 0], [0, 0, 3e-5]],
    sliding_speed=2e-3,
    base_position=[0.1, 0, 1],
    tool=np.array([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0.05], [0, 0, 0, 1]]),
)


def test_a_file_as_people_write_it(tmp_path: Path) -> None:
    assert load(tmp_path, FILE) == cdcr.Robot(
        sections=[
            cdcr.Section(
                length=0.8,
                backbone_mass=0.03,
                backbone_diameter=0.005,
                youngs_modulus=9.5e9,
                disk_mass=0.008,
                disk_diameter=0.04,
                num_disks=10,
                cable_radius=0.019,
                cable_angles=(0.0, 2.0, 4.0),
                damping=1e-3,
            )
        ],
        gravity=(0.0, 0.0, -9.81),
        payload=0.1,
    )


def test_what_may_be_left_out_has_the_defaults(tmp_path: Path) -> None:
    robot = load(
        tmp_path,
        "[[sections]]\nlength = 1\nbackbone_mass = 2\nbackbone_diameter = 0.3\n"
        "youngs_modulus = 4e9\n",
    )
    assert robot == cdcr.Robot(
        sections=[
            cdcr.Section(length=1, backbone_mass=2, backbone_diameter=0.3, youngs_modulus=4e9)
        ]
    )


@pytest.mark.filterwarnings("ignore:.*(full turn|softer|millimetres|material|mm/s)")
@given(robot=robots())
def test_round_trip_is_exact(robot: cdcr.Robot, tmp_path_factory: Any) -> None:
    path = tmp_path_factory.mktemp("robot") / "robot.toml"
    robot.save(path)
    loaded = cdcr.Robot.load(path)
    assert loaded == robot
    assert repr(loaded) == repr(robot)  # tells -0.0 from 0.0, which are equal


@pytest.mark.parametrize("largest", [5e-324, 1e-323, 1e-310, 1e-300])
def test_an_inertia_of_a_few_digits_comes_back(tmp_path: Path, largest: float) -> None:
    """The smallest numbers have so few digits that a turned body breaks its own triangle rule."""
    inertia = np.diag([0.0, 0.5 * largest, largest]) if largest < 1e-300 else np.eye(3) * largest
    robot = cdcr.Robot(sections=FULL.sections, payload=1.0, payload_inertia=inertia)
    robot.save(tmp_path / "robot.toml")
    assert cdcr.Robot.load(tmp_path / "robot.toml") == robot


def test_the_papers_robot_comes_back(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020(gravity=(0.1, 0.2, -9.81), payload=1 / 3, damping=1e-3)
    robot.save(tmp_path / "robot.toml")
    assert cdcr.Robot.load(tmp_path / "robot.toml") == robot
    assert cdcr.Robot.load(str(tmp_path / "robot.toml")) == robot


def test_the_text_names_every_field_with_its_unit() -> None:
    rod = dataclasses.replace(
        FULL.sections[0],
        bending_order=1,
        twist_order=0,
        stretch_order=0,
        backbone_inner_diameter=1e-4,
        shear_modulus=1e9,
        bending_stiffness=1.0,
        twist_stiffness=1.0,
        stretch_stiffness=1.0,
        twist_damping=1.0,
        stretch_damping=1.0,
        material_damping=1.0,
        rest_bending=(0.1, 0.0),
        rest_twist=0.1,
        nodes=8,
    )
    cable = cdcr.Cable(radius=0.01, angle=0.0, end_section=1, start_section=1)
    robot = dataclasses.replace(FULL, sections=(*FULL.sections, rod), cables=(*FULL.cables, cable))
    lines = robot_text(robot).splitlines()
    for kind in (cdcr.Section, cdcr.Robot, cdcr.Cable):
        for item in dataclasses.fields(kind):
            if item.name in ("sections", "cables"):
                assert f"[[{item.name}]]" in lines
                continue
            if item.name == "num_disks":  # told by the positions
                continue
            about, unit = item.metadata["about"], item.metadata["unit"]
            comment = f"  # {about} [{unit}]" if unit else f"  # {about}"
            assert any(
                line.startswith(f"{item.name} = ") and line.endswith(comment) for line in lines
            ), item.name


def test_the_text_of_a_plain_robot_has_the_plain_fields_alone() -> None:
    lines = robot_text(cdcr.robots.amouri2020()).splitlines()
    keys = [line.split(" = ")[0] for line in lines if " = " in line]
    assert keys == [
        "gravity",
        "payload",
        "length",
        "backbone_mass",
        "backbone_diameter",
        "youngs_modulus",
        "disk_mass",
        "disk_diameter",
        "num_disks",
        "cable_radius",
        "cable_angles",
        "damping",
    ]


def test_the_schema_has_the_fields_of_the_descriptions() -> None:
    section = {item.name for item in dataclasses.fields(cdcr.Section)}
    assert set(table_of(cdcr.Section).model_fields) == section | {
        "cable_angles_deg",
        "rest_bending_deg",
        "rest_twist_deg",
    }
    cable = {item.name for item in dataclasses.fields(cdcr.Cable)}
    assert set(table_of(cdcr.Cable).model_fields) == cable | {"angle_deg"}
    assert set(table_of(cdcr.Robot).model_fields) == {
        item.name for item in dataclasses.fields(cdcr.Robot)
    }


def test_angles_in_degrees(tmp_path: Path) -> None:
    robot = load(
        tmp_path, replaced("cable_angles = [0.0, 2.0, 4.0]", "cable_angles_deg = [0, 120]")
    )
    assert robot.sections[0].cable_angles == (0.0, math.radians(120.0))


def test_cables_as_people_write_them(tmp_path: Path) -> None:
    text = (
        "base_orientation = [[1, 0, 0], [0, -1, 0], [0, 0, -1]]\n" + FILE + "[[cables]]\n"
        "radius = 0.01\nangle_deg = 90\nend_section = 1\n[[cables]]\n"
        "radius = 0.02\nangle = 1\nend_section = 1\nstiffness = 5000\n"
    )
    robot = load(tmp_path, text)
    assert robot.base_orientation == ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0))
    assert robot.cables == (
        cdcr.Cable(radius=0.01, angle=math.radians(90), end_section=0),
        cdcr.Cable(radius=0.02, angle=1, end_section=0, stiffness=5000),
    )


@pytest.mark.parametrize(
    "robot",
    [FULL, cdcr.robots.three_sections().subdivide([3, 2, 7])],
    ids=["all fields", "subdivided"],
)
def test_robots_with_everything_come_back(robot: cdcr.Robot, tmp_path: Path) -> None:
    robot.save(tmp_path / "robot.toml")
    assert cdcr.Robot.load(tmp_path / "robot.toml") == robot


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("payload = \n", "line 1, column 11: "),
        ("\n\npayload == 1\n", "line 3, column 10: "),
        ("payload = 1\npayload = 2\n", "line 2, column 12: "),
        ('# robot\n\ntitle = """never closed\n\n', "line 3: "),
    ],
)
def test_broken_toml_is_refused_with_its_line(tmp_path: Path, text: str, place: str) -> None:
    path = tmp_path / "robot.toml"
    with pytest.raises(ValueError, match=r"robot\.toml") as caught:
        load(tmp_path, text)
    assert str(caught.value).startswith(f"{path}, {place}")
    assert "\n" not in str(caught.value)


def test_text_that_is_not_utf8_is_refused_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_bytes(b"# fine\npayload = 1 # \xe4\n")
    with pytest.raises(ValueError, match=re.escape(f"{path}, line 2: not UTF-8 text")):
        cdcr.Robot.load(path)
