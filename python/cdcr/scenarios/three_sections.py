"""Each section of a robot of three driven in turn, the others held straight."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from cdcr._coordinates import polar
from cdcr._model import Model
from cdcr._simulate import TensionTable
from cdcr._trajectory import Trajectory
from cdcr.robots import three_sections
from cdcr.scenarios._energy import energy_gap
from cdcr.scenarios._findings import Finding
from cdcr.scenarios._scenario import Scenario
from cdcr.scenarios._sections import HANGING, holding, speed_findings

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

# What each section is bent to while the others are straight: theta, phi [rad].
BENT = np.deg2rad([(60.0, 0.0), (60.0, 120.0), (90.0, 30.0)])
RAMP, PHASE = 1.0, 5.0  # time for each change, and between the starts of two [s]
DAMPING = 8e-3  # of each bending component [N m s/rad]
STEP = 2.5e-3  # between samples [s]


def goals() -> Array:
    """Return the shape of each phase (3, 6): one section is bent, the others are straight."""
    shapes = np.zeros((len(BENT), 2 * len(BENT)))
    for k, (theta, phi) in enumerate(BENT):
        shapes[k, 2 * k : 2 * k + 2] = theta * np.cos(phi), theta * np.sin(phi)
    return shapes


def ends(run: Trajectory) -> list[tuple[int, int]]:
    """Return each phase that the run comes to the end of, with its last sample."""
    times = [(k, PHASE * (k + 1)) for k in range(len(BENT))]
    return [(k, int(np.searchsorted(run.t, t - STEP / 2))) for k, t in times if t <= run.t[-1]]


def own_cables_alone(model: Model, k: int) -> Array:
    """Return q (2n,) at rest if only the cables that end at section k pulled, as in its phase."""
    own = np.array([cable.end_section == k for cable in model.robot.all_cables])
    return model.equilibrium(np.where(own, holding(model, goals()[k]), 0.0))


def _tensions(model: Model, t_end: float) -> TensionTable:
    times, rows = [0.0], [np.zeros(model.num_cables)]
    for k, goal in enumerate(goals()):
        held = holding(model, goal)
        times += [k * PHASE + RAMP, (k + 1) * PHASE]
        rows += [held, held]
    return TensionTable(times, rows)


def _tell(scenario: Scenario, run: Trajectory) -> tuple[Finding, ...]:
    model = run.model
    straight = model.tip(np.zeros(model.num_coordinates))[1]
    found = []
    for k, last in ends(run):
        key, at = f"section_{k + 1}", f"section {k + 1} driven"
        moved = 1e3 * float(np.linalg.norm(run.tip[last] - straight))
        error = float(np.rad2deg(np.max(np.abs(run.q[last] - goals()[k]))))
        held = run.tension[last]
        found += [
            Finding(f"{key}_tip_mm", f"{at}: tip from the straight robot's", moved, "mm"),
            Finding(f"{key}_error_deg", f"{at}: bending off the goal, end", error, "deg"),
            Finding(f"{key}_tension_N", f"{at}: largest tension", float(held.max()), "N"),
        ]
        angles = np.rad2deg(polar(own_cables_alone(model, k))[0])
        for i in range(k):
            name, label = f"{key}_alone_{i + 1}_deg", f"its cables alone would bend section {i + 1}"
            found.append(Finding(name, f"{at}: {label} by", float(angles[i]), "deg"))
    gap = Finding("energy_gap", "relative gap of the energy balance", energy_gap(run), "")
    return (*found, gap, *speed_findings(scenario, run))


def _draw(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios._sections_figure import three_sections_figure

    return three_sections_figure(scenario.title, run)


SCENARIO = Scenario(
    name="three-sections",
    title="Three sections driven in turn",
    description=(
        "A robot of three sections hangs straight down. Every five seconds another section is bent "
        "by 60 or 90 deg within a second, and the others are held straight. The cables of a "
        "section run through all sections before it and bend them too, as does the weight that "
        "hangs on them: other cables must pull against that. The tensions are the least that hold "
        "each shape, found by inverse dynamics at rest."
    ),
    source="example design of this project, robot three_sections hanging down",
    robot=replace(
        three_sections(gravity=(0.0, 0.0, -9.81), damping=DAMPING), base_orientation=HANGING
    ),
    q0=(0.0,) * 6,
    qd0=(0.0,) * 6,
    tension=_tensions,
    t_end=PHASE * len(BENT),
    num_samples=round(PHASE * len(BENT) / STEP) + 1,
    method="dopri5",
    rtol=1e-10,
    atol=1e-12,
    tell=_tell,
    draw=_draw,
)
