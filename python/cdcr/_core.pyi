"""Types of the compiled core (bindings/). Shapes and units are as in the C++ headers."""

import enum
from collections.abc import Callable, Sequence
from typing import final, type_check_only

import numpy as np
from numpy.typing import ArrayLike, NDArray

_FloatArray = NDArray[np.float64]

@type_check_only
class _Bound(type):
    """Metaclass of classes bound by pybind11."""

__version__: str
max_bending: float
taylor_range: float

class Status(enum.Enum):
    """How a computation ended; anything but ok is a failure."""

    ok = 0
    not_started = 1
    step_limit = 2
    step_too_small = 3
    tolerance_not_met = 4
    non_finite_state = 5
    bending_limit = 6
    invalid_tension = 7
    not_converged = 8
    interrupted = 9

class Method(enum.Enum):
    """How to integrate."""

    rk4 = 0
    dopri5 = 1
    bdf = 2
    adams = 3

class Formulation(enum.Enum):
    """Which inertia functions to use."""

    exact = 0
    taylor = 1
    printed = 2
    printed_taylor = 3

def status_message(status: Status) -> str: ...
def polar_along(q: ArrayLike) -> tuple[_FloatArray, _FloatArray]: ...

class Section(metaclass=_Bound):
    def __init__(
        self,
        *,
        length: float,
        backbone_mass: float,
        backbone_diameter: float,
        youngs_modulus: float,
        disk_mass: float,
        disk_diameter: float,
        num_disks: int,
        cable_radius: float,
        cable_angles: Sequence[float],
        damping: float,
    ) -> None: ...
    def violations(self) -> list[str]: ...
    @property
    def stiffness(self) -> float: ...

class Robot(metaclass=_Bound):
    def __init__(
        self, *, sections: Sequence[Section], gravity: ArrayLike, payload: float
    ) -> None: ...
    def violations(self) -> list[str]: ...

@final
class Equilibrium(metaclass=_Bound):
    """A point of rest and whether the robot stays there."""

    @property
    def q(self) -> _FloatArray: ...
    @property
    def eigenvalues(self) -> _FloatArray: ...
    @property
    def stable(self) -> bool: ...
    @property
    def residual(self) -> float: ...
    @property
    def iterations(self) -> int: ...
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

class Model(metaclass=_Bound):
    def __init__(self, robot: Robot, formulation: Formulation) -> None: ...
    @property
    def num_sections(self) -> int: ...
    @property
    def num_coordinates(self) -> int: ...
    @property
    def num_cables(self) -> int: ...
    @property
    def has_inertia(self) -> bool: ...
    def actuation_matrix(self) -> _FloatArray: ...
    def pose(
        self, q: ArrayLike, section: int, fraction: float
    ) -> tuple[_FloatArray, _FloatArray]: ...
    def tip(self, q: ArrayLike) -> tuple[_FloatArray, _FloatArray]: ...
    def tips(self, q: ArrayLike) -> _FloatArray: ...
    def jacobian(self, q: ArrayLike, section: int, fraction: float) -> _FloatArray: ...
    def cable_lengths(self, q: ArrayLike) -> _FloatArray: ...
    def mass_matrix(self, q: ArrayLike) -> _FloatArray: ...
    def bias(self, q: ArrayLike, qd: ArrayLike) -> _FloatArray: ...
    def forward_dynamics(self, q: ArrayLike, qd: ArrayLike, tension: ArrayLike) -> _FloatArray: ...
    def inverse_dynamics(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike) -> _FloatArray: ...
    def kinetic_energy(self, q: ArrayLike, qd: ArrayLike) -> float: ...
    def potential_energy(self, q: ArrayLike) -> float: ...
    def kinetic_energies(self, q: ArrayLike, qd: ArrayLike) -> _FloatArray: ...
    def potential_energies(self, q: ArrayLike) -> _FloatArray: ...
    def linearize(
        self, q: ArrayLike, qd: ArrayLike, tension: ArrayLike
    ) -> tuple[_FloatArray, _FloatArray]: ...
    def find_equilibrium(self, tension: ArrayLike, q0: ArrayLike | None = None) -> Equilibrium: ...
    def find_tension(
        self, force: ArrayLike, min_tension: float, max_tension: float
    ) -> Allocation: ...
    def _inverse_kinematics(self, p: ArrayLike) -> tuple[_FloatArray, _FloatArray, float, bool]: ...

class Options(metaclass=_Bound):
    def __init__(
        self,
        *,
        rtol: float = ...,
        atol: float = ...,
        step: float = ...,
        max_step: float = ...,
        max_steps: int = ...,
    ) -> None: ...
    @property
    def rtol(self) -> float: ...
    @property
    def atol(self) -> float: ...
    @property
    def step(self) -> float: ...
    @property
    def max_step(self) -> float: ...
    @property
    def max_steps(self) -> int: ...

@final
class Stats(metaclass=_Bound):
    """What a run cost."""

    def __getstate__(self) -> tuple[int, int, int, int, int]: ...
    def __setstate__(self, state: tuple[int, int, int, int, int]) -> None: ...
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

@final
class TensionInput(metaclass=_Bound):
    @staticmethod
    def constant(model: Model, tension: ArrayLike) -> TensionInput: ...
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
    def status(self) -> Status: ...
    @property
    def message(self) -> str: ...
    @property
    def stats(self) -> Stats: ...

def simulate(
    model: Model,
    q0: ArrayLike,
    qd0: ArrayLike,
    t: ArrayLike,
    input: TensionInput,
    method: Method,
    options: Options,
    progress: Callable[[float], object] | None,
) -> Trajectory: ...
def simulate_controlled(
    model: Model,
    q0: ArrayLike,
    qd0: ArrayLike,
    t: ArrayLike,
    controller: Controller,
    method: Method,
    options: Options,
    progress: Callable[[float], object] | None,
) -> Trajectory: ...

class Controller(metaclass=_Bound):
    """Turns the measured state into tensions, each period."""

    @property
    def period(self) -> float: ...
    def reset(self) -> None: ...

class Pid(Controller):
    def __init__(
        self,
        model: Model,
        *,
        kp: float,
        ki: float = 0.0,
        kd: float = 0.0,
        period: float = 0.001,
        feed_forward: bool = True,
        anti_windup: bool = True,
        min_tension: float = 0.0,
        max_tension: float = ...,
        cables: Sequence[int] = ...,
    ) -> None: ...
    @property
    def reference(self) -> _FloatArray: ...
    @reference.setter
    def reference(self, q: ArrayLike) -> None: ...
    @property
    def integral(self) -> _FloatArray: ...
    def update(self, t: float, q: ArrayLike, qd: ArrayLike) -> _FloatArray: ...

class Simulator(metaclass=_Bound):
    """The robot inside a control loop: one period at a time, tensions held over the period."""

    def __init__(self, model: Model, *, step: float = 0.001, substeps: int = 1) -> None: ...
    def reset(self, q: ArrayLike, qd: ArrayLike, time: float = 0.0) -> None: ...
    def step(self, tension: ArrayLike) -> Status: ...
    @property
    def q(self) -> _FloatArray: ...
    @property
    def qd(self) -> _FloatArray: ...
    @property
    def time(self) -> float: ...
    @property
    def period(self) -> float: ...
