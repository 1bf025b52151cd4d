"""Examples of names whose docstrings have none: those that the compiled core holds.

They stand in reference/examples.txt, under the name that they belong to, and the tests run them.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

FILE = Path(__file__).parents[1] / "reference" / "examples.txt"


def examples() -> dict[str, str]:
    """Return the examples by full name."""
    parts = re.split(r"^\[(cdcr[\w.]*)\]\n", FILE.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return dict(zip(parts[1::2], (text.strip() for text in parts[2::2]), strict=True))


def _add(
    app: Sphinx, what: str, name: str, thing: object, options: object, lines: list[str]
) -> None:
    if (example := examples().get(name)) and not any(">>>" in line for line in lines):
        lines += ["", "Examples", "--------", *example.splitlines(), ""]


def setup(app: Sphinx) -> dict[str, Any]:
    """Add examples before numpydoc reads the docstrings."""
    app.connect("autodoc-process-docstring", _add, priority=400)
    return {"parallel_read_safe": True}
