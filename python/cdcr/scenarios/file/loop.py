"""The [loop] table of scenario files: fixed steps, actuators and sensors around a controller."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from cdcr._core import Controller, TrackingController
from cdcr.base.arrays import FloatArray
from cdcr.files.toml import refuse, schema_errors
from cdcr.model.model import Model
from cdcr.runs.loop import Loop, LoopRun
from cdcr.runs.parts import Actuator, Sensor, Winch
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.file.controller import ControlLoop
from cdcr.scenarios.file.estimator import EstimatorMaker, read_estimator
from cdcr.scenarios.file.values import error_prefix

AT = "loop"
STEP = 1e-3  # without one in the file [s]
_NEAR = 1e-6  # a sample and a step, in steps
_MANY = 10000  # distances that are tried where another would do


@dataclass(frozen=True, eq=False)
class ClosedLoop:
    """A run of a `cdcr.Loop`, an input source of a scenario."""

    controller: ControlLoop
    step: float
    options: dict[str, Any]
    estimator: EstimatorMaker | None = None
    integrates = True

    def make(
        self,
        model: Model,
        plant: Model | None = None,
        around: Callable[[TrackingController], Controller] = lambda controller: controller,
    ) -> Loop:
        """Return the loop: of another robot than is reckoned with, where a plant is given.

        What `around` makes of the controller stands in its place.
        """
        estimator = None
        if self.estimator is not None:
            known = self.options["sensors"], self.options["actuators"]
            estimator = self.estimator(model, *known)
        controller = around(self.controller(model))
        return Loop(plant or model, controller, step=self.step, estimator=estimator, **self.options)

    def run(
        self,
        model: Model,
        q0: tuple[float, ...],
        qd0: tuple[float, ...],
        t: FloatArray,
        **options: Any,
    ) -> Trajectory:
        """Run the robot from a state and sample it at output times (N,) [s]."""
        return self.run_loop(model, q0, qd0, t, **options).trajectory

    def steps_apart(self, duration: float, num_samples: int) -> int:
        """Return how many steps there are from sample to sample, a whole number."""
        steps = duration / (num_samples - 1) / self.step
        every = round(steps)
        if every >= 1 and abs(steps - every) <= _NEAR * steps:
            return every
        whole, advice = round(duration / self.step), "change num_samples or t_end"
        if whole >= 1 and abs(whole - duration / self.step) <= _NEAR:
            near = (k for d in range(_MANY) for k in (every - d, every + d) if 1 <= k <= whole)
            found = next((k for k in near if whole % k == 0), whole)
            advice = f"num_samples = {whole // found + 1} would do"
        raise ValueError(
            f"samples of a closed loop must be whole numbers of its steps of {self.step:g} s "
            f"apart, got {steps * self.step:g} s: {advice}"
        )

    def run_loop(
        self,
        model: Model,
        q0: tuple[float, ...],
        qd0: tuple[float, ...],
        t: FloatArray,
        **options: Any,
    ) -> LoopRun:
        """Run it and return all that the loop tells."""
        every = self.steps_apart(float(t[-1] - t[0]), len(t))
        loop = self.make(model)
        loop.reset(q0, qd0, time=float(t[0]))
        wrenches = options.get("wrenches", ())
        duration = every * (len(t) - 1) * self.step
        return loop.run(duration, record_every=every, wrenches=wrenches)


def check_run(table: Mapping[str, Any], loop: ClosedLoop, num_samples: int, file: Path) -> None:
    """Refuse what a loop cannot do of the rest of a scenario file."""
    refuse(
        str(file),
        [
            f"wrenches[{i}].times must be left out, and factors: in a loop wrenches are constant"
            for i, wrench in enumerate(table.get("wrenches", ()))
            if "times" in wrench
        ],
    )
    with error_prefix(f"{file}, [{AT}]"):
        loop.steps_apart(table["t_end"], num_samples)


def read_loop(
    table: dict[str, Any], controller: ControlLoop, model: Model, file: Path
) -> ClosedLoop:
    """Return the loop of a [loop] table, or refuse it with file, key and value."""
    from cdcr.scenarios.file import control_schema as schema

    refuse(str(file), schema_errors(schema.LoopTable, table, AT))
    with error_prefix(f"{file}, [{AT}]"):
        actuators = [
            _actuator(one, f"actuators[{i}]") for i, one in enumerate(table.get("actuators", ()))
        ]
        sensors = [
            _sensor(one, model, f"sensors[{i}]") for i, one in enumerate(table.get("sensors", ()))
        ]
        options: dict[str, Any] = {"actuators": actuators, "sensors": sensors}
        options |= {key: table[key] for key in ("substeps", "method") if key in table}
        step = float(table.get("step", STEP))
        estimator = None
        if "estimator" in table:
            estimator = read_estimator(table["estimator"], model, step, "estimator")
        closed = ClosedLoop(controller, step, options, estimator)
        closed.make(model)
    return closed


def _actuator(table: dict[str, Any], at: str) -> Actuator:
    from cdcr.scenarios.file.control_schema import ActuatorTable, WinchTable

    _refuse(schema_errors(ActuatorTable, table, at))
    given = dict(table)
    if "winch" in given:
        _refuse(schema_errors(WinchTable, given["winch"], f"{at}.winch"))
        given["winch"] = Winch(**given["winch"])
    return Actuator(**given)


def _sensor(table: dict[str, Any], model: Model, at: str) -> Sensor:
    from cdcr.scenarios.file.control_schema import SensorTable

    _refuse(schema_errors(SensorTable, table, at))
    places = table.get("places", [])
    for place in places:
        if len(place) != 2 or place[0] not in np.arange(1, model.num_sections + 1):
            requirement = f"pairs of a section, 1 to {model.num_sections}, and a fraction"
            _refuse([f"{at}.places must be {requirement}, got {place}"])
    return Sensor(**table | {"places": [(int(one[0]) - 1, one[1]) for one in places]})


def _refuse(sentences: list[str]) -> None:
    if sentences:
        raise ValueError("\n".join(sentences))
