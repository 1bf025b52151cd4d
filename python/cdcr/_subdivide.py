"""One section cut into several: robots nearer to a beam, and the way of states there and back."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from numbers import Integral
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core
from cdcr._coordinates import _finite
from cdcr._fields import Check
from cdcr._robot import Robot, Section

FloatArray = NDArray[np.float64]
Parts = int | Sequence[int] | NDArray[np.integer[Any]]

# A disk this near to a border sits on it: fractions of a part, where rounding reaches 1e-14.
_ON_BORDER = Fraction(1, 10**12)


def subdivide(robot: Robot, parts: Parts) -> Robot:
    """Return the robot with its sections cut into parts; see Robot.subdivide."""
    counts = _counts(robot, parts)
    sections: list[Section] = []
    last_parts = []
    for section, count in zip(robot.sections, counts, strict=True):
        sections += _parts(section, count)
        last_parts.append(len(sections) - 1)
    cables = [replace(c, end_section=last_parts[c.end_section]) for c in robot.cables]
    return replace(robot, sections=tuple(sections), cables=tuple(cables))


def _parts(section: Section, count: int) -> list[Section]:
    """Return the parts of a section; its cables end on the last one."""
    if count == 1:
        return [section]
    disks = _disks_of_parts(section, count)
    last = replace(
        section,
        length=section.length / count,
        backbone_mass=section.backbone_mass / count,
        # A uniform bend shares its rate among the parts: count * c' (qd/count)^2 = c qd^2.
        damping=section.damping * count,
        **disks[-1],
    )
    without_cables = replace(
        last, cable_radius=0.0, cable_angles=(), cable_stiffness=0.0, cable_damping=0.0
    )
    return [replace(without_cables, **fields) for fields in disks[:-1]] + [last]


def _disks_of_parts(section: Section, count: int) -> list[dict[str, Any]]:
    """Return the fields of the disks of each part."""
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
    equal = [Fraction(k, number) for k in range(1, number + 1)]
    positions = () if [place for _, place in held] == equal else [float(x) for _, x in held]
    return {
        "num_disks": number,
        "disk_positions": positions,
        "disk_masses": [section.disk_masses[k] for k, _ in held] if section.disk_masses else (),
        "disk_diameters": (
            [section.disk_diameters[k] for k, _ in held] if section.disk_diameters else ()
        ),
    }


def subdivide_state(robot: Robot, parts: Parts, q: ArrayLike) -> FloatArray:
    """Return the state of a subdivided robot that has the shape of the whole one.

    Parameters
    ----------
    robot : Robot
        The robot of n sections, not yet subdivided.
    parts : int or sequence of int
        As in ``robot.subdivide``, m parts together.
    q : (..., 2n) array_like
        Bending vectors [rad]; or their rates.

    Returns
    -------
    (..., 2m) array
        Every part bent by its share of its section, in the unit of `q`.

    Raises
    ------
    ValueError
        For a wrong shape, values that are not finite, or wrong `parts`.

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.amouri2020()
    >>> print(cdcr.subdivide_state(robot, 2, [0.6, 0.2]))
    [0.3 0.1 0.3 0.1]
    """
    counts = np.array(_counts(robot, parts))
    vectors = _bending_vectors(q, len(counts))
    shares = np.repeat(vectors / counts[:, None], counts, axis=-2)
    return shares.reshape(*shares.shape[:-2], 2 * int(counts.sum()))


def merge_state(robot: Robot, parts: Parts, q: ArrayLike) -> FloatArray:
    """Return the state of the whole robot whose sections bend as much as their parts together.

    Exact where the parts of a section are bent alike, and the inverse of ``subdivide_state`` then.

    Parameters
    ----------
    robot : Robot
        The robot of n sections, not yet subdivided.
    parts : int or sequence of int
        As in ``robot.subdivide``, m parts together.
    q : (..., 2m) array_like
        Bending vectors of the subdivided robot [rad]; or their rates.

    Returns
    -------
    (..., 2n) array
        Bending vectors of the sections, in the unit of `q`.

    Raises
    ------
    ValueError
        For a wrong shape, values that are not finite, or wrong `parts`.

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.amouri2020()
    >>> print(cdcr.merge_state(robot, 2, [0.25, 0.0, 0.25, 0.0]))
    [0.5 0. ]
    """
    counts = np.array(_counts(robot, parts))
    vectors = _bending_vectors(q, int(counts.sum()))
    firsts = np.cumsum(counts) - counts
    sums = np.add.reduceat(vectors, firsts, axis=-2)
    return sums.reshape(*sums.shape[:-2], 2 * len(counts))


def _counts(robot: Robot, parts: Parts) -> list[int]:
    """Return the number of parts of each section, or refuse them."""
    if not isinstance(robot, Robot):
        raise TypeError(f"robot must be a cdcr.Robot, got {type(robot).__name__}")
    n = len(robot.sections)
    one = f"a whole number 1 to {_core.max_sections}"
    wanted = f"{one}, or one for each of {n} section{'s' if n > 1 else ''}"
    check = Check()
    if isinstance(parts, Integral):
        counts = [check.whole("parts", parts, wanted, 1, _core.max_sections)] * n
    else:
        counts = [
            check.whole(f"parts[{i}]", count, one, 1, _core.max_sections)
            for i, count in enumerate(check.items("parts", parts, wanted))
        ]
    if not check.sentences and len(counts) != n:
        check.refuse("parts", wanted, parts)
    if not check.sentences and sum(counts) > _core.max_sections:
        total = " + ".join(map(str, counts)) + f" = {sum(counts)}" if n > 1 else str(sum(counts))
        check.sentences.append(
            f"parts must give a robot of at most {_core.max_sections} sections, got {total}"
        )
    check.done()
    return counts


def _bending_vectors(q: ArrayLike, count: int) -> FloatArray:
    """Return q (..., 2 count) as (..., count, 2), or refuse it."""
    array = _finite(q, "q")
    if array.ndim == 0 or array.shape[-1] != 2 * count:
        raise ValueError(f"q must have shape (..., {2 * count}), got {array.shape}")
    return array.reshape(*array.shape[:-1], count, 2)
