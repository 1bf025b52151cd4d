"""Questions about numbers that are possible but look like those of another unit."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from cdcr.base.check import entry

if TYPE_CHECKING:
    from cdcr.base.arrays import FloatArray
    from cdcr.robot.robot import Robot
    from cdcr.robot.section import Section

FULL_TURN = 2.0 * math.pi * (1.0 + 1e-9)  # [rad]
SOFTEST = (1e-3, 1e3)  # Young's and shear moduli that nothing has, but in GPa or MPa much [Pa]
# Lengths in mm, masses in g: a thousand times what they are, so that few are asked in vain.
LONG, SLENDEREST = 5.0, 2e4  # a section longer than that [m] and than so many diameters
WIDE, WIDEST = 0.3, 5.0  # whatever is wider than that [m] and than so many lengths of the robot
THICKEST = 0.5  # a backbone that is thicker than so many lengths of the robot too
HEAVY, DENSEST = 0.1, 1e6  # a backbone heavier than that [kg] and denser than that [kg/m^3]
DENSE = 1e5  # of disks that fill all of their section [kg/m^3]
STRONGEST = 1e3  # gravity, or what a centrifuge has [m/s^2]
THINNEST = 0.1  # density of a long backbone, a tenth of that of air [kg/m^3]
ROUGHEST = 5.0  # coefficient of friction
FARTHEST = 10.0  # commanded length over that of the straight robot, or the other way round
_MILLIMETRES = "looks like millimetres: lengths are in m"


def ask_about_robot(robot: Robot) -> None:
    """Warn of what may be in degrees, GPa, mm, g or per cent."""
    for question in _questions(robot):
        warnings.warn(question, UserWarning, stacklevel=5)  # where the robot is described


def _questions(robot: Robot) -> Iterator[str]:
    for i, section in enumerate(robot.sections):
        at = entry("sections", i)
        for j, angle in enumerate(section.cable_angles):
            yield from _about_angle(f"{at}: cable_angles[{j}]", angle, "cable_angles_deg")
        for name in ("youngs_modulus", "shear_modulus"):
            modulus = getattr(section, name)
            if modulus is not None and SOFTEST[0] <= modulus < SOFTEST[1]:
                yield (
                    f"{at}: {name} = {modulus:g} Pa is softer than any backbone: is it in GPa? "
                    f"{modulus:g} GPa are {1e9 * modulus:g} Pa"
                )
        yield from _about_sizes(at, section, robot.length)
    for j, cable in enumerate(robot.cables):
        if isinstance(cable.angle, float):  # one that winds may wind more than once
            yield from _about_angle(f"{entry('cables', j)}: angle", cable.angle, "angle_deg")
        farthest = float(np.max(np.abs(cable.radius)))
        yield from _about_width(f"{entry('cables', j)}: radius", farthest, robot.length)
    for name, place in (
        ("payload_position", robot.payload_position),
        ("the place of tool", [row[3] for row in robot.tool[:3]]),
    ):
        yield from _about_width(name, math.hypot(*place), robot.length)
    strength = math.hypot(*robot.gravity)
    if strength > STRONGEST:
        told = f"gravity = {strength:g} m/s^2"
        yield f"{told} is more than a hundred times the earth's: is it in mm/s^2?"


def _about_width(name: str, width: float, length: float, most: float = WIDEST) -> Iterator[str]:
    if width > max(WIDE, most * length):
        yield f"{name} = {width:g} m, of a robot {length:g} m long, {_MILLIMETRES}"


def _about_sizes(at: str, section: Section, length: float) -> Iterator[str]:
    widest = max(section.diameters)
    volume = math.pi / 4.0 * widest * widest * section.length
    if section.length > LONG:
        slender = section.length > SLENDEREST * widest
        if slender or 0.0 < section.backbone_mass < THINNEST * volume:
            yield f"{at}: length = {section.length:g} m {_MILLIMETRES}"
    yield from _about_width(f"{at}: backbone_diameter", widest, length, THICKEST)
    for name in ("disk_diameter", "cable_radius"):
        yield from _about_width(f"{at}: {name}", getattr(section, name), length)
    mass = section.backbone_mass
    if mass > max(HEAVY, DENSEST * volume):
        yield (
            f"{at}: backbone_mass = {mass:g} kg makes the backbone denser than any material: is it "
            "in g? Masses are in kg"
        )
    disk = section.disk_diameter * section.disk_diameter
    filled = math.pi / 4.0 * disk * section.length / max(section.num_disks, 1)
    if filled and section.disk_mass > max(HEAVY, DENSE * filled):
        yield (
            f"{at}: disk_mass = {section.disk_mass:g} kg makes disks denser than any material: is "
            "it in g? Masses are in kg"
        )
    if section.cable_friction > ROUGHEST:
        yield (
            f"{at}: cable_friction = {section.cable_friction:g} is more than any materials have: "
            "is it in per cent?"
        )


def _about_angle(name: str, angle: float, in_degrees: str) -> Iterator[str]:
    if abs(angle) > FULL_TURN:
        yield (
            f"{name} = {angle:g} rad is more than a full turn: is it in degrees? In a file, "
            f"{in_degrees} takes them; in Python, math.radians({angle:g})"
        )


def ask_about_commands(robot: Robot, command: FloatArray, stacklevel: int = 3) -> None:
    """Warn of commands (..., num_cables) to cables driven by length that may be tensions."""
    springs = [one.cable_stiffness for one in robot.sections]
    if not any(springs) and not any(cable.stiffness for cable in robot.cables):
        return
    ends = list(accumulate((section.length for section in robot.sections), initial=0.0))
    drives = [
        *(
            (ends[i + 1], one.cable_stiffness)
            for i, one in enumerate(robot.sections)
            for _ in one.cable_angles
        ),
        *(
            (ends[cable.end_section + 1] - ends[cable.start_section], cable.stiffness)
            for cable in robot.cables
        ),
    ]
    for j, (length, stiffness) in enumerate(drives):
        if not stiffness:
            continue
        asked = command[..., j]
        odd = asked[(asked > FARTHEST * length) | (asked < length / FARTHEST)]
        if odd.size:
            warnings.warn(
                f"cable {j + 1} is driven by length and told {odd.flat[0]:g} m, where the straight "
                f"robot takes {length:g} m: is that a tension [N]? Model.rest_command gives the "
                "lengths of the straight robot, Model.commands those that hold tensions",
                UserWarning,
                stacklevel=stacklevel,
            )
            return
