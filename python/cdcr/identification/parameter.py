"""What is asked of a parameter beside its path: where to begin, bounds, what was known before."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

from cdcr.base.check import Check, format_value, nearest
from cdcr.identification.paths import Quantity, quantities_of
from cdcr.identification.setup import Plain, copy_plain
from cdcr.robot.robot import Robot


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """How a parameter is sought.

    Parameters
    ----------
    start : float, optional
        Where the search begins; by default the value that the robot has.
    low, high : float, optional
        Bounds; by default what the model allows.
    prior : tuple of two floats, optional
        What was known before, as mean and standard deviation; counts as one more measurement.

    Raises
    ------
    ValueError
        Naming what is no number, or out of order.

    Examples
    --------
    >>> import cdcr.identification
    >>> cdcr.identification.Parameter(low=40e9, high=90e9, prior=(60e9, 5e9)).low
    40000000000.0
    """

    start: float | None = None
    low: float | None = None
    high: float | None = None
    prior: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        """Keep plain floats, or refuse what is none."""
        check = Check()
        for name in ("start", "low", "high"):
            value = getattr(self, name)
            if value is not None:
                number = check.number(name, value, "a finite number", -math.inf)
                object.__setattr__(self, name, number)
        if self.prior is not None:
            requirement = "a mean and a standard deviation > 0"
            pair = check.vector("prior", self.prior, requirement, "a number", 2)
            if len(pair) == 2 and not pair[1] > 0.0:
                check.refuse("prior", requirement, self.prior)
            object.__setattr__(self, "prior", pair)
        check.done()


def parameter_of(path: str, told: object) -> Parameter:
    """Return a parameter from what may stand beside its path: nothing, a start, or a table."""
    if told is None:
        return Parameter()
    if isinstance(told, Parameter):
        return told
    known = [item.name for item in fields(Parameter)]
    try:
        if isinstance(told, Mapping):
            for key in told:
                if key not in known:
                    quote = f'; a path stands in quotes: "{path}.{key}"' if "." not in path else ""
                    hint = nearest(str(key), known)
                    raise ValueError(
                        f"there is no key {key!r}.{hint}"
                        if hint or not quote
                        else f"there is no key {key!r}{quote}"
                    )
            return Parameter(**told)
        return Parameter(start=told)  # type: ignore[arg-type]
    except ValueError as error:
        raise ValueError(f"parameter {path!r}: {error}") from None


@dataclass(frozen=True)
class Unknown:
    """One number that is sought, with all that is asked of it."""

    quantity: Quantity
    start: float
    low: float
    high: float
    prior: tuple[float, float] | None

    @property
    def size(self) -> float:
        """A size of it that matters: its start, or what is typical where it begins at zero."""
        return abs(self.start) if self.start and self.quantity.start else self.quantity.typical


def unknowns_of(parameters: object, robot: Robot, plain: Plain, first: int = 0) -> list[Unknown]:
    """Return all numbers sought.

    Raises
    ------
    ValueError
        For paths of no number, numbers sought twice, and starts out of bounds.
    """
    if not isinstance(parameters, Mapping):
        raise ValueError(f"parameters must be a table of paths, got {format_value(parameters)}")
    if not parameters:
        raise ValueError("parameters must name at least one number to seek, got none")
    found: list[Unknown] = []
    taken: dict[Any, str] = {}
    for path, told in parameters.items():
        asked = parameter_of(path, told)
        for quantity in quantities_of(path, robot, plain, first):
            for slot in quantity.slots:
                if slot in taken:
                    raise ValueError(
                        f"parameters {taken[slot]!r} and {path!r} seek the same number"
                    )
                taken[slot] = path
            found.append(_unknown(path, asked, quantity))
    return found


def _unknown(path: str, asked: Parameter, quantity: Quantity) -> Unknown:
    low = quantity.low if asked.low is None else max(asked.low, quantity.low)
    high = quantity.high if asked.high is None else min(asked.high, quantity.high)
    start = quantity.start if asked.start is None else asked.start
    if not low < high:
        raise ValueError(f"parameter {path!r}: low must be below high, got {low:g} and {high:g}")
    if not low <= start <= high:
        raise ValueError(
            f"parameter {path!r}: start must be from {low:g} to {high:g}, got {start:g}"
        )
    return Unknown(quantity, start, low, high, asked.prior)


def put_all(plain: Plain, unknowns: list[Unknown], values: Any) -> Plain:
    """Return the laboratory with values in place of the numbers sought."""
    changed: Plain = copy_plain(plain)
    for unknown, value in zip(unknowns, values, strict=True):
        unknown.quantity.put(changed, float(value))
    return changed
