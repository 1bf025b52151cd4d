"""Types of the compiled core (bindings/), which holds the documentation itself."""

import enum
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias, overload

from numpy.typing import ArrayLike

from cdcr._core_control import ComputedTorque as ComputedTorque
from cdcr._core_control import Controller as Controller
from cdcr._core_control import Estimator as Estimator
from cdcr._core_control import ExtendedKalman as ExtendedKalman
from cdcr._core_control import KalmanFilter as KalmanFilter
from cdcr._core_control import Loop as Loop
from cdcr._core_control import MomentumObserver as MomentumObserver
from cdcr._core_control import Pid as Pid
from cdcr._core_control import ReferencePath as ReferencePath
from cdcr._core_control import StateFeedback as StateFeedback
from cdcr._core_control import TaskSpace as TaskSpace
from cdcr._core_control import TrackingController as TrackingController
from cdcr._core_control import UnscentedKalman as UnscentedKalman
from cdcr._core_robot import Cable as Cable
from cdcr._core_robot import CoreWrench as CoreWrench
from cdcr._core_robot import Loads as Loads
from cdcr._core_robot import Robot as Robot
from cdcr._core_robot import Section as Section
from cdcr._core_robot import _Bound, _FloatArray
from cdcr._core_runs import Method as Method
from cdcr._core_runs import Options as Options
from cdcr._core_runs import Stats as Stats
from cdcr._core_runs import TensionInput as TensionInput
from cdcr._core_runs import Trajectory as Trajectory
from cdcr._core_statics import Allocation as Allocation
from cdcr._core_statics import Equilibrium as Equilibrium
from cdcr.model.wrench import Wrench

_FloatOrArray: TypeAlias = Any  # a float for one state, else an array

__version__: str
max_bending: float
with_cvode: bool
max_sections: int
max_order: int
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
    event = 10
    wrong_size = 11
    invalid_wrench = 12
    compression_limit = 13

class Formulation(enum.Enum):
    """Which inertia functions to use."""

    exact = 0
    taylor = 1
    printed = 2
    printed_taylor = 3

def finite(value: object, name: str) -> _FloatArray: ...
def numbers(value: object, name: str) -> _FloatArray: ...
def status_message(status: Status) -> str: ...
def polar_along(q: ArrayLike) -> tuple[_FloatArray, _FloatArray]: ...

class Model(metaclass=_Bound):
    @overload
    def __init__(self, robot: Robot, formulation: Formulation) -> None: ...
    @overload
    def __init__(self, robot: Robot, like: Model) -> None: ...
    @overload
    def __init__(self, model: Model, gravity: ArrayLike) -> None: ...
    @property
    def num_sections(self) -> int: ...
    @property
    def num_coordinates(self) -> int: ...
    @property
    def coordinate_names(self) -> tuple[str, ...]: ...
    def section_slice(self, section: int) -> slice: ...
    @property
    def num_cables(self) -> int: ...
    @property
    def has_inertia(self) -> bool: ...
    @property
    def has_rods(self) -> bool: ...
    @property
    def has_constant_actuation(self) -> bool: ...
    @property
    def rest_shape(self) -> _FloatArray: ...
    @property
    def elastic_stiffness(self) -> _FloatArray: ...
    @property
    def has_friction(self) -> bool: ...
    @property
    def num_deflections(self) -> int: ...
    @property
    def has_backlash(self) -> bool: ...
    def actuation_matrix(self, q: ArrayLike | None = None) -> _FloatArray: ...
    def pose(
        self, q: ArrayLike, section: int, fraction: float
    ) -> tuple[_FloatArray, _FloatArray]: ...
    def tip(self, q: ArrayLike) -> tuple[_FloatArray, _FloatArray]: ...
    def tips(self, q: ArrayLike) -> _FloatArray: ...
    def jacobian(self, q: ArrayLike, section: int, fraction: float) -> _FloatArray: ...
    def tip_jacobian(self, q: ArrayLike) -> _FloatArray: ...
    def kinematic_hessian(self, q: ArrayLike, section: int, fraction: float) -> _FloatArray: ...
    def tip_hessian(self, q: ArrayLike) -> _FloatArray: ...
    def cable_lengths(self, q: ArrayLike) -> _FloatArray: ...
    def mass_matrix(self, q: ArrayLike) -> _FloatArray: ...
    def bias(self, q: ArrayLike, qd: ArrayLike) -> _FloatArray: ...
    def forward_dynamics(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        tension: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> _FloatArray: ...
    def inverse_dynamics(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        qdd: ArrayLike,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> _FloatArray: ...
    def base_wrench(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        qdd: ArrayLike,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> _FloatArray: ...
    def kinetic_energy(self, q: ArrayLike, qd: ArrayLike) -> _FloatOrArray: ...
    def potential_energy(self, q: ArrayLike) -> _FloatOrArray: ...
    kinetic_energies = kinetic_energy
    potential_energies = potential_energy
    def potential_gradient(self, q: ArrayLike) -> _FloatArray: ...
    def potential_hessian(self, q: ArrayLike) -> _FloatArray: ...
    def linearize(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        tension: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> tuple[_FloatArray, _FloatArray]: ...
    def _derivatives(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        tension: ArrayLike | None,
        wrenches: Wrench | Sequence[Wrench],
    ) -> tuple[_FloatArray, _FloatArray, _FloatArray, _FloatArray]: ...
    def _tables(self) -> tuple[_FloatArray, list[_FloatArray]]: ...
    def _parameter_derivatives(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        tension: ArrayLike,
        wrenches: Wrench | Sequence[Wrench],
        parameters: ParameterSet,
    ) -> _FloatArray: ...
    def _equilibrium_derivatives(
        self,
        q: ArrayLike,
        tension: ArrayLike,
        wrenches: Wrench | Sequence[Wrench],
        parameters: ParameterSet,
    ) -> _FloatArray: ...
    def wrench_force(self, q: ArrayLike, wrenches: Wrench | Sequence[Wrench]) -> _FloatArray: ...
    def cable_tensions(self, q: ArrayLike, qd: ArrayLike, tension: ArrayLike) -> _FloatArray: ...
    def tensions_along(self, q: ArrayLike, qd: ArrayLike, tension: ArrayLike) -> _FloatArray: ...
    def cable_force(self, q: ArrayLike, qd: ArrayLike, tension: ArrayLike) -> _FloatArray: ...
    def friction_power(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        tension: ArrayLike,
        deflection: ArrayLike | None = None,
    ) -> _FloatOrArray: ...
    def cable_energy(self, q: ArrayLike, tension: ArrayLike) -> _FloatOrArray: ...
    def rest_command(self) -> _FloatArray: ...
    def find_equilibrium(
        self,
        tension: ArrayLike | None = None,
        q0: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> Equilibrium: ...
    def static_stiffness(
        self,
        q: ArrayLike,
        tension: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> _FloatArray: ...
    def commands(self, q: ArrayLike, tension: ArrayLike) -> _FloatArray: ...
    def _modes(
        self, q: ArrayLike, tension: ArrayLike | None, wrenches: Wrench | Sequence[Wrench]
    ) -> tuple[_FloatArray, ...]: ...
    def find_tension(
        self,
        force: ArrayLike,
        min_tension: float = 0.0,
        max_tension: float = ...,
        method: str = "automatic",
        q: ArrayLike | None = None,
    ) -> Allocation: ...
    def _inverse_kinematics(
        self,
        p: ArrayLike,
        R: ArrayLike | None,
        q0: ArrayLike | None,
        *,
        max_theta: ArrayLike | None,
        orientation_weight: float | None,
        tolerance: float | None,
        seeds: int,
        iterations: int,
    ) -> tuple[_FloatArray, _FloatArray, _FloatArray, float, float, float, bool, int, int, str]: ...

class ParameterSet(metaclass=_Bound):
    def __init__(
        self,
        model: Model,
        parameters: Sequence[tuple[str, float, float, Callable[[float], Robot]]],
    ) -> None: ...
    @staticmethod
    def of_sides(
        model: Model, parameters: Sequence[tuple[str, Model, Model, float]]
    ) -> ParameterSet: ...
    def __len__(self) -> int: ...
    @property
    def names(self) -> list[str]: ...
    def is_exact(self, parameter: int) -> bool: ...

def simulate(
    model: Model,
    q0: ArrayLike,
    qd0: ArrayLike,
    t: ArrayLike,
    input: TensionInput,
    method: Method,
    options: Options,
    progress: Callable[[float], object] | None,
    loads: Loads,
    events: Sequence[tuple[Callable[..., object], int, int]],
    sensitivities: tuple[Any, ...] | None,
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
    loads: Loads,
    events: Sequence[tuple[Callable[..., object], int, int]],
) -> Trajectory: ...
def rollout(
    models: Sequence[Model],
    q0: ArrayLike,
    qd0: ArrayLike,
    commands: ArrayLike | None,
    controllers: Controller | Sequence[Controller] | None,
    loads: Loads,
    method: Method,
    options: Options,
    step: float,
    steps: int,
    record_every: int,
    start: float,
    threads: int,
    progress: Callable[[int], object] | None,
) -> tuple[_FloatArray, _FloatArray, _FloatArray | None, list[tuple[int, Status, str]], Stats]: ...
def quasi_static(
    model: Model,
    commands: ArrayLike,
    q0: ArrayLike | None,
    deflection: ArrayLike | None,
    felt: ArrayLike | None,
    wrenches: Wrench | Sequence[Wrench],
) -> dict[str, Any]: ...

class Simulator(metaclass=_Bound):
    """The robot inside a control loop: one period at a time, tensions held over the period."""

    def __init__(
        self, model: Model, *, step: float = 0.001, substeps: int = 1, method: str = "rk4"
    ) -> None: ...
    def reset(self, q: ArrayLike, qd: ArrayLike, time: float = 0.0) -> None: ...
    def step(
        self,
        tension: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
        *,
        command: ArrayLike | None = None,
    ) -> Status: ...
    @property
    def q(self) -> _FloatArray: ...
    @property
    def qd(self) -> _FloatArray: ...
    @property
    def deflection(self) -> _FloatArray: ...
    @property
    def model(self) -> Any: ...
    @property
    def time(self) -> float: ...
    @property
    def period(self) -> float: ...
