"""The command line: what it prints where, its exit codes, and one sentence for every mistake."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import cdcr

pytest.importorskip("typer")
pytest.importorskip("matplotlib")
pytest.importorskip("h5netcdf")


from command import cdcr_, everything_in, refused

RUN_OPTIONS = ["--out", "--method", "--t-end", "--rtol", "--atol", "--overwrite", "--json"]


def python(code: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=folder, check=False
    )


def test_version() -> None:
    result = cdcr_("--version")
    assert (result.exit_code, result.stdout) == (0, f"cdcr {cdcr.__version__}\n")


@pytest.mark.parametrize(
    ("args", "words"),
    [
        ([], ["list", "info", "run", "--version"]),
        (["list"], ["scenarios", "robots"]),
        (["info"], ["ROBOT|FILE.toml", "stiffness"]),
        (
            ["run"],
            ["NAME|FILE.toml", *RUN_OPTIONS, "--max-steps", "Exit codes"],
        ),
    ],
)
@pytest.mark.parametrize("flag", ["--help", "-h"])
def test_help_everywhere(args: list[str], words: list[str], flag: str) -> None:
    result = cdcr_(*args, flag)
    assert result.exit_code == 0
    assert result.stderr == ""
    for word in words:
        assert word in result.stdout


def test_list_names_every_scenario_and_robot() -> None:
    result = cdcr_("list")
    assert result.exit_code == 0
    for name in (*cdcr.scenarios.names(), *cdcr.robots.names()):
        assert name in result.stdout
    assert cdcr.scenarios.get("step-tension").title in result.stdout


def test_info_by_name_and_by_file(tmp_path: Path) -> None:
    by_name = cdcr_("info", "amouri2020")
    assert by_name.exit_code == 0
    for number in ("0.802", "0.0326", "9.5e+09", "0.363412", "120", "240", "0.1146", "9.09645"):
        assert re.search(rf"\b{re.escape(number)}\b", by_name.stdout), number
    for label in ("length [m]", "mass [kg]", "bending stiffness E I / l [N m/rad]", "gravity"):
        assert label in by_name.stdout
    path = tmp_path / "r.toml"
    cdcr.robots.amouri2020().save(path)
    by_file = cdcr_("info", path)
    assert by_file.exit_code == 0
    assert by_file.stdout.replace(str(path), "amouri2020").split() == by_name.stdout.split()


def test_info_of_what_does_not_exist(tmp_path: Path) -> None:
    known = ", ".join(cdcr.robots.names())
    assert refused(cdcr_("info", "x")) == f"there is no robot 'x'. Known: {known}"
    path = tmp_path / "x.toml"
    assert refused(cdcr_("info", path)) == f"there is no robot file {path}"


@pytest.mark.parametrize(
    ("args", "sentence"),
    [
        (["run", "x"], f"there is no scenario 'x'. Known: {', '.join(cdcr.scenarios.names())}"),
        (["run", "x.toml"], "there is no scenario file x.toml"),
        (
            ["run", "step-tension", "--method", "euler"],
            "--method must be one of 'rk4', 'dopri5', 'bdf', 'adams', 'dop853', "
            "'auto', 'rosenbrock', got 'euler'",
        ),
        (
            ["run", "step-tension", "--t-end", "-1"],
            "--t-end must be a number > 0 s and finite, got -1.0 (float)",
        ),
        (
            ["run", "step-tension", "--max-steps", str(2**63)],
            "--max-steps must be a whole number 1 to 9223372036854775807, "
            "got 9223372036854775808 (int)",
        ),
        (
            ["run", "step-tension", "--t-end", "1e9"],
            "--t-end must be at most 100000 s, which 10000000 samples 0.01 s apart reach, "
            "got 1e+09 s",
        ),
        (
            ["run", "step-tension", "--t-end", "1e308"],
            "--t-end must be at most 100000 s, which 10000000 samples 0.01 s apart reach, "
            "got 1e+308 s",
        ),
    ],
)
def test_mistakes_are_one_sentence(
    args: list[str], sentence: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert refused(cdcr_(*args)) == sentence
    assert everything_in(tmp_path) == []


@pytest.mark.parametrize("option", ["--rtol", "--atol", "--max-steps"])
def test_options_out_of_range_are_named(
    option: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert refused(cdcr_("run", "step-tension", option, "-1")).startswith(f"{option} must be ")
    assert everything_in(tmp_path) == []


@pytest.mark.parametrize(
    "args",
    [["walk"], ["run"], ["run", "step-tension", "--speed", "2"], ["run", "s", "--t-end", "soon"]],
)
def test_wrong_usage_exits_with_2_on_stderr(args: list[str]) -> None:
    result = cdcr_(*args)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert "Error: " in result.stderr
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize(
    ("module", "extra", "args"),
    [
        ("typer", "cli", ["list"]),
        ("rich", "cli", ["list"]),
        ("matplotlib", "plot", ["run", "step-tension"]),
        ("xarray", "data", ["run", "step-tension"]),
        ("h5netcdf", "data", ["run", "step-tension"]),
        ("h5py", "data", ["run", "step-tension"]),
    ],
)
def test_a_missing_extra_is_named(tmp_path: Path, module: str, extra: str, args: list[str]) -> None:
    code = f"import sys\nsys.modules[{module!r}] = None\n"
    done = python(f"{code}from cdcr.cli import main\nmain({args!r})\n", tmp_path)
    assert done.returncode == 2
    assert done.stdout == ""
    (line,) = done.stderr.splitlines()
    assert line.startswith("cdcr: ")
    assert f'pip install "cdcr[{extra}]"' in line
    assert everything_in(tmp_path) == []


def test_python_m_cdcr() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "cdcr", "--version"], capture_output=True, text=True, check=True
    )
    assert done.stdout == f"cdcr {cdcr.__version__}\n"


def test_a_warning_is_a_sentence_without_its_place_in_the_code(tmp_path: Path) -> None:
    scenario = tmp_path / "far.toml"
    scenario.write_text(
        'robot = "amouri2020"\nformulation = "taylor"\nt_end = 0.1\ninitial = { q = [2.0, 0.0] }\n'
    )
    command = [sys.executable, "-m", "cdcr", "run", str(scenario), "--out", str(tmp_path)]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    assert told.splitlines() == [
        "cdcr: warning: formulation 'taylor' holds for |theta| up to 3 pi/5 = 1.8850 rad; "
        "this motion reaches 2.0000 rad"
    ]


def test_lists_and_robots_as_json() -> None:
    listed = json.loads(cdcr_("list", "--json").stdout)
    assert [one["name"] for one in listed["scenarios"]] == list(cdcr.scenarios.names())
    assert [one["name"] for one in listed["robots"]] == list(cdcr.robots.names())
    for name in cdcr.robots.names():
        told = json.loads(cdcr_("info", name, "--json").stdout)
        robot = cdcr.robots.get(name)
        assert (told["length_m"], told["num_cables"]) == (robot.length, robot.num_cables)
        model = cdcr.Model(robot)
        if model.has_inertia:
            modes = model.modes([0.0] * model.num_coordinates, model.rest_command())
            assert told["rest"]["frequency_Hz"] == pytest.approx(modes.frequency_hz)
        else:
            assert told["rest"]["frequency_Hz"] is None


@pytest.mark.parametrize("name", ["three-sections", "three_sections"])
def test_dashes_and_underscores_are_the_same_in_names(name: str, tmp_path: Path) -> None:
    assert cdcr.robots.get(name) == cdcr.robots.three_sections()
    assert cdcr.scenarios.get(name).name == "three-sections"
    assert cdcr.scenarios.source_file(name).stem == "three-sections"
    assert cdcr_("info", name).exit_code == 0
    assert cdcr_("new", tmp_path / "x.toml", "--from", name).exit_code == 0


@pytest.mark.parametrize("get", [cdcr.robots.get, cdcr.scenarios.get, cdcr.scenarios.source_file])
@pytest.mark.parametrize("name", [1, [], None])
def test_names_that_are_no_strings(get: Any, name: object) -> None:
    with pytest.raises(ValueError, match=r"^the name of a (robot|scenario) must be a string, got"):
        get(name)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no full device")
@pytest.mark.parametrize("args", [["list", "--json"], ["list"], ["doctor", "--json"], ["doctor"]])
def test_what_is_printed_onto_a_full_disk(args: list[str]) -> None:
    command = [sys.executable, "-m", "cdcr", *args]
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr == "cdcr: what is printed: No space left on device\n"


@pytest.mark.parametrize(
    "command", ["info", "validate", "export-c", "export-fmu", "export-mjcf", "view"]
)
def test_a_robot_beyond_all_sizes_is_refused(command: str, tmp_path: Path) -> None:
    file, out = tmp_path / "robot.toml", tmp_path / "out.xml"
    section = cdcr.Section(
        length=1e-160, backbone_mass=0.01, backbone_diameter=1e-3, youngs_modulus=1e10
    )
    cdcr.Robot(sections=[section]).save(file)
    result = cdcr_(command, file, *(("--out", out) if command.startswith("export") else ()))
    assert result.exit_code == 2, result.output
    sentence = f"{file}: the robot must be 1e-150 to 1e+150 m long in all, got 1e-160"
    assert sentence in result.output.replace("\n", "")


def test_a_terminal_whose_width_is_not_known(monkeypatch: pytest.MonkeyPatch) -> None:
    command = [sys.executable, "-m", "cdcr", "list"]
    monkeypatch.setenv("COLUMNS", "0")
    assert "step-tension" in subprocess.run(command, capture_output=True, text=True).stdout
