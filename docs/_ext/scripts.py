"""Scripts and notebooks as pages that run: cells of MyST, with their text between them.

A script begins with a docstring, its title underlined. ``# %%`` begins a cell, and the comments
after it are text.
"""

from __future__ import annotations

import ast
import json
import re

FRONT = "---\nfile_format: mystnb\nkernelspec: {name: python3}\n---\n"
# Scripts draw into a file that is named; here none is, and they show what they draw.
NO_ARGUMENTS = "import sys\n\nsys.argv = sys.argv[:1]"


def cell(code: str, *tags: str) -> str:
    """Return code as a cell."""
    told = f":tags: [{', '.join(tags)}]\n" if tags else ""
    return f"```{{code-cell}} python\n{told}{code.strip()}\n```\n"


def page_of_script(text: str) -> str:
    """Return a script as a page."""
    docstring = ast.get_docstring(ast.parse(text)) or ""
    body = text.split('"""', 2)[2]
    parts = [FRONT, docstring, cell(NO_ARGUMENTS, "remove-cell")]
    for number, block in enumerate(re.split(r"^# %%\n", body, flags=re.MULTILINE)):
        comment, code = "", block
        if number and (match := re.match(r"(?:#.*\n)+", block)):
            comment, code = match[0], block[match.end() :]
        parts.append("\n".join(line[2:] for line in comment.splitlines()))
        if code.strip():
            parts.append(cell(code))
    return "\n\n".join(parts) + "\n"


def page_of_notebook(text: str) -> str:
    """Return a notebook as a page."""
    parts = [FRONT]
    for one in json.loads(text)["cells"]:
        source = "".join(one["source"])
        parts.append(source if one["cell_type"] == "markdown" else cell(source))
    return "\n\n".join(parts) + "\n"


PAGES = {".py": page_of_script, ".ipynb": page_of_notebook}
