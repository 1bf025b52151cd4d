"""A function of CasADi that calls Python, with the Jacobian that Python gives."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, NoReturn

import casadi
import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import count
from cdcr.model.maps import ExactMap, Rows

NO_HESSIAN = (
    "cdcr has no second derivatives: give the solver an approximation of the Hessian, as in "
    '{"ipopt.hessian_approximation": "limited-memory"}'
)
# CasADi knows a callback by its address and does not keep it: expressions may outlive the name that
# a user gave it, so all callbacks stay for the life of the process.
_KEPT: list[Callback] = []


class Callback(casadi.Callback):
    """A map of one row, whose vectors are columns; `slopes` gives the blocks of its Jacobian.

    Forward and reverse derivatives are products with that Jacobian, whose entries cost less
    together than as many calls.
    """

    def __init__(
        self,
        name: str,
        takes: Mapping[str, tuple[int, ...]],
        gives: Mapping[str, tuple[int, ...]],
        values: Rows,
        slopes: Rows | None,
    ) -> None:
        super().__init__()
        self._takes, self._gives = dict(takes), dict(gives)
        self._values, self._slopes = values, slopes
        by_jacobian = {"enable_forward": False, "enable_reverse": False}
        self.construct(name, by_jacobian)
        _KEPT.append(self)

    @classmethod
    def of(cls, exact: ExactMap) -> Callback:
        """Return the function of CasADi of a map."""

        def slopes(*rows: FloatArray) -> Iterable[FloatArray]:
            """Stack the entries of an answer as CasADi does, column below column."""
            for slope in exact.slopes(*rows):
                block = slope[0]
                entries = math.prod(block.shape[:-1])
                yield block.reshape(entries, block.shape[-1], order="F")[None]

        takes = {name: (size,) for name, size in exact.takes.items()}
        made = (exact.name, takes, exact.gives, exact.values)
        return cls(*made, lambda *rows: tuple(slopes(*rows)))

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
        """Compute on CasADi's own memory, where None stands for zeros and for what nobody asks."""
        rows = [
            np.zeros((1, *shape)) if one is None else np.frombuffer(one, dtype=np.float64)[None]
            for shape, one in zip(self._takes.values(), given, strict=True)
        ]
        for answer, room in zip(self._values(*rows), found, strict=True):
            if room is not None:
                np.frombuffer(room, dtype=np.float64)[:] = answer[0].ravel(order="F")
        return 0

    def has_jacobian(self) -> bool:
        return True

    def get_jacobian(self, name: str, inames: Any, onames: Any, opts: Any) -> Any:
        """Return the function of the blocks d(out)/d(in), which takes the answers too."""
        if self._slopes is None:
            raise NotImplementedError(NO_HESSIAN)
        slopes, num_takes = self._slopes, len(self._takes)
        takes = [*self._takes.values(), *self._gives.values()]
        sizes = [int(np.prod(shape)) for shape in takes]
        gives = [(size, by) for size in sizes[num_takes:] for by in sizes[:num_takes]]
        return Callback(
            name,
            dict(zip(inames, takes, strict=True)),
            dict(zip(onames, gives, strict=True)),
            lambda *rows: slopes(*rows[:num_takes]),
            None,
        )

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        """Call it with the shapes asked about first, as CasADi tells of its own ones at length."""
        if args and len(args) != len(self._takes):
            takes = ", ".join(self._takes)
            raise TypeError(f"{self.name()} takes ({takes}), got {count(len(args), 'argument')}")
        for name, value in (*zip(self._takes, args, strict=False), *kwargs.items()):
            if name in self._takes:
                _refuse_shape(name, value, self._takes[name][0])
        return super().__call__(*args, **kwargs)

    def __copy__(self) -> Callback:
        return self

    def __deepcopy__(self, memo: dict[int, Any] | None = None) -> Callback:
        return self

    def _refuse(self, *_: object) -> NoReturn:
        raise TypeError(
            f"{self.name()} calls Python and cannot be pickled; pickle the cdcr.Model, and make "
            "the function anew from it"
        )

    __reduce__ = _refuse
    serialize: Any = _refuse
    save: Any = _refuse


def _refuse_shape(name: str, value: Any, size: int) -> None:
    given = getattr(value, "shape", None)
    shape = np.shape(value) if given is None else tuple(given)
    column = shape == (size,) or (len(shape) == 2 and (shape[0] == size or shape == (1, size)))
    if not column and not (shape == () and size == 1):
        raise ValueError(
            f"{name} must have shape ({size},) or ({size}, k) for k columns, got {shape}"
        )
