"""What the tests in C++ hold the reader there to, tests/data/robot_files, is what Python reads."""

import re
from pathlib import Path
from typing import Any

import pytest

import cdcr
from cdcr.export.fmu import setup_lines
from cdcr.files.toml import read_toml
from cdcr.robot.file import robot_text, switched_off
from description import without_lines

FOLDER = Path(__file__).parents[1] / "data" / "robot_files"
REFUSED = read_toml(FOLDER / "refused.toml", "file")


@pytest.mark.parametrize("name", [*cdcr.robots.names(), "rods", "every_key"])
def test_the_fields_are_those_of_the_file(name: str) -> None:
    robot = cdcr.Robot.load(FOLDER / f"{name}.toml")
    assert "\n".join([*setup_lines(robot), ""]) == (FOLDER / f"{name}.fields").read_text()


@pytest.mark.parametrize("name", cdcr.robots.names())
def test_the_files_are_what_new_writes(name: str) -> None:
    robot = cdcr.robots.get(name)
    assert (FOLDER / f"{name}.toml").read_text() == robot_text(robot) + switched_off(robot)


@pytest.mark.parametrize("case", REFUSED["refused"], ids=lambda case: case["new"] or case["old"])
def test_the_sentences_are_those_of_python(tmp_path: Path, case: dict[str, Any]) -> None:
    file = tmp_path / "robot.toml"
    file.write_text(REFUSED["base"].replace(case["old"], case["new"]))
    with pytest.raises(ValueError, match=r"robot\.toml") as caught:
        cdcr.Robot.load(file)
    found = [line.removeprefix(f"{file}: ") for line in without_lines(caught.value, file)]
    assert [re.sub(r" Did you mean '\w+'\?", "", line) for line in found] == case["sentences"]
