"""The scripts of validation/ as modules, and small files of numbers in the formats they read."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("scipy")
HERE = Path(__file__).resolve().parents[3] / "validation"
if not HERE.is_dir():
    pytest.skip("validation/ is not beside the tests", allow_module_level=True)
sys.path.insert(0, str(HERE))
agotelli: Any = import_module("agotelli")
catheter: Any = import_module("catheter")
common: Any = import_module("common")
ftdcr: Any = import_module("ftdcr")
loaded_shapes: Any = import_module("loaded_shapes")
sorosim: Any = import_module("sorosim")
three_codes: Any = import_module("three_codes")
trunk: Any = import_module("trunk")
sys.path.remove(str(HERE))


def write(path: Path, header: list[str] | None, rows: Any, split: str = ",") -> Path:
    """Write a file of numbers to all their digits."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [split.join(header)] if header else []
    lines += [split.join(repr(float(value)) for value in row) for row in rows]
    path.write_text("\n".join(lines) + "\n")
    return path
