"""Types of the compiled core that hold what a run takes and gives; `_core.pyi` hands them on."""

import enum
from collections.abc import Callable, Sequence
from typing import final

from numpy.typing import ArrayLike

from cdcr._core import Model, Status
from cdcr._core_robot import _Bound, _FloatArray

class Method(enum.Enum):
    """How to integrate."""

    rk4 = 0
    dopri5 = 1
    bdf = 2
    adams = 3
    dop853 = 4
    auto = 5
    rosenbrock = 6

class Options(metaclass=_Bound):
    def __init__(
        self,
        *,
        rtol: float | None = None,
        atol: float | None = None,
        step: float = ...,
        max_step: float = ...,
        max_steps: int | None = None,
    ) -> None: ...
    @property
    def rtol(self) -> float | None: ...
    @property
    def atol(self) -> float | None: ...
    @property
    def step(self) -> float: ...
    @property
    def max_step(self) -> float: ...
    @property
    def max_steps(self) -> int | None: ...

@final
class Stats(metaclass=_Bound):
    """What a run cost."""

    def __init__(
        self,
        steps: int = 0,
        rejected: int = 0,
        evaluations: int = 0,
        jacobians: int = 0,
        newton_failures: int = 0,
        switches: int = 0,
        method: str | None = None,
        stiff: float | None = None,
    ) -> None: ...
    @property
    def steps(self) -> int: ...
    @property
    def rejected(self) -> int: ...
    @property
    def evaluations(self) -> int: ...
    @property
    def jacobians(self) -> int: ...
    @property
    def newton_failures(self) -> int: ...
    @property
    def switches(self) -> int: ...
    @property
    def method(self) -> str | None: ...
    @property
    def stiff(self) -> float | None: ...

@final
class TensionInput(metaclass=_Bound):
    @staticmethod
    def constant(model: Model, tension: ArrayLike, name: str = "tension") -> TensionInput: ...
    @staticmethod
    def table(model: Model, t: ArrayLike, tension: ArrayLike, linear: bool) -> TensionInput: ...
    @staticmethod
    def function(
        model: Model, function: Callable[..., ArrayLike], break_points: Sequence[float]
    ) -> TensionInput: ...

@final
class Trajectory(metaclass=_Bound):
    @property
    def t(self) -> _FloatArray: ...
    @property
    def q(self) -> _FloatArray: ...
    @property
    def qd(self) -> _FloatArray: ...
    @property
    def tension(self) -> _FloatArray: ...
    @property
    def command(self) -> _FloatArray: ...
    @property
    def deflection(self) -> _FloatArray: ...
    @property
    def sensitivities(self) -> _FloatArray: ...
    @property
    def slack_events(self) -> list[tuple[float, int, bool]]: ...
    @property
    def events(self) -> list[tuple[float, int, _FloatArray, _FloatArray]]: ...
    @property
    def status(self) -> Status: ...
    @property
    def message(self) -> str: ...
    @property
    def stats(self) -> Stats: ...
