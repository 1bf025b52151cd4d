"""A tapered arm under one converging cable: its curvature against the closed form."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial.legendre import legval

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

TENSIONS = (0.1, 0.2, 0.3)  # [N]
ORDERS = range(5)
X = np.linspace(0.0, 1.0, 2001)  # fractions of the length
ROUNDS = 50  # of a contraction to less than a tenth


def model_of(scenario: Scenario, order: int) -> Model:
    """Return the arm with another order of its bending."""
    (section,) = scenario.robot.sections
    return Model(replace(scenario.robot, sections=(replace(section, bending_order=order),)))


def curvature(model: Model, tension: float) -> FloatArray:
    """Return the curvature of rest at each X [1/m]."""
    q = model.equilibrium([tension])
    return np.asarray(legval(2.0 * X - 1.0, q[0::2]) / model.robot.length)


def closed_form(scenario: Scenario, tension: float) -> FloatArray:
    """Return F r cos(beta)/(E I) at each X [1/m], beta the angle between cable and backbone."""
    (section,), (cable,) = scenario.robot.sections, scenario.robot.all_cables
    (d0, d1), ((r0, r1), _) = section.diameters, cable.route(0)
    d, r = d0 + X * (d1 - d0), r0 + X * (r1 - r0)
    rigidity = section.youngs_modulus * np.pi / 64.0 * d**4
    slope = (r1 - r0) / section.length
    kappa: FloatArray = np.zeros_like(X)
    for _ in range(ROUNDS):
        along = 1.0 - r * kappa
        kappa = tension * r * along / np.hypot(along, slope) / rigidity
    return kappa


def tip_of(kappa: FloatArray, length: float) -> FloatArray:
    """Return x and z of the tip of a curve in a plane (2,) [m]."""
    h = length * (X[1] - X[0])
    angle = np.concatenate([[0.0], np.cumsum((kappa[1:] + kappa[:-1]) * h / 2.0)])
    rows = np.array([np.sin(angle), np.cos(angle)])
    return np.asarray(np.sum(rows[:, 1:] + rows[:, :-1], axis=1) * h / 2.0)


def tip_errors(scenario: Scenario) -> FloatArray:
    """Return how far the tip of each order is from the closed form, largest tension (5,) [m]."""
    exact = tip_of(closed_form(scenario, TENSIONS[-1]), scenario.robot.length)
    found = []
    for order in ORDERS:
        model = model_of(scenario, order)
        x, _, z = model.tip(model.equilibrium([TENSIONS[-1]]))[1]
        found.append(np.hypot(x - exact[0], z - exact[1]))
    return np.array(found)


def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    """Return curvatures at base and tip, and how near each order comes."""
    found = []
    exact, reached = closed_form(scenario, TENSIONS[-1]), curvature(scenario.model, TENSIONS[-1])
    for name, k in (("base", 0), ("tip", -1)):
        label = f"curvature at the {name}, {TENSIONS[-1]:g} N"
        found += [
            Metric(f"curvature_{name}", label, float(reached[k]), "1/m"),
            Metric(f"exact_{name}", "the same, closed form", float(exact[k]), "1/m"),
        ]
    for order, error in zip(ORDERS, tip_errors(scenario), strict=True):
        label = f"bending order {order}: tip from the closed form"
        found.append(Metric(f"order_{order}_mm", label, 1e3 * float(error), "mm"))
    return tuple(found)
