"""What the fields of a description say about themselves."""

from __future__ import annotations

from dataclasses import MISSING, field, fields
from typing import Any


def quantity(
    about: str,
    unit: str,
    requirement: str,
    *,
    kind: str | type = "number",
    each: str = "",
    default: Any = MISSING,
    advanced: bool = False,
) -> Any:
    """Return a dataclass field that says what it is, for refusals and for comments in files.

    Parameters
    ----------
    about, unit, requirement : str
        What it is, in which unit, and what it must be; "> 0" and ">= 0" are numbers, and finite.
    kind : str or type, optional
        How `Check.keep` makes it plain: "number", "number or none", "number or pair", "whole",
        "whole or none", "order" (None where it is locked), "section" (an index, which files count
        from 1), "numbers", "pair", "vector", "matrix", "transform" (4 rows of 4) or "route" (a
        number, or (base, tip) pairs); a type is that of every thing in a sequence.
    each : str, optional
        What every number in a sequence must be.
    default : optional
        Its value where it is left out.
    advanced : bool, optional
        Whether it stands in files and tables only where it differs from its default.
    """
    told = {"about": about, "unit": unit, "kind": kind, "advanced": advanced}
    told |= {"requirement": _in_words(requirement, unit), "each": _in_words(each, unit)}
    return field(default=default, metadata=told)


def told(description: Any) -> str:
    """Return what one would type, without the advanced fields that are at their defaults."""
    shown = [
        f"{item.name}={getattr(description, item.name)!r}"
        for item in fields(description)
        if not item.metadata["advanced"] or getattr(description, item.name) != item.default
    ]
    return f"{type(description).__name__}({', '.join(shown)})"


def _in_words(requirement: str, unit: str) -> str:
    bound = f"{requirement} {unit}".rstrip()
    return f"a number {bound} and finite" if requirement.startswith(">") else requirement
