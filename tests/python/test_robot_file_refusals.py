"""What is wrong in a robot file is said in one sentence: file, key, value and what is allowed."""

import re
from pathlib import Path

import pytest

import cdcr
from cdcr.robot.schema import table_of
from description import without_lines
from robot_file import FILE, load, replaced

CABLE = "[[cables]]\nradius = 0.01\nangle = 0.5\nend_section = 1\n"


def refusal(folder: Path, text: str) -> list[str]:
    """The sentences, without the file's name each must begin with."""
    with pytest.raises(ValueError, match=r"robot\.toml") as caught:
        load(folder, text)
    where = f"{folder / 'robot.toml'}: "
    lines = without_lines(caught.value, folder / "robot.toml")
    assert all(line.startswith(where) for line in lines), lines
    return [line.removeprefix(where) for line in lines]


def test_angles_in_both_units_are_refused(tmp_path: Path) -> None:
    assert refusal(tmp_path, FILE + "cable_angles_deg = [0]\n") == [
        "section 1 must have cable_angles or cable_angles_deg, not both"
    ]


def test_an_unknown_key_is_named_with_the_nearest_and_all_known_ones(tmp_path: Path) -> None:
    known = ", ".join(table_of(cdcr.Section).model_fields)
    assert refusal(tmp_path, replaced("damping", "dampign")) == [
        f"section 1: dampign is not a known key. Did you mean 'damping'? Known keys: {known}"
    ]
    known = ", ".join(table_of(cdcr.Robot).model_fields)
    assert refusal(tmp_path, "colour = 1\n" + FILE) == [
        f"colour is not a known key. Known keys: {known}"
    ]
    known = ", ".join(table_of(cdcr.Cable).model_fields)
    assert refusal(tmp_path, FILE + CABLE + "raduis = 1\n") == [
        f"cable 1 of cables: raduis is not a known key. Did you mean 'radius'? Known keys: {known}"
    ]


def test_a_key_of_another_table_is_told_where_it_belongs(tmp_path: Path) -> None:
    (told,) = refusal(tmp_path, "cable_friction = 0.3\n" + FILE)
    assert told.startswith(
        "cable_friction is not a known key. It belongs into a table [[sections]]. "
    )
    (told,) = refusal(tmp_path, FILE + "gravity = [0, 0, -9.81]\n")
    home = "It belongs above the first [[sections]]. "
    assert told.startswith(f"section 1: gravity is not a known key. {home}")


def test_a_misspelt_required_key_is_unknown_and_missing(tmp_path: Path) -> None:
    missing, unknown = refusal(tmp_path, replaced("length", "lenght"))
    assert missing == "section 1: length is missing; it must be a number > 0 m and finite"
    assert unknown.startswith("section 1: lenght is not a known key. Did you mean 'length'?")


@pytest.mark.parametrize("name", ["length", "backbone_mass", "backbone_diameter", "youngs_modulus"])
def test_each_required_key_is_missed(tmp_path: Path, name: str) -> None:
    text = re.sub(rf"^{name} = .*\n", "", FILE, flags=re.MULTILINE)
    (sentence,) = refusal(tmp_path, text)
    assert sentence.startswith(f"section 1: {name} is missing; it must be a number >")


def test_sections_are_missed(tmp_path: Path) -> None:
    requirement = "one [[sections]] table for each section"
    assert refusal(tmp_path, "payload = 1.0\n") == [
        f"sections is missing; it must be {requirement}"
    ]
    assert refusal(tmp_path, "sections = 1\n") == [
        f"sections must be {requirement}, got 1 (integer)"
    ]
    assert refusal(tmp_path, "sections = [1]\n") == ["section 1 must be a table, got 1 (integer)"]
    assert refusal(tmp_path, "sections = []\n") == ["the number of sections must be 1 to 32, got 0"]


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        (
            "length = 0.8",
            "length = '0.8'",
            "section 1: length must be a number > 0 m and finite, got '0.8' (string)",
        ),
        (
            "length = 0.8",
            "length = true",
            "section 1: length must be a number > 0 m and finite, got true (boolean)",
        ),
        (
            "damping = 1e-3",
            "damping = [1e-3]",
            "section 1: damping must be a number >= 0 N m s/rad and finite, got [0.001] (array)",
        ),
        (
            "num_disks = 10",
            "num_disks = 10.0",
            "section 1: num_disks must be a whole number 0 to 64, got 10.0 (float)",
        ),
        (
            "num_disks = 10",
            "num_disks = 5000000000",
            "section 1: num_disks must be a whole number 0 to 64, got 5000000000 (integer)",
        ),
        (
            "cable_angles = [0.0, 2.0, 4.0]",
            "cable_angles = 2.0",
            "section 1: cable_angles must be an array of 0 to 16 numbers [rad], got 2.0 (float)",
        ),
        (
            "cable_angles = [0.0, 2.0, 4.0]",
            "cable_angles = [0.0, '2']",
            "section 1: cable_angles must be an array of 0 to 16 numbers [rad], "
            "got '2' (string) at cable_angles[1]",
        ),
        (
            "cable_angles = [0.0, 2.0, 4.0]",
            "cable_angles_deg = {a = 1}",
            "section 1: cable_angles_deg must be an array of 0 to 16 numbers [deg], "
            "got {'a': 1} (table)",
        ),
        (
            "gravity = [0, 0, -9.81]",
            "gravity = [0, -9.81]",
            "gravity must be an array of 3 numbers [m/s^2], got [0, -9.81] (array)",
        ),
        (
            "payload = 0.1",
            "base_orientation = [[1, 0, 0], [0, 1], [0, 0, 1]]",
            "base_orientation must be an array of 3 rows of 3 numbers, got [0, 1] (array) "
            "at base_orientation[1]",
        ),
        (
            "payload = 0.1",
            "tool = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1]]",
            "tool must be an array of 4 rows of 4 numbers, got [0, 0, 1] (array) at tool[2]",
        ),
        (
            "payload = 0.1",
            "payload_inertia = [1, 1, 1]",
            "payload_inertia must be an array of 3 rows of 3 numbers [kg m^2], got 1 (integer) "
            "at payload_inertia[0]",
        ),
        (
            "payload = 0.1",
            "payload_position = [0, 0]",
            "payload_position must be an array of 3 numbers [m], got [0, 0] (array)",
        ),
        (
            "payload = 0.1",
            "payload_position = [0, 0, 0.1]",
            "payload_position must be zero where the payload is zero, got [0, 0, 0.1]",
        ),
        (
            "payload = 0.1",
            "cables = [1]",
            "cable 1 of cables must be a table, got 1 (integer)",
        ),
        (
            "num_disks = 10",
            "num_disks = 10\ndisk_positions = [1.0]",
            "section 1: num_disks must be 0 or the number of disk_positions, 1, got 10",
        ),
        (
            "num_disks = 10",
            "disk_positions = [0.5, 'end']",
            "section 1: disk_positions must be an array of 0 to 64 numbers 0 to 1, "
            "got 'end' (string) at disk_positions[1]",
        ),
        (
            "payload = 0.1",
            "payload = 2020-01-01",
            "payload must be a number >= 0 kg and finite, got datetime.date(2020, 1, 1) (date)",
        ),
        ("length = 0.8", "length = -1", "section 1: length must be > 0 m and finite, got -1"),
        ("length = 0.8", "length = inf", "section 1: length must be > 0 m and finite, got inf"),
        ("num_disks = 10", "num_disks = 65", "section 1: num_disks must be 0 to 64, got 65"),
        ("payload = 0.1", "payload = nan", "payload must be >= 0 kg and finite, got nan"),
        (
            "cable_angles = [0.0, 2.0, 4.0]",
            f"cable_angles = {[0.0] * 17}",
            "section 1: the number of cable_angles must be 0 to 16, got 17",
        ),
        (
            "cable_radius = 0.019",
            "cable_radius = 0",
            "section 1: cable_radius must be > 0 m and finite, got 0",
        ),
    ],
)
def test_wrong_types_and_values(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    assert refusal(tmp_path, replaced(old, new)) == [sentence]


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        (
            "radius = 0.01\n",
            "",
            "cable 1 of cables: radius is missing; it must be a number [m], or one "
            "[base, tip] pair for "
            "each section passed",
        ),
        ("angle = 0.5\n", "", "cable 1 of cables must have angle [rad] or angle_deg [deg]"),
        (
            "angle = 0.5\n",
            "angle = 0.5\nangle_deg = 1\n",
            "cable 1 of cables must have angle or angle_deg, not both",
        ),
        (
            "angle = 0.5",
            "angle = nan",
            "cable 1 of cables: angle must be a finite number of rad, got nan",
        ),
        (
            "angle = 0.5",
            "angle_deg = '1'",
            "cable 1 of cables: angle_deg must be a number [deg], or one [base, tip] pair for "
            "each section passed, got '1' (string)",
        ),
        (
            "end_section = 1",
            "end_section = 2",
            "cable 1 of cables: end_section must be the number of a section, "
            "1 to 1, got 2 (integer)",
        ),
        (
            "end_section = 1",
            "end_section = 0",
            "cable 1 of cables: end_section must be the number of a section, "
            "from 1, got 0 (integer)",
        ),
        (
            "end_section = 1",
            "end_section = 1.0",
            "cable 1 of cables: end_section must be the number of a section, "
            "from 1, got 1.0 (float)",
        ),
    ],
)
def test_wrong_cables(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    assert old in CABLE
    assert refusal(tmp_path, FILE + CABLE.replace(old, new)) == [sentence]


def test_an_integer_beyond_every_float_is_refused(tmp_path: Path) -> None:
    (sentence,) = refusal(tmp_path, replaced("length = 0.8", f"length = 1{'0' * 400}"))
    assert sentence.startswith("section 1: length must be ")


def test_everything_wrong_is_told_at_once(tmp_path: Path) -> None:
    second = FILE[FILE.index("[[sections]]") :].replace("damping", "dampign")
    sentences = refusal(tmp_path, replaced("length = 0.8", "length = 'x'") + second)
    assert [sentence.partition(" must")[0].partition(" is")[0] for sentence in sentences] == [
        "section 1: length",
        "section 2: dampign",
    ]
    values = replaced("length = 0.8", "length = -1").replace("payload = 0.1", "payload = -1")
    assert [
        sentence.partition(" must")[0].partition(" is")[0] for sentence in refusal(tmp_path, values)
    ] == [
        "section 1: length",
        "payload",
    ]
