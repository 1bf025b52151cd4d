"""The keys of robot and scenario files, as tables, and as JSON schemas beside the pages."""

from __future__ import annotations

import json
from dataclasses import MISSING
from importlib import import_module
from pathlib import Path
from typing import Any

from docutils import nodes
from pydantic import BaseModel
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from cdcr.cli import schema as json_schema
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.schema import table_of
from cdcr.robot.section import Section

DESCRIBED = {"Robot": Robot, "Section": Section, "Cable": Cable}
# In place of defaults that only hold where the key means nothing, or stand for no table.
CONDITIONS = {"Section.cable_radius": "needed where there are cables", "Robot.cables": "none"}


def schema(name: str) -> type[BaseModel]:
    """Return a schema by name: Robot, Section, Cable, or module:NAME of a file's table."""
    if name in DESCRIBED:
        return table_of(DESCRIBED[name])
    module, _, attribute = name.partition(":")
    room = "identification.schema" if module == "identify" else f"scenarios.file.{module}"
    found: type[BaseModel] = getattr(import_module(f"cdcr.{room}"), attribute)
    return found


def rows(name: str) -> list[tuple[str, str, str]]:
    """Return key, whether it is needed or its default, and what it is and must be."""
    fields = getattr(DESCRIBED.get(name), "__dataclass_fields__", {})
    told = []
    for key, field in schema(name).model_fields.items():
        described = fields.get(key.removesuffix("_deg"))
        default = field.default
        if described is not None and described.default is not MISSING:
            default = described.default
        value = str(field.description)
        if described is not None and "about" in described.metadata:
            value = f"{described.metadata['about']}: {value}"
        elif field.title:
            value = f"{field.title}: {value}"
        need = CONDITIONS.get(f"{name}.{key}") or needed(field.is_required(), default)
        told.append((key, need, value))
    return told


def needed(required: bool, default: Any) -> str:
    """Return whether a key is needed, or its default as a file would say it."""
    if required:
        return "needed"
    return "" if default is None else json.dumps(default)


class FileKeys(SphinxDirective):
    """A table of the keys of one table of a file."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return the table."""
        group = nodes.tgroup("", cols=3)
        group += [nodes.colspec(colwidth=width) for width in (22, 18, 60)]
        head, body = nodes.thead(), nodes.tbody()
        head += self._row(*(nodes.paragraph(text=text) for text in ("key", "default", "value")))
        for key, need, value in rows(self.arguments[0]):
            literal = nodes.paragraph("", "", nodes.literal(text=key))
            body += self._row(literal, nodes.paragraph(text=need), nodes.paragraph(text=value))
        group += [head, body]
        table = nodes.table("", group, classes=["file-keys"])
        return [table]

    @staticmethod
    def _row(*cells: nodes.Node) -> nodes.row:
        row = nodes.row()
        row += [nodes.entry("", cell) for cell in cells]
        return row


def publish(app: Sphinx, error: Exception | None) -> None:
    """Write the JSON schemas into the site."""
    if error is None:
        folder = Path(app.outdir) / "schema"
        folder.mkdir(exist_ok=True)
        for kind in json_schema.KINDS:
            path = folder / json_schema.file_name(kind)
            path.write_text(json_schema.text(kind) + "\n", encoding="utf-8")


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the directive ``file-keys``, and the schemas."""
    app.add_directive("file-keys", FileKeys)
    app.connect("build-finished", publish)
    return {"parallel_read_safe": True}
