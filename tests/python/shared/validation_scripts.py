"""The scripts of validation/ as modules, and small files of numbers in the formats they read."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("scipy")
HERE = Path(__file__).resolve().parents[3] / "validation"
if not HERE.is_dir():
    pytest.skip("validation/ is not beside the tests", allow_module_level=True)
sys.path.insert(0, str(HERE))
import agotelli as agotelli  # noqa: E402
import common as common  # noqa: E402
import ftdcr as ftdcr  # noqa: E402
import sorosim as sorosim  # noqa: E402
import three_codes as three_codes  # noqa: E402

sys.path.remove(str(HERE))


def write(path: Path, header: list[str] | None, rows: Any, split: str = ",") -> Path:
    """Write a file of numbers to all their digits."""
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = [split.join(header)] if header else []
    lines += [split.join(repr(float(value)) for value in row) for row in rows]
    path.write_text("\n".join(lines) + "\n")
    return path
