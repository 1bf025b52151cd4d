"""The [controller] table of scenario files: a controller, its reference, what it shows.

[controller]
type = "pid"                    # or "computed-torque", "lqr", "task-space"
kp = 2.0                        # [N m/rad]
cables = [1, 2]                 # counted from 1, as everywhere in the file

[controller.reference]
theta_deg = [15.0]              # of each section

In place of [controller.reference] there may be a [controller.motion].
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr._core import ReferencePath, TrackingController
from cdcr.base.arrays import FloatArray
from cdcr.base.rotations import rotation_of, rotation_vector
from cdcr.control import lqr
from cdcr.files.toml import refuse, schema_errors
from cdcr.model.model import Model
from cdcr.motion.reference import Reference
from cdcr.runs.controllers import ComputedTorque, StateFeedback, TaskSpace
from cdcr.runs.pid import Pid
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.file import values
from cdcr.scenarios.file.paths import read_path
from cdcr.scenarios.file.trajectory import kind_errors
from cdcr.scenarios.metrics import Metric, run_metrics
from cdcr.scenarios.scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AT = "controller"
BAND = 0.02  # of the first error, within which a loop has settled
_KINDS = {"pid": Pid, "computed-torque": ComputedTorque, "task-space": TaskSpace}
_WEIGHTS = ("state_weight", "rate_weight", "command_weight")


@dataclass(frozen=True, eq=False)
class ControlLoop:
    """A controller to be made for a model, and the path it is to follow."""

    kind: str
    options: dict[str, Any]
    path: ReferencePath

    def __call__(self, model: Model) -> TrackingController:
        """Return the controller."""
        made = self._lqr(model) if self.kind == "lqr" else _KINDS[self.kind](model, **self.options)
        made.path = self.path
        return made

    def _lqr(self, model: Model) -> StateFeedback:
        """Return state feedback with the gain of a regulator about the start of the path."""
        options = {key: value for key, value in self.options.items() if key not in _WEIGHTS}
        state, rate, command = (self.options[name] for name in _WEIGHTS)
        q = self.path.evaluate(self.path.start)[0]
        limits = {key: options[key] for key in ("min_tension", "max_tension") if key in options}
        hold = model.find_tension(model.bias(q, np.zeros_like(q)), q=q, **limits).tension
        weights = np.repeat([state, rate], model.num_coordinates)
        gain = lqr(model, q, hold, Q=weights, R=command, period=options.get("period", 1e-3))
        return StateFeedback(model, gain=gain, **options)

    @property
    def of_tip(self) -> bool:
        """Whether it moves the tip."""
        return self.kind == "task-space"

    def reference(self, t: FloatArray) -> Reference | None:
        """Return the motion asked for at times (N,) [s]; none where it is of the tip."""
        if self.of_tip:
            return None
        return Reference(t, *np.array([self.path.evaluate(time) for time in t]).transpose(1, 0, 2))

    def errors(self, run: Trajectory) -> FloatArray:
        """Return the distance from the path at each sample [rad], of the tip's place [m]."""
        wanted = np.array([self.path.evaluate(t)[0] for t in run.t])
        reached = run.tip if self.of_tip else run.q
        return np.asarray(np.linalg.norm(reached - wanted[:, : reached.shape[1]], axis=1))

    def _turn(self, run: Trajectory) -> float:
        """Return the angle between the tip at the end and a pose asked for [rad]."""
        wanted = rotation_of(self.path.evaluate(run.t[-1])[0][3:])
        return float(np.linalg.norm(rotation_vector(run.model.tip(run.q[-1])[0].T @ wanted)))

    def summarize(self, scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
        """Return what every run shows, how near the loop comes, and how hard it pulls."""
        error = self.errors(run)
        scale, unit, suffix = (1e3, "mm", "mm") if self.of_tip else (180.0 / np.pi, "deg", "deg")
        moves = self.path.end > self.path.start
        found = [
            *run_metrics(scenario, run),
            Metric(f"error_end_{suffix}", "error at the end", float(error[-1] * scale), unit)
            if self.of_tip
            else Metric("error_end_deg", "error at the end", float(np.rad2deg(error[-1])), "deg"),
        ]
        if self.of_tip and self.path.size == 6:
            turn = float(np.rad2deg(self._turn(run)))
            found.append(Metric("turn_end_deg", "error of the tip's turn at the end", turn, "deg"))
        if moves:
            root = float(np.sqrt(np.mean(error**2)) * scale)
            largest = float(error.max() * scale)
            found.append(Metric(f"error_rms_{suffix}", "error, root mean square", root, unit))
            found.append(Metric(f"error_max_{suffix}", "error, largest", largest, unit))
        outside = np.flatnonzero(error > BAND * error[0])
        last = int(outside[-1]) if outside.size else -1
        if last + 1 < len(run) and not moves:
            label = f"within {100 * BAND:g} % of the first error from"
            found.append(Metric("settling_s", label, float(run.t[last + 1]), "s"))
        lowest, highest = float(run.tension.min()), float(run.tension.max())
        return (
            *found,
            Metric("tension_min_N", "smallest tension", lowest, "N"),
            Metric("tension_max_N", "largest tension", highest, "N"),
        )

    def plot(self, scenario: Scenario, run: Trajectory) -> Figure:
        """Return the picture of every run, with the bending angles asked for."""
        from cdcr.scenarios.figures.run import run_figure

        figure = run_figure(scenario, run)
        axes = figure.axes[1]
        dashed: dict[str, Any] = {"color": "black", "linewidth": 1.0, "dashes": (6, 4)}
        if self.of_tip:
            return figure
        if self.path.end > self.path.start:
            wanted = np.array([self.path.evaluate(t)[0] for t in run.t])
            for angle in np.rad2deg(run.model.polar(wanted, continuous=True)[0]).T:
                axes.plot(run.t, angle, **dashed)
            axes.set_title("dashed: reference", loc="left", fontsize=9.5)
            return figure
        theta, phi = run.model.polar([self.path.evaluate(self.path.start)[0]])
        # A section that ended bent the other way has a negative theta.
        signed = np.rad2deg(theta * np.sign(np.cos(phi - run.phi[-1]) + 1e-9))[0]
        for angle in signed:
            axes.axhline(angle, **dashed)
        angles = ", ".join(f"{angle:.2f}" for angle in signed)
        axes.set_title(f"dashed: reference, {angles} deg", loc="left", fontsize=9.5)
        return figure


def read_controller(table: dict[str, Any], model: Model, file: Path) -> ControlLoop:
    """Return the loop of a [controller] table, or refuse it with file, key and value."""
    from cdcr.scenarios.file.control_schema import CONTROLLERS

    refuse(str(file), kind_errors(CONTROLLERS, table, AT, "type"))
    kind, taken = table["type"], ("type", "reference", "motion", "tip")
    options = {key: value for key, value in table.items() if key not in taken}
    if "cables" in options:
        options["cables"] = _indices(options["cables"], model.num_cables, file)
    if kind == "lqr" and any(cable.length_driven for cable in model.robot.all_cables):
        refuse(str(file), [f"{AT}.type must not be lqr where cables are driven by length"])
    rivals = [key for key in ("motion", "reference", "tip") if key in table]
    if len(rivals) > 1:
        refuse(str(file), [f"{AT} must have {rivals[0]} or {rivals[1]}, not both"])
    loop = ControlLoop(kind, options, _path(table, model, file))
    with values.error_prefix(f"{file}, [{AT}]"):
        loop(model)
    return loop


def _path(table: dict[str, Any], model: Model, file: Path) -> ReferencePath:
    """Return what is to be followed: a motion, or a reference, straight where there is none."""
    from cdcr.scenarios.file.schema import ReferenceTable

    of_tip = table["type"] == "task-space"
    if "motion" in table:
        names = tuple(model.coordinate_names)
        if of_tip:
            names = ("x", "y", "z", *(("rx", "ry", "rz") if "orientation_weight" in table else ()))
        return read_path(table["motion"], names, file)
    if of_tip:
        weight = table.get("orientation_weight")
        with values.error_prefix(f"{file}, [{AT}]"):
            rest = TaskSpace(model, orientation_weight=weight).reference
        given = table.get("tip", rest)
        if len(given) != len(rest):
            told = "six numbers with orientation_weight" if weight is not None else "three numbers"
            refuse(str(file), [f"{AT}.tip must be {told}, got {len(given)}"])
        return ReferencePath.constant(given)
    reference, at = table.get("reference", {}), f"{AT}.reference"
    found = [*schema_errors(ReferenceTable, reference, at), *values.rival_errors(reference, at)]
    refuse(str(file), found)
    refuse(str(file), values.length_errors(reference, model, at))
    with values.error_prefix(str(file)):
        return ReferencePath.constant(values.coordinates(reference, model, at))


def _indices(cables: list[int], num_cables: int, file: Path) -> list[int]:
    for i, cable in enumerate(cables):
        if not 1 <= cable <= num_cables:
            requirement = f"the number of a cable, 1 to {num_cables}"
            refuse(str(file), [f"{AT}.cables[{i}] must be {requirement}, got {cable}"])
        if cable in cables[:i]:
            refuse(str(file), [f"{AT}.cables[{i}] must differ from those before, got {cable}"])
    return [cable - 1 for cable in cables]
