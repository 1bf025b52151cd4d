"""Folders of Zarr appear whole, or nothing of them, whatever ends the process."""

from __future__ import annotations

import errno
import signal
import subprocess
import sys
import time
from contextlib import ExitStack
from pathlib import Path

import pytest

from cdcr.files.new_folder import new_folder

DEADLINE = 60.0  # after which something hangs [s]
WRITE = """
import signal, sys, threading
from pathlib import Path
from cdcr.files.new_folder import new_folder
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
    signal.signal(number, signal.SIG_DFL if number != signal.SIGINT else signal.default_int_handler)
with new_folder(Path(sys.argv[1])) as part:
    part.mkdir()
    (part / ".zgroup").write_text("{}")
    def go_on():  # as a thread of Zarr does
        while True:
            part.mkdir(parents=True, exist_ok=True)
            (part / "0").write_bytes(bytes(8))
    threading.Thread(target=go_on, daemon=True).start()
    print("writing", flush=True)
    threading.Event().wait()
"""


def names(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir()]


def zarr(path: Path, text: str) -> None:
    with new_folder(path, overwrite=True) as part:
        part.mkdir()
        (part / ".zgroup").write_text(text)


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP", "SIGKILL"])
def test_signals_leave_nothing(name: str, tmp_path: Path) -> None:
    command = [sys.executable, "-c", WRITE, str(tmp_path / "ä b.zarr")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"writing\n"
        assert len(list(tmp_path.iterdir())) == 1
        process.send_signal(getattr(signal, name))
        assert process.wait(DEADLINE) == -getattr(signal, name)
    since = time.monotonic()
    while list(tmp_path.iterdir()) and time.monotonic() - since < DEADLINE:
        time.sleep(0.01)
    assert names(tmp_path) == []


def test_a_folder_is_replaced_by_another_of_its_kind_alone(tmp_path: Path) -> None:
    path = tmp_path / "runs.zarr"
    zarr(path, "one")
    zarr(path, "two")
    assert (path / ".zgroup").read_text() == "two"
    assert names(tmp_path) == ["runs.zarr"]
    (path / ".zgroup").rename(path / "notes")
    with pytest.raises(FileExistsError, match=r"runs\.zarr is no folder of Zarr; remove it"):
        zarr(path, "three")
    assert (path / "notes").read_text() == "two"
    with pytest.raises(FileExistsError, match=r"runs\.zarr exists already; pass overwrite=True"):
        new_folder(path).__enter__()
    with pytest.raises(NotADirectoryError, match="notes is a file, not a folder to write to"):
        zarr(path / "notes" / "a.zarr", "four")


def test_somebody_else_was_first(tmp_path: Path) -> None:
    path = tmp_path / "runs.zarr"
    with ExitStack() as stack:
        stack.enter_context(pytest.raises(FileExistsError, match="exists already"))
        stack.enter_context(new_folder(path)).mkdir()
        zarr(path, "other")
    assert (path / ".zgroup").read_text() == "other"
    assert names(tmp_path) == ["runs.zarr"]


def test_errors_name_the_folder(tmp_path: Path) -> None:
    path = tmp_path / "runs.zarr"
    with pytest.raises(OSError, match=r"No space left on device: '.*runs\.zarr'"), new_folder(path):
        raise OSError(errno.ENOSPC, "No space left on device")
    assert names(tmp_path) == []
