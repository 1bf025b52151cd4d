"""Entry point of the command ``cdcr``; the commands are in ``app``."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from cdcr.base.extras import require


def main(args: Sequence[str] | None = None) -> None:
    """Run the command line; exit codes: 0 fine, 1 run failed, 2 user's mistake, 130 Ctrl-C."""
    try:
        require("typer", "cli")
        require("rich", "cli")
    except ImportError as error:
        print(f"cdcr: {error}", file=sys.stderr)
        sys.exit(2)
    from cdcr.cli.app import app

    app(args=args, prog_name="cdcr")
