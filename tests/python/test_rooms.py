"""The map of the source in CONTRIBUTING.md, and what import-linter cannot see of its arrows."""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "python" / "cdcr"
TOPS = {
    *("bench", "bindings", "cmake", "cpp", "docs", "examples", "licenses", "packaging", "python"),
    "tests",
    "tools",
    "validation",
}
MADE = {"build", "dist", "out"}  # by make, and in .gitignore
MOST = 19  # modules at the top of the package
SPINE = (
    *("description/*", "section/*", "chain/*", "dynamics/*", "loads/cable*"),
    *("integration/robot_ode.*", "integration/rk4.*", "integration/simulator.*"),
)
MOST_SPINE = 5200  # lines of code


def folders_with_files() -> set[str]:
    return {
        path.parent.relative_to(ROOT).as_posix()
        for top in TOPS
        for path in (ROOT / top).rglob("*")
        if path.is_file() and path.parent.name != "__pycache__"
    }


def test_the_map_has_every_folder_and_no_other() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text().partition("## Rooms")[2].partition("\n## ")[0]
    rooms = re.findall(r"^\| `([\w/]+)/` \| [^|]+ \|", text, re.MULTILINE)
    assert len(rooms) == len(set(rooms))
    assert set(rooms) == folders_with_files()


def test_no_folder_is_forgotten() -> None:
    visible = {path.name for path in ROOT.iterdir() if path.is_dir() and path.name[0] != "."}
    assert visible - MADE == TOPS


def test_the_top_of_the_package_is_short() -> None:
    rooms = {path.parent for path in PACKAGE.glob("*/__init__.py")}
    modules = {path for path in PACKAGE.glob("*.py") if path.stem not in ("__init__", "__main__")}
    assert len(rooms) + len(modules) <= MOST


def test_no_room_takes_from_the_root_what_the_root_takes_from_rooms() -> None:
    # import-linter takes the compiled core for the root, so it cannot tell.
    public = {path.stem for path in PACKAGE.glob("*.py")} | {
        path.name for path in PACKAGE.iterdir()
    }
    for path in PACKAGE.rglob("*/*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom) and node.module == "cdcr":
                assert {alias.name for alias in node.names} <= public | {"_core"}, path
            if isinstance(node, ast.Import) and path.parent.name != "cli":
                assert "cdcr" not in {alias.name for alias in node.names}, path


def test_no_module_only_forwards() -> None:
    for path in PACKAGE.rglob("*.py"):
        body = ast.parse(path.read_text()).body[1:]  # after its docstring
        if path.stem != "__init__":
            forwards = (ast.Import, ast.ImportFrom)
            assert not all(isinstance(node, forwards) for node in body), path


def test_the_spine_is_short() -> None:
    total = 0
    for pattern in SPINE:
        files = list((ROOT / "cpp" / "src").glob(pattern))
        assert files, pattern
        text = "\n".join(path.read_text() for path in files)
        lines = sum(bool(line.partition("//")[0].strip()) for line in text.splitlines())
        print(f"{pattern:24} {lines:5} lines of code")
        total += lines
    print(f"{'the spine':24} {total:5}")
    assert total <= MOST_SPINE
