"""cpp/README.md and docs/origin-paper.md against the sources: numbers, names and examples."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CPP = ROOT / "cpp"
README = (CPP / "README.md").read_text()
SECTIONS = (CPP / "several-sections.md").read_text()
RODS = (CPP / "rods.md").read_text()
DERIVATIVES = (CPP / "derivatives.md").read_text()
CONTROL = (CPP / "control.md").read_text()
ESTIMATION = (CPP / "estimation.md").read_text()
FRICTION = (CPP / "friction.md").read_text()
SENSITIVITIES = (CPP / "sensitivities.md").read_text()
BASE_WRENCH = (CPP / "base-wrench.md").read_text()
ORIGIN = (ROOT / "docs" / "origin-paper.md").read_text()


def blocks(document: str, language: str) -> list[str]:
    """The fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```", document, re.MULTILINE | re.DOTALL)


PAGES = (
    *(README, SECTIONS, RODS, DERIVATIVES, CONTROL),
    *(ESTIMATION, FRICTION, SENSITIVITIES, BASE_WRENCH),
)
FORMULAS = "".join(block for page in PAGES for block in blocks(page, "text"))
EQUATIONS = [int(number) for number in re.findall(r" \((\d+)\)$", FORMULAS, re.MULTILINE)]


def sources() -> list[Path]:
    """What quotes our equations; files about the paper quote the paper's."""
    folders = ("cpp", "bindings", "python", "tests/cpp")
    return [
        path
        for folder in folders
        for path in sorted((ROOT / folder).rglob("*"))
        if path.suffix in {".hpp", ".cpp", ".py", ".pyi"}
        and not {"paper", "scenarios"} & set(path.parts)
        and "paper" not in path.name
    ]


def quoted(text: str) -> list[int]:
    """Numbers after eq. or eqs., those of the origin paper left out."""
    found = []
    for match in re.finditer(r"(paper )?\beqs?\. ((?:\(\d+\)(?:, | to | and )?)+)", text):
        if match[1] is None:
            found += [int(number) for number in re.findall(r"\d+", match[2])]
    return found


def test_equations_are_numbered_in_order() -> None:
    assert list(range(1, 125)) == EQUATIONS


def test_equations_quoted_by_the_sources_exist() -> None:
    quotes = {path: quoted(path.read_text()) for path in sources()}
    assert sum(len(numbers) for numbers in quotes.values()) > 10
    for path, numbers in quotes.items():
        assert set(numbers) <= set(EQUATIONS), path


@pytest.mark.parametrize("header", sorted((CPP / "include" / "cdcr").glob("*.hpp")), ids=str)
def test_every_public_header_is_listed(header: Path) -> None:
    assert f"`{header.name}`" in README


def test_files_named_exist() -> None:
    for name in re.findall(r"[`(]((?:[\w.-]+/)+[\w-]+\.\w+)[`)]", README + SECTIONS):
        assert (ROOT / name).exists() or (CPP / name).exists(), name
    for name in re.findall(r"`(\w+\.cpp)`", ORIGIN):
        assert (CPP / "src" / name).exists(), name


def test_tests_named_exist() -> None:
    proofs = (ROOT / "tests" / "python" / "test_derivation_paper.py").read_text()
    names = re.findall(r"`(test_\w+)`", ORIGIN)
    assert len(names) == 7
    for name in names:
        assert f"def {name}(" in proofs, name


def test_the_cpp_example_is_what_the_consumer_project_compiles() -> None:
    (example,) = blocks(README, "cpp")
    program = (ROOT / "tests" / "consumer" / "core" / "main.cpp").read_text()
    lines = [line.strip() for line in program.splitlines() if line.strip()]
    wanted = [line.strip() for line in example.splitlines() if line.strip()]
    start = lines.index(wanted[0])
    assert lines[start : start + len(wanted)] == wanted


def examples() -> list[tuple[str, str]]:
    """Each Python example with the output that stands behind it."""
    front = (ROOT / "README.md").read_text()
    pairs: list[tuple[str, str]] = []
    for document in (ORIGIN, front[: front.index("## C++")]):
        pairs += zip(blocks(document, "python"), blocks(document, "text"), strict=True)
    return pairs


@pytest.mark.parametrize(("example", "output"), examples())
def test_a_python_example_prints_what_it_says(
    example: str,
    output: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)  # an example may write files
    exec(example, {})
    assert capsys.readouterr().out == output


def test_one_word_for_each_thing() -> None:
    """The commonest of the words that the glossary leaves to others."""
    strays = re.compile(r"\b(tendons?|vertebrae?|end effectors?)\b", re.IGNORECASE)
    foreign = re.compile(r".*# MuJoCo's word$", re.MULTILINE)
    for path in sources():
        assert not strays.search(foreign.sub("", path.read_text())), path
