"""Derivatives of a run: what it is differentiated by, and the answers by name."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from cdcr import _core
from cdcr.base.arrays import FloatArray, read_only
from cdcr.base.check import is_iterable, short
from cdcr.model.model import Model

_START = ("q0", "qd0")
_COMMANDS = ("tension", "command")


@dataclass(frozen=True)
class Asked:
    """By what a run is differentiated, as the core takes it.

    Attributes
    ----------
    names : tuple of str
        In the order of the columns.
    parameters : _core.ParameterSet, optional
        Those that are neither of the start nor commands.
    start : (2d, k) array, optional
        Derivatives of the start, where it depends on more than itself.
    command_slopes : tuple, optional
        Times, derivatives of the commands (N, k num_cables) and whether they are connected.
    """

    names: tuple[str, ...]
    parameters: _core.ParameterSet | None = None
    start: FloatArray | None = None
    command_slopes: tuple[FloatArray, FloatArray, bool] | None = None

    def core(self) -> tuple[Any, ...]:
        """Return it as the core takes it."""
        command = any(name in self.names for name in _COMMANDS)
        start = ("q0" in self.names, "qd0" in self.names)
        return (*start, command, self.parameters, self.start, self.command_slopes)

    def split(self, model: Model, rows: FloatArray) -> tuple[dict[str, FloatArray], ...]:
        """Return the derivatives of q and of qd (N, d, k) by name."""
        d = model.num_coordinates
        found: tuple[dict[str, FloatArray], ...] = ({}, {})
        at = 0
        for name, width in self._widths(model):
            for half, answers in enumerate(found):
                block = rows[:, half * d : (half + 1) * d, at : at + width]
                answers[name] = read_only(block.copy())
            at += width
        return found

    def _widths(self, model: Model) -> Iterator[tuple[str, int]]:
        for name in self.names:
            several = model.num_cables if name in _COMMANDS else 1
            yield name, model.num_coordinates if name in _START else several


def asked_of(model: Model, names: str | Sequence[str]) -> Asked:
    """Return what names ask for.

    Raises
    ------
    ValueError
        For names given twice, and paths that lead to no number.
    TypeError
        For what is no name.
    """
    if not is_iterable(names):
        must = "names, such as 'q0', 'tension' or 'payload'"
        raise TypeError(f"sensitivities must be {must}, got {short(names)}")
    given = (names,) if isinstance(names, str) else tuple(names)
    if not given:
        return Asked(())
    known = [name for name in given if name in (*_START, *_COMMANDS)]
    paths = [name for name in given if name not in known]
    twice = [name for name in given if given.count(name) > 1]
    if twice or all(name in known for name in _COMMANDS):
        told = repr(twice[0]) if twice else "'tension', which is 'command',"
        raise ValueError(f"sensitivities must be named once each, got {told} twice")
    besides = (*_START, *_COMMANDS)
    parameters = model._parameter_sets.find(model, paths, besides) if paths else None
    order = [name for name in (*_START, *_COMMANDS) if name in known]
    return Asked((*order, *paths), parameters)
