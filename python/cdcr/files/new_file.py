"""Files that appear whole or not at all."""

from __future__ import annotations

import errno
import fcntl
import os
import secrets
import signal
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from os import PathLike
from pathlib import Path

from cdcr.base.check import format_value, require_truth

MAX_NAMED = 4  # files named in one sentence
REPLACE = "pass overwrite=True to replace it"
_PROCESSES = "/proc"  # where Linux shows the open files of each


def file_path(path: str | PathLike[str]) -> Path:
    """Return a path as one, or refuse what is none."""
    if isinstance(path, str | PathLike):
        if "\0" in str(path):
            raise ValueError(f"path must be the path of a file, got {format_value(str(path))}")
        return Path(path)
    raise TypeError(f"path must be the path of a file, got {format_value(path)}")


def check_folder(folder: Path) -> None:
    """Refuse a folder that is not there to write to."""
    if not folder.is_dir():
        _refuse_file(folder)
        raise FileNotFoundError(f"the folder {folder} does not exist; make it first")


def _refuse_file(folder: Path) -> None:
    """Refuse a folder that is a file, or would be in one."""
    for one in (folder, *folder.parents):
        if one.exists() and not one.is_dir():
            raise NotADirectoryError(f"{one} is a file, not a folder to write to")


@contextmanager
def new_file(path: Path, *, overwrite: bool = False, replace: str = REPLACE) -> Iterator[Path]:
    """Yield a path to write to; what is written becomes `path`, in a folder that exists."""
    check_folder(path.parent)
    with new_files([path], overwrite=overwrite, replace=replace) as (part,):
        yield part


@contextmanager
def new_files(
    paths: Sequence[Path], *, overwrite: bool = False, replace: str = REPLACE
) -> Iterator[list[Path]]:
    """Yield a path to write to for each of several in one folder, which is made where missing.

    The files get their names together when all goes well, or, where somebody else has taken one
    meanwhile, none does. Until then they have none, so that nothing is left of them whatever ends
    the process. On a file system that cannot do this they have hidden names, and a signal that
    ends Python at once, such as SIGKILL, leaves these. `replace` says in a refusal how files are
    replaced.
    """
    check_files(paths, overwrite=overwrite, replace=replace)
    folder = paths[0].parent
    parts: dict[str, Path] = {}
    try:
        with ExitStack() as stack:
            for path in paths:
                parts[str(stack.enter_context(_part(path)))] = path
            yield [Path(part) for part in parts]
            _place(parts, overwrite, replace)
    except OSError as error:  # of a part, or of a library that does not say of what
        what = parts.get(str(error.filename)) if error.filename else folder
        if error.errno is None or what is None:
            raise
        raise OSError(error.errno, os.strerror(error.errno), str(what)) from error


def check_files(paths: Sequence[Path], *, overwrite: bool = False, replace: str = REPLACE) -> None:
    """Refuse what would stop `new_files`, as far as it is known before."""
    _check(paths, overwrite, replace)
    with _part(paths[0]):
        pass


def _check(paths: Sequence[Path], overwrite: bool, replace: str) -> None:
    require_truth("overwrite", overwrite)
    _refuse_file(paths[0].parent)
    for path in paths:
        if path.is_dir():
            raise IsADirectoryError(f"{path} is a folder, not a file")
    existing = [str(path) for path in paths if os.path.lexists(path)]
    if existing and not overwrite:
        named = existing if len(existing) <= MAX_NAMED else [existing[0], "and others"]
        exist = "exists" if len(existing) == 1 else "exist"
        raise FileExistsError(f"{', '.join(named)} {exist} already; {replace}")


@contextmanager
def _part(path: Path) -> Iterator[Path]:
    """Yield a path to a new file without a name that can become `path`, or with a hidden one."""
    near = next(one for one in path.absolute().parents if one.is_dir())
    hidden = _hidden(near / path.name)
    try:
        file = _nameless(near)
        if file is None:
            hidden.touch(exist_ok=False)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None
    if file is not None:
        try:
            yield Path(f"{_PROCESSES}/{os.getpid()}/fd/{file}")
        finally:
            os.close(file)
        return
    try:
        yield hidden
    finally:
        hidden.unlink(missing_ok=True)


def _nameless(near: Path) -> int | None:
    """Open a file without a name in a folder; None on a system that knows no such files."""
    flag = getattr(os, "O_TMPFILE", None)
    if flag is None or not Path(f"{_PROCESSES}/self/fd").is_dir():
        return None
    try:
        return os.open(near, flag | os.O_RDWR, 0o666)
    except OSError as error:
        if error.errno in (errno.EINVAL, errno.EISDIR, errno.EOPNOTSUPP):
            return None
        raise


def _hidden(path: Path) -> Path:
    return path.with_name(f".{path.stem}-{secrets.token_hex(4)}{path.suffix}")


def _place(parts: dict[str, Path], overwrite: bool, replace: str) -> None:
    """Give the parts their names, in one go as seen by others who do this and by signals."""
    paths = list(parts.values())
    folder = paths[0].parent
    made = [one for one in (folder, *folder.parents) if not one.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    placed: list[Path] = []
    with alone(folder):
        try:
            _check(paths, overwrite, replace)
            for part, path in parts.items():
                _give_name(part, path, overwrite)
                placed.append(path)
        except BaseException:
            for path in placed if not overwrite else ():
                path.unlink()
            with suppress(OSError):  # somebody else may have put something there
                for one in made:
                    one.rmdir()
            raise


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Keep out others who write to a folder here, and then signals."""
    lock = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):  # file systems without locks
            fcntl.flock(lock, fcntl.LOCK_EX)
        before = signal.pthread_sigmask(signal.SIG_BLOCK, signal.valid_signals())
        try:
            yield
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
    finally:
        os.close(lock)


def _give_name(part: str, path: Path, overwrite: bool) -> None:
    if not part.startswith(f"{_PROCESSES}/"):
        Path(part).replace(path)
        return
    name = _hidden(path) if overwrite else path
    # Python follows the link in /proc only where it is given a folder, which goes unused here.
    os.link(part, name, src_dir_fd=0, follow_symlinks=True)
    if overwrite:
        try:
            name.replace(path)
        finally:
            name.unlink(missing_ok=True)
