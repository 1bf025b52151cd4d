"""What ``cdcr run --watch`` does: run a file again each time that it, or one it names, changes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from time import sleep
from typing import Any, TypeAlias

import typer

from cdcr.cli.plain import INTERRUPTED, told_plainly
from cdcr.cli.run import Mistake, is_scenario_file
from cdcr.files.toml import read_toml

PERIOD = 0.5  # between two looks at the files [s]
_SUFFIXES = (".toml", ".csv")

Seen: TypeAlias = dict[Path, tuple[int, int, int] | None]


def run_and_watch(scenario: str, run_once: Callable[[], None], *, quiet: bool) -> None:
    """Run a scenario file and watch it; what is wrong with it is told, and waits for a change."""
    with told_plainly():
        if not is_scenario_file(scenario):
            raise Mistake(f"--watch needs a scenario file of your own, got {scenario!r}")

    def run() -> None:
        try:
            with told_plainly():
                run_once()
        except typer.Exit as ended:
            if ended.exit_code == INTERRUPTED:
                raise KeyboardInterrupt from None

    def tell(words: str) -> None:
        if not quiet:
            typer.echo(f"cdcr: {words}", err=True)

    with suppress(KeyboardInterrupt):
        watch(Path(scenario), run, tell)
    tell(f"no longer watching {scenario}")


def watch(file: Path, run: Callable[[], None], tell: Callable[[str], object]) -> None:
    """Run, and again after each change, until interrupted.

    A change is waited out: the files must have been the same at two looks, so that none is read
    while it is written. `run` tells its own errors.
    """
    while True:
        before = _seen(file)
        run()
        tell(f"watching {file}; Ctrl-C ends")
        now, last = _seen(file), before
        while now == before or now != last:
            sleep(PERIOD)
            last, now = now, _seen(file)


def _seen(file: Path) -> Seen:
    """Return what tells another content of the file, and of each that it names, from this one."""
    files = [file]
    with suppress(OSError, ValueError):  # of a file half written, or gone
        files += [file.parent / name for name in _named(read_toml(file, "scenario file"))]
    return {one: _mark(one) for one in files}


def _named(value: Any) -> Iterator[str]:
    """Yield the names of files in a table of TOML."""
    if isinstance(value, dict):
        for one in value.values():
            yield from _named(one)
    elif isinstance(value, str) and value.endswith(_SUFFIXES):
        yield value


def _mark(path: Path) -> tuple[int, int, int] | None:
    try:
        about = path.stat()
    except (OSError, ValueError):
        return None
    return about.st_mtime_ns, about.st_size, about.st_ino
