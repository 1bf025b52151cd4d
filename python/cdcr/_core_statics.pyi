"""Types of the compiled core that hold answers of statics; `_core.pyi` hands them on."""

import enum
from typing import final, type_check_only

import numpy as np
from numpy.typing import NDArray

from cdcr._core import Status

_FloatArray = NDArray[np.float64]

@type_check_only
class _Bound(type):
    """Metaclass of classes bound by pybind11."""

@final
class Equilibrium(metaclass=_Bound):
    """A point of rest and whether the robot stays there."""

    @property
    def q(self) -> _FloatArray: ...
    @property
    def tension(self) -> _FloatArray: ...
    @property
    def eigenvalues(self) -> _FloatArray: ...
    @property
    def stable(self) -> bool: ...
    @property
    def residual(self) -> float: ...
    @property
    def iterations(self) -> int: ...
    @property
    def load_steps(self) -> int: ...
    @property
    def searches(self) -> int: ...
    @property
    def status(self) -> Status: ...

@final
class Allocation(metaclass=_Bound):
    @property
    def tension(self) -> _FloatArray: ...
    @property
    def force(self) -> _FloatArray: ...
    @property
    def distance(self) -> float: ...
    @property
    def feasible(self) -> bool: ...
    @property
    def limiting(self) -> list[int]: ...
    @property
    def limits(self) -> list[str]: ...

class AllocationMethod(enum.Enum):
    """How tensions are found."""

    automatic = 0
    sections = 1
    search = 2

@final
class CoreModes(metaclass=_Bound):
    """Small vibrations about a shape."""

    @property
    def squared_frequency(self) -> _FloatArray: ...
    @property
    def frequency(self) -> _FloatArray: ...
    @property
    def shape(self) -> _FloatArray: ...
    @property
    def damping_ratio(self) -> _FloatArray: ...
    @property
    def eigenvalues(self) -> NDArray[np.complex128]: ...
    @property
    def stable(self) -> bool: ...
