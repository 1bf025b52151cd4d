"""Robots that differ from one episode to the next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from cdcr.base.check import Check, format_value, known_name, short
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

Ranges = Mapping[str, Sequence[float]]

RANDOM = ("stiffness", "damping", "mass", "payload")
# Fields of a section that a factor multiplies, where they are given.
_STIFFNESS = (
    *("youngs_modulus", "shear_modulus"),
    *("bending_stiffness", "twist_stiffness", "stretch_stiffness"),
)
_DAMPING = ("damping", "twist_damping", "stretch_damping")
_MASS = ("backbone_mass", "disk_mass")


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
            must = f"two numbers {bound}, from low to high"
            raise ValueError(f"{item} must be {must}, got {short(given)}")
        checked[name] = (pair[0], pair[1])
    return checked


def draw_robot(
    robot: Robot, ranges: Mapping[str, tuple[float, float]], rng: np.random.Generator
) -> Robot:
    """Return the robot with stiffness, damping, mass and payload drawn evenly from their ranges."""
    drawn = {name: float(rng.uniform(*ranges[name])) for name in RANDOM if name in ranges}
    stiffness, damping, mass = (drawn.get(name, 1.0) for name in RANDOM[:3])
    sections = [_multiplied(one, stiffness, damping, mass) for one in robot.sections]
    payload = drawn.get("payload", robot.payload)
    return replace(robot, sections=tuple(sections), payload=payload)


def _multiplied(section: Section, stiffness: float, damping: float, mass: float) -> Section:
    factors = dict.fromkeys(_STIFFNESS, stiffness)
    factors |= dict.fromkeys(_DAMPING, damping) | dict.fromkeys(_MASS, mass)
    factors["material_damping"] = damping / stiffness  # the damping is this times the stiffness
    changed: dict[str, Any] = {
        name: factor * value
        for name, factor in factors.items()
        if (value := getattr(section, name)) is not None
    }
    return replace(
        section, **changed, disk_masses=tuple(mass * disk for disk in section.disk_masses)
    )
