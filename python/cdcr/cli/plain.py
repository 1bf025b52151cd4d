"""What the commands share: options, and errors told in a sentence."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Annotated, Any, NoReturn

import typer

from cdcr.cli import complete, run
from cdcr.files.refusals import os_or_value

INTERRUPTED = 130  # exit code of what Ctrl-C ended

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
        min=1,
        help="Processes of this machine; by default as many as there are processors to use.",
    ),
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object in place of tables.")]


def print_json(table: dict[str, Any]) -> None:
    """Print one JSON object."""
    typer.echo(json.dumps(table, indent=2, allow_nan=False))


def whole(text: str) -> int:
    """Return the whole number that is written, as 1e6 too, or refuse the option."""
    with suppress(ValueError):
        return int(text)
    with suppress(ValueError):
        if (value := float(text)).is_integer() and abs(value) < 2**53:
            return int(value)
    raise typer.BadParameter(f"must be a whole number, got {text!r}")


def end(code: int, sentence: object) -> NoReturn:
    """Say why on stderr, each line a sentence, and end with an exit code."""
    for line in str(sentence).split("\n"):
        typer.echo(f"cdcr: {line}", err=True)
    raise typer.Exit(code) from None


def _warn_plainly(message: Warning | str, *_: object, **__: object) -> None:
    """Show a warning as the sentence it is, without the place in the code it came from."""
    typer.echo(f"cdcr: warning: {message}", err=True)


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
        end(2, os_or_value(error))
