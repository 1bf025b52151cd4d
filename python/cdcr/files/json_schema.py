"""JSON schemas of tables in TOML files, which editors complete and check keys by."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pydantic import BaseModel

DIALECT = "http://json-schema.org/draft-07/schema#"  # the newest that editors of TOML know

Schema = dict[str, Any]


def table_schema(table: type[BaseModel], **replaced: Schema) -> Schema:
    """Return the schema of a table, with others in place of what it says of some keys.

    Each key is described by what it is and what its value must be, with the unit.
    """
    found = table.model_json_schema()
    keys = {}
    for key, told in found["properties"].items():
        about, requirement = told.pop("title"), told.pop("description")
        if told.get("default", 0) is None:
            del told["default"]
        keys[key] = {"description": f"{about}: {requirement}"} | replaced.get(key, told)
    schema: Schema = {"type": "object", "properties": keys, "additionalProperties": False}
    if "required" in found:
        schema["required"] = found["required"]
    return schema


def one_of_keys(*rivals: tuple[str, ...]) -> Schema:
    """Return the rule that no two of some keys are in a table."""
    return {"not": {"anyOf": [{"required": list(pair)} for pair in rivals]}}


def document(title: str, schema: Schema) -> Schema:
    """Return the schema of a whole file."""
    return {"$schema": DIALECT, "title": title} | schema
