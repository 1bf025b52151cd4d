"""Each example is a page with a title and cells, and uses public names alone."""

import ast
import re
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "examples"
SCRIPTS = sorted(FOLDER.glob("[0-9][0-9]_*.py"))


def test_the_table_has_every_example() -> None:
    row = r"^\| \[(\d\d)\]\((\w+\.py)\) \| `python examples/\2` \|"
    rows = re.findall(row, (FOLDER / "README.md").read_text(), re.MULTILINE)
    assert rows == [(script.name[:2], script.name) for script in SCRIPTS]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_an_example_is_a_page_and_uses_public_names_alone(script: Path) -> None:
    text = script.read_text()
    tree = ast.parse(text)
    title, line, *paragraphs = (ast.get_docstring(tree) or "").splitlines()
    assert line == "=" * len(title)
    assert any(paragraph.startswith("Look at ") for paragraph in paragraphs)
    assert text.count("\n# %%\n") >= 3
    assert len(text.splitlines()) <= 100
    assert text.endswith("\ncdcr.plotting.show_or_save(fig, sys.argv[1:])\n")
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute):
            assert not node.attr.startswith("_") or node.attr == "__init__"
        if isinstance(node, ast.ImportFrom):
            assert not str(node.module).startswith("cdcr")
