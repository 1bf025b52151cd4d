"""Text files that people write: ordinary files of UTF-8, no larger than such a file can be."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

MAX_MEGABYTES = 1000
_HDF5 = b"\x89HDF\r\n\x1a\n"  # with which files of netCDF-4 begin


def read_text(path: Path, what: str) -> str:
    """Return the text of a file; `what` names it in refusals, as in 'robot file'.

    A byte-order mark at its start is no part of the text.

    Raises
    ------
    FileNotFoundError
        Where there is no such file.
    ValueError
        Where it is a folder, a pipe or a device, is too large, or holds what is no text.
    """
    if "\0" in str(path):
        raise ValueError(f"{str(path)!r} is no name of a {what}")
    if path.is_dir():
        raise ValueError(f"{path} is a folder, not a {what}")
    if path.exists() and not path.is_file():
        raise ValueError(f"{path} is a pipe or a device, not a {what}")
    try:
        with path.open("rb") as file:
            data = file.read(MAX_MEGABYTES * 10**6 + 1)
    except FileNotFoundError:
        raise FileNotFoundError(f"there is no {what} {path}") from None
    if len(data) > MAX_MEGABYTES * 10**6:
        raise ValueError(f"{path} must have at most {MAX_MEGABYTES} MB, and has more")
    if data.startswith(_HDF5):
        raise ValueError(f"{path} is a netCDF file, not a {what}: `cdcr view` plays a run")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        _refuse(path, data, error.start)
    if "\0" in text:
        _refuse(path, data, data.index(0))
    return text


def _refuse(path: Path, data: bytes, at: int) -> None:
    line = data[:at].count(b"\n") + 1
    raise ValueError(f"{path}, line {line}: not UTF-8 text")
