"""What ``cdcr schema`` prints, and how files name a schema to editors."""

from __future__ import annotations

import json
from typing import Annotated, Any, Literal

import typer

from cdcr.cli import complete
from cdcr.cli.plain import told_plainly
from cdcr.cli.run import Mistake

commands = typer.Typer()

Kind = Literal["robot", "scenario"]
KINDS: tuple[Kind, ...] = ("robot", "scenario")


def schema(kind: Kind) -> dict[str, Any]:
    """Return the JSON schema of robot or scenario files."""
    if kind == "robot":
        from cdcr.robot.json_schema import robot_file_schema

        return robot_file_schema()
    from cdcr.scenarios.file.json_schema import scenario_file_schema

    return scenario_file_schema()


def text(kind: Kind) -> str:
    """Return the schema as text."""
    return json.dumps(schema(kind), indent=2, allow_nan=False)


def file_name(kind: Kind) -> str:
    """Return the name under which files look for the schema, beside them."""
    return f"cdcr-{kind}.schema.json"


def comment(kind: Kind) -> str:
    """Return the lines that name the schema to editors, at the top of a file."""
    name = file_name(kind)
    made = f"cdcr schema {kind} > {name}"
    return f"#:schema ./{name}\n# Editors complete keys by it where it is; to make it: {made}\n\n"


@commands.command("schema", short_help="Print the JSON schema of robot or scenario files.")
def schema_command(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="robot|scenario", help="The files.", autocompletion=complete.kinds_of_files
        ),
    ],
) -> None:
    """Print the JSON schema of robot or scenario files, by which editors complete and check keys.

    Files written by `cdcr new` name it: taplo and Even Better TOML (VS Code) look for it beside the
    file, under cdcr-robot.schema.json or cdcr-scenario.schema.json.
    """
    with told_plainly():
        for known in KINDS:
            if kind == known:
                typer.echo(text(known))
                return
        raise Mistake(f"the schema must be one of {', '.join(KINDS)}, got {kind!r}")
