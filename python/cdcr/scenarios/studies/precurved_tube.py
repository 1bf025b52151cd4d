"""A tube that is curved at rest: straightened by a cable, loaded out of its plane."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.wrench import Wrench
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

TENSIONS = np.linspace(0.0, 15.0, 7)  # [N]
LOADS = np.linspace(0.0, 0.1, 9)  # out of the plane, on the tip [N]
SMALL = 1e-4  # a load that is [N]


def straightened(scenario: Scenario) -> FloatArray:
    """Return the shapes of rest under each of the tensions (tensions, d)."""
    return np.array([scenario.model.equilibrium([tension]) for tension in TENSIONS])


def loaded(scenario: Scenario, loads: FloatArray = LOADS) -> FloatArray:
    """Return the shapes of rest under each of the loads (loads, d)."""
    model, q = scenario.model, [scenario.model.rest_shape]
    for load in loads:
        pull = Wrench(section=0, force=(0.0, float(load), 0.0))
        q.append(model.equilibrium([0.0], q[-1], pull))
    return np.array(q[1:])


def compliance(scenario: Scenario) -> float:
    """Return by how much a small load moves the tip, over the load [m/N]."""
    (q,) = loaded(scenario, np.array([SMALL]))
    return float(scenario.model.tip(q)[1][1]) / SMALL


def timoshenko(scenario: Scenario) -> float:
    """Return the same of a bar that is an arc of a circle, by Castigliano's theorem [m/N]."""
    (section,) = scenario.robot.sections
    theta = math.hypot(*section.rest_bending)
    area = section.second_moment_of_area
    assert section.shear_modulus is not None
    bending, twist = section.youngs_modulus * area, 2.0 * section.shear_modulus * area
    return (section.length / theta) ** 3 * (
        (theta / 2.0 - math.sin(2.0 * theta) / 4.0) / bending
        + (1.5 * theta - 2.0 * math.sin(theta) + math.sin(2.0 * theta) / 4.0) / twist
    )


def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    """Return angles under tension, and displacements under load beside Timoshenko's."""
    model, end = scenario.model, loaded(scenario)[-1]
    least = math.degrees(float(straightened(scenario)[-1][0]))
    moved = 1e3 * float(model.tip(end)[1][1])
    twist = math.degrees(float(end[model.coordinate_names.index("t1")]))
    found, exact = 1e3 * compliance(scenario), 1e3 * timoshenko(scenario)
    return (
        Metric("theta_pulled_deg", f"theta under {TENSIONS[-1]:g} N", least, "deg"),
        Metric("moved_mm", f"tip moved by {LOADS[-1]:g} N out of the plane", moved, "mm"),
        Metric("twist_deg", "twist from base to tip under that", twist, "deg"),
        Metric("compliance_mm_N", "tip moved by a small load, over it", found, "mm/N"),
        Metric("exact_mm_N", "the same of Timoshenko's curved bar", exact, "mm/N"),
    )
