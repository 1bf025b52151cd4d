"""Robots that differ from one episode to the next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from cdcr.base.check import Check, format_value, known_name
from cdcr.robot.robot import Robot

Ranges = Mapping[str, Sequence[float]]

RANDOM = ("stiffness", "damping", "mass", "payload")


def checked_ranges(ranges: Ranges | None) -> dict[str, tuple[float, float]]:
    """Return the ranges of what is drawn anew for each episode, or refuse them."""
    if not isinstance(ranges, Mapping | None):
        example = '{"damping": (0.5, 2.0)}'
        got = format_value(ranges)
        raise ValueError(f"randomization must be a mapping such as {example}, got {got}")
    checked = {}
    for name, given in (ranges or {}).items():
        known_name("range of randomization", name, RANDOM)
        check = Check()
        item = f"randomization[{name!r}]"
        pair = check.numbers(item, given, "two numbers, from low to high", "a number >= 0")
        check.done()
        least_allowed = name in ("damping", "payload")  # these may be 0
        if (
            len(pair) != 2
            or not 0.0 <= pair[0] <= pair[1] < np.inf
            or not (pair[0] or least_allowed)
        ):
            bound = ">= 0" if least_allowed else "> 0"
            raise ValueError(f"{item} must be two numbers {bound}, from low to high, got {given!r}")
        checked[name] = (pair[0], pair[1])
    return checked


def draw_robot(
    robot: Robot, ranges: Mapping[str, tuple[float, float]], rng: np.random.Generator
) -> Robot:
    """Return the robot with stiffness, damping, mass and payload drawn evenly from their ranges."""
    drawn = {name: float(rng.uniform(*ranges[name])) for name in RANDOM if name in ranges}
    stiffness, damping, mass = (drawn.get(name, 1.0) for name in RANDOM[:3])
    sections = [
        replace(
            one,
            youngs_modulus=stiffness * one.youngs_modulus,
            damping=damping * one.damping,
            backbone_mass=mass * one.backbone_mass,
            disk_mass=mass * one.disk_mass,
            disk_masses=tuple(mass * disk for disk in one.disk_masses),
        )
        for one in robot.sections
    ]
    payload = drawn.get("payload", robot.payload)
    return replace(robot, sections=tuple(sections), payload=payload)
