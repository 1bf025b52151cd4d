"""One helical cable: how far it bends and twists, beside a rod that is kept straight."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

ROUNDS = 100  # of a contraction


def twist_of_straight(scenario: Scenario, tension: float) -> float:
    """Return the twist of a rod that its helical cable twists and something keeps straight [rad].

    The cable is sqrt(l^2 + r^2 (a + t)^2) long, a its turn and t the twist; its shortening works
    against G J t^2/(2 l).
    """
    (section,), (cable,) = scenario.robot.sections, scenario.robot.all_cables
    ((r, _), (start, end)), l = cable.route(0), section.length
    assert section.shear_modulus is not None
    stiffness = 2.0 * section.shear_modulus * section.second_moment_of_area / l
    twist = 0.0
    for _ in range(ROUNDS):
        turn = end - start + twist
        twist = -tension * r**2 * turn / math.hypot(l, r * turn) / stiffness
    return twist


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return where the last tension brings the robot to rest."""
    model, tension = run.model, run.tension[-1]
    rest = model.equilibrium(tension)
    twist = float(rest[model.coordinate_names.index("t1")])
    moved = float(np.linalg.norm(model.tip(rest)[1] - model.tip(model.rest_shape)[1]))
    left = float(np.linalg.norm(run.tip[-1] - model.tip(rest)[1]))
    straight = twist_of_straight(scenario, float(tension[0]))
    at = f"at rest under {tension[0]:g} N"
    return (
        Metric("moved_mm", f"{at}: tip from that of the straight robot", 1e3 * moved, "mm"),
        Metric("twist_deg", f"{at}: twist from base to tip", math.degrees(twist), "deg"),
        Metric("straight_deg", "the same of a rod kept straight", math.degrees(straight), "deg"),
        Metric("left_mm", "tip from there at the end of the run", 1e3 * left, "mm"),
    )
