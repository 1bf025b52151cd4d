"""A soft arm held at a wall is let go, swings and comes to rest hanging."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cdcr.model.coordinates import bending
from cdcr.model.model import Model
from cdcr.robots import three_sections
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario
from cdcr.scenarios.studies.sections import HORIZONTAL, release_metrics

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BENT = math.radians(50.0), math.radians(50.0)  # theta, phi of every section at the start [rad]
DAMPING = 6e-3  # of each bending component [N m s/rad]
STEP = 2e-3  # between samples [s]
T_END = 12.0  # [s]
SHOWN = (0.0, 0.12, 0.24, 0.5, 1.0)  # times of the shapes in the picture [s]


def at_rest(model: Model) -> NDArray[np.float64]:
    """Return q (2n,) of the arm that hangs at rest [rad]."""
    return model.equilibrium(np.zeros(model.num_cables))


def _summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    return release_metrics(scenario, run, at_rest(run.model))


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.sections import release_figure

    return release_figure(scenario.title, run, at_rest(run.model), SHOWN)


SCENARIO = Scenario(
    name="hanging-arm",
    title="An arm at a wall, let go",
    description=(
        "A soft arm of three sections sticks out of a wall, bent up and sideways. Its cables are "
        "slack: it falls, swings in both directions and comes to rest where elasticity holds its "
        "weight. What energy it loses, damping takes."
    ),
    source="example design of this project, robot three_sections fixed to a wall",
    robot=replace(
        three_sections(gravity=(0.0, 0.0, -9.81), damping=DAMPING), base_orientation=HORIZONTAL
    ),
    q0=tuple(bending([BENT[0]] * 3, [BENT[1]] * 3).tolist()),
    qd0=(0.0,) * 6,
    tension=(0.0,) * 9,
    t_end=T_END,
    num_samples=round(T_END / STEP) + 1,
    method="dopri5",
    rtol=1e-10,
    atol=1e-12,
    summarize=_summarize,
    plot=_plot,
)
