"""cdcr validate: one sentence for each fault, with its line; nothing runs."""

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import cdcr

pytest.importorskip("typer")

from cdcr.files.toml_lines import key_lines, line_of
from command import cdcr_, refused

LIBRARY = sorted((Path(cdcr.__file__).parent / "scenarios" / "library").glob("*.toml"))
RUN = "robot = 'amouri2020'\nt_end = 1.0\n"
SHAPE = "[[{}]]\ncable = 1\nshape = 'step'\nvalue = 0.81"
FAULTY = """\
title = "faulty"
robot = "amouri2020"
t_end = 10
tension = [1, 2]                  # three cables
[integrator]
rtoll = 1e-6
[output]
files = ["png"]
[[wrenches]]
section = 1
force = [1, 0, 0]
[[wrenches]]
section = 4
force = [1, 0, 0]
[initial]
q = [0, 0]
theta = [0]
"""


def test_all_faults_are_told_each_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(FAULTY, encoding="utf-8")
    result = cdcr_("validate", path)
    assert (result.exit_code, result.stdout) == (2, "")
    told = [line.removeprefix(f"cdcr: {path}, line ") for line in result.stderr.splitlines()]
    assert [line.partition(" ")[:3:2] for line in (one.partition(" must")[0] for one in told)] == [
        ("6:", "integrator.rtoll is not a known key. Did you mean 'rtol'? Known keys: "
         "method, rtol, atol, step, max_step, max_steps"),
        ("8:", "output.files"),
        ("4:", "tension"),
        ("13:", "wrenches[1].section"),
        ("15:", "initial"),
    ]  # fmt: skip


def test_files_without_faults_are_told_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cdcr.scenarios.Scenario, "simulate", None)  # a run would fail
    robot = tmp_path / "robot.toml"
    cdcr.robots.three_sections().save(robot)
    result = cdcr_("validate", LIBRARY[-1], robot, tmp_path / "no.toml", robot)
    assert result.exit_code == 2
    assert result.stdout.splitlines()[1:] == [f"{robot}: ok, a robot of 3 sections, 9 cables"] * 2
    assert result.stderr == f"cdcr: there is no robot or scenario file {tmp_path / 'no.toml'}\n"
    assert cdcr_("validate", robot).exit_code == 0


def test_scenarios_of_the_package_that_run_are_valid() -> None:
    files = [path for path in LIBRARY if cdcr.scenarios.get(path.stem).has_run]
    result = cdcr_("validate", *files)
    assert (result.exit_code, result.stderr) == (0, "")
    assert len(result.stdout.splitlines()) == len(files) == 19


def test_faults_of_a_robot_that_a_scenario_names_are_found_there(tmp_path: Path) -> None:
    robot, path = tmp_path / "robot.toml", tmp_path / "my.toml"
    cdcr.robots.three_sections().save(robot)
    lines = robot.read_text(encoding="utf-8").splitlines()
    at = [i for i, line in enumerate(lines) if line.startswith("length")][1]
    lines[at] = "length = -1.0"
    robot.write_text("\n".join(lines), encoding="utf-8")
    path.write_text('robot = "robot.toml"\nt_end = 1.0\n', encoding="utf-8")
    fault = f"{robot}, line {at + 1}: section 2: length must be"
    assert cdcr_("validate", path).stderr.startswith(f"cdcr: {path}, line 1, robot: {fault}")
    for command in ("validate", "info"):
        assert cdcr_(command, robot).stderr.startswith(f"cdcr: {fault}")
    with pytest.raises(ValueError, match=f"^{re.escape(fault)}"):
        cdcr.Robot.load(robot)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('robot = "no.toml"\nt_end = 1.0', "1, robot: there is no robot file {}/no.toml"),
        ('robot = "."\nt_end = 1.0', "1, robot: there is no robot '.'"),
        (f"{RUN}[tension]\nfile = 'no.csv'", "4, tension.file: there is no tension file {}/no.csv"),
        (f"{RUN}[tension]\nfile = '.'", "4, tension.file: {} is a folder, not a tension file"),
        (
            f"{RUN}[tension]\nfile = 'bad.csv'",
            "4, tension.file: {}/bad.csv, line 3: cable 2 must be a number >= 0 [N], got 'x'",
        ),
        (
            f"{RUN}[trajectory]\nfile = 'no.csv'",
            "4, trajectory.file: there is no trajectory file {}/no.csv",
        ),
    ],
)
def test_what_is_wrong_with_a_named_file_says_where_it_is_named(
    tmp_path: Path, text: str, told: str
) -> None:
    (tmp_path / "bad.csv").write_text("t,cable 1,cable 2,cable 3\n0,0,0,0\n1,1,x,1\n")
    path = tmp_path / "my.toml"
    path.write_text(text, encoding="utf-8")
    start = f"cdcr: {path}, line {told.format(tmp_path)}"
    for command in ("validate", "run"):
        assert cdcr_(command, path).stderr.startswith(start)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "[trajectory]\nshape = 'line'\ntheta_rate_deg = 1000",
            "3, [trajectory]: the reference bends section 1 by 9.425 rad at t = 0.54 s, beyond",
        ),
        ("[integrator]\nmethod = 'rk4'\nrtol = 1e-6", "5: integrator.rtol is none of rk4"),
        (
            "[integrator]\nmethod = 'rk4'\nstep = 10",
            "5: integrator.step must be at most t_end, 1 s, got 10",
        ),
        (
            "[trajectory]\nshape = 'line'\ntheta_rate_deg = 10\nsimulate = true\nstep = 10",
            "7: trajectory.step must be at most t_end, 1 s, got 10",
        ),
        (
            f"[tension]\nstep = 1e-12\n{SHAPE.format('tension.shapes')}",
            "4, [tension]: step must be at least 1e-07 s in a run of 1 s, got 1e-12 s",
        ),
        (
            "[trajectory]\nshape = 'line'\ntheta_rate_deg = 10\nsimulate = true\nstep = 1e-12",
            "7, [trajectory]: step must be at least 1e-07 s in a run of 1 s, got 1e-12 s",
        ),
    ],
)
def test_what_a_run_would_refuse_or_ignore(tmp_path: Path, text: str, told: str) -> None:
    path = tmp_path / "my.toml"
    path.write_text(RUN + text)
    found = refused(cdcr_("validate", path))
    assert found.startswith(f"{path}, line {told}")
    assert refused(cdcr_("run", path, "--out", tmp_path / "out")) == found


@pytest.mark.parametrize(
    ("text", "where", "instead"),
    [
        (
            SHAPE.format("tension"),
            "3, [[tension]]",
            "write [[tension.shapes]], and [tension] with step, which samples them",
        ),
        (
            "[trajectory]\nshape = 'line'\ntheta_rate_deg = 10\nsimulate = true",
            "3, [trajectory]",
            "give step, which samples the commands",
        ),
    ],
)
def test_drives_with_backlash_take_no_function_of_time(
    tmp_path: Path, text: str, where: str, instead: str
) -> None:
    robot, path = tmp_path / "robot.toml", tmp_path / "my.toml"
    section = replace(
        cdcr.robots.amouri2020().sections[0], cable_stiffness=2e4, cable_backlash=1e-3
    )
    cdcr.Robot(sections=[section]).save(robot)
    run = RUN.replace("amouri2020", "robot.toml")
    path.write_text(run + text)
    for command in (("validate", path), ("run", path, "--out", tmp_path / "out")):
        assert refused(cdcr_(*command)) == (
            f"{path}, line {where}: a drive with backlash takes tables and constants, whose turns "
            f"are known, and no function of time; cable 1 has 0.001 m: {instead}"
        )
    sampled = text + "\nstep = 1e-3"  # as the sentence says
    if "[[tension]]" in text:
        sampled = "[tension]\nstep = 1e-3\n" + SHAPE.format("tension.shapes")
    path.write_text(run + sampled)
    assert cdcr_("run", path, "--out", tmp_path / "out", "--format", "csv").exit_code == 0


def test_a_robot_for_a_scenario_and_the_reverse(tmp_path: Path) -> None:
    robot, path, other = (tmp_path / f"{name}.toml" for name in ("robot", "my", "other"))
    cdcr.robots.amouri2020().save(robot)
    path.write_text(RUN)
    other.write_text(f"robot = '{path}'\nt_end = 1.0\n")
    takes = f"{path} is a scenario file: `cdcr run` and `cdcr view` take it"
    for command, target, told in (
        ("run", robot, f"{robot} is a robot file: `cdcr info` and `cdcr view` take it, or name it "
         "in a scenario"),
        ("info", path, takes),
        ("run", other, f"{other}, line 1, robot: {takes}"),
        ("run", "amouri2020", "amouri2020 is a robot: `cdcr info amouri2020` or `cdcr view "
         "amouri2020`"),
        ("info", "step-tension", "step-tension is a scenario: `cdcr run step-tension` or "
         "`cdcr view step-tension`"),
    ):  # fmt: skip
        assert refused(cdcr_(command, target)) == told


def test_run_tells_faults_as_validate_does(tmp_path: Path) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(FAULTY, encoding="utf-8")
    faults = cdcr_("validate", path).stderr
    assert len(faults.splitlines()) == 5
    assert cdcr_("run", path).stderr == faults


def test_syntax_keeps_its_line(tmp_path: Path) -> None:
    path = tmp_path / "my.toml"
    path.write_text('robot = "amouri2020"\nt_end = \n', encoding="utf-8")
    told = cdcr_("validate", path).stderr
    assert told.startswith(f"cdcr: {path}, line 2, column 9: ")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "[robot.each_section]\ndamping = 1",
            "line 3, column 20: robot is given twice: as a value on line 1 and as a table on "
            "line 3; put the value into [robot]",
        ),
        ("t_end = 2", "line 3, column 10: t_end is given twice: on line 2 and on line 3"),
        ("[initial]\n[initial]", "initial is given twice: on line 3 and on line 4"),
    ],
)
def test_what_is_given_twice_is_named(tmp_path: Path, text: str, told: str) -> None:
    path = tmp_path / "my.toml"
    path.write_text(f"{RUN}{text}\n")
    assert refused(cdcr_("validate", path)).endswith(told)


def test_json_is_one_object(tmp_path: Path) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(FAULTY, encoding="utf-8")
    result = cdcr_("validate", path, LIBRARY[-1], "--json")
    assert (result.exit_code, result.stderr) == (2, "")
    bad, good = json.loads(result.stdout)["files"]
    assert (bad["ok"], len(bad["faults"]), bad["file"]) == (False, 5, str(path))
    assert (good["ok"], good["faults"]) == (True, [])


TOML = '''
integrator.rtol = 1
[initial]
q = [1,
 2]  # ] [ no = "bracket
text = """
[not.a.table]
a = 1
"""
inline = { a = 1 }
[["wrenches"]]
section = 1
[[wrenches]]
section = 2
[[robot.sections]]
length = 1
[[robot.sections]]
length = 2
'''


def test_lines_of_keys() -> None:
    assert key_lines(TOML) == {
        "integrator": 2,
        "integrator.rtol": 2,
        "initial": 3,
        "initial.q": 4,
        "initial.text": 6,
        "initial.inline": 10,
        "wrenches[0]": 11,
        "wrenches[0].section": 12,
        "wrenches[1]": 13,
        "wrenches[1].section": 14,
        "robot": 15,
        "robot.sections[0]": 15,
        "robot.sections[0].length": 16,
        "robot.sections[1]": 17,
        "robot.sections[1].length": 18,
    }


@pytest.mark.parametrize(
    ("sentence", "home", "line"),
    [
        ("integrator.rtol must be", "", 2),
        ("rtol must be", "integrator", 2),
        ("initial.q[0] must be", "", 4),
        ("wrenches[1].force is missing", "", 13),
        ("section 2: length must be", "robot", 18),
        ("there must be only one of", "", None),
    ],
)
def test_the_line_of_a_sentence(sentence: str, home: str, line: Any) -> None:
    assert line_of(key_lines(TOML), sentence, home) == line
