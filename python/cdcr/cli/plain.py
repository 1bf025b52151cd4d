"""What the commands share: options, and errors told in a sentence."""

from __future__ import annotations

import json
import math
import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Annotated, Any, NoReturn

import typer

from cdcr.base import decimals
from cdcr.cli import complete, run
from cdcr.files.refusals import os_or_value

INTERRUPTED = 130  # exit code of what Ctrl-C ended


def number(text: object) -> float:
    """Return the number that is written, or refuse the option."""
    value = decimals.number(str(text))  # a default is a number already
    if math.isnan(value):
        raise typer.BadParameter(f"must be a number such as 0.5 or 1e-3, got {text!r}")
    return value


def whole_from(low: int | None = None, high: int | None = None) -> Callable[[object], int]:
    """Return what reads a whole number from `low` to `high`, as 1e6 too, or refuses the option."""
    allowed = "" if low is None else f" >= {low}" if high is None else f" {low} to {high}"

    def whole(text: object) -> int:
        value = decimals.whole(str(text))
        if (
            value is None
            or (low is not None and value < low)
            or (high is not None and value > high)
        ):
            raise typer.BadParameter(f"must be a whole number{allowed}, got {text!r}")
        return value

    return whole


whole = whole_from()

Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace files that are there.")]

Size = Annotated[
    str | None,
    typer.Option(
        metavar="SIZE",
        help="Of pictures and films: journal (8.5 cm wide), slide (16:9), or WIDTHxHEIGHT in cm.",
        autocompletion=complete.sizes,
    ),
]
Scenario = Annotated[
    str,
    typer.Argument(
        metavar="NAME|FILE.toml",
        help="A scenario from `cdcr list` or a file of your own.",
        autocompletion=complete.scenarios,
    ),
]
Robot = Annotated[
    str,
    typer.Argument(
        metavar="ROBOT|FILE.toml",
        help="A name from `cdcr list` or a file.",
        autocompletion=complete.robots,
    ),
]
Jobs = Annotated[
    int | None,
    typer.Option(
        metavar="NUMBER",
        parser=whole_from(1),
        help="Processes of this machine; by default as many as there are processors to use.",
    ),
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object in place of tables.")]


def print_json(table: dict[str, Any]) -> None:
    """Print one JSON object."""
    typer.echo(json.dumps(table, indent=2, allow_nan=False))


def end(code: int, sentence: object) -> NoReturn:
    """Say why on stderr, each line a sentence, and end with an exit code."""
    for line in str(sentence).split("\n"):
        typer.echo(f"cdcr: {line}", err=True)
    raise typer.Exit(code) from None


def _warn_plainly(message: Warning | str, *_: object, **__: object) -> None:
    """Show a warning as the sentence it is, without the place in the code it came from."""
    typer.echo(f"cdcr: warning: {message}", err=True)


def _forget_what_is_printed() -> None:
    """Where stdout can no more be written, keep Python from trying again when it ends."""
    try:
        sys.stdout.flush()
    except OSError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


@contextmanager
def told_plainly() -> Iterator[None]:
    """Turn what users can mend into a sentence on stderr and an exit code, without a traceback."""
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _warn_plainly
            yield
    except KeyboardInterrupt:
        end(INTERRUPTED, "interrupted, no file was written")
    except run.RunFailed as failure:
        end(1, failure)
    except (run.Mistake, ImportError) as error:
        end(2, error)
    except OSError as error:
        _forget_what_is_printed()
        end(2, os_or_value(error))
