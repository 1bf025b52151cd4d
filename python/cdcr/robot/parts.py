"""One section cut into several, and its cables with it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import accumulate, pairwise
from numbers import Integral
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cdcr import _core
from cdcr.base.check import Check, count
from cdcr.robot.cable import Cable, Pairs
from cdcr.robot.section import Section

if TYPE_CHECKING:
    from fractions import Fraction

Parts = int | Sequence[int] | NDArray[np.integer[Any]]

# A disk this near to a border sits on it: a share of a part, where rounding reaches 1e-14.
_ON_BORDER = 1e-12


def part_counts(n: int, parts: Parts) -> list[int]:
    """Return the number of parts of each of n sections, or refuse them."""
    one = f"a whole number 1 to {_core.max_sections}"
    requirement = f"{one}, or one for each of {count(n, 'section')}"
    check = Check()
    if isinstance(parts, Integral):
        counts = [check.whole("parts", parts, requirement, 1, _core.max_sections)] * n
    else:
        counts = [
            check.whole(f"parts[{i}]", number, one, 1, _core.max_sections)
            for i, number in enumerate(check.items("parts", parts, requirement))
        ]
    if not check.sentences and len(counts) != n:
        check.refuse("parts", requirement, parts)
    if not check.sentences and sum(counts) > _core.max_sections:
        total = " + ".join(map(str, counts)) + f" = {sum(counts)}" if n > 1 else str(sum(counts))
        check.sentences.append(
            f"parts must give a robot of at most {_core.max_sections} sections, got {total}"
        )
    check.done()
    return counts


def parts_of(section: Section, count: int) -> list[Section]:
    """Return the parts of a section; its cables end on the last one."""
    if count == 1:
        return [section]
    x, y = section.rest_bending
    even = replace(
        section,
        length=section.length / count,
        backbone_mass=section.backbone_mass / count,
        # A uniform strain shares its rate among the parts: count * c' (qd/count)^2 = c qd^2.
        damping=section.damping * count,
        twist_damping=section.twist_damping * count,
        stretch_damping=section.stretch_damping * count,
        rest_bending=(x / count, y / count),
        rest_twist=section.rest_twist / count,
    )
    own: list[dict[str, Any]] = [
        disks | backbone
        for disks, backbone in zip(
            _disks_of_parts(section, count), _backbones(section, count), strict=True
        )
    ]
    without_cables: dict[str, Any] = {
        "cable_radius": 0.0,
        "cable_angles": (),
        "cable_stiffness": 0.0,
        "cable_damping": 0.0,
        "cable_entry_friction": 0.0,
        "cable_sheath_friction": 0.0,
        "cable_viscosity": 0.0,
        "cable_pretension": 0.0,
        "cable_backlash": 0.0,
    }
    return [*(replace(even, **one, **without_cables) for one in own[:-1]), replace(even, **own[-1])]


def cable_of_parts(cable: Cable, counts: Sequence[int]) -> Cable:
    """Return a cable as it runs through the parts of sections, of which there are so many each."""
    ends = [0, *accumulate(counts)]
    passed = counts[cable.start_section : cable.end_section + 1]

    def along(value: float | Pairs) -> float | Pairs:
        if isinstance(value, float):
            return value
        return tuple(
            pair for ends, n in zip(value, passed, strict=True) for pair in _between(ends, n)
        )

    return replace(
        cable,
        radius=along(cable.radius),
        angle=along(cable.angle),
        start_section=ends[cable.start_section],
        end_section=ends[cable.end_section + 1] - 1,
    )


def _between(ends: tuple[float, float], count: int) -> list[tuple[float, float]]:
    """Return the (base, tip) pairs of equal parts of what changes evenly between two ends."""
    base, tip = ends
    values = [base + (tip - base) * k / count for k in range(count)] + [tip]
    return list(pairwise(values))


def _backbones(section: Section, count: int) -> list[dict[str, Any]]:
    """Return the diameters of the parts of a taper, and its mass in proportion to the volume."""
    base, tip = section.diameters
    if base == tip:
        return [{}] * count
    ends = _between((base, tip), count)
    inner = section.backbone_inner_diameter
    volumes = [(a * a + a * b + b * b) / 3.0 - inner * inner for a, b in ends]
    return [
        {"backbone_diameter": pair, "backbone_mass": section.backbone_mass * volume / sum(volumes)}
        for pair, volume in zip(ends, volumes, strict=True)
    ]


def _disks_of_parts(section: Section, count: int) -> list[dict[str, Any]]:
    """Return the fields of the disks of each part."""
    from fractions import Fraction

    number = section.num_disks
    places = [Fraction(x) for x in section.disk_positions] or [
        Fraction(k, number) for k in range(1, number + 1)
    ]
    at: list[list[tuple[int, Fraction]]] = [[] for _ in range(count)]  # disk and place in the part
    for disk, place in enumerate(places):
        along = place * count
        if abs(along - round(along)) <= _ON_BORDER:
            along = Fraction(round(along))
        part = max(math.ceil(along) - 1, 0)  # on a border it belongs to the part that ends there
        at[part].append((disk, along - part))
    return [_disk_fields(section, held) for held in at]


def _disk_fields(section: Section, held: list[tuple[int, Fraction]]) -> dict[str, Any]:
    """Return the fields of disks held at places of a part, plainly where equally spaced."""
    number = len(held)
    equal = [place * number for _, place in held] == list(range(1, number + 1))
    positions = () if equal else [float(place) for _, place in held]
    return {
        "num_disks": number,
        "disk_positions": positions,
        "disk_masses": [section.disk_masses[k] for k, _ in held] if section.disk_masses else (),
        "disk_diameters": (
            [section.disk_diameters[k] for k, _ in held] if section.disk_diameters else ()
        ),
    }
