"""Entry point of the command ``cdcr``; the commands are in ``app``."""

from __future__ import annotations

import io
import os
import signal
import sys
from collections.abc import Sequence

from cdcr.base.extras import require


def main(args: Sequence[str] | None = None) -> None:
    """Run the command line.

    Exit codes: 0 fine, 1 run failed, 2 user's mistake, 128 and its number for a signal.
    """
    try:
        require("typer", "cli")
        require("rich", "cli")
    except ImportError as error:
        print(f"cdcr: {error}", file=sys.stderr)
        sys.exit(2)
    from cdcr.cli.app import app

    if os.environ.get("COLUMNS") == "0":  # a width that is not known, of which nothing would show
        del os.environ["COLUMNS"]
    for stream in (sys.stdout, sys.stderr):  # what a terminal cannot show is a question mark
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    for number in (signal.SIGTERM, signal.SIGHUP):  # end as an error does, past what is to be done
        if signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _end)

    app(args=args, prog_name="cdcr")


def _end(number: int, frame: object) -> None:
    sys.exit(128 + number)
