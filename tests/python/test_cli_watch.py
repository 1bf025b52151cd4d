"""cdcr run --watch: again after each change, whatever is wrong with the file."""

import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("typer")

from typer.testing import Result

from cdcr.cli import watch
from command import cdcr_, everything_in, refused

FILE = 'robot = "amouri2020"\nt_end = {t_end}\n[output]\nfiles = ["csv"]\n'
DEADLINE = 100.0  # after which something hangs [s]


@pytest.fixture
def watched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Result]:
    """Run a file that changes, as each step says, whenever it is looked at; then comes Ctrl-C."""

    def run(*steps: Callable[[], Any], options: tuple[str, ...] = ()) -> Result:
        left = list(steps)

        def look_later(period: float) -> None:
            assert period >= 0.2  # no busy loop
            if not left:
                raise KeyboardInterrupt
            left.pop(0)()

        monkeypatch.setattr(watch, "sleep", look_later)
        out = ("--out", tmp_path / "out")
        result = cdcr_("run", "--watch", tmp_path / "my.toml", *out, *options)
        assert left == []
        return result

    return run


def nothing() -> None:
    """Let the time pass."""


def test_it_runs_again_after_a_change(tmp_path: Path, watched: Callable[..., Result]) -> None:
    file = tmp_path / "my.toml"
    file.write_text(FILE.format(t_end=0.1))
    result = watched(nothing, lambda: file.write_text(FILE.format(t_end=0.25)), nothing)
    assert result.exit_code == 0
    assert result.stdout.count("my.csv") == 2
    told = [f"cdcr: watching {file}; Ctrl-C ends"] * 2 + [f"cdcr: no longer watching {file}"]
    assert result.stderr.splitlines() == told
    assert (tmp_path / "out" / "my.csv").read_text().splitlines()[-1].startswith("0.25,")


def test_a_file_is_read_when_it_stands_still(
    tmp_path: Path, watched: Callable[..., Result]
) -> None:
    file = tmp_path / "my.toml"
    file.write_text(FILE.format(t_end=0.1))
    half, whole = FILE.format(t_end=0.2)[:20], FILE.format(t_end=0.2)
    result = watched(lambda: file.write_text(half), lambda: file.write_text(whole), nothing)
    assert result.stdout.count("my.csv") == 2
    assert "my.toml, line" not in result.stderr


def test_mistakes_are_told_and_outlived(tmp_path: Path, watched: Callable[..., Result]) -> None:
    file = tmp_path / "my.toml"
    steps = [
        lambda: file.write_text("robot = amouri"),
        nothing,
        file.unlink,
        nothing,
        lambda: file.write_text(FILE.format(t_end=0.1) + "tension = [500, 0, 0]\n"),
        nothing,
        lambda: file.write_text(FILE.format(t_end=0.1)),
        nothing,
    ]
    result = watched(*steps, options=("--quiet",))
    assert (result.exit_code, result.stdout) == (0, "")
    lines = result.stderr.splitlines()
    assert [line.split(" ")[1] for line in lines[:3]] == ["there", f"{file},", "there"]
    assert len(lines) == 4
    assert "my.csv" in everything_in(tmp_path / "out")


def test_files_that_it_names_are_watched_too(
    tmp_path: Path, watched: Callable[..., Result]
) -> None:
    import cdcr

    file, robot = tmp_path / "my.toml", tmp_path / "robot.toml"
    file.write_text(FILE.format(t_end=0.1).replace("amouri2020", "robot.toml"))
    cdcr.robots.amouri2020().save(robot)

    def change() -> None:
        cdcr.robots.amouri2020(damping=0.01).save(robot, overwrite=True)

    assert watched(change, nothing).stdout.count("my.csv") == 2


def test_only_its_own_files_are_replaced(tmp_path: Path, watched: Callable[..., Result]) -> None:
    file = tmp_path / "my.toml"
    file.write_text(FILE.format(t_end=0.1))
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "my.nc").write_text("mine")
    more = FILE.format(t_end=0.1).replace('["csv"]', '["csv", "nc"]')
    result = watched(lambda: file.write_text(more), nothing)
    assert f"{tmp_path / 'out' / 'my.nc'} exist" in result.stderr
    assert (tmp_path / "out" / "my.nc").read_text() == "mine"


def test_a_scenario_of_the_package_does_not_change() -> None:
    told = refused(cdcr_("run", "--watch", "pid"))
    assert told == "--watch needs a scenario file of your own, got 'pid'"


def test_control_c_ends_it_cleanly(tmp_path: Path) -> None:
    file = tmp_path / "my.toml"
    file.write_text(FILE.format(t_end=0.1))
    code = f"""
import signal
from cdcr.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
main(["run", "--watch", {str(file)!r}, "--out", {str(tmp_path / "out")!r}])
"""
    command = [sys.executable, "-c", code]
    with subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as run:
        assert run.stderr is not None
        assert run.stderr.readline() == f"cdcr: watching {file}; Ctrl-C ends\n"
        run.send_signal(signal.SIGINT)
        try:
            _, told = run.communicate(timeout=DEADLINE)
        finally:
            run.kill()
    assert (run.returncode, told) == (0, f"cdcr: no longer watching {file}\n")
