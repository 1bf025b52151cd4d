"""The [initial] table of scenario files: where the robot starts.

[initial]
equilibrium = true              # at rest under what pulls at the start
payload = 0.015                 # at the tip until the run starts, when it falls off [kg]
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from cdcr.base.arrays import FloatArray
from cdcr.files.toml import refuse, schema_errors
from cdcr.model.model import Model
from cdcr.model.statics import ConvergenceError, checked_equilibrium
from cdcr.scenarios.file.values import coordinates, error_prefix, length_errors, rival_errors

_SHAPE = ("q", "theta", "theta_deg", "phi", "phi_deg")


def carrying(model: Model, payload: float) -> Model:
    """Return the model of the same robot with a mass more at its tip [kg]."""
    if not payload:
        return model
    robot = replace(model.robot, payload=model.robot.payload + payload)
    return Model(robot, formulation=model.formulation)


@dataclass(frozen=True, eq=False)
class Rest:
    """The start of a run at rest.

    Parameters
    ----------
    command : callable
        From the model to the commands (num_cables,) at the start.
    payload : float
        Mass at the tip until the start [kg].
    guess : tuple of float, d, optional
        Where the search begins [rad].
    where : str
        What a refusal begins with.
    """

    command: Callable[[Model], FloatArray]
    payload: float
    guess: tuple[float, ...] | None
    where: str

    def __call__(self, model: Model) -> tuple[float, ...]:
        """Return the coordinates (d,) of rest."""
        loaded = carrying(model, self.payload)
        try:
            found = loaded.equilibrium(self.command(model), self.guess, throw=False)
            return tuple(checked_equilibrium(found).tolist())
        except ConvergenceError as error:
            raise ValueError(f"{self.where}: initial.equilibrium: {error}") from None


def read_start(
    table: Mapping[str, Any],
    model: Model,
    command: Callable[[Model], FloatArray] | None,
    file: Path,
) -> tuple[tuple[float, ...] | Rest, tuple[float, ...]]:
    """Return q0 and qd0 of an [initial] table; `command` gives the commands at the start."""
    from cdcr.scenarios.file.schema import InitialTable

    at = "initial"
    refuse(str(file), [*schema_errors(InitialTable, table, at), *rival_errors(table, at)])
    arrays = {key: table[key] for key in (*_SHAPE, "qd") if key in table}
    refuse(str(file), length_errors(arrays, model, at))
    with error_prefix(str(file)):
        q0 = coordinates(table, model, at)
    qd0 = tuple(map(float, table.get("qd", [0.0] * model.num_coordinates)))
    if not table.get("equilibrium", False):
        if "payload" in table:
            refuse(str(file), ["initial.payload needs equilibrium = true: it is held until then"])
        return q0, qd0
    if command is None:
        refuse(str(file), ["initial.equilibrium needs tensions or a trajectory, not a controller"])
    assert command is not None
    guess = q0 if any(key in table for key in _SHAPE) else None
    return Rest(command, table.get("payload", 0.0), guess, str(file)), qd0
