"""Tensions over time in a scenario file: in place, or in a CSV file beside it."""

import re
from pathlib import Path

import numpy as np
import pytest

import cdcr
from cdcr.scenarios import Scenario
from cdcr.scenarios.file.reader import load_scenario
from description import without_lines

HEAD = 'robot = "amouri2020"\nt_end = 0.5\n[tension]\n'
ROWS = "t = [0, 1]\nrows = [[0, 0, 0], [1, 2, 3]]\n"
CSV = "file = 'tension.csv'\n"


def load(folder: Path, tension: str) -> Scenario:
    path = folder / "pull.toml"
    path.write_text(HEAD + tension, encoding="utf-8")
    return load_scenario(path)


def refusal(folder: Path, tension: str, where: str) -> str:
    """The only sentence, without the place it must begin with."""
    with pytest.raises(ValueError, match=re.escape(where.split(",")[0])) as caught:
        load(folder, tension)
    start = f"{folder / where}: "
    if where.startswith("tension.csv"):
        start = f"{folder / 'pull.toml'}, tension.file: {start}"
    (sentence,) = without_lines(caught.value, folder / "pull.toml")
    assert sentence.startswith(start)
    return sentence.removeprefix(start)


@pytest.mark.parametrize("interpolation", ["linear", "previous"])
def test_tensions_over_time_in_the_file(tmp_path: Path, interpolation: str) -> None:
    text = ROWS + f'interpolation = "{interpolation}"\n'
    run = load(tmp_path, text).simulate(t_end=1.0, num_samples=5)
    fraction = run.t if interpolation == "linear" else np.floor(run.t)
    np.testing.assert_allclose(run.tension, np.outer(fraction, [1.0, 2.0, 3.0]), rtol=1e-15)


def test_tensions_over_time_in_a_csv_file(tmp_path: Path) -> None:
    (tmp_path / "tension.csv").write_text("t, cable 1,cable 2,cable 3\n0,0,0,0\n\n1,1.0,2e0, 3\n")
    from_csv = load(tmp_path, CSV)
    in_place = load(tmp_path, ROWS)
    np.testing.assert_array_equal(from_csv.simulate().q, in_place.simulate().q)


def test_a_csv_file_as_a_table(tmp_path: Path) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    file = tmp_path / "tension.csv"
    file.write_text("cable 3,t,cable 1,cable 2\n3,0,1,2\n6,0.5,4,5\n")
    table = cdcr.TensionTable.load(file, model, interpolation="previous")
    assert repr(table) == "<TensionTable: 2 x 3 commands, previous>"
    run = cdcr.simulate(model, [0, 0], [0, 0], t=[0.0, 0.4, 0.5, 1.0], tension=table)
    np.testing.assert_array_equal(run.tension, [[1, 2, 3], [1, 2, 3], [4, 5, 6], [4, 5, 6]])
    again = cdcr.TensionTable.load(run.save(tmp_path / "run.csv"), model)
    np.testing.assert_array_equal(again.tension, run.tension)
    with pytest.raises(TypeError, match=r"^model must be a "):
        cdcr.TensionTable.load(file, model.robot)  # type: ignore[arg-type]
    with pytest.raises(FileNotFoundError, match=r"^there is no tension file "):
        cdcr.TensionTable.load(tmp_path / "other.csv", model)


@pytest.mark.parametrize(
    ("rows", "where", "sentence"),
    [
        (
            "t = [0]\n",
            "pull.toml",
            "tension.rows is missing; it must be an array with one row for each time: "
            "a number >= 0 [N] for each cable",
        ),
        (
            ROWS.replace("[1, 2, 3]", "[1, 2, -3]"),
            "pull.toml",
            "tension.rows must be an array with one row for each time: a number >= 0 [N] "
            "for each cable, got -3 (integer) at tension.rows[1][2]",
        ),
        (
            ROWS + "interpolation = 'cubic'\n",
            "pull.toml",
            'tension.interpolation must be "linear" or "previous", got \'cubic\' (string)',
        ),
        (
            ROWS.replace("[1, 2, 3]", "[1, 2]"),
            "pull.toml, [tension]",
            "rows[1] must have 3 numbers, one for each cable, got 2",
        ),
        (
            ROWS.replace("[0, 1]", "[0, 1, 2]"),
            "pull.toml, [tension]",
            "rows must be as many as t, 3, got 2",
        ),
        (
            CSV + "t = [0]\n",
            "pull.toml",
            "tension.t is not a known key. Known keys: interpolation, file",
        ),
    ],
)
def test_what_is_wrong_in_the_table(tmp_path: Path, rows: str, where: str, sentence: str) -> None:
    assert refusal(tmp_path, rows, where) == sentence


def test_times_must_increase(tmp_path: Path) -> None:
    back_in_time = ROWS.replace("[0, 1]", "[1, 0]")  # a time given twice is a jump
    same = refusal(tmp_path, back_in_time, "pull.toml, [tension]")
    assert "increasing" in same
    (tmp_path / "tension.csv").write_text("t,cable 1,cable 2,cable 3\n2,0,0,0\n1,0,0,0\n")
    back = refusal(tmp_path, CSV, "tension.csv")
    assert "increasing" in back


@pytest.mark.parametrize(
    ("csv", "where", "sentence"),
    [
        (
            "t,cable 1\n0,1\n",
            "tension.csv, line 1",
            "the columns must be t, cable 1, cable 2, cable 3, got t, cable 1",
        ),
        (
            "",
            "tension.csv, line 1",
            "the columns must be t, cable 1, cable 2, cable 3, got nothing",
        ),
        (
            "t;cable 1;cable 2;cable 3\n0;1;2;3\n",
            "tension.csv, line 1",
            "columns must be separated by commas, not semicolons",
        ),
        ("t,cable 1,cable 2,cable 3\n0,1\n", "tension.csv, line 2", "must have 4 columns, got 2"),
        (
            "t,cable 1,cable 2,cable 3\n0,1,2,3\n\n1,2,x,4\n",
            "tension.csv, line 4",
            "cable 2 must be a number >= 0 [N], got 'x'",
        ),
        (
            "t,cable 1,cable 2,cable 3\n0,1,-2,3\n",
            "tension.csv, line 2",
            "cable 2 must be a number >= 0 [N], got '-2'",
        ),
        (
            "t,cable 1,cable 2,cable 3\nnan,1,2,3\n",
            "tension.csv, line 2",
            "t must be a time [s], got 'nan'",
        ),
    ],
)
def test_what_is_wrong_in_a_tension_file(
    tmp_path: Path, csv: str, where: str, sentence: str
) -> None:
    (tmp_path / "tension.csv").write_text(csv)
    assert refusal(tmp_path, CSV, where) == sentence


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"t,cable 1,cable 2,cable 3\n", " has no rows of numbers under its header"),
        (b"t,cable 1,cable 2,cable 3\n0,\xff,0,0\n", ", line 2: not UTF-8 text"),
    ],
)
def test_a_tension_file_without_numbers(tmp_path: Path, content: bytes, sentence: str) -> None:
    (tmp_path / "tension.csv").write_bytes(content)
    with pytest.raises(ValueError, match=re.escape(f"{tmp_path / 'tension.csv'}{sentence}")):
        load(tmp_path, CSV)
