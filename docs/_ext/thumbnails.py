"""Pictures in a table of pages: each row that begins with a link shows the page's first picture."""

from __future__ import annotations

from posixpath import join, normpath
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx

INDEX = "examples/index"


def _show(app: Sphinx, doctree: nodes.document, docname: str) -> None:
    if docname != INDEX or app.builder.format != "html":
        return
    for row in doctree.findall(nodes.row):
        link = next(row[0].findall(nodes.reference), None)
        if link is None or not link["refuri"].endswith(".html"):
            continue
        page = normpath(join(docname, "..", link["refuri"])).removesuffix(".html")
        picture = next(app.env.get_doctree(page).findall(nodes.image), None)
        if picture is not None:
            words = {"alt": f"picture of {link.astext()}", "classes": ["thumbnail"]}
            shown = nodes.image(uri=picture["uri"], candidates=picture["candidates"], **words)
            link += shown


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the pictures once all pages are read."""
    app.connect("doctree-resolved", _show)
    return {"parallel_read_safe": True}
