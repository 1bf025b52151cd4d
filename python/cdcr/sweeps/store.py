"""Finished runs of a sweep on disk, a line for each chunk, while others are still computed.

The file stands beside that of the result. Its first line says of which sweep it is, a last line
that is not whole does not count, and one process at a time writes to it.
"""

from __future__ import annotations

import fcntl
import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

from cdcr.files.new_file import REPLACE
from cdcr.sweeps.jobs import Done, Outcome

SUFFIX = ".partial"
# Keys of the first line, as a refusal names what differs.
_NAMES = {
    "version": "another version of cdcr",
    "source": "another scenario",
    "parameters": "other parameters",
    "values": "other values",
    "metrics": "other metrics",
}


def partial_path(path: Path) -> Path:
    """Return where the finished runs of a sweep stand until its file is written."""
    return path.with_name(path.name + SUFFIX)


def differences(one: Mapping[str, Any], other: Mapping[str, Any]) -> str:
    """Return in words in what two sweeps differ; nothing where they are the same."""
    return " and ".join(words for key, words in _NAMES.items() if one.get(key) != other.get(key))


class Store:
    """Finished runs of a sweep; nobody else writes to them."""

    def __init__(self, path: Path, file: BinaryIO, outcomes: dict[int, Outcome]) -> None:
        self.path, self._file, self.outcomes = path, file, outcomes

    def keep(self, done: Done) -> None:
        """Keep a chunk that has been computed."""
        self.outcomes.update(zip(done.numbers, done.outcomes, strict=True))
        _append(self.path, self._file, [done.numbers, done.outcomes])

    def remove(self) -> None:
        """Remove the file, when all runs have another place."""
        self.path.unlink(missing_ok=True)


@contextmanager
def store(path: Path, sweep: Mapping[str, Any], *, overwrite: bool) -> Iterator[Store]:
    """Open the finished runs of a sweep, none at first, and keep others from them meanwhile.

    Raises
    ------
    FileExistsError
        Where another process writes to them, or they are of another sweep and must not be replaced.
    """
    with _alone(path) as file:
        outcomes: dict[int, Outcome] = {}
        whole = _read(path, file, sweep, outcomes, overwrite)
        file.truncate(whole)
        file.seek(whole)
        if not whole:
            _append(path, file, sweep)
        kept = Store(path, file, outcomes)
        try:
            yield kept
        finally:
            if not outcomes:
                kept.remove()


def _append(path: Path, file: BinaryIO, thing: Any) -> None:
    """Write a line, or say of which file it is that it cannot be."""
    try:
        file.write(json.dumps(thing).encode() + b"\n")
        file.flush()
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(path)) from None


@contextmanager
def _alone(path: Path) -> Iterator[BinaryIO]:
    """Open a file, made where missing, that no other process has open so."""
    while True:
        file = os.fdopen(os.open(path, os.O_RDWR | os.O_CREAT, 0o666), "r+b")
        with file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise FileExistsError(
                    f"another sweep is writing to {path}: wait for it, or name another file"
                ) from None
            except OSError:  # a file system without locks
                pass
            if _is_at(path, file):
                yield file
                return


def _is_at(path: Path, file: BinaryIO) -> bool:
    """Whether an open file still has that name, which another sweep may have removed."""
    try:
        return os.path.samestat(path.stat(), os.fstat(file.fileno()))
    except FileNotFoundError:
        return False


def _read(
    path: Path,
    file: BinaryIO,
    sweep: Mapping[str, Any],
    outcomes: dict[int, Outcome],
    overwrite: bool,
) -> int:
    """Read finished runs, and return how many bytes of the file are whole lines of them."""
    first = file.readline()
    if not first:
        return 0
    begun = _parsed(first)
    if not isinstance(begun, dict) or not _NAMES.keys() <= begun.keys():
        raise FileExistsError(f"{path} is no part of a sweep that cdcr has written; remove it")
    different = differences(sweep, begun)
    if different and (overwrite or _parsed(file.readline()) is None):  # none is finished
        return 0
    if different:
        raise FileExistsError(f"{path} holds finished runs of a sweep with {different}; {REPLACE}")
    whole = len(first)
    for line in file:
        found = _chunk(_parsed(line), len(sweep["metrics"]))
        if found is None:
            break
        outcomes.update(found)
        whole += len(line)
    return whole


def _chunk(line: Any, num_metrics: int) -> dict[int, Outcome] | None:
    """Return the outcomes that stand in a line, None where `Store.keep` has not written it."""
    try:
        numbers, ended = line
        found = {
            number: Outcome(tuple(float(value) for value in values), status, message)
            for number, (values, status, message) in zip(numbers, ended, strict=True)
        }
        words = all(isinstance(word, str) for one in ended for word in one[1:])
    except (TypeError, ValueError):
        return None
    whole = all(isinstance(number, int) for number in numbers)
    sizes = all(len(one.values) == num_metrics for one in found.values())
    return found if words and whole and sizes else None


def _parsed(line: bytes) -> Any:
    """Return what stands in a line, None where it is not whole."""
    if not line.endswith(b"\n"):
        return None
    try:
        return json.loads(line)
    except (ValueError, RecursionError):
        return None
