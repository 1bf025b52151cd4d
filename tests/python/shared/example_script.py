"""An example as the tests run it."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from typing import Any

import pytest

FOLDER = Path(__file__).parents[3] / "examples"
FEWEST_BYTES = 10_000  # of a picture with something on it


class Example:
    """Runs an example and keeps its names, its picture and what it prints."""

    def __init__(self, picture: Path, capsys: pytest.CaptureFixture[str]) -> None:
        self.picture, self.capsys = picture, capsys

    def __call__(self, number: int) -> dict[str, Any]:
        (script,) = FOLDER.glob(f"{number:02}_*.py")
        sys.argv = [str(script), str(self.picture)]
        names = runpy.run_path(str(script))
        findings = self.capsys.readouterr().out.splitlines()
        assert len(findings) >= 2
        assert self.picture.read_bytes().startswith(b"\x89PNG")
        assert self.picture.stat().st_size > FEWEST_BYTES
        return names
