"""The wrenches of scenario files: tables [[wrenches]]."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from cdcr.base.check import count
from cdcr.files.toml import refuse, schema_errors
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench, loads
from cdcr.scenarios.file.values import error_prefix

_KEYS = ("fraction", "force", "moment", "frame", "interpolation")


def read_wrenches(
    tables: Sequence[Mapping[str, Any]], model: Model, file: Path
) -> tuple[Wrench, ...]:
    """Return the wrenches of the tables [[wrenches]], sections counted from 1 in them."""
    refuse(
        str(file),
        [
            sentence
            for i, table in enumerate(tables)
            for sentence in _table_errors(table, model.num_sections, f"wrenches[{i}]")
        ],
    )
    return tuple(_wrench(table, f"{file}: wrenches[{i}]") for i, table in enumerate(tables))


def _table_errors(table: Mapping[str, Any], num_sections: int, at: str) -> list[str]:
    from cdcr.scenarios.file.schema import WrenchTable

    found = schema_errors(WrenchTable, table, at)
    if found:
        return found
    if table["section"] > num_sections:
        requirement = f"the number of a section, 1 to {num_sections}"
        found.append(f"{at}.section must be {requirement}, got {table['section']}")
    if "force" not in table and "moment" not in table:
        found.append(f"{at} must have force, moment or both")
    if ("times" in table) != ("factors" in table):
        found.append(f"{at} must have both times and factors, or neither")
    elif "times" not in table and "interpolation" in table:
        found.append(f"{at}.interpolation goes with times and factors, which are missing")
    elif "times" in table and len(table["times"]) != len(table["factors"]):
        times, factors = len(table["times"]), len(table["factors"])
        found.append(f"{at}.factors must have {count(times, 'number')} as times has, got {factors}")
    return found


def _wrench(table: Mapping[str, Any], where: str) -> Wrench:
    given = {key: table[key] for key in _KEYS if key in table}
    if "times" in table:
        given["profile"] = (table["times"], table["factors"])
    with error_prefix(where):
        wrench = Wrench(section=table["section"] - 1, **given)
        loads(wrench)
    return wrench
