"""cdcr: dynamics and control of cable-driven continuum robots.

SI units and radians throughout. q stacks one bending vector per section, base to tip:
q_i = theta_i (cos phi_i, sin phi_i). Arrays are float64 with time on axis 0.
"""

try:
    from cdcr import _core
except ImportError as error:  # pragma: no cover
    raise ImportError(
        f"cdcr's compiled core could not be loaded ({error}). Install the package "
        "('pip install .' in the project's folder) and do not import it from its source folder."
    ) from error

from cdcr import paper, robots, scenarios
from cdcr._control import Pid
from cdcr._coordinates import bending, polar
from cdcr._core import Controller, Equilibrium, Simulator, Stats, Status, max_bending, taylor_range
from cdcr._inverse import InverseRun, inverse_run
from cdcr._inverse_kinematics import InverseKinematics
from cdcr._model import ConvergenceError, InfeasibleError, Model
from cdcr._modes import Modes
from cdcr._reference import Reference
from cdcr._robot import Cable, Robot, Section
from cdcr._simulate import TensionTable, simulate
from cdcr._stability import stable_step
from cdcr._subdivide import merge_state, subdivide_state
from cdcr._trajectory import SlackEvent, Trajectory
from cdcr._wrench import Wrench

__version__: str = _core.__version__

__all__ = [
    "Cable",
    "Controller",
    "ConvergenceError",
    "Equilibrium",
    "InfeasibleError",
    "InverseKinematics",
    "InverseRun",
    "Model",
    "Modes",
    "Pid",
    "Reference",
    "Robot",
    "Section",
    "Simulator",
    "SlackEvent",
    "Stats",
    "Status",
    "TensionTable",
    "Trajectory",
    "Wrench",
    "__version__",
    "bending",
    "inverse_run",
    "max_bending",
    "merge_state",
    "paper",
    "polar",
    "robots",
    "scenarios",
    "simulate",
    "stable_step",
    "subdivide_state",
    "taylor_range",
]


def __dir__() -> list[str]:
    return __all__
