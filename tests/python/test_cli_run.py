"""The command run: its files, its summary, and its care when something goes wrong."""

import csv
import io
import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.runs.simulate import DEFAULT_METHOD

pytest.importorskip("typer")
pytest.importorskip("matplotlib")
pytest.importorskip("h5netcdf")

from rich.console import Console
from typer.testing import Result

from cdcr.cli import run as cli_run
from cdcr.scenarios.file.reader import load_scenario
from command import cdcr_, everything_in, refused

FILES = ["step-tension.png", "step-tension.csv", "step-tension.nc"]
# 500 N bends the robot beyond the largest angle within a fraction of a second.
TOO_STRONG = (
    'robot = "amouri2020"\nt_end = 1\nintegrator.method = "dopri5"\ntension = [500, 0, 0]\n'
)


@pytest.fixture(scope="module")
def first(tmp_path_factory: Any) -> tuple[Path, Result]:
    out = tmp_path_factory.mktemp("demo") / "new" / "out"
    return out, cdcr_("run", "step-tension", "--out", out)


def test_run_writes_three_files_and_says_so(first: tuple[Path, Result]) -> None:
    out, result = first
    assert result.exit_code == 0, result.output
    assert result.stderr == ""
    assert everything_in(out) == sorted(FILES)
    for name in FILES:
        assert f"wrote {out / name}" in result.stdout
    assert (out / FILES[0]).read_bytes().startswith(b"\x89PNG")
    with (out / FILES[1]).open(newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0][0] == "t [s]"
    assert len(rows) == 1002
    import xarray

    with xarray.open_dataset(out / FILES[2], engine="h5netcdf") as data:
        np.testing.assert_array_equal(data.time, np.linspace(0.0, 10.0, 1001))


def test_run_prints_its_findings(first: tuple[Path, Result]) -> None:
    _, result = first
    scenario = cdcr.scenarios.get("step-tension")
    for metric in scenario.summary(scenario.simulate()):
        assert metric.label in result.stdout
    words = result.stdout.split()
    for word in ("14.9778", "29.9555", "0.6892", "deg", "steps", DEFAULT_METHOD, "(dop853),", "ms"):
        assert word in words


def test_existing_files_are_listed_before_the_run_and_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "step-tension.csv").write_text("mine")
    monkeypatch.setattr(cdcr.scenarios.Scenario, "simulate", None)  # a run would fail
    one = refused(cdcr_("run", "step-tension", "--out", tmp_path))
    assert one == (
        f"{tmp_path / 'step-tension.csv'} exists already; "
        "give --overwrite to replace, or another folder with --out"
    )
    (tmp_path / "step-tension.nc").write_text("mine too")
    two = refused(cdcr_("run", "step-tension", "--out", tmp_path))
    assert two.startswith(f"{tmp_path / 'step-tension.csv'}, {tmp_path / 'step-tension.nc'} exist ")
    assert everything_in(tmp_path) == ["step-tension.csv", "step-tension.nc"]
    assert (tmp_path / "step-tension.csv").read_text() == "mine"


@pytest.mark.usefixtures("quick")
def test_overwrite_replaces(tmp_path: Path) -> None:
    (tmp_path / "step-tension.csv").write_text("old")
    args = ("run", "step-tension", "--out", tmp_path, "--t-end", 0.1, "--overwrite")
    assert cdcr_(*args).exit_code == 0
    assert cdcr_(*args).exit_code == 0
    assert (tmp_path / "step-tension.csv").read_text().startswith("t [s]")
    assert everything_in(tmp_path) == sorted(FILES)


@pytest.mark.usefixtures("quick")
def test_json_is_one_object_and_nothing_else(tmp_path: Path) -> None:
    options = ("--method", "dopri5", "--t-end", 2, "--rtol", 1e-6, "--atol", 1e-8)
    result = cdcr_("run", "step-tension", "--json", "--out", tmp_path, *options)
    assert result.exit_code == 0
    assert result.stderr == ""
    told = json.loads(result.stdout)
    run = cdcr.scenarios.get("step-tension").simulate(
        method="dopri5", t_end=2.0, rtol=1e-6, atol=1e-8
    )
    assert told["scenario"] == "step-tension"
    assert told["method"] == "dopri5"
    assert (told["success"], told["status"], told["message"]) == (True, "ok", "")
    assert (told["t_end"], told["num_samples"]) == (2.0, 201)
    assert told["stats"]["steps"] == run.stats.steps
    assert told["findings"]["theta_max_deg"] == float(np.rad2deg(run.theta.max()))
    assert told["wall_time_s"] > 0.0
    assert told["files"] == [str(tmp_path / name) for name in FILES]
    sections = [cdcr.Section(**one) for one in told["robot"].pop("sections")]
    assert cdcr.Robot(sections=sections, **told["robot"]) == cdcr.robots.amouri2020()


@pytest.mark.usefixtures("quick")
def test_a_users_file_is_named_after_it(tmp_path: Path) -> None:
    path = tmp_path / "two cables.toml"
    path.write_text('robot = "amouri2020"\nt_end = 0.2\ntension = [1, 1, 0]\n')
    out = tmp_path / "out"
    result = cdcr_("run", path, "--out", out)
    assert result.exit_code == 0, result.output
    assert everything_in(out) == ["two cables.csv", "two cables.nc", "two cables.png"]


@pytest.mark.usefixtures("quick")
def test_a_known_name_wins_over_a_file_of_that_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "step-tension").write_text("not TOML")
    assert cdcr_("run", "step-tension", "--t-end", 0.1).exit_code == 0
    assert everything_in(tmp_path / "out") == sorted(FILES)


def test_an_output_folder_that_is_a_file(tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.write_text("mine")
    sentence = f"{out} is a file, not a folder to write to"
    assert refused(cdcr_("run", "step-tension", "--out", out)) == sentence


def test_an_error_of_the_system_names_file_and_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def no_room(self: object, run: object, **_: object) -> None:
        raise OSError(28, "No space left on device", "disk")

    monkeypatch.setattr(cdcr.scenarios.Scenario, "figure", no_room)
    out = tmp_path / "out"
    sentence = "disk: No space left on device"
    assert refused(cdcr_("run", "step-tension", "--out", out, "--t-end", 0.1)) == sentence
    assert everything_in(tmp_path) == []


def test_our_own_mistakes_are_not_taken_for_the_users(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def bug(self: object, run: object, **_: object) -> None:
        raise ValueError("a bug")

    monkeypatch.setattr(cdcr.scenarios.Scenario, "figure", bug)
    result = cdcr_("run", "step-tension", "--out", tmp_path / "out", "--t-end", 0.1)
    assert isinstance(result.exception, ValueError)
    assert everything_in(tmp_path) == []


@pytest.mark.parametrize("as_json", [False, True])
def test_a_failed_run_exits_with_1_and_keeps_what_it_has(tmp_path: Path, as_json: bool) -> None:
    path, out = tmp_path / "strong.toml", tmp_path / "out"
    path.write_text(TOO_STRONG)
    result = cdcr_("run", path, "--out", out, *(["--json"] if as_json else []))
    assert result.exit_code == 1
    run = load_scenario(path).simulate()
    files = [str(out / f"strong-incomplete.{suffix}") for suffix in ("csv", "nc")]
    kept = ", ".join(files)
    assert result.stderr == f"cdcr: {run.message} What was reached is in {kept}.\n"
    assert everything_in(out) == ["strong-incomplete.csv", "strong-incomplete.nc"]
    for file in files:
        again = cdcr.Trajectory.load(file, model=run.model)
        np.testing.assert_array_equal(again.q, run.q)
    assert (again.status, again.message) == (run.status, run.message)
    if as_json:
        told = json.loads(result.stdout)
        assert (told["success"], told["status"]) == (False, "bending_limit")
        assert told["message"]
        assert (told["files"], told["findings"]) == (files, {})
    else:
        assert "steps" in result.stdout
        assert result.stdout.count("wrote") == 2
    # The next attempt replaces them, without --overwrite: they are no results.
    assert cdcr_("run", path, "--out", out).exit_code == 1


def test_too_few_steps_fail_with_what_to_try(tmp_path: Path) -> None:
    result = cdcr_("run", "step-tension", "--out", tmp_path, "--max-steps", 10)
    assert result.exit_code == 1
    assert "raise --max-steps. Or loosen --rtol and --atol." in result.stderr
    assert "bdf" not in result.stderr  # the method it ran by
    assert everything_in(tmp_path) == [f"step-tension-incomplete.{s}" for s in ("csv", "nc")]


def test_ctrl_c_while_integrating(tmp_path: Path) -> None:
    """The signal itself, in a process of its own."""
    code = """
import os, signal
from cdcr.cli import run as cli_run
from cdcr.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
cli_run.DelayedBar.__call__ = lambda self, done: os.kill(os.getpid(), signal.SIGINT)
main(["run", "step-tension", "--out", "new/out", "--t-end", "1000"])
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, check=False
    )
    assert done.returncode == 130
    assert (done.stdout, done.stderr) == ("", "cdcr: interrupted, no file was written\n")
    assert everything_in(tmp_path) == []


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("when", ["figure", "write_run"])
def test_ctrl_c_while_writing_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, when: str
) -> None:
    def interrupted(*args: object, **kwargs: object) -> None:
        raise KeyboardInterrupt

    owner: object = cdcr.scenarios.Scenario if when == "figure" else cli_run
    monkeypatch.setattr(owner, when, interrupted)
    old = tmp_path / "old"
    old.mkdir()
    (old / "step-tension.png").write_text("old")
    for out in (old, tmp_path / "new" / "out"):
        result = cdcr_("run", "step-tension", "--out", out, "--t-end", 0.1, "--overwrite")
        assert result.exit_code == 130
        assert result.stderr == "cdcr: interrupted, no file was written\n"
    assert everything_in(tmp_path) == ["old"]
    assert everything_in(old) == ["step-tension.png"]
    assert (old / "step-tension.png").read_text() == "old"


@pytest.mark.parametrize(
    ("delay", "terminal", "shown"), [(0.0, True, True), (1e9, True, False), (0.0, False, False)]
)
def test_progress_is_shown_on_long_runs_at_a_terminal(
    monkeypatch: pytest.MonkeyPatch, delay: float, terminal: bool, shown: bool
) -> None:
    monkeypatch.setattr(cli_run, "BAR_DELAY", delay)
    monkeypatch.setenv("TERM", "xterm")  # a dumb one has no bar
    screen = io.StringIO()
    console = Console(file=screen, force_terminal=terminal, width=80)
    with cli_run.DelayedBar(console, "step-tension", 10.0) as bar:
        bar(5.0)
    assert ("step-tension" in screen.getvalue()) is shown
    assert ("50%" in screen.getvalue()) is shown
    assert bool(screen.getvalue()) is shown


def test_progress_tells_time_simulated_and_how_fast(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    clock = iter([0.0, 2.0, 2.0, 4.0, 4.0])
    monkeypatch.setattr("cdcr.cli.run.time.monotonic", lambda: next(clock))
    screen = io.StringIO()
    console = Console(file=screen, force_terminal=True, width=120)
    with cli_run.DelayedBar(console, "step-tension", 40.0, real=True) as bar:
        bar(10.0)
        bar(30.0)
    shown = screen.getvalue()
    assert "30 of 40 s, 7.5 times real time" in shown
    assert " left" in shown


@pytest.mark.usefixtures("quick")
def test_quiet_prints_nothing_but_errors(tmp_path: Path) -> None:
    args = ("run", "step-tension", "--out", tmp_path, "--t-end", 0.1, "--quiet")
    result = cdcr_(*args)
    assert (result.exit_code, result.output) == (0, "")
    assert everything_in(tmp_path) == sorted(FILES)
    assert refused(cdcr_(*args)).endswith(
        "give --overwrite to replace, or another folder with --out"
    )
    loud = cdcr_(*args, "--overwrite", "--json")
    assert json.loads(loud.stdout)["t_end"] == 0.1


def test_wrong_options_are_told_before_files_that_exist(tmp_path: Path) -> None:
    (tmp_path / "step-tension.png").write_text("mine")
    wrong = refused(cdcr_("run", "step-tension", "--out", tmp_path, "--method", "euler"))
    assert wrong.startswith("--method must be")
    there = refused(cdcr_("run", "step-tension", "--out", tmp_path))
    assert there.endswith("give --overwrite to replace, or another folder with --out")


def test_a_folder_that_cannot_be_written_is_found_before_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def ran(*args: object, **kwargs: object) -> None:
        pytest.fail("it ran")

    monkeypatch.setattr(cdcr.scenarios.Scenario, "simulate", ran)
    # No folder can be made in /proc, by nobody.
    told = refused(cdcr_("run", "step-tension", "--out", "/proc/cdcr"))
    assert told.startswith("/proc/cdcr/step-tension.png: ")


@pytest.mark.parametrize("args", [["list"], ["info", "amouri2020"], ["audit"]])
def test_a_terminal_of_few_characters_shows_what_it_can(args: list[str]) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "cdcr", *args],
        env=os.environ | {"PYTHONIOENCODING": "latin-1"},
        capture_output=True,
        check=False,
        timeout=120.0,
    )
    assert (done.returncode, done.stderr) == (0, b"")


def test_terminating_a_run_ends_it_and_leaves_nothing(tmp_path: Path) -> None:
    code = """
import os, signal
from cdcr.cli import run as cli_run
from cdcr.cli import main
cli_run.DelayedBar.__call__ = lambda self, done: os.kill(os.getpid(), signal.SIGTERM)
main(["run", "step-tension", "--out", "new/out", "--t-end", "1000"])
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        check=False,
        timeout=120.0,
    )
    assert (done.returncode, done.stdout) == (128 + signal.SIGTERM, "")
    assert everything_in(tmp_path) == []
