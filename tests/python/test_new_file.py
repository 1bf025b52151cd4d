"""Files that appear whole or not at all: signals, full disks, two writers at once."""

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import cdcr
from cdcr.files import new_file as module
from cdcr.files.new_file import new_file, new_files
from command import everything_in

SECONDS = 60.0  # after which a process that should have ended is taken for stuck

# Writes two files, the second into a folder that is not there yet, and stops before the end.
WRITER = """
import signal, sys
from pathlib import Path
from cdcr.files.new_file import new_files
for number in signal.SIGQUIT, signal.SIGHUP:  # a background job may have inherited them ignored
    signal.signal(number, signal.SIG_DFL)
with new_files([Path("new/out/a.txt"), Path("new/out/b.txt")]) as (a, b):
    a.write_text("whole")
    b.write_text("half")
    print("written", flush=True)
    sys.stdin.readline()
"""
SIGNALS = [signal.SIGTERM, signal.SIGKILL, signal.SIGHUP, signal.SIGQUIT, signal.SIGUSR1]


@pytest.fixture(params=["nameless", "hidden"])
def kind(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    """Files without names, and those of systems that know none."""
    if request.param == "hidden":
        monkeypatch.setattr(module, "_nameless", lambda near: None)
    return str(request.param)


@pytest.mark.parametrize("number", SIGNALS, ids=lambda number: number.name)
def test_no_signal_leaves_anything(tmp_path: Path, number: signal.Signals) -> None:
    command = [sys.executable, "-c", WRITER]
    pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, cwd=tmp_path, **pipes) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "written\n"
        process.send_signal(number)
        assert process.wait(SECONDS) == -number
    assert everything_in(tmp_path) == []


def test_a_folder_that_fills_up_is_named_and_left_as_it_was(tmp_path: Path) -> None:
    """A limit on the size of files ends a write as a full disk does."""
    code = """
import resource
from pathlib import Path
import matplotlib.animation, xarray, h5netcdf  # what Python compiles has to be written before
import numpy as np
import cdcr
model = cdcr.Model(cdcr.robots.amouri2020())
run = cdcr.simulate(model, [0.1, 0], [0, 0], t=np.linspace(0, 0.1, 1001))
resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
for suffix in ("csv", "nc", "gif"):
    try:
        write = run.animate if suffix == "gif" else run.save
        write(Path(f"run.{suffix}"))
    except OSError as error:
        print(error.filename, error.strerror, sep=": ")
try:
    run.model.robot.subdivide(10).save(Path("robot.toml"))
except OSError as error:
    print(error.filename, error.strerror, sep=": ")
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
        timeout=SECONDS,
    )
    lines = done.stdout.splitlines()
    assert [line.split(": ", 1)[1] for line in lines] == ["File too large"] * 4
    for line, name in zip(lines, ("run.csv", "run.nc", "run.gif", "robot.toml"), strict=True):
        assert line.split(": ")[0] in (name, ".")  # some libraries do not say which file
    assert everything_in(tmp_path) == []


@pytest.mark.usefixtures("kind")
def test_of_two_writers_the_first_wins_and_the_second_leaves_nothing(tmp_path: Path) -> None:
    paths = [tmp_path / "out" / name for name in ("a.txt", "b.txt")]
    sentence = r"b\.txt exists already; pass overwrite=True to replace it$"
    with pytest.raises(FileExistsError, match=sentence), new_files(paths) as (a, b):  # noqa: PT012
        a.write_text("mine")
        b.write_text("mine")
        (tmp_path / "out").mkdir()
        paths[1].write_text("theirs")
    assert everything_in(tmp_path) == ["out"]
    assert everything_in(tmp_path / "out") == ["b.txt"]
    assert paths[1].read_text() == "theirs"


def test_sets_of_two_processes_do_not_mix(tmp_path: Path) -> None:
    code = """
import sys
from pathlib import Path
from cdcr.files.new_file import new_files
for _ in range(50):
    with new_files([Path(f"out/{i}") for i in range(8)], overwrite=True) as parts:
        for part in parts:
            part.write_text(sys.argv[1])
"""
    writers = [subprocess.Popen([sys.executable, "-c", code, name], cwd=tmp_path) for name in "ab"]
    assert [writer.wait(SECONDS) for writer in writers] == [0, 0]
    assert everything_in(tmp_path / "out") == [str(i) for i in range(8)]
    assert len({path.read_text() for path in (tmp_path / "out").iterdir()}) == 1


@pytest.mark.usefixtures("kind")
def test_a_file_is_replaced_only_when_told_so_and_never_half(tmp_path: Path) -> None:
    path = tmp_path / "file.txt"
    for text in ("old", "new"):
        with new_file(path, overwrite=text == "new") as part:
            part.write_text(text)
        assert path.read_text() == text
    with pytest.raises(ZeroDivisionError), new_file(path, overwrite=True) as part:  # noqa: PT012
        part.write_text("half")
        raise ZeroDivisionError
    with (
        pytest.raises(FileExistsError, match=r"pass overwrite=True to replace it$"),
        new_file(path),
    ):
        pass
    assert path.read_text() == "new"
    assert everything_in(tmp_path) == ["file.txt"]


@pytest.mark.usefixtures("kind")
def test_a_new_file_has_the_permissions_that_new_files_have(tmp_path: Path) -> None:
    (tmp_path / "plain").touch()
    with new_file(tmp_path / "ours") as part:
        part.write_text("")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_a_folder_that_cannot_be_written_is_found_before_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: Any, flags: int, mode: int = 0) -> int:
        raise OSError(30, os.strerror(30), str(path))

    monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(OSError, match=r"Read-only file system: '.*new/a\.txt'"):
        module.check_files([tmp_path / "new" / "a.txt"])
    assert everything_in(tmp_path) == []


def test_a_path_that_is_none() -> None:
    robot = cdcr.robots.amouri2020()
    run = cdcr.simulate(cdcr.Model(robot), [0, 0], [0, 0], t=[0, 0.1])
    no_path: Any = 5
    for write in (
        run.save,
        robot.save,
        cdcr.Robot.load,
        cdcr.Trajectory.load,
        lambda path: cdcr.export.write_fmu(robot, path),
        lambda path: cdcr.export.write_mjcf(robot, path),
    ):
        with pytest.raises(TypeError, match=r"^path must be the path of a file, got 5 \(int\)$"):
            write(no_path)
