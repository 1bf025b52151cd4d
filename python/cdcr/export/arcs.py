"""What other software is not told of yet: sections that stretch or taper, cables that wind."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any, NamedTuple

from cdcr.base.check import entry
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section


class Twist(NamedTuple):
    """How a section resists twist."""

    stiffness: float  # [N m/rad]
    damping: float  # [N m s/rad]


def twist_of(section: Section) -> Twist | None:
    """Return how a section resists twist, None where it does not twist."""
    if section.twist_order is None:
        return None
    rigidity = section.twist_stiffness
    if rigidity is None:
        assert section.shear_modulus is not None  # a section that twists has one of them
        rigidity = 2.0 * section.shear_modulus * section.second_moment_of_area
    stiffness = rigidity / section.length
    return Twist(stiffness, section.twist_damping + section.material_damping * stiffness)


def as_solid_arcs(robot: Robot, what: str) -> Robot:
    """Return an equal robot of round, solid arcs with straight cables, or refuse it.

    `what` is what cannot be made of others: "a chain of rigid links", which bends as freely as a
    rod of any bending order. How sections twist, which chains do too, tells `twist_of`.
    """
    robot = replace(robot, sections=tuple(map(_of_one_bend, robot.sections)))
    for i, section in enumerate(robot.sections):
        if section.is_rod:
            more = "that bend and twist alone, untapered, straight at rest, without stretch"
            raise ValueError(
                f"{what} can be made of sections {more}; {entry('sections', i)} is more than that"
            )
    for j, cable in enumerate(robot.cables):
        if not cable.straight or cable.start_section > 0:
            raise ValueError(
                f"{what} can be made with straight cables that begin at the base; "
                f"{entry('cables', j)} does not run so"
            )
    return replace(
        robot,
        sections=tuple(map(_solid, robot.sections)),
        cables=tuple(map(_plain, robot.cables)),
    )


def _of_one_bend(section: Section) -> Section:
    """Return a section without twist and bends of higher order; one that cannot bend stays."""
    if section.bending_order is None:
        return section
    return replace(section, bending_order=0, twist_order=None, nodes=None)


def _solid(section: Section) -> Section:
    """Return a section whose stiffness, inertia and damping need no other fields."""
    # I_t = m (d^2 + d_i^2)/16 of a slice of a tube.
    diameter = math.hypot(section.diameters[0], section.backbone_inner_diameter)
    unused: dict[str, Any] = {
        **dict.fromkeys(("shear_modulus", "twist_stiffness", "stretch_stiffness")),
        **dict.fromkeys(("twist_damping", "stretch_damping", "material_damping"), 0.0),
    }
    found = replace(
        section,
        backbone_diameter=diameter,
        backbone_inner_diameter=0.0,
        bending_stiffness=None,
        damping=section.damping + section.material_damping * section.stiffness,
        **unused,
    )
    if found.stiffness == section.stiffness:
        return found
    return replace(
        found, youngs_modulus=section.youngs_modulus * section.stiffness / found.stiffness
    )


def _plain(cable: Cable) -> Cable:
    (radius, _), (angle, _) = cable.route(cable.end_section)
    return replace(cable, radius=radius, angle=angle)
