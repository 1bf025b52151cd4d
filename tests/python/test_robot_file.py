"""Robot files: they come back exactly, and what is wrong in them is said in one sentence."""

import dataclasses
import math
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import cdcr
from cdcr._robot_file import robot_text
from cdcr._robot_schema import RobotTable, SectionTable

FILE = """\
gravity = [0, 0, -9.81]
payload = 0.1

[[sections]]
length = 0.8
backbone_mass = 0.03
backbone_diameter = 0.005
youngs_modulus = 9.5e9
disk_mass = 0.008
disk_diameter = 0.04
num_disks = 10
cable_radius = 0.019
cable_angles = [0.0, 2.0, 4.0]
damping = 1e-3
"""

not_negative = st.floats(min_value=0.0, allow_infinity=False)
positive = st.floats(min_value=0.0, exclude_min=True, allow_infinity=False)
finite = st.floats(allow_nan=False, allow_infinity=False)
sections = st.builds(
    cdcr.Section,
    length=positive,
    backbone_mass=not_negative,
    backbone_diameter=positive,
    youngs_modulus=positive,
    disk_mass=not_negative,
    disk_diameter=not_negative,
    num_disks=st.integers(0, 64),
    cable_radius=positive,
    cable_angles=st.lists(finite, max_size=16),
    damping=not_negative,
)
robots = st.builds(
    cdcr.Robot,
    sections=st.lists(sections, min_size=1, max_size=3),
    gravity=st.tuples(finite, finite, finite),
    payload=not_negative,
)


def load(folder: Path, text: str) -> cdcr.Robot:
    path = folder / "robot.toml"
    path.write_text(text, encoding="utf-8")
    return cdcr.Robot.load(path)


def refusal(folder: Path, text: str) -> list[str]:
    """The sentences, without the file's name each must begin with."""
    with pytest.raises(ValueError, match=r"robot\.toml") as caught:
        load(folder, text)
    where = f"{folder / 'robot.toml'}: "
    lines = str(caught.value).split("\n")
    assert all(line.startswith(where) for line in lines), lines
    return [line.removeprefix(where) for line in lines]


def replaced(old: str, new: str) -> str:
    assert old in FILE
    return FILE.replace(old, new)


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
        "[[sections]]\nlength = 1\nbackbone_mass = 2\nbackbone_diameter = 3\nyoungs_modulus = 4\n",
    )
    assert robot == cdcr.Robot(
        sections=[cdcr.Section(length=1, backbone_mass=2, backbone_diameter=3, youngs_modulus=4)]
    )


@given(robot=robots)
def test_round_trip_is_exact(robot: cdcr.Robot, tmp_path_factory: Any) -> None:
    path = tmp_path_factory.mktemp("robot") / "robot.toml"
    robot.save(path)
    loaded = cdcr.Robot.load(path)
    assert loaded == robot
    assert repr(loaded) == repr(robot)  # tells -0.0 from 0.0, which are equal


def test_the_papers_robot_comes_back(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020(gravity=(0.1, 0.2, -9.81), payload=1 / 3, damping=1e-3)
    robot.save(tmp_path / "robot.toml")
    assert cdcr.Robot.load(tmp_path / "robot.toml") == robot
    assert cdcr.Robot.load(str(tmp_path / "robot.toml")) == robot


def test_the_text_names_every_field_with_its_unit() -> None:
    lines = robot_text(cdcr.robots.amouri2020()).splitlines()
    for kind in (cdcr.Section, cdcr.Robot):
        for item in dataclasses.fields(kind):
            if item.name == "sections":
                assert "[[sections]]" in lines
                continue
            (line,) = (line for line in lines if line.startswith(f"{item.name} = "))
            assert item.metadata["about"] in line
            if item.metadata["unit"]:
                assert line.endswith(f"[{item.metadata['unit']}]")


def test_the_schema_has_the_fields_of_the_descriptions() -> None:
    section = {item.name for item in dataclasses.fields(cdcr.Section)}
    assert set(SectionTable.model_fields) == section | {"cable_angles_deg"}
    assert set(RobotTable.model_fields) == {item.name for item in dataclasses.fields(cdcr.Robot)}


def test_angles_in_degrees(tmp_path: Path) -> None:
    robot = load(
        tmp_path, replaced("cable_angles = [0.0, 2.0, 4.0]", "cable_angles_deg = [0, 120]")
    )
    assert robot.sections[0].cable_angles == (0.0, math.radians(120.0))


def test_angles_in_both_units_are_refused(tmp_path: Path) -> None:
    assert refusal(tmp_path, FILE + "cable_angles_deg = [0]\n") == [
        "sections[0] must have cable_angles or cable_angles_deg, not both"
    ]


def test_an_unknown_key_is_named_with_the_nearest_and_all_known_ones(tmp_path: Path) -> None:
    known = ", ".join(SectionTable.model_fields)
    assert refusal(tmp_path, replaced("damping", "dampign")) == [
        f"sections[0].dampign is not a known key. Did you mean 'damping'? Known keys: {known}"
    ]
    assert refusal(tmp_path, "colour = 1\n" + FILE) == [
        "colour is not a known key. Known keys: gravity, payload, sections"
    ]


def test_a_misspelt_required_key_is_unknown_and_missing(tmp_path: Path) -> None:
    missing, unknown = refusal(tmp_path, replaced("length", "lenght"))
    assert missing == "sections[0].length is missing; it must be a number > 0 m and finite"
    assert unknown.startswith("sections[0].lenght is not a known key. Did you mean 'length'?")


@pytest.mark.parametrize("name", ["length", "backbone_mass", "backbone_diameter", "youngs_modulus"])
def test_each_required_key_is_missed(tmp_path: Path, name: str) -> None:
    text = re.sub(rf"^{name} = .*\n", "", FILE, flags=re.MULTILINE)
    (sentence,) = refusal(tmp_path, text)
    assert sentence.startswith(f"sections[0].{name} is missing; it must be a number >")


def test_sections_are_missed(tmp_path: Path) -> None:
    wanted = "one [[sections]] table for each section"
    assert refusal(tmp_path, "payload = 1.0\n") == [f"sections is missing; it must be {wanted}"]
    assert refusal(tmp_path, "sections = 1\n") == [f"sections must be {wanted}, got 1 (integer)"]
    assert refusal(tmp_path, "sections = [1]\n") == [
        f"sections must be {wanted}, got 1 (integer) at sections[0]"
    ]
    assert refusal(tmp_path, "sections = []\n") == ["the number of sections must be 1 to 32, got 0"]


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        (
            "length = 0.8",
            "length = '0.8'",
            "sections[0].length must be a number > 0 m and finite, got '0.8' (string)",
        ),
        (
            "length = 0.8",
            "length = true",
            "sections[0].length must be a number > 0 m and finite, got true (boolean)",
        ),
        (
            "damping = 1e-3",
            "damping = [1e-3]",
            "sections[0].damping must be a number >= 0 N m s/rad and finite, got [0.001] (array)",
        ),
        (
            "num_disks = 10",
            "num_disks = 10.0",
            "sections[0].num_disks must be a whole number 0 to 64, got 10.0 (float)",
        ),
        (
            "num_disks = 10",
            "num_disks = 5000000000",
            "sections[0].num_disks must be a whole number 0 to 64, got 5000000000 (integer)",
        ),
        (
            "cable_angles = [0.0, 2.0, 4.0]",
            "cable_angles = 2.0",
            "sections[0].cable_angles must be an array of 0 to 16 numbers [rad], got 2.0 (float)",
        ),
        (
            "cable_angles = [0.0, 2.0, 4.0]",
            "cable_angles = [0.0, '2']",
            "sections[0].cable_angles must be an array of 0 to 16 numbers [rad], "
            "got '2' (string) at sections[0].cable_angles[1]",
        ),
        (
            "cable_angles = [0.0, 2.0, 4.0]",
            "cable_angles_deg = {a = 1}",
            "sections[0].cable_angles_deg must be an array of 0 to 16 numbers [deg], "
            "got {'a': 1} (table)",
        ),
        (
            "gravity = [0, 0, -9.81]",
            "gravity = [0, -9.81]",
            "gravity must be an array of 3 numbers [m/s^2], got [0, -9.81] (array)",
        ),
        (
            "payload = 0.1",
            "payload = 2020-01-01",
            "payload must be a number >= 0 kg and finite, got datetime.date(2020, 1, 1) (date)",
        ),
        ("length = 0.8", "length = -1", "sections[0].length must be > 0 m and finite, got -1"),
        ("length = 0.8", "length = inf", "sections[0].length must be > 0 m and finite, got inf"),
        ("num_disks = 10", "num_disks = 65", "sections[0].num_disks must be 0 to 64, got 65"),
        ("payload = 0.1", "payload = nan", "payload must be >= 0 kg and finite, got nan"),
        (
            "cable_angles = [0.0, 2.0, 4.0]",
            f"cable_angles = {[0.0] * 17}",
            "the number of sections[0].cable_angles must be 0 to 16, got 17",
        ),
        (
            "cable_radius = 0.019",
            "cable_radius = 0",
            "sections[0].cable_radius must be > 0 m and finite, got 0",
        ),
    ],
)
def test_wrong_types_and_values(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    assert refusal(tmp_path, replaced(old, new)) == [sentence]


def test_an_integer_beyond_every_float_is_refused(tmp_path: Path) -> None:
    (sentence,) = refusal(tmp_path, replaced("length = 0.8", f"length = 1{'0' * 400}"))
    assert sentence.startswith("sections[0].length must be ")


def test_everything_wrong_is_told_at_once(tmp_path: Path) -> None:
    second = FILE[FILE.index("[[sections]]") :].replace("damping", "dampign")
    sentences = refusal(tmp_path, replaced("length = 0.8", "length = 'x'") + second)
    assert [sentence.split()[0] for sentence in sentences] == [
        "sections[0].length",
        "sections[1].dampign",
    ]
    values = replaced("length = 0.8", "length = -1").replace("payload = 0.1", "payload = -1")
    assert [sentence.split()[0] for sentence in refusal(tmp_path, values)] == [
        "sections[0].length",
        "payload",
    ]


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


def test_a_missing_file_and_a_folder(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    with pytest.raises(FileNotFoundError, match=f"^there is no robot file {re.escape(str(path))}$"):
        cdcr.Robot.load(path)
    with pytest.raises(ValueError, match=r"is a folder, not a robot file$"):
        cdcr.Robot.load(tmp_path)


def test_nothing_is_overwritten_unasked(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("mine")
    robot = cdcr.robots.amouri2020()
    sentence = f"{path} exists already; pass overwrite=True to replace it"
    with pytest.raises(FileExistsError, match=re.escape(sentence)):
        robot.save(path)
    assert path.read_text() == "mine"
    robot.save(path, overwrite=True)
    assert cdcr.Robot.load(path) == robot


def test_a_missing_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=re.escape(str(tmp_path / "nowhere"))):
        cdcr.robots.amouri2020().save(tmp_path / "nowhere" / "robot.toml")


def test_an_interrupted_save_leaves_the_old_file_and_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("old")

    def interrupted(self: Path, target: Path) -> None:
        assert self.read_text().startswith("# A cable-driven")  # all written, not yet in place
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupted)
    with pytest.raises(KeyboardInterrupt):
        cdcr.robots.amouri2020().save(path, overwrite=True)
    assert os.listdir(tmp_path) == ["robot.toml"]  # noqa: PTH208 - hidden files count
    assert path.read_text() == "old"


def test_pydantic_is_loaded_only_to_read_a_file(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    code = (
        "import sys, cdcr\n"
        f"cdcr.robots.amouri2020().save({str(path)!r})\n"
        "assert 'pydantic' not in sys.modules\n"
        f"cdcr.Robot.load({str(path)!r})\n"
        "assert 'pydantic' in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
