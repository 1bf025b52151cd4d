"""cdcr: dynamics and control of cable-driven continuum robots.

SI units and radians throughout. q stacks one bending vector per section, base to tip:
q_i = theta_i (cos phi_i, sin phi_i). Arrays are float64 with time on axis 0.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

try:
    from cdcr import _core
except ImportError as error:  # pragma: no cover
    raise ImportError(
        f"cdcr's compiled core could not be loaded ({error}). Install the package "
        "('pip install .' in the project's folder) and do not import it from its source folder."
    ) from error

from cdcr import robots
from cdcr._core import (
    Allocation,
    Controller,
    Equilibrium,
    ReferencePath,
    Simulator,
    Stats,
    Status,
    max_bending,
    taylor_range,
)
from cdcr.model.coordinates import bending, polar
from cdcr.model.derivatives import Derivatives
from cdcr.model.inverse_kinematics import InverseKinematics
from cdcr.model.model import Model
from cdcr.model.modes import Modes
from cdcr.model.quasi_static import QuasiStatic, quasi_static
from cdcr.model.stability import stable_step
from cdcr.model.statics import ConvergenceError, InfeasibleError
from cdcr.model.wrench import Wrench
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section
from cdcr.robot.states import merge_state, subdivide_state
from cdcr.runs.command import TensionTable
from cdcr.runs.events import SlackEvent
from cdcr.runs.simulate import simulate
from cdcr.runs.trajectory import Trajectory

if TYPE_CHECKING:
    from cdcr import casadi as casadi
    from cdcr import control, export, identification, paper, scenarios, sweeps
    from cdcr import gym as gym
    from cdcr import jax as jax
    from cdcr import plotting as plotting
    from cdcr.base.rotations import rotation_vector
    from cdcr.identification import identify
    from cdcr.model.subdivision import subdivide_wrench
    from cdcr.motion.feasibility import PathReport, check_path
    from cdcr.motion.inverse import InverseRun, inverse_run
    from cdcr.motion.reference import Reference
    from cdcr.runs.controllers import ComputedTorque, StateFeedback, TaskSpace
    from cdcr.runs.estimators import ExtendedKalman, MomentumObserver, UnscentedKalman
    from cdcr.runs.gradient import Gradient, gradient
    from cdcr.runs.loop import Loop, LoopRun
    from cdcr.runs.loop_log import LoopLog
    from cdcr.runs.parts import Actuator, Sensor, Winch
    from cdcr.runs.pid import Pid
    from cdcr.runs.rollout import rollout
    from cdcr.runs.rollout_result import Rollout, RolloutFailure
    from cdcr.runs.rollout_store import rollout_to_zarr
    from cdcr.sweeps import sweep

__version__: str = _core.__version__

__all__ = [
    "Actuator",
    "Allocation",
    "Cable",
    "ComputedTorque",
    "Controller",
    "ConvergenceError",
    "Derivatives",
    "Equilibrium",
    "ExtendedKalman",
    "Gradient",
    "InfeasibleError",
    "InverseKinematics",
    "InverseRun",
    "Loop",
    "LoopLog",
    "LoopRun",
    "Model",
    "Modes",
    "MomentumObserver",
    "PathReport",
    "Pid",
    "QuasiStatic",
    "Reference",
    "ReferencePath",
    "Robot",
    "Rollout",
    "RolloutFailure",
    "Section",
    "Sensor",
    "Simulator",
    "SlackEvent",
    "StateFeedback",
    "Stats",
    "Status",
    "TaskSpace",
    "TensionTable",
    "Trajectory",
    "UnscentedKalman",
    "Winch",
    "Wrench",
    "__version__",
    "bending",
    "check_path",
    "control",
    "export",
    "gradient",
    "identification",
    "identify",
    "inverse_run",
    "max_bending",
    "merge_state",
    "paper",
    "polar",
    "quasi_static",
    "robots",
    "rollout",
    "rollout_to_zarr",
    "rotation_vector",
    "scenarios",
    "simulate",
    "stable_step",
    "subdivide_state",
    "subdivide_wrench",
    "sweep",
    "sweeps",
    "taylor_range",
]


_ROOMS = frozenset({
    "casadi", "control", "export", "gym", "identification", "jax", "paper", "plotting",
    "scenarios", "sweeps",
})  # fmt: skip
_LATER = {
    "Actuator": "runs.parts",
    "ComputedTorque": "runs.controllers",
    "ExtendedKalman": "runs.estimators",
    "Gradient": "runs.gradient",
    "InverseRun": "motion.inverse",
    "Loop": "runs.loop",
    "LoopLog": "runs.loop_log",
    "LoopRun": "runs.loop",
    "MomentumObserver": "runs.estimators",
    "PathReport": "motion.feasibility",
    "Pid": "runs.pid",
    "Reference": "motion.reference",
    "Rollout": "runs.rollout_result",
    "RolloutFailure": "runs.rollout_result",
    "Sensor": "runs.parts",
    "StateFeedback": "runs.controllers",
    "TaskSpace": "runs.controllers",
    "UnscentedKalman": "runs.estimators",
    "Winch": "runs.parts",
    "check_path": "motion.feasibility",
    "gradient": "runs.gradient",
    "identify": "identification",
    "inverse_run": "motion.inverse",
    "rollout": "runs.rollout",
    "rollout_to_zarr": "runs.rollout_store",
    "rotation_vector": "base.rotations",
    "subdivide_wrench": "model.subdivision",
    "sweep": "sweeps",
}


def __getattr__(name: str) -> Any:
    """Load what few programs need when it is asked for: rooms, and names of their modules."""
    if name in _ROOMS:
        return import_module(f"cdcr.{name}")
    if name in _LATER:
        return getattr(import_module(f"cdcr.{_LATER[name]}"), name)
    hint = {"load_robot": "; use cdcr.Robot.load"}.get(name, "")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}{hint}")


def __dir__() -> list[str]:
    return [*__all__, "casadi", "gym", "jax", "plotting"]  # not in __all__, as each needs an extra
