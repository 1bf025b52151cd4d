"""TOML files people write: read with line numbers and checked key by key."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from cdcr.base.check import nearest
from cdcr.files.text import read_text
from cdcr.files.toml_lines import given_twice

if TYPE_CHECKING:
    from pydantic import BaseModel
    from pydantic_core import ErrorDetails

_TOML = import_module("tomllib" if sys.version_info >= (3, 11) else "tomli")
_KINDS = {dict: "table", list: "array", str: "string", bool: "boolean", int: "integer"}
MAX_DEPTH = 50  # of tables and arrays in one another


def read_toml(path: Path, what: str) -> dict[str, Any]:
    """Return the content of a file; `what` names it in the sentences, as in 'robot file'."""
    text = read_text(path, what)
    try:
        table: dict[str, Any] = _TOML.loads(text)
    except _TOML.TOMLDecodeError as error:
        raise ValueError(f"{path}, {_place_and_reason(str(error), text)}") from None
    except RecursionError:
        raise ValueError(f"{path} must be nested at most {MAX_DEPTH} deep") from None
    except ValueError:  # Python's own, of an integer with thousands of digits
        digits = re.search(r"[0-9_]{1000}", text)
        line = text[: digits.start()].count("\n") + 1 if digits else 1
        raise ValueError(f"{path}, line {line}: an integer must have 64 bits") from None
    return {key: _plain(value, f"{path}: {key}") for key, value in table.items()}


def _plain(value: Any, where: str, depth: int = 1) -> Any:
    """Return a value with integers of more than 64 bits, TOML's own, as the floats nearest them."""
    if depth > MAX_DEPTH:
        raise ValueError(f"{where} must be nested at most {MAX_DEPTH} deep")
    if isinstance(value, dict):
        return {key: _plain(one, where, depth + 1) for key, one in value.items()}
    if isinstance(value, list):
        return [_plain(one, where, depth + 1) for one in value]
    if isinstance(value, int) and not -(2**63) <= value < 2**63:
        return float(value) if abs(value) < 2**1000 else math.copysign(math.inf, value > 0 or -1)
    return value


def _place_and_reason(message: str, text: str) -> str:
    found = re.fullmatch(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", message)
    reason, line, column = found.groups() if found else (message, None, None)
    if line is None:
        return f"line {text.rstrip().count(chr(10)) + 1}: {reason} at the end of the file"
    twice = given_twice(text, int(line)) if reason.startswith("Cannot ") else None
    return f"line {line}, column {column}: {twice or reason}"


def schema_errors(
    schema: type[BaseModel],
    table: Mapping[str, Any],
    at: str = "",
    elsewhere: Mapping[str, str] = MappingProxyType({}),
) -> list[str]:
    """Return a sentence for each key of a table that its schema does not allow.

    Every field of the schema says in its description what it must be; the schemas are flat, tables
    inside tables are checked on their own. `at` is the key path of the table inside the file;
    `elsewhere` says where keys belong that other tables have.
    """
    from pydantic import ValidationError

    try:
        schema.model_validate(table)
    except ValidationError as error:
        # A key that may be of several types has an error for each; the first one tells enough.
        first = {str(one["loc"][0]): one for one in reversed(error.errors(include_url=False))}
        return [_sentence(schema, one, at, elsewhere) for one in reversed(first.values())]
    return []


def _sentence(
    schema: type[BaseModel], error: ErrorDetails, at: str, elsewhere: Mapping[str, str]
) -> str:
    """Say what one error of pydantic means for the writer of the file."""
    key, *index = error["loc"]
    name = str(key) if str(key).isprintable() else repr(key)
    path = f"{at}.{name}" if at else name
    if error["type"] == "extra_forbidden":
        known = list(schema.model_fields)
        home = elsewhere.get(str(key))
        guess = f" It belongs {home}." if home else nearest(str(key), known)
        return f"{path} is not a known key.{guess} Known keys: {', '.join(known)}"
    requirement = schema.model_fields[str(key)].description
    if error["type"] == "missing":
        return f"{path} is missing; it must be {requirement}"
    place = "".join(f"[{i}]" for i in index if isinstance(i, int))
    return f"{path} must be {requirement}, got {format_toml(error['input'])}" + (
        f" at {path}{place}" if place else ""
    )


def format_toml(value: object) -> str:
    """Return a TOML value as a refusal prints it: short, with its kind in TOML's words."""
    kind = _KINDS.get(type(value), type(value).__name__)
    text = str(value).lower() if isinstance(value, bool) else repr(value)
    return f"{text if len(text) <= 60 else text[:57] + '...'} ({kind})"


class Faults:
    """Keeps what is wrong with the parts of a file, so that all of it is told at once."""

    def __init__(self) -> None:
        self._sentences: list[str] = []

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Keep the sentences of a ValueError for `done`."""
        try:
            yield
        except ValueError as error:
            self._sentences.append(str(error))

    def __bool__(self) -> bool:
        """Return whether there are any."""
        return bool(self._sentences)

    def done(self) -> None:
        """Raise a ValueError with all sentences, one a line, where there are any."""
        if self:
            raise ValueError("\n".join(self._sentences))


def refuse(where: str, sentences: Iterable[str]) -> None:
    """Raise a ValueError with the sentences, each after the file's name, if there are any."""
    text = "\n".join(f"{where}: {sentence}" for sentence in sentences)
    if text:
        raise ValueError(text)
