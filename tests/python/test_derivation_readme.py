"""cpp/README.md against the sources: equation numbers, headers, names and the C++ example."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "cpp" / "README.md").read_text()
CPP = ROOT / "cpp"

BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```", README, re.MULTILINE | re.DOTALL)
FORMULAS = "".join(text for language, text in BLOCKS if language == "text")
EQUATIONS = [int(number) for number in re.findall(r"  \((\d+)\)$", FORMULAS, re.MULTILINE)]


def sources() -> list[Path]:
    folders = ("cpp", "bindings", "python", "tests/cpp")
    return [
        path
        for folder in folders
        for path in sorted((ROOT / folder).rglob("*"))
        if path.suffix in {".hpp", ".cpp", ".py", ".pyi"}
    ]


def quoted(text: str) -> list[int]:
    """Numbers after eq. or eqs., those of the origin paper left out."""
    found = []
    for match in re.finditer(r"(paper )?\beqs?\. ((?:\(\d+\)(?:, | to | and )?)+)", text):
        if match[1] is None:
            found += [int(number) for number in re.findall(r"\d+", match[2])]
    return found


def test_equations_are_numbered_in_order() -> None:
    assert EQUATIONS == list(range(1, 23))


def test_equations_quoted_by_the_sources_exist() -> None:
    quotes = {path: quoted(path.read_text()) for path in sources()}
    assert sum(len(numbers) for numbers in quotes.values()) > 10
    for path, numbers in quotes.items():
        assert set(numbers) <= set(EQUATIONS), path


@pytest.mark.parametrize("header", sorted((CPP / "include" / "cdcr").glob("*.hpp")), ids=str)
def test_every_public_header_is_listed(header: Path) -> None:
    assert f"`{header.name}`" in README


def test_files_and_tests_named_exist() -> None:
    for name in re.findall(r"`((?:\w+/)+\w+\.\w+)`", README):
        assert (ROOT / name).exists() or (CPP / name).exists(), name
    tests = "".join(path.read_text() for path in (ROOT / "tests" / "python").glob("test_*.py"))
    names = re.findall(r"`(test_\w+)`", README)
    assert names
    for name in names:
        assert f"def {name}(" in tests, name


def test_the_example_is_what_the_consumer_project_compiles() -> None:
    (example,) = [text for language, text in BLOCKS if language == "cpp"]
    program = (ROOT / "tests" / "consumer" / "core" / "main.cpp").read_text()
    lines = [line.strip() for line in program.splitlines() if line.strip()]
    wanted = [line.strip() for line in example.splitlines() if line.strip()]
    start = lines.index(wanted[0])
    assert lines[start : start + len(wanted)] == wanted


def test_one_word_for_each_thing() -> None:
    """The words the glossary leaves to others do not stray into the sources."""
    strays = re.compile(r"\b(tendons?|vertebrae?)\b", re.IGNORECASE)
    for path in sources():
        assert not strays.search(path.read_text()), path
