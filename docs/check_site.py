"""Whether the links of a built site lead somewhere, and whether it asks nothing of others.

    python docs/check_site.py build/docs

Every href and src of a page is looked up: the file and, after a #, the place in it. What a browser
fetches by itself (scripts, styles, pictures) has to be a file of the site. No comment of a C++
header may have become a quotation.
"""

from __future__ import annotations

import re
import sys
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

FETCHED = {
    ("script", "src"),
    ("img", "src"),
    ("link", "href"),
    ("source", "src"),
    ("iframe", "src"),
}
OUTSIDE = re.compile(r"^(https?:)?//")
QUOTE = "<blockquote"  # what Doxygen makes of a comment that begins with >
IN_STYLE = re.compile(r"(?:url\(\s*|@import\s+)[\"']?((?:https?:)?//[^\"')]+)")


class Page(HTMLParser):
    """The links of a page, the places in it and what a browser fetches for it."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.fetched: list[str] = []
        self.places: set[str] = {""}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.places.add(value)
            if value and (tag, name) in FETCHED:
                self.fetched.append(value)
            if value and (name == "src" or (tag, name) == ("a", "href")):
                self.links.append(value)


@cache
def page(path: Path) -> Page:
    return Page(path)


def complaints(site: Path) -> list[str]:
    """Return what is wrong, a line for each."""
    told = []
    for path in sorted(site.rglob("*.html")):
        if "_static" in path.relative_to(site).parts:
            continue
        if path.parent.match("reference/cpp") and QUOTE in path.read_text(encoding="utf-8"):
            told.append(f"{path}: a comment of a header became a quotation")
        for target in page(path).fetched:
            if OUTSIDE.match(target):
                told.append(f"{path}: asks {target} of another machine")
        for target in page(path).links:
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            there = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not there.is_file():
                told.append(f"{path}: {target} is not there")
            elif there.suffix == ".html" and unquote(parts.fragment) not in page(there).places:
                told.append(f"{path}: {target} has no such place")
    for path in sorted(site.rglob("*.css")):
        for match in IN_STYLE.finditer(path.read_text(encoding="utf-8")):
            told.append(f"{path}: asks {match[1]} of another machine")
    return told


def main() -> None:
    site = Path(sys.argv[1]).resolve()
    told = complaints(site)
    for line in told:
        print(line, file=sys.stderr)
    if told:
        sys.exit(1)
    print(f"{len(list(site.rglob('*.html')))} pages: all links inside lead somewhere")


if __name__ == "__main__":
    main()
