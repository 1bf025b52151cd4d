"""A state, tensions, and every method of a model that takes a bending vector."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import cdcr

Q, QD, QDD = [0.4, -0.7], [1.5, 0.3], [-2.0, 5.0]
TENSION = [3.0, 1.0, 0.5]

OF_Q: dict[str, Callable[[cdcr.Model, Any], Any]] = {
    "pose": lambda m, q: m.pose(q, 0, 0.5),
    "tip": lambda m, q: m.tip(q),
    "jacobian": lambda m, q: m.jacobian(q, 0, 1.0),
    "tip_jacobian": lambda m, q: m.tip_jacobian(q),
    "actuation_matrix": lambda m, q: m.actuation_matrix(q),
    "cable_lengths": lambda m, q: m.cable_lengths(q),
    "mass_matrix": lambda m, q: m.mass_matrix(q),
    "potential_energy": lambda m, q: m.potential_energy(q),
    "bias": lambda m, q: m.bias(q, QD),
    "kinetic_energy": lambda m, q: m.kinetic_energy(q, QD),
    "forward_dynamics": lambda m, q: m.forward_dynamics(q, QD, TENSION),
    "inverse_dynamics": lambda m, q: m.inverse_dynamics(q, QD, QDD),
    "base_wrench": lambda m, q: m.base_wrench(q, QD, QDD),
    "linearize": lambda m, q: m.linearize(q, QD, TENSION),
}
