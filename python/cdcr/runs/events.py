"""What a run looks for on its way: functions of time and state that go through zero."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Sequence
from numbers import Integral, Real
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import NO_NUMBERS, Check, short

EventFunction: TypeAlias = Callable[..., Any]
Watched: TypeAlias = tuple[EventFunction, int, int]


class EventRecord(NamedTuple):
    """An event of a run: one of its functions went through zero.

    Attributes
    ----------
    time : float
        When [s].
    event : int
        Index of the function among those given.
    q, qd : (d,) array
        Coordinates and their rates there.
    """

    time: float
    event: int
    q: FloatArray
    qd: FloatArray


class SlackEvent(NamedTuple):
    """A length-driven cable turned slack or taut.

    Attributes
    ----------
    time : float
        When [s].
    cable : int
        Index of the cable.
    slack : bool
        Slack from here on, or taut again.
    """

    time: float
    cable: int
    slack: bool


def watched(events: EventFunction | Sequence[EventFunction] | None) -> list[Watched]:
    """Return what the core looks for, of functions with attributes as SciPy's solve_ivp has them.

    Raises
    ------
    TypeError, ValueError
        For what is no function, takes other arguments, or has other attributes.
    """
    if events is None or (isinstance(events, tuple) and not events):
        return []
    check = Check()
    functions = [events] if callable(events) else events
    functions = check.items("events", functions, "a function or a sequence of functions")
    check.done()
    return [_watched(function, i) for i, function in enumerate(functions)]


def _watched(function: EventFunction, i: int) -> Watched:
    item = f"events[{i}]"
    if not callable(function):
        raise TypeError(f"{item} must be a function, got {type(function).__name__}")
    direction = getattr(function, "direction", 0)
    is_number = isinstance(direction, Real) and not isinstance(direction, NO_NUMBERS)
    if not (is_number and math.isfinite(direction)):
        raise ValueError(f"direction of {item} must be a number, got {short(direction)}")
    terminal = getattr(function, "terminal", False)
    if not isinstance(terminal, (Integral, np.bool_)) or terminal < 0:
        raise ValueError(
            f"terminal of {item} must be True, False or a number of times, got {short(terminal)}"
        )
    told = _of_state(function, item)

    def number(t: float, q: FloatArray, qd: FloatArray) -> Any:
        value = told(t, q, qd)
        if isinstance(value, (bool, np.bool_)):
            raise TypeError(f"{item} must return a number that goes through zero, got {value}")
        return value

    return number, int(np.sign(float(direction))), int(terminal)


def _of_state(function: EventFunction, item: str) -> EventFunction:
    """Return a function of t, q and qd."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return function
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    if any(p.kind is p.VAR_POSITIONAL for p in parameters):
        return function
    needed = sum(p.kind in positional and p.default is p.empty for p in parameters)
    if needed == 3:
        return function
    if needed == 2:
        return lambda t, q, qd: function(t, np.concatenate([q, qd]))
    if needed == 1:
        return lambda t, q, qd: function(t)
    raise ValueError(
        f"{item} must take (t, q, qd), (t, y) with y = (q, qd), or (t), "
        f"got a function that needs {needed} arguments"
    )
