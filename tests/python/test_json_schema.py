"""JSON schemas of files: what the package reads fits, what it refuses does not."""

import json
import re
import sys
from collections.abc import Iterator
from dataclasses import fields
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

import cdcr
from cdcr.robot.json_schema import robot_file_schema
from cdcr.scenarios.file.json_schema import scenario_file_schema
from cdcr.scenarios.file.template import template

pytest.importorskip("jsonschema")
pytest.importorskip("typer")

import jsonschema  # type: ignore[import-untyped]

from command import cdcr_, refused
from robot_file import FILE

TOML = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
SCENARIO = jsonschema.Draft7Validator(json.loads(json.dumps(scenario_file_schema())))
ROBOT = jsonschema.Draft7Validator(json.loads(json.dumps(robot_file_schema())))
LIBRARY = sorted((Path(cdcr.__file__).parent / "scenarios" / "library").glob("*.toml"))
START = 'robot = "amouri2020"\nt_end = 1.0\n'


def wrong(validator: Any, text: str) -> list[str]:
    return [error.message for error in validator.iter_errors(TOML.loads(text))]


def switched_on() -> Iterator[str]:
    """Yield each block of the template that is switched off, switched on."""
    for block in template().split("\n\n"):
        lines = re.findall(r"^#(\S.*)$", block, flags=re.MULTILINE)
        if lines:
            yield "\n".join(lines)


def test_they_are_schemas() -> None:
    for validator in (SCENARIO, ROBOT):
        jsonschema.Draft7Validator.check_schema(validator.schema)


def test_every_key_is_described_with_its_unit() -> None:
    def keys(schema: Any) -> Iterator[tuple[str, dict[str, Any]]]:
        if isinstance(schema, dict):
            yield from schema.get("properties", {}).items()
            for one in schema.values():
                yield from keys(one)
        if isinstance(schema, list):
            for one in schema:
                yield from keys(one)

    found = [*keys(SCENARIO.schema), *keys(ROBOT.schema)]
    assert len(found) > 150
    for name, told in found:
        about, _, requirement = told["description"].partition(": ")
        assert about, name
        assert requirement, name
    units = {name: told["description"] for name, told in keys(ROBOT.schema)}
    for kind in (cdcr.Robot, cdcr.Section, cdcr.Cable):
        for item in fields(kind):
            if item.metadata["unit"]:
                assert item.metadata["unit"].split()[0] in units[item.name]


@pytest.mark.parametrize("path", LIBRARY, ids=lambda path: path.stem)
def test_scenarios_of_the_package_fit(path: Path) -> None:
    found = wrong(SCENARIO, path.read_text(encoding="utf-8"))
    runs = cdcr.scenarios.get(path.stem).has_run  # the others are pictures, which users have not
    assert found == ([] if runs else ["'t_end' is a required property"])


@pytest.mark.parametrize("name", cdcr.robots.names())
def test_robots_that_are_saved_fit(tmp_path: Path, name: str) -> None:
    cdcr.robots.get(name).save(tmp_path / "robot.toml")
    assert wrong(ROBOT, (tmp_path / "robot.toml").read_text(encoding="utf-8")) == []


def test_a_robot_without_cables_fits(tmp_path: Path) -> None:
    section = cdcr.Section(
        length=0.2, backbone_mass=0.01, backbone_diameter=0.002, youngs_modulus=60e9
    )
    cable = cdcr.Cable(radius=0.01, angle=0.0, end_section=0)
    for robot in (cdcr.Robot(sections=[section]), cdcr.Robot(sections=[section], cables=[cable])):
        robot.save(tmp_path / "robot.toml", overwrite=True)
        assert wrong(ROBOT, (tmp_path / "robot.toml").read_text(encoding="utf-8")) == []


def test_everything_that_the_template_shows_fits() -> None:
    blocks = list(switched_on())
    assert len(blocks) > 20
    for block in blocks:
        table = {"robot": "amouri2020", "t_end": 1.0} | TOML.loads(block)
        assert [error.message for error in SCENARIO.iter_errors(table)] == [], block


@pytest.mark.parametrize(
    "text",
    [
        'robot = "amouri"\nt_end = 1.0\n',
        'robot = "amouri2020"\n',
        'robot = "amouri2020"\nt_end = 0.0\n',
        START + "tensoin = [1.0, 0.0, 0.0]\n",
        START + "tension = [-1.0, 0.0, 0.0]\n",
        START + 'tension = [1.0]\n[trajectory]\nfile = "a.csv"\n',
        START + '[integrator]\nmethod = "euler"\n',
        START + "[output]\nnum_samples = 1\n",
        START + '[output]\nfiles = ["png"]\n',
        START + "[initial]\nq = [0.0, 0.0]\ntheta = [0.0]\n",
        START + '[[tension]]\ncable = 1\nshape = "step"\n',
        START + '[[tension]]\ncable = 0\nshape = "step"\nvalue = 1.0\n',
        START + "[[wrenches]]\nsection = 1\n",
        START + "[[wrenches]]\nsection = 1\nforce = [1.0, 0.0]\n",
        START + '[controller]\ntype = "pid"\n',
        START + '[trajectory]\nshape = "circle"\ntheta = 0.1\n',
        't_end = 1.0\n[robot]\nname = "amouri2020"\n[robot.each_section]\ndamping = -1.0\n',
    ],
)
def test_faults_of_scenarios_are_found(tmp_path: Path, text: str) -> None:
    """By the schema and, as they are faults, by cdcr."""
    assert wrong(SCENARIO, text) != []
    path = tmp_path / "my.toml"
    path.write_text(text, encoding="utf-8")
    assert cdcr_("validate", path).exit_code == 2


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("length = 0.8", "length = 0.0"),
        ("length = 0.8", "lenght = 0.8"),
        ("num_disks = 10", "num_disks = 65"),
        ("payload = 0.1", "payload = -0.1"),
        ("gravity = [0, 0, -9.81]", "gravity = [0, 0]"),
        ("cable_angles = [0.0, 2.0, 4.0]", "cable_angles = [0.0]\ncable_angles_deg = [0.0]"),
        ("damping = 1e-3", 'damping = "low"'),
    ],
)
def test_faults_of_robots_are_found(tmp_path: Path, old: str, new: str) -> None:
    assert wrong(ROBOT, FILE) == []
    text = FILE.replace(old, new)
    assert wrong(ROBOT, text) != []
    path = tmp_path / "robot.toml"
    path.write_text(text, encoding="utf-8")
    assert cdcr_("validate", path).exit_code == 2


def test_the_command_prints_them() -> None:
    for kind, validator in (("scenario", SCENARIO), ("robot", ROBOT)):
        assert json.loads(cdcr_("schema", kind).stdout) == validator.schema
    assert refused(cdcr_("schema", "run")) == "the schema must be one of robot, scenario, got 'run'"
