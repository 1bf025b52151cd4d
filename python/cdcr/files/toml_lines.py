"""The line of a TOML file in which a key stands."""

from __future__ import annotations

import re
from collections.abc import Iterator

_HEADER = re.compile(r"\s*(\[\[?)\s*([^\]]+?)\s*\]")
_KEY = re.compile(r"\s*([A-Za-z0-9_\-.\"' ]+?)\s*=")
# What matters to brackets: strings and comments do not count.
_TOKENS = re.compile(r'"""|\'\'\'|"(?:\\.|[^"\\])*"|\'[^\']*\'|#.*|[\[\]{}]')


def key_lines(text: str) -> dict[str, int]:
    """Return the line of each table and key, by its path: 'wrenches[0].force', 'robot.gravity'."""
    found: dict[str, int] = {}
    for number, path, _ in _entries(text):
        for one in _parents(path):
            found.setdefault(one, number)
    return found


def given_twice(text: str, line: int) -> str | None:
    """Return a sentence about what stands in a line of a TOML file and above it too."""
    entries = [entry for entry in _entries(text) if entry[0] <= line]
    if not entries:
        return None
    number, path, is_table = entries.pop()
    for first, one, was_table in entries:
        is_inside = path.startswith(f"{one}.") and not was_table
        if one != path and not is_inside:
            continue
        if was_table == (is_table or is_inside):
            return f"{one} is given twice: on line {first} and on line {number}"
        was, now = ("table", "value") if was_table else ("value", "table")
        return (
            f"{one} is given twice: as a {was} on line {first} and as a {now} on line {number}; "
            f"put the value into [{one}]"
        )
    return None


def _entries(text: str) -> Iterator[tuple[int, str, bool]]:
    """Yield the line of each header and key, its path, and whether it is a header."""
    counts: dict[str, int] = {}
    home, depth, quotes = "", 0, ""
    for number, line in enumerate(text.splitlines(), start=1):
        if not quotes and depth == 0:
            if header := _HEADER.match(line):
                home = _numbered(_plain(header[2]), counts, is_list=len(header[1]) == 2)
                yield number, home, True
                continue
            if key := _KEY.match(line):
                yield number, f"{home}.{_plain(key[1])}" if home else _plain(key[1]), False
        depth, quotes = _after(line, depth, quotes)


def _plain(key: str) -> str:
    return re.sub(r"[\s\"']", "", key)


def _numbered(path: str, counts: dict[str, int], *, is_list: bool) -> str:
    """Return the path of a header with the number of each table in a list of tables, from 0."""
    home = ""
    parts = path.split(".")
    for i, part in enumerate(parts):
        home = f"{home}.{part}" if home else part
        if i == len(parts) - 1 and is_list:
            counts[home] = counts.get(home, 0) + 1
            for inner in [one for one in counts if one.startswith(f"{home}[{counts[home] - 1}]")]:
                del counts[inner]
        if home in counts:
            home = f"{home}[{counts[home] - 1}]"
    return home


def _parents(path: str) -> Iterator[str]:
    """Yield a path and those of the tables that its dots name."""
    while path:
        yield path
        path = path.rpartition(".")[0]


def _after(line: str, depth: int, quotes: str) -> tuple[int, str]:
    """Return how deep in brackets a line ends, and the quotes of a text that goes on."""
    at = 0
    while at < len(line):
        if quotes:
            end = line.find(quotes, at)
            if end < 0:
                return depth, quotes
            at, quotes = end + 3, ""
            continue
        token = _TOKENS.search(line, at)
        if token is None:
            break
        at = token.end()
        if token[0] in ('"""', "'''"):
            quotes = token[0]
        elif token[0] in "[{":
            depth += 1
        elif token[0] in "]}":
            depth = max(0, depth - 1)
    return depth, quotes


def line_of(lines: dict[str, int], sentence: str, home: str = "") -> int | None:
    """Return the line of the key that a refusal begins with, or of the table it is missing in.

    The sentence may name a section or a cable by its number from 1, as in 'section 1: length must
    be'; `home` is the table that it is about.
    """
    path = home
    if place := re.match(r"(section|cable) (\d+)(?: of cables)?\b:? ?", sentence):
        within = f"{place[1]}s[{int(place[2]) - 1}]"
        path = f"{path}.{within}" if path else within
        sentence = sentence[place.end() :]
    if key := re.match(r"(\w+(?:\[\d+\])?(?:\.\w+(?:\[\d+\])?)*):? ", sentence):
        path = f"{path}.{key[1]}" if path else key[1]
    while path:
        for one in (path, f"{path}[0]"):  # of a list of tables, the first
            if one in lines:
                return lines[one]
        path = path[: path.rindex("[")] if path.endswith("]") else path.rpartition(".")[0]
    return None
