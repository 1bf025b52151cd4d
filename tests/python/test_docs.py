"""Every public name answers help(): what it takes and gives, with shapes and units."""

from __future__ import annotations

import ast
import doctest
import enum
import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import cdcr
import cdcr.plotting
import cdcr.view
from cdcr import _core

MODULES = (
    cdcr,
    cdcr.casadi,
    cdcr.control,
    cdcr.gym,
    cdcr.jax,
    cdcr.paper,
    cdcr.plotting,
    cdcr.robots,
    cdcr.scenarios,
    cdcr.sweeps,
    cdcr.view,
    _core,
)
# What says what kind of number it is: a unit in brackets, or words in place of one.
# The class Model says once what coordinates are measured in.
UNIT = re.compile(
    r"\[[^\]]+\]|unit of `q`|coordinates|in rad|radians|rotation matri|indices|whether", re.I
)
ARRAY = re.compile(r"\b(array|ndarray|array_like)\b")
SHAPE = re.compile(r"\([^()]*\)")


def stub_arrays() -> set[tuple[str, str]]:
    """Properties of bound classes that the stubs say are arrays, by class and name."""
    return {
        (item.name, member.name)
        for stub in Path(cdcr.__file__).parent.rglob("_core*.pyi")
        for item in ast.parse(stub.read_text(encoding="utf-8")).body
        if isinstance(item, ast.ClassDef)
        for member in item.body
        if isinstance(member, ast.FunctionDef) and member.returns is not None
        if "Array" in ast.unparse(member.returns)
    }


ARRAYS = stub_arrays()


def public_names(module: ModuleType) -> list[str]:
    names = getattr(module, "__all__", None) or [name for name in vars(module) if name[0] != "_"]
    return [name for name in names if not name.startswith("__")]


def members(cls: type) -> Iterator[tuple[str, Any]]:
    """Public members of a class of ours, inherited ones too."""
    for name in dir(cls):
        owner = next((base for base in cls.__mro__ if name in vars(base)), object)
        field = name in getattr(cls, "__dataclass_fields__", ())
        if not name.startswith("_") and owner.__module__.startswith("cdcr") and not field:
            yield name, inspect.getattr_static(cls, name)


def everything() -> Iterator[tuple[str, Any]]:
    for module in MODULES:
        yield module.__name__, module
        for name in public_names(module):
            thing = getattr(module, name)
            yield f"{module.__name__}.{name}", thing
            if inspect.isclass(thing):
                for member, what in members(thing):
                    yield f"{module.__name__}.{name}.{member}", what


def sections(doc: str) -> dict[str, str]:
    """The sections of a docstring in numpydoc's form, the text before them as ''."""
    parts = re.split(r"^(\w[\w ]*)\n-{3,}$", inspect.cleandoc(doc), flags=re.M)
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2], strict=True))}


def entries(section: str) -> dict[str, str]:
    """What a section says under each of its headings, such as 'q, qd : (2n,) array'."""
    parts = re.split(r"^(\S.*)$", section, flags=re.M)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def documented(section: str) -> set[str]:
    heads = (head.split(" : ")[0] for head in entries(section))
    return {name.lstrip("*") for head in heads for name in head.split(", ")}


def without_shape_or_unit(section: str) -> Iterator[str]:
    for head, text in entries(section).items():
        if not ARRAY.search(head):
            continue
        if not SHAPE.search(head):
            yield f"no shape for {head!r}"
        if not UNIT.search(text) and not UNIT.search(head):
            yield f"no unit for {head!r}"


def arguments(thing: Any) -> set[str]:
    names = inspect.signature(thing).parameters
    return {name for i, name in enumerate(names) if not (i == 0 and name in ("self", "cls"))}


def wrong(name: str, thing: Any) -> Iterator[str]:
    """What is missing in the documentation of one name."""
    if isinstance(thing, (staticmethod, classmethod)):
        thing = thing.__func__
    doc = inspect.getdoc(thing) or ""
    if isinstance(thing, property):
        yield from wrong_property(name, thing, doc)
    elif callable(thing) and not isinstance(thing, enum.Enum):
        if not doc:
            yield "no docstring"
        parts = sections(doc)
        for title in ("Parameters", "Attributes", "Returns"):
            yield from without_shape_or_unit(parts.get(title, ""))
        if inspect.isclass(thing) and issubclass(thing, (enum.Enum, Exception)):
            return
        if inspect.isclass(thing) and thing.__module__ == _core.__name__:
            constructor: Any = vars(thing)["__init__"]
            if inspect.ismethoddescriptor(constructor):  # the slot of what the core alone makes
                return
            parts = sections(inspect.getdoc(constructor) or "")
        told = {
            name
            for title in ("Parameters", "Other Parameters", "Attributes")
            for name in documented(parts.get(title, ""))
        }
        missing = arguments(thing) - told
        if missing and "fields" not in told:
            yield f"no word of {', '.join(sorted(missing))}"
    elif inspect.ismodule(thing) and not doc:
        yield "no docstring"


def wrong_property(name: str, thing: property, doc: str) -> Iterator[str]:
    if not doc:
        yield "no docstring"
    *_, cls, member = name.split(".")
    annotation = str(getattr(thing.fget, "__annotations__", {}).get("return", ""))
    if "Array" in annotation or "NDArray" in annotation or (cls, member) in ARRAYS:
        if not SHAPE.search(doc):
            yield "no shape"
        if not UNIT.search(doc):
            yield "no unit"


@pytest.mark.parametrize(("name", "thing"), [pytest.param(*one, id=one[0]) for one in everything()])
def test_help_says_what_a_name_takes_and_gives(name: str, thing: Any) -> None:
    assert not list(wrong(name, thing))


def test_methods_of_a_model_name_their_equation() -> None:
    for name, what in members(cdcr.Model):
        if callable(what) and arguments(what):
            assert re.search(r"\(\d+\)|the p of `tip`", inspect.getdoc(what) or ""), name


def bare(x: float) -> None: ...


def silent(x: float, y: float) -> None:
    """Add.

    Parameters
    ----------
    x : float
        A number.
    """


def shapeless(x: float) -> None:
    """Add.

    Parameters
    ----------
    x : array_like
        Some numbers.
    """


def test_what_is_missing_is_found() -> None:
    assert list(wrong("bare", bare)) == ["no docstring", "no word of x"]
    assert list(wrong("silent", silent)) == ["no word of y"]
    assert list(wrong("shapeless", shapeless)) == [
        "no shape for 'x : array_like'",
        "no unit for 'x : array_like'",
    ]


def test_signatures_of_the_core_have_names_and_defaults() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    assert str(inspect.signature(model.forward_dynamics)) == "(q, qd, tension=None, wrenches=())"
    assert str(inspect.signature(cdcr.Model.mass_matrix)) == "(self, q)"
    assert str(inspect.signature(cdcr.Simulator)) == (
        "(model, *, step=0.001, substeps=1, method='rk4')"
    )
    assert inspect.signature(cdcr.Pid).parameters["max_tension"].default == float("inf")
    assert list(inspect.signature(cdcr.Model).parameters) == ["robot", "formulation"]


def test_getters_of_the_core_have_the_words_of_their_properties() -> None:
    classes = [thing for thing in vars(_core).values() if inspect.isclass(thing)]
    getters = {
        f"{cls.__name__}.{name}": one
        for cls in classes
        for name, one in vars(cls).items()
        if isinstance(one, property) and not name.startswith("_")
    }
    assert len(getters) > 100
    assert [at for at, one in getters.items() if one.__doc__ != inspect.getdoc(one.fget)] == []


def test_examples_of_the_core_run() -> None:
    flags = doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS
    failed, attempted = doctest.testmod(_core, optionflags=flags)
    assert attempted > 0
    assert failed == 0
