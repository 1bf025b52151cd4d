"""What gravity does to the robot (Fig. 7)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from cdcr._core import taylor_range
from cdcr.base.arrays import FloatArray
from cdcr.model.coordinates import polar
from cdcr.model.model import Model
from cdcr.robots import amouri2020
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

G = 9.81  # [m/s^2]
# How the robot stands in the field, by name: gravity along Z of the base [m/s^2].
WAYS = {"no gravity": 0.0, "upright": -G, "hanging": G}
TENSION = 5.0  # on cable 1 [N]
CLAIM = 0.27  # largest ratio that the paper gives [%]


def model_of(way: str) -> Model:
    """Return the robot in the field of gravity."""
    return Model(amouri2020(gravity=(0.0, 0.0, WAYS[way])))


def energy_ratio(theta: ArrayLike, way: str) -> FloatArray:
    """Return the gravitational energy, zero when straight, over the elastic one, theta > 0 [1]."""
    angles = np.atleast_1d(np.asarray(theta, dtype=np.float64))
    q = np.stack([angles, np.zeros_like(angles)], axis=1)
    free, heavy = model_of("no gravity"), model_of(way)
    elastic, total = free.potential_energies(q), heavy.potential_energies(q)
    straight = heavy.potential_energy([0.0, 0.0])
    ratio: FloatArray = (total - straight - elastic) / elastic
    return ratio


def stiffness(way: str) -> float:
    """Return the bending stiffness d2U/dtheta2 of the straight robot, with gravity [N m/rad]."""
    model = model_of(way)
    rest = np.zeros(2)
    A, _ = model.linearize(rest, rest, np.zeros(model.num_cables))
    return float(-(model.mass_matrix(rest) @ A[2:, :2])[0, 0])


def theta_deg(tension: float, way: str) -> float:
    """Return the bending angle of rest under a tension on cable 1 [deg]."""
    return float(np.rad2deg(polar(model_of(way).equilibrium([tension, 0.0, 0.0]))[0]))


def linear_theta_deg(tension: float, way: str) -> float:
    """Return the same from the stiffness of the straight robot [deg]."""
    radius = amouri2020().sections[0].cable_radius
    return float(np.rad2deg(tension * radius / stiffness(way)))


def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    """Return the ratio of energies, and bending angles at rest with and without gravity."""
    start = 1.0 - stiffness("upright") / stiffness("no gravity")
    end = -float(energy_ratio(taylor_range, "upright")[0])
    found = [
        Metric("ratio_0", "gravitational over elastic energy at theta -> 0", 100.0 * start, "%"),
        Metric("ratio_end", "the same at theta = 3 pi/5", 100.0 * end, "%"),
    ]
    for way in WAYS:
        key, label = way.replace(" ", "_"), f"theta at {TENSION:g} N, {way}"
        linear = linear_theta_deg(TENSION, way)
        found += [
            Metric(f"theta_{key}_deg", label, theta_deg(TENSION, way), "deg"),
            Metric(f"theta_{key}_linear_deg", f"{label}, linearised", linear, "deg"),
        ]
    return tuple(found)
