"""The command new: its file runs as it is, and with each of its comments switched on."""

import csv
import json
import re
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import BaseModel

import cdcr

pytest.importorskip("typer")
pytest.importorskip("matplotlib")
pytest.importorskip("h5netcdf")

from cdcr.cli.schema import comment
from cdcr.scenarios.file import control_schema, estimator_schema, schema, shape_schema
from cdcr.scenarios.file.template import template
from command import cdcr_, everything_in, refused

TEMPLATE = template()
BLOCKS = TEMPLATE.split("\n\n")
SWITCHED_OFF = [i for i, block in enumerate(BLOCKS) if re.search(r"^#\S", block, re.MULTILINE)]
# Tensions are shared among cables that are named by other arithmetic than among all [rad].
NAMED_CABLES = 1e-13


def switched_on(i: int) -> str:
    """The template with a block switched on, and off what cannot stand beside it."""
    block = re.sub(r"^#(\S)", r"\1", BLOCKS[i], flags=re.MULTILINE)
    others = "\n\n".join([*BLOCKS[:i], block, *BLOCKS[i + 1 :]])
    if re.search(r"^\[+(tension|trajectory|controller)", block, re.MULTILINE):
        others = re.sub(r"^tension = .*\n", "", others, flags=re.MULTILINE)
    if re.search(r"^(\[robot\]|robot = \"robot.toml\")", block, re.MULTILINE):
        others = re.sub(r'^robot = "amouri2020"\n', "", others, flags=re.MULTILINE)
    return others


@pytest.mark.parametrize(
    ("name", "told"), [("my arm.toml", "'my arm.toml'"), ("-a.toml", "./-a.toml")]
)
def test_the_command_to_go_on_with_can_be_copied(
    name: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert cdcr_("new", "--", name).stdout == f"wrote {name}; next: cdcr run {told}\n"


def test_the_file_runs_as_it_is(tmp_path: Path) -> None:
    path, out = tmp_path / "my.toml", tmp_path / "out"
    result = cdcr_("new", path)
    assert result.exit_code == 0, result.output
    assert result.stdout == f"wrote {path}; next: cdcr run {path}\n"
    assert path.read_text(encoding="utf-8") == comment("scenario") + TEMPLATE
    result = cdcr_("run", path, "--out", out)
    assert result.exit_code == 0, result.output
    assert everything_in(out) == ["my.csv", "my.nc", "my.png"]
    assert "14.9778" in result.stdout  # 5 N on cable 1, as in step-tension


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("i", SWITCHED_OFF)
def test_it_runs_with_each_comment_switched_on(tmp_path: Path, i: int) -> None:
    cdcr.robots.amouri2020(damping=1e-3).save(tmp_path / "robot.toml")
    (tmp_path / "tension.csv").write_text("t,cable 1,cable 2,cable 3\n0,0,0,0\n1,5,0,0\n")
    lines = [f"{t},{t},{9 * t}" for t in range(11)]
    (tmp_path / "path.csv").write_text("\n".join(["t,theta_deg 1,phi_deg 1", *lines]))
    path = tmp_path / "my.toml"
    path.write_text(switched_on(i), encoding="utf-8")
    result = cdcr_("run", path, "--out", tmp_path / "out", "--json")
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert told["success"]
    assert told["t_end"] == 10.0
    if "[trajectory]" in BLOCKS[i]:
        errors = [value for key, value in told["findings"].items() if key == "path_error_rad"]
        assert len(errors) == ("simulate = true\n" in BLOCKS[i] + "\n")
        # Cables driven by length give a little.
        assert all(error < (0.05 if "shorter" in BLOCKS[i] else 1e-8) for error in errors)


def test_there_are_blocks_to_switch_on() -> None:
    assert len(SWITCHED_OFF) == 27
    assert sum("[trajectory]" in BLOCKS[i] for i in SWITCHED_OFF) == 7


def test_every_key_is_shown() -> None:
    said = set(re.findall(r"\w+", TEMPLATE))
    schemas: tuple[type[BaseModel], ...] = (
        schema.ScenarioTable,
        schema.InitialTable,
        schema.RobotChanges,
        schema.IntegratorTable,
        schema.OutputTable,
        *control_schema.CONTROLLERS.values(),
        *control_schema.MOTIONS.values(),
        control_schema.LoopTable,
        control_schema.ActuatorTable,
        control_schema.SensorTable,
        *estimator_schema.ESTIMATORS.values(),
        schema.ReferenceTable,
        schema.TensionRows,
        schema.TensionHold,
        schema.HoldTable,
        schema.TensionSampled,
        schema.TensionFile,
        schema.WrenchTable,
        shape_schema.TrajectorySamples,
        shape_schema.TrajectoryFile,
        *shape_schema.TENSION_SHAPES.values(),
        *shape_schema.TRAJECTORY_SHAPES.values(),
    )
    for table in schemas:
        assert set(table.model_fields) - said == set(), table.__name__
    for item in (*fields(cdcr.Robot), *fields(cdcr.Section), *fields(cdcr.Cable)):
        assert {item.name, f"{item.name}_deg"} & said, item.name


def test_defaults_shown_are_the_defaults(tmp_path: Path) -> None:
    """The integrator and its tolerances, the number of samples, the options of a PID loop."""
    path = tmp_path / "my.toml"
    runs = []
    for text in (TEMPLATE, switched_on(BLOCKS.index(next(b for b in BLOCKS if "#rtol" in b)))):
        path.write_text(re.sub(r"^max_step = .*\n", "", text, flags=re.MULTILINE))
        runs.append(cdcr.scenarios.Scenario.simulate(_load(path)))
    np.testing.assert_array_equal(runs[0].q, runs[1].q)
    pid = next(b for b in BLOCKS if "#[controller]" in b)
    text = switched_on(BLOCKS.index(pid))
    loops = []
    defaults = r"^(period|feed_forward|anti_windup|min_tension|max_tension|cables) = .*\n"
    for one in (text, re.sub(defaults, "", text, flags=re.MULTILINE)):
        path.write_text(one)
        loops.append(_load(path).simulate(t_end=1.0))
    assert len(loops[0]) == 101
    np.testing.assert_allclose(loops[0].q, loops[1].q, atol=NAMED_CABLES)


def _load(path: Path) -> cdcr.scenarios.Scenario:
    from cdcr.scenarios.file.reader import load_scenario

    return load_scenario(path)


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize(
    ("files", "written"),
    [
        (["csv"], ["my.csv"]),
        (["nc", "picture"], ["my.nc", "my.png"]),
        (["csv", "csv"], ["my.csv"]),
    ],
)
def test_only_the_files_asked_for_are_written(
    tmp_path: Path, files: list[str], written: list[str]
) -> None:
    path, out = tmp_path / "my.toml", tmp_path / "out"
    path.write_text(f'robot = "amouri2020"\nt_end = 0.1\n[output]\nfiles = {files}\n')
    result = cdcr_("run", path, "--out", out)
    assert result.exit_code == 0, result.output
    assert everything_in(out) == written
    again = cdcr_("run", path, "--out", out)
    assert again.exit_code == 2
    assert all(str(out / name) in again.stderr for name in written)


def test_a_file_is_replaced_only_when_told(tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    path.write_text("mine")
    result = cdcr_("new", path)
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr == f"cdcr: {path} exists already; give --overwrite to replace it\n"
    assert path.read_text() == "mine"
    assert cdcr_("new", path, "--overwrite").exit_code == 0
    assert path.read_text(encoding="utf-8") == comment("scenario") + TEMPLATE
    assert everything_in(tmp_path) == ["my.toml"]


def test_a_file_must_be_one_that_run_takes(tmp_path: Path) -> None:
    result = cdcr_("new", tmp_path / "my.txt")
    assert result.exit_code == 2
    assert result.stderr == "cdcr: the file name must end in .toml, got 'my.txt'\n"
    for name, option in (("step-tension", "--from"), ("three_sections", "--robot")):
        way = f"start from it by `cdcr new FILE.toml {option} {name}`\n"
        assert cdcr_("new", name).stderr.endswith(way)
    result = cdcr_("new", tmp_path / "no" / "my.toml")
    assert result.exit_code == 2
    assert result.stderr == f"cdcr: the folder {tmp_path / 'no'} does not exist; make it first\n"
    (tmp_path / "file").touch()
    result = cdcr_("new", tmp_path / "file" / "my.toml")
    assert result.stderr == f"cdcr: {tmp_path / 'file'} is a file, not a folder to write to\n"
    result = cdcr_("run", "step-tension", "--out", tmp_path / "file" / "out")
    assert result.stderr == f"cdcr: {tmp_path / 'file'} is a file, not a folder to write to\n"
    (tmp_path / "file").unlink()
    (tmp_path / "folder.toml").mkdir()
    result = cdcr_("new", tmp_path / "folder.toml", "--overwrite")
    assert result.stderr == f"cdcr: {tmp_path / 'folder.toml'} is a folder, not a file\n"
    assert everything_in(tmp_path) == ["folder.toml"]


def file_scenarios() -> list[str]:
    found = [one for one in cdcr.scenarios.names() if cdcr.scenarios.get(one).has_run]
    assert len(found) == 19
    return found


def columns(path: Path) -> list[dict[str, str]]:
    """Rows of a run's CSV but for how long updates of the controller took, by the clock."""
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return [{name: row[name] for name in row if name != "duration [s]"} for row in rows]


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("name", file_scenarios())
def test_a_scenario_written_out_is_the_same_run(tmp_path: Path, name: str) -> None:
    path, out = tmp_path / "my.toml", tmp_path / "out"
    result = cdcr_("new", path, "--from", name)
    assert result.exit_code == 0, result.output
    assert result.stdout == f"wrote {path}; next: cdcr run {path}\n"
    source = cdcr.scenarios.source_file(name).read_text(encoding="utf-8")
    assert path.read_text(encoding="utf-8") == comment("scenario") + source
    runs = []
    for one in (path, name):
        result = cdcr_("run", one, "--out", out, "--json")
        assert result.exit_code == 0, result.output
        runs.append(json.loads(result.stdout))
    same = ("title", "source", "robot", "formulation", "method", "t_end", "num_samples", "stats")
    assert [runs[0][key] for key in same] == [runs[1][key] for key in same]
    assert columns(out / "my.csv") == columns(out / f"{name}.csv")


def test_only_scenarios_that_run_can_be_written_out(tmp_path: Path) -> None:
    path, known = tmp_path / "my.toml", ", ".join(file_scenarios())
    assert refused(cdcr_("new", path, "--from", "step-tensoin")) == (
        f"there is no scenario 'step-tensoin'. Did you mean 'step-tension'? Known: {known}"
    )
    assert refused(cdcr_("new", path, "--from", "gravity-ratio")) == (
        "nothing runs in the scenario 'gravity-ratio': it is a picture of the model alone. "
        f"Scenarios in which something runs: {known}"
    )
    assert everything_in(tmp_path) == []
    path.write_text("mine")
    told = f"{path} exists already; give --overwrite to replace it"
    assert refused(cdcr_("new", path, "--from", "pid")) == told
    assert path.read_text() == "mine"
    assert cdcr_("new", path, "--from", "pid", "--overwrite").exit_code == 0
    assert "[controller]" in path.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", cdcr.robots.names())
def test_a_robot_written_out_is_that_robot(tmp_path: Path, name: str) -> None:
    path = tmp_path / "robot.toml"
    result = cdcr_("new", path, "--robot", name.replace("_", "-"))
    assert (result.exit_code, result.stdout) == (0, f"wrote {path}; next: cdcr info {path}\n")
    robot = cdcr.robots.get(name)
    assert cdcr.Robot.load(path) == robot
    text = path.read_text(encoding="utf-8")
    assert text.startswith("#:schema ./cdcr-robot.schema.json\n")
    for item in (*fields(cdcr.Robot), *fields(cdcr.Section), *fields(cdcr.Cable)):
        if item.name not in ("sections", "cables"):
            assert re.search(rf"^#?{item.name} = \S.*  # ", text, re.MULTILINE), item.name
    assert cdcr_("info", path).exit_code == 0


def test_what_else_a_robot_may_have_is_shown_with_its_default(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    assert cdcr_("new", path, "--robot", "amouri2020").exit_code == 0
    whole = path.read_text(encoding="utf-8")
    robot, section, cable = re.split(
        r"# Of a section:\n|# Cables that", whole.partition("Of the ")[2]
    )
    sections = whole.index("[[sections]]")
    text = _on(robot) + whole[:sections] + "[[sections]]\n" + _on(section) + whole[sections + 12 :]
    path.write_text(text, encoding="utf-8")
    found = cdcr.Robot.load(path)
    stiffnesses = [f"{strain}_stiffness" for strain in ("bending", "twist", "stretch")]
    examples: dict[str, Any] = dict.fromkeys(["shear_modulus", *stiffnesses, "nodes"])
    plain = replace(found, sections=(replace(found.sections[0], **examples),))
    assert plain == cdcr.robots.amouri2020()
    path.write_text(whole + _on(cable), encoding="utf-8")
    assert cdcr.Robot.load(path).num_cables == 4


def _on(block: str) -> str:
    lines = re.findall(r"^#(\S.*)$", block, flags=re.MULTILINE)
    return "\n".join(lines) + "\n"


def test_robots_to_start_from_are_those_of_the_list(tmp_path: Path) -> None:
    path = tmp_path / "robot.toml"
    told = refused(cdcr_("new", path, "--robot", "amouri"))
    assert told.startswith("there is no robot 'amouri'. Did you mean 'amouri2020'?")
    told = refused(cdcr_("new", path, "--robot", "rao2021", "--from", "pid"))
    assert told == "give either --from or --robot, not both"
    assert everything_in(tmp_path) == []
