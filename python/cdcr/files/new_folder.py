"""Folders of Zarr that appear whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from cdcr.base.check import require_truth
from cdcr.files.new_file import REPLACE, alone, check_folder

ZARR = (".zgroup", "zarr.json")  # one of which stands in such a folder
_REMOVE = 'read -r word; rm -rf -- "$0"'


@contextmanager
def new_folder(path: Path, *, overwrite: bool = False) -> Iterator[Path]:
    """Yield a path to make a folder of Zarr at, which becomes `path` when all goes well.

    Meanwhile it stands in a hidden folder beside its place. What ends the process before, SIGKILL
    too, leaves nothing of it: a shell waits for that and removes it. Only a folder of Zarr is
    replaced.
    """
    _check(path, overwrite=overwrite)
    try:
        hidden = Path(tempfile.mkdtemp(prefix=f".{path.stem}-", dir=path.parent)).resolve()
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
    guard = _guard(hidden)
    over = True
    try:
        yield hidden / path.name
        with alone(path.parent):
            _check(path, overwrite=overwrite)
            if path.exists():
                path.rename(hidden / f"{path.name}-before")
            (hidden / path.name).rename(path)
    except BaseException as error:
        # Threads of Zarr may still write: the guard then stays as long as this process does.
        over = isinstance(error, Exception) and not isinstance(error, OSError)
        if isinstance(error, OSError) and error.errno is not None and error.filename is None:
            raise OSError(error.errno, os.strerror(error.errno), str(path)) from error
        raise
    finally:
        shutil.rmtree(hidden, ignore_errors=True)
        if guard is not None and over:
            os.close(guard[1])
            os.waitpid(guard[0], 0)


def _check(path: Path, *, overwrite: bool) -> None:
    require_truth("overwrite", overwrite)
    check_folder(path.parent)
    if not os.path.lexists(path):
        return
    if not overwrite:
        raise FileExistsError(f"{path} exists already; {REPLACE}")
    if not any((path / name).exists() for name in ZARR):
        raise FileExistsError(f"{path} is no folder of Zarr; remove it, or name another")


def _guard(folder: Path) -> tuple[int, int] | None:
    """Start a shell that removes a folder once the file returned beside it is closed.

    None where there is no shell. It has a session of its own, so that Ctrl-C does not reach it.
    """
    reading, writing = os.pipe()
    quiet = [(os.POSIX_SPAWN_OPEN, out, os.devnull, os.O_WRONLY, 0) for out in (1, 2)]
    try:
        with suppress(OSError, NotImplementedError):
            shell = os.posix_spawnp(
                "sh",
                ["sh", "-c", _REMOVE, str(folder)],
                os.environ,
                file_actions=[(os.POSIX_SPAWN_DUP2, reading, 0), *quiet],
                setsid=True,
            )
            return shell, writing
    finally:
        os.close(reading)
    os.close(writing)
    return None
