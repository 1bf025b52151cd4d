"""What is wrong with the arguments of a call to the compiled core, in a sentence."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Mapping, Sequence
from numbers import Integral, Real
from sys import float_info
from typing import Any

import numpy as np

from cdcr.base.check import MAX_INT, format_value

# What docstrings in numpydoc's form say of an argument, and what it must be.
_KINDS: dict[str, tuple[Any, str]] = {
    "int": (Integral, "a whole number"),
    "float": (Real, "a number"),
    "bool": (bool, "True or False"),
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
        listed = rf"^ *(?:\w+, )*{item}(?:, \w+)* : (?:(int|float|bool)(?:,.*)?$|({{))"
        kind = re.search(listed, documented.__doc__ or "", re.MULTILINE)
        left_out = value is None and parameters[item].default is None
        if kind and not left_out:
            wanted, requirement = _KINDS[kind[1] or kind[2]]
            if not isinstance(value, wanted) or isinstance(value, np.timedelta64):
                return f"{item} must be {requirement}, got {format_value(value)}"
            largest = MAX_INT if wanted is Integral else float_info.max
            if isinstance(value, Integral) and abs(int(value)) > largest:
                told = f"{requirement} of at most {largest:.10g} in size"
                return f"{item} must be {told}, got {format_value(value)}"
    kinds = ", ".join(f"{item} {type(value).__name__}" for item, value in given.items())
    return f"{name}() takes arguments of other kinds than {kinds}"
