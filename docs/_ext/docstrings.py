"""Docstrings as the reference shows them.

Names whose docstrings have no example, such as those of the compiled core, have one in
reference/examples.txt, which the tests run. Files of equations become links to their pages.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

# The files that docstrings quote equations of, as pages.
PAPERS = {
    "cpp/README.md": ":doc:`the model on paper </explanation/model>`",
    "cpp/several-sections.md": ":doc:`several sections </explanation/several-sections>`",
    "cpp/rods.md": ":doc:`rods </explanation/rods>`",
    "cpp/derivatives.md": ":doc:`derivatives </explanation/derivatives>`",
    "cpp/control.md": ":doc:`control </explanation/control>`",
    "cpp/estimation.md": ":doc:`estimation </explanation/estimation>`",
    "cpp/friction.md": ":doc:`friction </explanation/friction>`",
    "cpp/sensitivities.md": ":doc:`sensitivities </explanation/sensitivities>`",
    "cpp/base-wrench.md": ":doc:`what the base feels </explanation/base-wrench>`",
}
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
    for file, page in PAPERS.items():
        lines[:] = [line.replace(file, page) for line in lines]


def _without_self(
    app: Sphinx, what: str, name: str, thing: object, options: object, signature: str, returns: str
) -> tuple[str, str] | None:
    """Return the signature of a bound method as Python's own look in a reference."""
    if what == "method" and signature is not None and signature.startswith("(self"):
        return "(" + signature.removeprefix("(self").removeprefix(", "), returns
    return None


def setup(app: Sphinx) -> dict[str, Any]:
    """Add examples before numpydoc reads the docstrings."""
    app.connect("autodoc-process-signature", _without_self)
    app.connect("autodoc-process-docstring", _add, priority=400)
    return {"parallel_read_safe": True}
