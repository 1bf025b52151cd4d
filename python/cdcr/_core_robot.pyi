"""Types of the compiled core that describe robots and loads; `_core.pyi` hands them on."""

from collections.abc import Callable, Sequence
from typing import final, type_check_only

import numpy as np
from numpy.typing import ArrayLike, NDArray

_FloatArray = NDArray[np.float64]

@type_check_only
class _Bound(type):
    """Metaclass of classes bound by pybind11."""

class Section(metaclass=_Bound):
    def __init__(
        self,
        *,
        length: float,
        backbone_mass: float,
        backbone_diameter: float | Sequence[float],
        youngs_modulus: float,
        disk_mass: float,
        disk_diameter: float,
        num_disks: int,
        disk_positions: Sequence[float],
        disk_masses: Sequence[float],
        disk_diameters: Sequence[float],
        cable_radius: float,
        cable_angles: Sequence[float],
        cable_stiffness: float,
        cable_damping: float,
        cable_friction: float,
        damping: float,
        bending_order: int | None,
        twist_order: int | None,
        stretch_order: int | None,
        backbone_inner_diameter: float,
        shear_modulus: float | None,
        bending_stiffness: float | None,
        twist_stiffness: float | None,
        stretch_stiffness: float | None,
        twist_damping: float,
        stretch_damping: float,
        material_damping: float,
        rest_bending: Sequence[float],
        rest_twist: float,
        nodes: int | None,
        cable_entry_friction: float,
        cable_sheath_friction: float,
        cable_viscosity: float,
        cable_pretension: float,
        cable_backlash: float,
    ) -> None: ...
    def violations(self) -> list[str]: ...
    def disks(self) -> list[tuple[float, float, float]]: ...
    @property
    def stiffness(self) -> float: ...
    @property
    def is_rod(self) -> bool: ...

class Cable(metaclass=_Bound):
    def __init__(
        self,
        *,
        radius: float | Sequence[Sequence[float]],
        angle: float | Sequence[Sequence[float]],
        end_section: int,
        stiffness: float,
        damping: float,
        friction: float | None,
        start_section: int,
        entry_friction: float,
        sheath_friction: float,
        viscosity: float,
        pretension: float,
        backlash: float,
    ) -> None: ...
    @property
    def radius(self) -> float: ...
    @property
    def angle(self) -> float: ...
    @property
    def radii(self) -> list[list[float]]: ...
    @property
    def angles(self) -> list[list[float]]: ...
    @property
    def start_section(self) -> int: ...
    @property
    def end_section(self) -> int: ...
    @property
    def stiffness(self) -> float: ...
    @property
    def damping(self) -> float: ...
    @property
    def friction(self) -> float | None: ...
    @property
    def entry_friction(self) -> float: ...
    @property
    def sheath_friction(self) -> float: ...
    @property
    def viscosity(self) -> float: ...
    @property
    def pretension(self) -> float: ...
    @property
    def backlash(self) -> float: ...

class Robot(metaclass=_Bound):
    def __init__(
        self,
        *,
        sections: Sequence[Section],
        gravity: ArrayLike,
        payload: float,
        cables: Sequence[Cable],
        base_orientation: ArrayLike,
        base_position: ArrayLike,
        payload_position: ArrayLike,
        payload_inertia: ArrayLike,
        sliding_speed: float,
        tool: ArrayLike,
        presliding_stiffness: float,
    ) -> None: ...
    def violations(self) -> list[str]: ...
    def locate(self, s: float) -> tuple[int, float]: ...
    def all_cables(self) -> list[Cable]: ...

@final
class CoreWrench(metaclass=_Bound):
    """A wrench as the core sees it; not validated."""

    def __init__(
        self, section: int, fraction: float, force: ArrayLike, moment: ArrayLike, local: bool
    ) -> None: ...
    @property
    def force(self) -> _FloatArray: ...
    @property
    def moment(self) -> _FloatArray: ...

@final
class Loads(metaclass=_Bound):
    """Wrenches over time."""

    def __init__(self) -> None: ...
    def add(self, wrench: CoreWrench) -> None: ...
    def add_table(
        self, wrench: CoreWrench, times: ArrayLike, factors: ArrayLike, linear: bool
    ) -> None: ...
    def add_function(
        self, wrench: CoreWrench, function: Callable[[float], float], break_points: list[float]
    ) -> None: ...
    def at(self, t: float) -> list[CoreWrench]: ...
