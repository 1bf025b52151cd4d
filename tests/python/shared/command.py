"""The command line, called within the process, and what it did."""

from __future__ import annotations

import os
from pathlib import Path

from typer.testing import CliRunner, Result

from cdcr.cli.app import app


def cdcr_(*args: object) -> Result:
    return CliRunner().invoke(app, [str(arg) for arg in args])


def everything_in(folder: Path) -> list[str]:
    return sorted(os.listdir(folder))  # noqa: PTH208 - hidden files count


def refused(result: Result) -> str:
    """The only line on stderr of a command that was refused."""
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    (line,) = result.stderr.splitlines()
    assert line.startswith("cdcr: ")
    return line.removeprefix("cdcr: ")
