"""Pages whose text is a file of the repository, and links between pages and such files.

A page that says ``<!-- text: cpp/README.md -->`` has the text of that file there; scripts and
notebooks run. Links to a file that a page shows lead to the page; links to other files of the
source become plain words.
"""

from __future__ import annotations

import re
from os.path import normpath, relpath
from pathlib import Path, PurePosixPath
from typing import Any

from inline import inline
from scripts import PAGES
from sphinx.application import Sphinx
from typeset import typeset

ROOT = Path(__file__).parents[2]
TEXT = re.compile(r"^<!-- text: (\S+) -->\n", re.MULTILINE)
LINK = re.compile(r"(!?)\[((?:[^\]\[]|\[[^\]]*\])*)\]\(((?!https?:|mailto:|#)[^)\s]+)\)")
FENCE = re.compile(r"(^(`{3,}).*?^\2$)", re.MULTILINE | re.DOTALL)


def shown() -> dict[str, str]:
    """Return the page of each file that a page shows."""
    pages = {}
    for path in (ROOT / "docs").rglob("*.md"):
        name = path.relative_to(ROOT).as_posix()
        pages[name] = name
        if match := TEXT.search(path.read_text(encoding="utf-8")):
            pages[match[1]] = name
    return pages


def relinked(text: str, home: str, page: str) -> str:
    """Return a text of the file `home` with its links as `page` has to have them."""
    pages = shown()

    def link(match: re.Match[str]) -> str:
        picture, words, target = match.groups()
        target, _, anchor = target.partition("#")
        place = normpath(PurePosixPath(home).parent / target)
        if picture:
            return f"![{words}]({relpath(place, PurePosixPath(page).parent)})"
        if place in pages:
            there = relpath(pages[place], PurePosixPath(page).parent)
            return f"[{words}]({there}{'#' + anchor if anchor else ''})"
        return words if (ROOT / place).exists() else match[0]

    parts = FENCE.split(text)
    # Of each fence the pattern has two groups, itself and its marks.
    return "".join(
        LINK.sub(link, part) if k % 3 == 0 else part for k, part in enumerate(parts) if k % 3 != 2
    )


def _read(app: Sphinx, docname: str, source: list[str]) -> None:
    path = Path(app.env.doc2path(docname))
    if path.suffix != ".md":
        return
    page = path.relative_to(ROOT).as_posix()
    text = relinked(source[0], page, page)
    if match := TEXT.search(text):
        file = ROOT / match[1]
        app.env.note_dependency(str(file))
        told = file.read_text(encoding="utf-8")
        if file.suffix in PAGES:
            told = PAGES[file.suffix](told)
        told = relinked(told, match[1], page)
        if match[1].startswith("cpp/"):
            told = inline(typeset(told))
        text = text[: match.start()] + told + text[match.end() :]
    source[0] = text


def setup(app: Sphinx) -> dict[str, Any]:
    """Read pages through the above."""
    app.connect("source-read", _read)
    return {"parallel_read_safe": True}
