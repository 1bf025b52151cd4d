"""A robot holds a payload with its cables; the payload falls off and the robot recoils."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cdcr.model.model import Model
from cdcr.robots import three_sections
from cdcr.runs.command import TensionTable
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario
from cdcr.scenarios.studies.sections import HORIZONTAL, holding, release_metrics

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PAYLOAD = 0.015  # [kg]
DAMPING = 6e-3  # of each bending component [N m s/rad]
STEP = 2e-3  # between samples [s]
T_END = 10.0  # [s]
SHOWN = (0.0, 0.15, 0.25, 0.36, 0.5, 0.8)  # times of the shapes in the picture [s]


def loaded(model: Model) -> Model:
    """Return the model of the robot with the payload."""
    return Model(replace(model.robot, payload=PAYLOAD))


def tension(model: Model) -> NDArray[np.float64]:
    """Return the least tensions (num_cables,) that hold robot and payload straight [N]."""
    return holding(loaded(model), np.zeros(model.num_coordinates))


def held(model: Model) -> tuple[float, ...]:
    """Return q (2n,) at rest with the payload [rad]."""
    straight = np.zeros(model.num_coordinates)
    return tuple(loaded(model).equilibrium(tension(model), straight).tolist())


def at_rest(model: Model) -> NDArray[np.float64]:
    """Return q (2n,) at rest without the payload [rad]."""
    return model.equilibrium(tension(model))


def _summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    model = run.model
    start = model.forward_dynamics(run.q[0], run.qd[0], run.tension[0])
    lift = (model.jacobian(run.q[0], model.num_sections - 1, 1.0) @ start)[2]
    return (
        Metric("lift_m_s2", "the tip's first acceleration upwards", float(lift), "m/s^2"),
        *release_metrics(scenario, run, at_rest(model)),
    )


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.sections import release_figure

    return release_figure(scenario.title, run, at_rest(run.model), SHOWN, fallen="payload")


SCENARIO = Scenario(
    name="payload-drop",
    title=f"A payload of {1e3 * PAYLOAD:g} g falls off",
    description=(
        "A robot of three sections sticks out of a wall. Its cables hold it straight with "
        f"{1e3 * PAYLOAD:g} g at its tip. At t = 0 the payload falls off, the tensions stay: the "
        "tip is thrown up, swings and comes to rest where the cables hold the robot alone."
    ),
    source="example design of this project, robot three_sections fixed to a wall",
    robot=replace(
        three_sections(gravity=(0.0, 0.0, -9.81), damping=DAMPING), base_orientation=HORIZONTAL
    ),
    q0=held,
    qd0=(0.0,) * 6,
    tension=lambda model, t_end: TensionTable([0.0], [tension(model)]),
    t_end=T_END,
    num_samples=round(T_END / STEP) + 1,
    method="dopri5",
    rtol=1e-10,
    atol=1e-12,
    summarize=_summarize,
    plot=_plot,
)
