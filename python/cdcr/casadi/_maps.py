"""A function of CasADi that calls Python, with the Jacobian that Python gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NoReturn, TypeAlias

import casadi
import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import count

Evaluate: TypeAlias = Callable[..., tuple[FloatArray, ...]]
Shapes: TypeAlias = Mapping[str, tuple[int, int]]

# CasADi knows a callback by its address and does not keep it: expressions may outlive the name that
# a user gave it, so all callbacks stay for the life of the process.
_KEPT: list[Any] = []


class Map(casadi.Callback):
    """A function of named columns; `slopes` gives the blocks of its Jacobian, row by row.

    Forward and reverse derivatives are products with that Jacobian, whose entries cost less
    together than as many calls.
    """

    def __init__(
        self, name: str, takes: Shapes, gives: Shapes, evaluate: Evaluate, slopes: Evaluate | None
    ) -> None:
        super().__init__()
        self._takes, self._gives = dict(takes), dict(gives)
        self._evaluate, self._slopes = evaluate, slopes
        by_jacobian = {"enable_forward": False, "enable_reverse": False}
        self.construct(name, by_jacobian)
        _KEPT.append(self)

    def get_n_in(self) -> int:
        return len(self._takes)

    def get_n_out(self) -> int:
        return len(self._gives)

    def get_name_in(self, i: int) -> str:
        return list(self._takes)[i]

    def get_name_out(self, i: int) -> str:
        return list(self._gives)[i]

    def get_sparsity_in(self, i: int) -> Any:
        return casadi.Sparsity.dense(*list(self._takes.values())[i])

    def get_sparsity_out(self, i: int) -> Any:
        return casadi.Sparsity.dense(*list(self._gives.values())[i])

    def has_eval_buffer(self) -> bool:
        return True

    def eval_buffer(self, given: Any, found: Any) -> int:
        """Compute on CasADi's own memory, matrices by columns; None where nobody asks."""
        some = zip(self._takes.values(), given, strict=True)
        columns = [
            np.zeros(rows * cols) if one is None else np.frombuffer(one, dtype=np.float64)
            for (rows, cols), one in some
        ]
        for answer, room in zip(self._evaluate(*columns), found, strict=True):
            if room is not None:
                np.frombuffer(room, dtype=np.float64)[:] = answer.ravel(order="F")
        return 0

    def has_jacobian(self) -> bool:
        return True

    def get_jacobian(self, name: str, inames: Any, onames: Any, opts: Any) -> Any:
        """Return the function of the blocks d(out)/d(in), which takes the answers too."""
        if self._slopes is None:
            raise NotImplementedError(NO_HESSIAN)
        slopes, takes = self._slopes, len(self._takes)
        shapes = [
            (no * co, ni * ci) for no, co in self._gives.values() for ni, ci in self._takes.values()
        ]
        return Map(
            name,
            dict(zip(inames, [*self._takes.values(), *self._gives.values()], strict=True)),
            dict(zip(onames, shapes, strict=True)),
            lambda *columns: slopes(*columns[:takes]),
            None,
        )

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Call it with the shapes asked about first, as CasADi tells of its own ones at length."""
        if args and len(args) != len(self._takes):
            takes = ", ".join(self._takes)
            raise TypeError(f"{self.name()} takes ({takes}), got {count(len(args), 'argument')}")
        for name, value in (*zip(self._takes, args, strict=False), *kwargs.items()):
            if name in self._takes:
                _refuse_shape(name, value, self._takes[name])
        return super().__call__(*args, **kwargs)

    def __copy__(self) -> Map:
        return self

    def __deepcopy__(self, memo: dict[int, Any] | None = None) -> Map:
        return self

    def _refuse(self, *_: object) -> NoReturn:
        raise TypeError(
            f"{self.name()} calls Python and cannot be pickled; pickle the cdcr.Model, and make "
            "the function anew from it"
        )

    __reduce__ = _refuse
    serialize: Any = _refuse
    save: Any = _refuse


NO_HESSIAN = (
    "cdcr has no second derivatives: give the solver an approximation of the Hessian, as in "
    '{"ipopt.hessian_approximation": "limited-memory"}'
)


def _refuse_shape(name: str, value: Any, wanted: tuple[int, int]) -> None:
    shape = getattr(value, "shape", None)
    shape = np.shape(value) if shape is None else tuple(shape)
    size = wanted[0]
    fits = shape == (size,) or (len(shape) == 2 and (shape[0] == size or shape == (1, size)))
    if not fits and not (shape == () and size == 1):
        raise ValueError(
            f"{name} must have shape ({size},) or ({size}, k) for k columns, got {shape}"
        )
