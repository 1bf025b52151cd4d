"""The inertias M11 and M22, whole and cut after theta^4 (Fig. 6)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr._core import taylor_range
from cdcr.base.arrays import FloatArray
from cdcr.paper import inertia
from cdcr.paper.claims.printed import printed_inertia
from cdcr.robot.robot import Robot
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.studies.factors import cut

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

CLAIM = 0.05  # error that the paper gives for both [%]


# What the two ways to write eq. (21) are called, and the kinds that they have of factors.
WAYS = {"derived": (inertia, "exact"), "printed": (printed_inertia, "printed")}


def terms(theta: FloatArray, robot: Robot, way: str) -> tuple[FloatArray, FloatArray]:
    """Return M11 and M22 (2, N) whole, and the same cut after theta^4 [kg m^2]."""
    function, kind = WAYS[way]
    return np.array(function(theta, robot, kind)), np.array(function(theta, robot, cut(kind)))


def taylor_errors(theta: FloatArray, robot: Robot, way: str) -> FloatArray:
    """Return the errors of M11 and M22 (2, N) cut after theta^4 [%]."""
    whole, series = terms(theta, robot, way)
    return 100.0 * (series - whole) / whole


def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    """Return M11 and M22 at the end of the range, and the errors of Taylor there."""
    end, robot = np.array([taylor_range]), scenario.robot
    found = []
    for way in WAYS:
        values, errors = terms(end, robot, way)[0], taylor_errors(end, robot, way)
        for term, value, error in zip(("M11", "M22"), values, errors, strict=True):
            key, label = f"{term}_{way}", f"{term}, {way}"
            found += [
                Metric(f"{key}_end", f"{label}, at 3 pi/5", 1e3 * float(value[0]), "1e-3 kg m^2"),
                Metric(f"{key}_error", f"{label}: error of Taylor", float(error[0]), "%"),
            ]
    return tuple(found)
