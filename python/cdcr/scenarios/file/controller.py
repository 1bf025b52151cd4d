"""The [controller] table of scenario files: a PID loop, its reference, what it shows.

[controller]
type = "pid"
kp = 2.0                        # [N m/rad]
cables = [1, 2]                 # counted from 1, as everywhere in the file

[controller.reference]
theta_deg = [15.0]              # of each section
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.files.toml import refuse, schema_errors
from cdcr.model.model import Model
from cdcr.runs.pid import Pid
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.file import values
from cdcr.scenarios.metrics import Metric, run_metrics
from cdcr.scenarios.scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

AT = "controller"
BAND = 0.02  # of the first error, within which a loop has settled


@dataclass(frozen=True, eq=False)
class PidLoop:
    """A PID controller to be made for a model, and the coordinates it is to reach."""

    options: dict[str, Any]
    reference: tuple[float, ...]

    def __call__(self, model: Model) -> Pid:
        """Return the controller."""
        pid = Pid(model, **self.options)
        pid.reference = self.reference
        return pid

    def summarize(self, scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
        """Return what every run shows, how near the loop comes, and how hard it pulls."""
        error = np.linalg.norm(run.q - self.reference, axis=1)
        found = [
            *run_metrics(scenario, run),
            Metric("error_end_deg", "error at the end", float(np.rad2deg(error[-1])), "deg"),
        ]
        outside = np.flatnonzero(error > BAND * error[0])
        last = int(outside[-1]) if outside.size else -1
        if last + 1 < len(run):
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
        theta, phi = run.model.polar([self.reference])
        # A section that ended bent the other way has a negative theta.
        signed = np.rad2deg(theta * np.sign(np.cos(phi - run.phi[-1]) + 1e-9))[0]
        axes = figure.axes[1]
        for angle in signed:
            axes.axhline(angle, color="black", linewidth=1.0, dashes=(6, 4))
        angles = ", ".join(f"{angle:.2f}" for angle in signed)
        axes.set_title(f"dashed: reference, {angles} deg", loc="left", fontsize=9.5)
        return figure


def read_controller(table: dict[str, Any], model: Model, file: Path) -> PidLoop:
    """Return the loop of a [controller] table, or refuse it with file, key and value."""
    from cdcr.scenarios.file.schema import ControllerTable, ReferenceTable

    refuse(str(file), schema_errors(ControllerTable, table, AT))
    options = {key: value for key, value in table.items() if key not in ("type", "reference")}
    if "cables" in options:
        options["cables"] = _indices(options["cables"], model.num_cables, file)
    reference, at = table.get("reference", {}), f"{AT}.reference"
    found = [*schema_errors(ReferenceTable, reference, at), *values.rival_errors(reference, at)]
    refuse(str(file), found)
    refuse(str(file), values.length_errors(reference, model, at))
    with values.error_prefix(str(file)):
        goal = values.coordinates(reference, model, at)
    loop = PidLoop(options, goal)
    with values.error_prefix(f"{file}, [{AT}]"):
        loop(model)
    return loop


def _indices(cables: list[int], num_cables: int, file: Path) -> list[int]:
    for i, cable in enumerate(cables):
        if not 1 <= cable <= num_cables:
            requirement = f"the number of a cable, 1 to {num_cables}"
            refuse(str(file), [f"{AT}.cables[{i}] must be {requirement}, got {cable}"])
        if cable in cables[:i]:
            refuse(str(file), [f"{AT}.cables[{i}] must differ from those before, got {cable}"])
    return [cable - 1 for cable in cables]
