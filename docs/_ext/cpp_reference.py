"""The C++ headers, read by Doxygen; each header of cdcr is a part of its page.

What a header says before its namespace, in plain comments, is what the part begins with.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.domains.cpp import CPPDomain
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

ROOT = Path(__file__).parents[2]
HEADERS = ROOT / "cpp" / "include" / "cdcr"
SETTINGS = f"""
PROJECT_NAME = cdcr
INPUT = {HEADERS}
STRIP_FROM_PATH = {HEADERS.parent}
STRIP_FROM_INC_PATH = {HEADERS.parent}
FILE_PATTERNS = *.hpp
GENERATE_HTML = NO
HAVE_DOT = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_AS_ERROR = YES
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = CDCR_EXPORT= CDCR_CVODE_EXPORT=
HIDE_UNDOC_RELATIONS = NO
EXTRACT_ALL = YES
XML_PROGRAMLISTING = NO
"""
# What is public, in the order shown.
PARTS = (
    *("briefdescription", "detaileddescription", "innernamespace", "innerclass", "enum"),
    *("typedef", "var", "func", "public-type", "public-func", "public-static-func"),
    *("public-attrib", "public-static-attrib"),
)


def _doxygen(app: Sphinx) -> None:
    out = Path(app.doctreedir).parent / "docs-doxygen"
    out.mkdir(parents=True, exist_ok=True)
    app.config.breathe_projects = {"cdcr": str(out / "xml")}
    newest = max(path.stat().st_mtime for path in [*HEADERS.glob("*.hpp"), Path(__file__)])
    index = out / "xml" / "index.xml"
    if index.exists() and index.stat().st_mtime > newest:
        return
    try:
        subprocess.run(
            ["doxygen", "-"],
            input=f"{SETTINGS}OUTPUT_DIRECTORY = {out}\n",
            text=True,
            check=True,
            capture_output=True,
        )
    except FileNotFoundError:
        raise ExtensionError("doxygen is not installed: apt-get install doxygen") from None
    except subprocess.CalledProcessError as error:
        raise ExtensionError(f"doxygen: {error.stderr}") from None


def introduction(header: str) -> str:
    """Return the plain comment that a header begins with, as paragraphs."""
    before = header.partition("\nnamespace ")[0]
    lines = [line[2:].strip() for line in before.splitlines() if line.startswith("//")]
    return "\n".join(lines)


class CppHeader(SphinxDirective):
    """What a header is for and everything that it declares."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the section of the header."""
        name = self.arguments[0]
        header = HEADERS / name
        self.env.note_dependency(str(header))
        section = nodes.section(ids=[nodes.make_id(name)], names=[name])
        section += nodes.title("", "", nodes.literal(text=f"cdcr/{name}"))
        for part in introduction(header.read_text(encoding="utf-8")).split("\n\n"):
            if part:
                section += nodes.paragraph(text=part)
        section += self.parse_text_to_nodes(
            f"```{{doxygenfile}} {name}\n:sections: {' '.join(PARTS)}\n```\n"
        )
        for block in list(section.findall(addnodes.desc)):
            if block[0].astext().startswith("namespace"):  # the same on all pages
                place = nodes.container(ids=block[0]["ids"])  # the index and links lead there
                block.replace_self([place, *block[1].children])
        return [section]


class CppNames(CPPDomain):
    """The names of C++ that a search finds: no parameters, which would hide what explains them."""

    def get_objects(self) -> Iterator[tuple[str, str, str, str, str, int]]:
        """Yield name, shown name, kind, page, place and priority."""
        return (one for one in super().get_objects() if not one[2].endswith("Param"))


def setup(app: Sphinx) -> dict[str, Any]:
    """Run Doxygen before the pages are read, and add the directive ``cpp-header``."""
    app.add_directive("cpp-header", CppHeader)
    app.add_domain(CppNames, override=True)
    app.connect("builder-inited", _doxygen, priority=100)
    return {"parallel_read_safe": True}
