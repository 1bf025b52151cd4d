"""The documentation site: every name in the reference has an example, and code in pages runs."""

from __future__ import annotations

import doctest
import importlib.util
import inspect
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import cdcr
import cdcr.gym
import cdcr.identification
import cdcr.plotting

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
REFERENCE = DOCS / "reference"
MODULES = (
    *(cdcr, cdcr.casadi, cdcr.control, cdcr.export, cdcr.gym, cdcr.identification, cdcr.jax),
    *(cdcr.paper, cdcr.plotting, cdcr.robots, cdcr.scenarios, cdcr.sweeps),
)
RETURNED = {"cdcr.view.View"}  # by public names
FLAGS = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS


def module_of(path: Path) -> ModuleType:
    """Load a file of the site, without Sphinx."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def examples() -> dict[str, str]:
    """Examples of names whose docstrings have none."""
    text = (REFERENCE / "examples.txt").read_text(encoding="utf-8")
    parts = re.split(r"^\[(cdcr[\w.]*)\]\n", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


EXAMPLES = examples()


def public() -> Iterator[tuple[str, Any]]:
    """Public names, and the methods and properties of public classes."""
    for module in MODULES:
        for name in module.__all__:
            thing = getattr(module, name)
            if name.startswith("__") or inspect.ismodule(thing):
                continue
            yield f"{module.__name__}.{name}", thing
            if inspect.isclass(thing):
                for member in filter(lambda member: is_ours(thing, member), dir(thing)):
                    found = inspect.getattr_static(thing, member)
                    yield f"{module.__name__}.{name}.{member}", found


def is_ours(cls: type, member: str) -> bool:
    """Whether it is a public method or property of ours, and no field."""
    owner = next((base for base in cls.__mro__ if member in vars(base)), object)
    fields = (*getattr(cls, "__dataclass_fields__", ()), *getattr(cls, "_fields", ()))
    return member[0] != "_" and member not in fields and owner.__module__.startswith("cdcr")


def needs_example(thing: Any) -> bool:
    """Whether it is called; what a class holds stands in the example of the class."""
    return isinstance(thing, (staticmethod, classmethod)) or callable(thing)


PUBLIC = dict(public())
PAGES = "\n".join(page.read_text(encoding="utf-8") for page in REFERENCE.rglob("*.md"))


def documented() -> dict[str, set[str] | None]:
    """Names that the reference asks for, and their members: None for all."""
    told: dict[str, set[str] | None] = {}
    pattern = r"^\.\. auto(?:class|function|exception|data|module):: (\S+)\n((?: {3}:.*\n)*)"
    for name, options in re.findall(pattern, PAGES, re.MULTILINE):
        match = re.search(r":members:(.*)", options)
        if match is None:
            told[name] = set()
        else:
            told[name] = set(re.findall(r"\w+", match[1])) or None
    return told


DOCUMENTED = documented()


def in_reference(name: str) -> bool:
    if name in DOCUMENTED:
        return True
    owner, _, member = name.rpartition(".")
    return owner in DOCUMENTED and member in (DOCUMENTED[owner] or {member})


@pytest.mark.parametrize("name", PUBLIC)
def test_a_public_name_is_in_the_reference_with_an_example(name: str) -> None:
    assert in_reference(name)
    if needs_example(PUBLIC[name]):
        function = getattr(PUBLIC[name], "__func__", PUBLIC[name])
        assert (name in EXAMPLES) != (">>>" in (inspect.getdoc(function) or ""))


@pytest.mark.parametrize("name", EXAMPLES)
def test_an_example_of_the_reference_runs(name: str) -> None:
    assert name in PUBLIC or name in RETURNED
    test = doctest.DocTestParser().get_doctest(EXAMPLES[name], {}, name, None, 0)
    assert test.examples
    assert doctest.DocTestRunner(optionflags=FLAGS).run(test).failed == 0


def test_every_header_is_in_the_reference() -> None:
    headers = {path.name for path in (ROOT / "cpp" / "include" / "cdcr").glob("*.hpp")}
    shown = re.findall(r"^```\{cpp-header\} (\S+)$", PAGES, re.MULTILINE)
    assert sorted(shown) == sorted(headers)


def test_every_status_is_told_of() -> None:
    page = (DOCS / "howto" / "embed.md").read_text()
    assert [name for name in cdcr.Status.__members__ if f"`{name}`" not in page] == []


def test_no_comment_of_a_header_reads_as_a_quotation() -> None:
    """As one does that begins with >: Doxygen makes a quotation of it, which breaks the site."""
    headers = sorted((ROOT / "cpp" / "include" / "cdcr").glob("*.hpp"))
    begins = re.compile(r"///<? *>(?!=)")
    assert [path.name for path in headers if begins.search(path.read_text())] == []


def tables() -> set[str]:
    """Schemas of scenario files, and of those for `cdcr identify`, that hold keys of their own."""
    from pydantic import BaseModel

    from cdcr.identification import schema as identify
    from cdcr.scenarios.file import control_schema, estimator_schema, schema, shape_schema

    bases = {"BaseModel", "MeasuredTable", "TensionShape"}
    homes = {"schema": schema, "shape_schema": shape_schema, "identify": identify}
    homes |= {"control_schema": control_schema, "estimator_schema": estimator_schema}
    return {
        f"{home}:{name}"
        for home, module in homes.items()
        for name, thing in vars(module).items()
        if inspect.isclass(thing)
        and issubclass(thing, BaseModel)
        and name[0] != "_"
        and name not in bases
        and (thing.__module__ == module.__name__ or name == "RobotChanges")
    }


def test_every_table_of_files_is_in_the_reference() -> None:
    shown = re.findall(r"^```\{file-keys\} (\S+)$", PAGES, re.MULTILINE)
    assert {"Robot", "Section", "Cable"} | tables() == set(shown)


def plain_blocks() -> Iterator[Any]:
    """Python in pages that the build does not run; other tests run that of the paper's page."""
    for page in sorted(DOCS.rglob("*.md")):
        if page.name == "origin-paper.md":
            continue
        for k, block in enumerate(
            re.findall(r"^```python\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL)
        ):
            yield pytest.param(block, id=f"{page.stem}-{k}")


@pytest.mark.parametrize("block", list(plain_blocks()))
def test_python_in_a_page_runs(block: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    block = block.replace("linspace(0, 2, 201)", "linspace(0, 0.2, 21)")  # a shorter film
    exec(compile(block, "page", "exec"), {})


# --- Formulas ---

sys.path.insert(0, str(DOCS / "_ext"))
typeset = importlib.import_module("typeset")
inline = importlib.import_module("inline").inline
sys.path.pop(0)


@pytest.mark.parametrize(
    ("plain", "tex"),
    [
        ("T = 1/2 (a w + b p^2)", r"T=\frac{1}{2}(aw+bp^{2})"),
        ("S(y) = sin y / y", r"S(y)=\frac{\sin y }{y}"),
        ("omega' = omega + W qd", r"\omega^{\prime }=\omega +W\dot q"),
        ("v = x z x q", r"v=xz\times q"),
        ("M^-1 v = (v - q)/a", r"M^{-1}v=\frac{v-q}{a}"),
        ("J = a 1 + b q q^T", r"J=a\,\mathbf{1}+bqq^{T}"),
        ("d2U/dq2", r"\frac{d^2 U}{dq^2}"),
        ("theta_max,i <= 2 pi", r"\theta_{\max , i}\le 2\pi "),
        ("s = -tanh(u/u_0)", r"s=-\tanh \left(\frac{u}{u_{0}}\right)"),
    ],
)
def test_a_formula_as_tex(plain: str, tex: str) -> None:
    assert typeset.formula(plain) == tex


@pytest.mark.parametrize(
    ("plain", "told"),
    [
        ("at theta = 0 all are", r"at $\theta =0$ all are"),
        ("A cable at a x of its own", "A cable at a $x$ of its own"),
        ("with A, S of x", "with $A$, $S$ of $x$"),
        ("give alpha' and beta'", r"give $\alpha^{\prime }$ and $\beta^{\prime }$"),
        ("(q_x, q_y, 0), see (2)", "$(q_{x}, q_{y}, 0)$, see (2)"),
        ("where |r|^2 falls", r"where $\vert r\vert ^{2}$ falls"),
        ("A. Amouri, C. Mahfoudi", "A. Amouri, C. Mahfoudi"),
        ("Young's, 5 N on it, 3x2, e.g. C++", "Young's, 5 N on it, 3x2, e.g. C++"),
        ("`q` [N m] in [theta](theta.md)", "`q` [N m] in [theta](theta.md)"),
        (
            "| symbol | unit |\n|---|---|\n| a, b; G_A | kg m^2 |\n",
            "| symbol | unit |\n|---|---|\n| $a, b; G_{A}$ | kg m² |\n",
        ),
    ],
)
def test_formulas_within_lines(plain: str, told: str) -> None:
    assert inline(plain) == told


def test_what_has_no_meaning_is_refused() -> None:
    with pytest.raises(typeset.FormulaError, match="'#' in the formula"):
        typeset.formula("a # b")
    with pytest.raises(typeset.FormulaError, match="without"):
        typeset.formula("(a + b")


@pytest.mark.parametrize(
    "name",
    [
        *("README.md", "several-sections.md", "rods.md", "derivatives.md", "control.md"),
        *("estimation.md", "friction.md", "sensitivities.md"),
    ],
)
def test_all_numbered_equations_are_set(name: str) -> None:
    text = (ROOT / "cpp" / name).read_text(encoding="utf-8")
    numbers = re.findall(r" \((\d+)\)$", "".join(typeset.FENCED.findall(text)), re.MULTILINE)
    told = typeset.typeset(text)
    assert re.findall(r"\\tag\{(\d+)\}", told) == numbers
    for block in re.findall(r"\\begin\{align\*\}(.*?)\\end\{align\*\}", told, re.DOTALL):
        assert block.count("{") == block.count("}")
        assert block.count(r"\left") - block.count(r"\leftarrow") == block.count(r"\right)")


# --- Pages of scripts, and the check of links ---


def test_a_script_becomes_cells_with_text_between_them() -> None:
    script = (
        '"""\nTitle\n=====\n\nText.\n"""\n\nimport sys\n\n# %%\n# Part\n# ----\n\nx = 1  # one\n'
    )
    page = module_of(DOCS / "_ext" / "scripts.py").page_of_script(script)
    assert re.findall(r"```.*?```", page, re.DOTALL)[1:] == [
        "```{code-cell} python\nimport sys\n```",
        "```{code-cell} python\nx = 1  # one\n```",
    ]
    assert re.sub(r"```.*?```", "", page, flags=re.DOTALL).split() == [
        *("---", "file_format:", "mystnb", "kernelspec:", "{name:", "python3}", "---"),
        *("Title", "=====", "Text.", "Part", "----"),
    ]


def test_dead_links_and_requests_to_elsewhere_are_found(tmp_path: Path) -> None:
    complaints = module_of(DOCS / "check_site.py").complaints
    good, bad = tmp_path / "good", tmp_path / "bad"
    for folder in (good, bad):
        folder.mkdir()
        (folder / "a.html").write_text('<a href="b.html#b">b</a> <a href="https://x.org">x</a>')
    (good / "b.html").write_text('<h1 id="b">b</h1>')
    assert complaints(good) == []
    (bad / "b.html").write_text('<script src="https://x.org/y.js"></script>')
    (bad / "c.css").write_text("@import url(https://x.org/font.css);")
    (bad / "d.html").write_text('<img src="none.png"><a href="#none">d</a>')
    (bad / "reference" / "cpp").mkdir(parents=True)
    (bad / "reference" / "cpp" / "e.html").write_text("<blockquote>0: upwards</blockquote>")
    told = [line.removeprefix(f"{bad}/") for line in complaints(bad)]
    assert told == [
        "a.html: b.html#b has no such place",
        "b.html: asks https://x.org/y.js of another machine",
        "d.html: none.png is not there",
        "d.html: #none has no such place",
        "reference/cpp/e.html: a comment of a header became a quotation",
        "c.css: asks https://x.org/font.css of another machine",
    ]
