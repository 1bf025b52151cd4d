"""What ``cdcr info --json`` prints."""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import asdict
from typing import Any

import numpy as np

from cdcr.model.rest import Rest, at_rest
from cdcr.model.statics import ConvergenceError
from cdcr.robot.robot import Robot


def as_dict(name: str, robot: Robot) -> dict[str, Any]:
    """Return what a robot is made of, and how it is at rest, as JSON has it; null for unknown."""
    told: dict[str, Any] = {
        "name": name,
        "robot": asdict(robot),
        "num_cables": robot.num_cables,
        "length_m": robot.length,
        "mass_kg": robot.mass,
        "rest": None,
    }
    with suppress(ConvergenceError):
        told["rest"] = _rest(at_rest(robot))
    return told


def _rest(rest: Rest) -> dict[str, Any]:
    told: dict[str, Any] = {
        "where": rest.words,
        "q_rad": rest.q.tolist(),
        "command": rest.command.tolist(),
        "tension_N": rest.tension.tolist(),
        "stable": rest.stable,
        "tip_stiffness_N_per_m": _finite(np.array(rest.tip_stiffness))
        if rest.is_nondegenerate
        else None,
        "frequency_Hz": None,
        "damping_ratio": None,
        "largest_stable_step_s": None,
    }
    with suppress(ValueError):  # no inertia
        told["frequency_Hz"] = _finite(rest.modes.frequency_hz)
        told["damping_ratio"] = _finite(rest.modes.damping_ratio)
        told["largest_stable_step_s"] = rest.step
    return told


def _finite(values: np.ndarray[Any, np.dtype[np.float64]]) -> list[float | None]:
    return [value if math.isfinite(value) else None for value in values.tolist()]
