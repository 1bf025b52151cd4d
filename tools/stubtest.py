"""The types of the compiled core against the core: python tools/stubtest.py.

Its stub is in several files, which stubtest takes for modules of their own: each becomes one that
has what its file names, else stubtest would leave out what `_core.pyi` only hands on.
"""

import ast
import sys
from pathlib import Path
from types import ModuleType

from mypy import stubtest

from cdcr import _core

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "python" / "cdcr"


def part(path: Path) -> str:
    """Make a module of what a stub defines, and return its name."""
    module = ModuleType(f"cdcr.{path.stem}")
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)) and hasattr(_core, node.name):
            setattr(module, node.name, getattr(_core, node.name))
    sys.modules[module.__name__] = module
    return module.__name__


def main() -> int:
    """Return the exit code of stubtest."""
    modules = ["cdcr._core", *(part(path) for path in sorted(FOLDER.glob("_core_*.pyi")))]
    allowed = ROOT / "tests" / "python" / "stubtest_allowlist.txt"
    return stubtest.test_stubs(stubtest.parse_options([*modules, "--allowlist", str(allowed)]))


if __name__ == "__main__":
    sys.exit(main())
