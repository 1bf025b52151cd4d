"""What gravity does to the robot (Fig. 7)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr._coordinates import polar
from cdcr._core import taylor_range
from cdcr._model import Model
from cdcr.robots import amouri2020
from cdcr.scenarios._findings import Finding
from cdcr.scenarios._paper import source
from cdcr.scenarios._scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

G = 9.81  # [m/s^2]
# How the robot stands in the field, by name: gravity along Z of the base [m/s^2].
WAYS = {"no gravity": 0.0, "upright": -G, "hanging": G}
TENSION = 5.0  # on cable 1 [N]
CLAIM = 0.27  # largest ratio that the paper gives [%]


def model_of(way: str) -> Model:
    """Return the robot in the field of gravity."""
    return Model(amouri2020(gravity=(0.0, 0.0, WAYS[way])))


def energy_ratio(theta: ArrayLike, way: str) -> NDArray[np.float64]:
    """Return the gravitational energy, zero when straight, over the elastic one, theta > 0 [1]."""
    angles = np.atleast_1d(np.asarray(theta, dtype=np.float64))
    q = np.stack([angles, np.zeros_like(angles)], axis=1)
    free, heavy = model_of("no gravity"), model_of(way)
    elastic, total = free.potential_energies(q), heavy.potential_energies(q)
    straight = heavy.potential_energy([0.0, 0.0])
    ratio: NDArray[np.float64] = (total - straight - elastic) / elastic
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


def _tell(scenario: Scenario, run: None) -> tuple[Finding, ...]:
    start = 1.0 - stiffness("upright") / stiffness("no gravity")
    end = -float(energy_ratio(taylor_range, "upright")[0])
    found = [
        Finding("ratio_0", "gravitational over elastic energy at theta -> 0", 100.0 * start, "%"),
        Finding("ratio_end", "the same at theta = 3 pi/5", 100.0 * end, "%"),
    ]
    for way in WAYS:
        key, label = way.replace(" ", "_"), f"theta at {TENSION:g} N, {way}"
        linear = linear_theta_deg(TENSION, way)
        found += [
            Finding(f"theta_{key}_deg", label, theta_deg(TENSION, way), "deg"),
            Finding(f"theta_{key}_linear_deg", f"{label}, linearised", linear, "deg"),
        ]
    return tuple(found)


def _draw(scenario: Scenario, run: None) -> Figure:
    from cdcr.scenarios._gravity_figure import gravity_figure

    return gravity_figure(scenario.title)


SCENARIO = Scenario(
    name="gravity-ratio",
    title="Gravitational over elastic energy, and what gravity does to the equilibrium at 5 N",
    description=(
        "The paper neglects gravity, finding its energy below 0.27 % of the elastic one. With the "
        "masses of Table 1 and g = 9.81 m/s^2 it is 23.8 % near straight and 21.0 % at 3 pi/5, "
        "so 0.27 was perhaps a ratio, read as per cent. Under 5 N on cable 1 the robot bends by "
        "14.98 deg without gravity, about 20 deg standing upright and 12 deg hanging."
    ),
    source=source("section 4.2 and Fig. 7"),
    paper_figure=7,
    robot=amouri2020(),
    tell=_tell,
    draw=_draw,
)
