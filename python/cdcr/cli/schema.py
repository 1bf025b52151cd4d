"""What ``cdcr schema`` prints, and how files name a schema to editors."""

from __future__ import annotations

import json
from typing import Any, Literal

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
