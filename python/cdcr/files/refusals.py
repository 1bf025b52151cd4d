"""What is wrong with a file, told with its line and with the file that names it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from cdcr.files.text import read_text
from cdcr.files.toml_lines import key_lines, line_of

# What follows a file's name in a refusal: the table or key in it, where one is named, and the rest.
_REFUSAL = re.compile(r"(?P<home>, [^:]+)?: (?P<rest>.*)")


@contextmanager
def named_by(where: str) -> Iterator[None]:
    """Begin what is wrong with a file, or that there is none, with where it is named."""
    try:
        yield
    except (OSError, ValueError) as error:
        told = "\n".join(f"{where}: {sentence}" for sentence in os_or_value(error).split("\n"))
        raise (type(error) if isinstance(error, OSError) else ValueError)(told) from None


def os_or_value(error: OSError | ValueError) -> str:
    """Return the sentence of an error; the system's own have a file and a reason."""
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename or 'what is printed'}: {error.strerror}"
    return str(error)


@contextmanager
def with_lines(file: Path) -> Iterator[None]:
    """Name the lines of a TOML file that its refusals are about, where they are found."""
    try:
        yield
    except ValueError as error:
        raise ValueError(_with_lines(file, str(error))) from None
    except OSError as error:  # of a file that it names
        raise type(error)(_with_lines(file, os_or_value(error))) from None


def _with_lines(file: Path, sentences: str) -> str:
    try:
        lines = key_lines(read_text(file, "file"))
    except (OSError, ValueError):
        return sentences
    return "\n".join(_with_line(file, lines, sentence) for sentence in sentences.split("\n"))


def _with_line(file: Path, lines: dict[str, int], sentence: str) -> str:
    refusal = _REFUSAL.fullmatch(sentence.removeprefix(str(file)))
    if not sentence.startswith(str(file)) or refusal is None:
        return sentence
    home = refusal["home"] or ""
    if home.startswith(", line "):
        return sentence
    tables = [one.strip(" []") for one in home.split(",") if one.strip()]
    line = line_of(lines, refusal["rest"], ".".join(tables))
    return sentence if line is None else f"{file}, line {line}{home}: {refusal['rest']}"
