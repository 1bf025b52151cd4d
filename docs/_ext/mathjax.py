"""MathJax as one file of the site: no request leaves the machine of a reader.

The file comes from the package django-static-mathjax, which holds nothing but MathJax.
"""

from __future__ import annotations

import shutil
from importlib.metadata import files
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

NAME = "tex-svg.js"  # draws with paths, so it needs no fonts


def _copy(app: Sphinx, error: Exception | None) -> None:
    if error is not None or app.builder.format != "html":
        return
    found = [path for path in files("django-static-mathjax") or () if path.match(f"es5/{NAME}")]
    shutil.copyfile(Path(found[0].locate()), Path(app.outdir) / "_static" / NAME)


def setup(app: Sphinx) -> dict[str, Any]:
    """Tell Sphinx where MathJax is, and put it there."""
    app.config.mathjax_path = NAME
    app.config.mathjax3_config = {
        "tex": {"tags": "none"},
        "svg": {"fontCache": "global", "scale": 0.9},
    }
    app.connect("build-finished", _copy)
    return {"parallel_read_safe": True}
