"""Files that appear whole or not at all."""

from __future__ import annotations

import secrets
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path


@contextmanager
def new_file(path: Path, *, overwrite: bool = False) -> Iterator[Path]:
    """Yield a path beside `path` to write to; it becomes `path` only if all goes well.

    Whatever interrupts the writing, Ctrl-C included, leaves neither a half-written file nor the
    temporary one.
    """
    _check_target(path, overwrite)
    partial = path.with_name(f".{path.stem}-{secrets.token_hex(4)}{path.suffix}")
    try:
        yield partial
        _check_target(path, overwrite)  # somebody else may have written it meanwhile
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


@contextmanager
def new_files(paths: Sequence[Path], *, overwrite: bool = False) -> Iterator[list[Path]]:
    """Yield a path to write to for each of several in one folder; they become these together.

    The folder is made where it is missing, and goes again where something fails.
    """
    folder = paths[0].parent
    made = [one for one in (folder, *folder.parents) if not one.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    try:
        with ExitStack() as stack:
            yield [stack.enter_context(new_file(path, overwrite=overwrite)) for path in paths]
    except BaseException:
        with suppress(OSError):  # somebody else may have put something there
            for one in made:
                one.rmdir()
        raise


def _check_target(path: Path, overwrite: bool) -> None:
    if not path.parent.is_dir():
        raise FileNotFoundError(f"the folder {path.parent} does not exist; make it first")
    if path.is_dir():
        raise IsADirectoryError(f"{path} is a folder, not a file")
    if path.exists() and not overwrite:
        raise FileExistsError(f"{path} exists already; pass overwrite=True to replace it")
