"""Logs of closed loops that C++ writes while they run."""

from __future__ import annotations

import fcntl
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import BinaryIO, NoReturn

from cdcr.base.check import Check, require_kind
from cdcr.base.keywords import by_keyword
from cdcr.files.new_file import REPLACE, check_files, check_folder, file_path
from cdcr.runs.loop import Loop

MOST_ROWS = 2**24


@by_keyword
class LoopLog:
    """Writes each step of a loop to a file, from a thread that the loop never waits for.

    Rows go through a ring between the two: one for which there is no room is dropped and counted.
    The file can be read while it grows. To be used in a ``with`` statement, or closed.

    Parameters
    ----------
    loop : Loop
        Whose further steps are written, those by `Loop.run` too.
    path : path-like
        The file: ``.csv``, with the columns of `Trajectory.save` and more; ``.npy``, an array of
        records for `numpy.load`; or ``.mcap``, with a topic each for state, tension, tip, sensors,
        estimate, reference and timing.
    capacity : int, default 8192
        Room for rows on their way.
    overwrite : bool, default False
        Whether an existing file may be replaced.

    Raises
    ------
    ValueError
        For another suffix, and a loop that writes a log already.
    FileExistsError
        If the file exists and ``overwrite`` is false, or another log is written to it.
    RuntimeError
        At its end, where the file could not be written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> loop = cdcr.Loop(model, cdcr.ComputedTorque(model))
    >>> loop.reset([0.1, 0.0], [0.0, 0.0])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "loop.npy"
    ...     with cdcr.LoopLog(loop, path) as log:
    ...         for _ in range(100):
    ...             status = loop.step()
    ...     rows = np.load(path)
    >>> log.dropped, len(rows), rows["q1_x"][0].item()
    (0, 100, 0.1)
    """

    def __init__(
        self,
        loop: Loop,
        path: str | PathLike[str],
        *,
        capacity: int = 8192,
        overwrite: bool = False,
    ) -> None:
        require_kind("loop", loop, Loop)
        check = Check()
        rows = check.whole(
            "capacity", capacity, f"a whole number 1 to {MOST_ROWS}", low=1, high=MOST_ROWS
        )
        check.done()
        file = file_path(path)
        if file.suffix not in (".csv", ".npy", ".mcap"):
            raise ValueError(f"the file name must end in .csv, .npy or .mcap, got {file.name!r}")
        check_folder(file.parent)
        check_files([file], overwrite=overwrite)
        made = not file.exists()
        self._claim = _claimed(file, overwrite=overwrite)
        try:
            loop._open_log(str(file), rows)
        except BaseException:
            self._claim.close()
            if made:
                file.unlink()
            raise
        self._loop = loop
        self._file = file
        self._dropped: int | None = None  # once it is closed

    @property
    def path(self) -> Path:
        """The file."""
        return self._file

    @property
    def dropped(self) -> int:
        """Rows for which there was no room [1]."""
        return self._loop._dropped() if self._dropped is None else self._dropped

    def close(self) -> None:
        """Write what is left and end the log.

        Raises
        ------
        RuntimeError
            Where the file could not be written.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> loop = cdcr.Loop(model, cdcr.ComputedTorque(model))
        >>> loop.reset([0.1, 0.0], [0.0, 0.0])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     log = cdcr.LoopLog(loop, Path(folder) / "loop.csv")
        ...     status = loop.step()
        ...     log.close()
        ...     lines = log.path.read_text().splitlines()
        >>> len(lines)
        2
        """
        if self._dropped is None:
            self._dropped = self._loop._dropped()
            try:
                self._loop._close_log()
            finally:
                self._claim.close()

    def __reduce__(self) -> NoReturn:
        """Refuse: a file has one log."""
        raise TypeError("a cdcr LoopLog can be neither pickled nor copied: it writes to a file")

    def __repr__(self) -> str:
        """Return the file, and whether it is open."""
        state = "open" if self._dropped is None else "closed"
        return f"<LoopLog to {self._file}, {state}, {self.dropped} rows dropped>"

    def __enter__(self) -> LoopLog:
        """Return itself, which is open."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close it."""
        self.close()


def _claimed(file: Path, *, overwrite: bool) -> BinaryIO:
    """Open a file that nobody else logs to; it is made here unless it may be replaced."""
    if file.exists() and not file.is_file():
        raise ValueError(f"{file} is a pipe or a device, not a file to write to")
    try:
        opened = file.open("ab" if overwrite else "xb")
    except FileExistsError:  # since a moment ago
        raise FileExistsError(f"{file} exists already; {REPLACE}") from None
    try:
        fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        opened.close()
        raise FileExistsError(f"another log is written to {file}; close it first") from None
    except OSError:  # a file system without locks
        pass
    return opened
