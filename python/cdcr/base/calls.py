"""What is wrong with the arguments of a call to the compiled core, in a sentence."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from numbers import Integral, Real
from sys import float_info
from typing import Any

import numpy as np

from cdcr.base.check import MAX_INT, NO_NUMBERS, format_value

# What docstrings in numpydoc's form say of an argument, and what it must be.
_KINDS: dict[str, tuple[Any, str]] = {
    "int": (Integral, "a whole number"),
    "float": (Real, "a number"),
    "bool": ((bool, np.bool_), "True or False"),
    "{": (str, "a string"),
}


def explain(function: Callable[..., Any], args: Sequence[Any], kwargs: Mapping[str, Any]) -> str:
    """Return what is wrong with a call that the core refused, from signature and docstring.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> explain(cdcr.Model.pose, (model, [0.1, 0.0], 0), {})
    "pose(): missing a required argument: 'fraction'"
    >>> explain(cdcr.Model.pose, (model, [0.1, 0.0], "tip", 1.0), {})
    "section must be a whole number, got 'tip' (str)"
    """
    name, signature = function.__name__.strip("_"), inspect.signature(function)
    owner = type(args[0]) if "self" in signature.parameters else None
    documented = getattr(owner, name, function)  # where the core's own is a private one beneath
    if function.__name__ == "__init__" and owner:
        name = owner.__name__
    try:
        given = signature.bind(*args, **kwargs).arguments
    except TypeError as error:
        return f"{name}(): {error}"
    given.pop("self", None)
    parameters = inspect.signature(documented).parameters
    for item, value in given.items():
        kind = _kind(documented.__doc__ or "", item)
        left_out = value is None and parameters[item].default is None
        if kind and not left_out:
            wanted, requirement = _KINDS[kind]
            scalar = isinstance(value, np.ndarray) and value.ndim == 0
            plain = value[()] if scalar else value
            no_number = kind != "bool" and isinstance(plain, NO_NUMBERS)
            if no_number or not isinstance(plain, wanted):
                return f"{item} must be {requirement}, got {format_value(value)}"
            largest = MAX_INT if wanted is Integral else float_info.max
            if isinstance(plain, Integral) and abs(int(plain)) > largest:
                told = f"{requirement} of at most {largest:.10g} in size"
                return f"{item} must be {told}, got {format_value(value)}"
    kinds = ", ".join(f"{item} {type(value).__name__}" for item, value in given.items())
    return f"{name}() takes arguments of other kinds than {kinds}"


@cache
def _kind(documentation: str, item: str) -> str | None:
    """Return which of `_KINDS` a docstring says that an argument is, if any."""
    listed = rf"^ *(?:\w+, )*{item}(?:, \w+)* : (?:(int|float|bool)(?: or None)?(?:,.*)?$|({{))"
    kind = re.search(listed, documentation, re.MULTILINE)
    return (kind[1] or kind[2]) if kind else None
