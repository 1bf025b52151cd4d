"""The commands of ``cdcr``, as typer knows them: what ``cdcr COMMAND --help`` prints."""

from __future__ import annotations

import re
from typing import Any

import typer
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from cdcr.cli.app import app as cdcr_app

WIDTH = 92  # of a line of help


def helps() -> dict[str, tuple[str, str]]:
    """Return of each command its first sentence and its whole help, of cdcr itself first."""
    group: Any = typer.main.get_command(cdcr_app)
    with group.make_context("cdcr", [], resilient_parsing=True) as parent:
        parent.terminal_width = parent.max_content_width = WIDTH
        told = {"cdcr": (group.get_short_help_str(200), plain(group.get_help(parent)))}
        for name, command in group.commands.items():
            with command.make_context(name, [], parent=parent, resilient_parsing=True) as context:
                help_text = plain(command.get_help(context))
                told[f"cdcr {name}"] = (command.get_short_help_str(200), help_text)
    return told


def plain(text: str) -> str:
    """Return a help text without colours and without spaces at ends of lines."""
    return "\n".join(re.sub(r"\x1b\[[0-9;]*m", "", line).rstrip() for line in text.splitlines())


class CommandLine(SphinxDirective):
    """A section for each command."""

    def run(self) -> list[nodes.Node]:
        """Return the sections."""
        told: list[nodes.Node] = []
        for name, (short, text) in helps().items():
            section = nodes.section(ids=[nodes.make_id(name)], names=[name])
            section += nodes.title(text=name)
            section += nodes.paragraph(text=short)
            section += nodes.literal_block(text, text, language="text")
            told.append(section)
        return told


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the directive ``command-line``."""
    app.add_directive("command-line", CommandLine)
    return {"parallel_read_safe": True}
