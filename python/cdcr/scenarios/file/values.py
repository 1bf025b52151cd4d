"""What the tables of scenario files share: counts, bending vectors, angles per section."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from cdcr._core import max_bending
from cdcr.base.arrays import FloatArray
from cdcr.base.check import count
from cdcr.files.toml import format_toml, refuse
from cdcr.model.coordinates import bending
from cdcr.model.model import Model

_ANGLES = ("theta", "theta_deg", "phi", "phi_deg")
RIVALS = (("theta", "theta_deg"), ("phi", "phi_deg"), *(("q", angle) for angle in _ANGLES))


@contextmanager
def error_prefix(where: str) -> Iterator[None]:
    """Begin each line of what is refused inside with where it stands."""
    try:
        yield
    except ValueError as error:
        refuse(where, str(error).split("\n"))


def rival_errors(table: Mapping[str, Any], at: str) -> list[str]:
    """Return a sentence for each two keys of a table that say the same."""
    return [
        f"{at} must have {one} or {other}, not both"
        for one, other in RIVALS
        if one in table and other in table
    ]


def length_errors(table: Mapping[str, Any], model: Model, at: str) -> list[str]:
    """Return a sentence for each array that is not a number for each section, or coordinate."""
    found = []
    for key, value in table.items():
        length, robot = numbers_of(key, model)
        if len(value) != length or any(isinstance(one, list) for one in value):
            found.append(
                f"{at}.{key} must have {count(length, 'number')} for a robot with {robot}, "
                f"got {format_toml(value)}"
            )
    return found


def numbers_of(key: str, model: Model) -> tuple[int, str]:
    """Return how many numbers a key takes, and the robot that they are for in words."""
    sections = count(model.num_sections, "section")
    if key not in ("q", "qd"):
        return model.num_sections, sections
    names = f" and coordinates {', '.join(model.coordinate_names)}" if model.has_rods else ""
    return model.num_coordinates, f"{sections}{names}"


def coordinates(table: Mapping[str, Any], model: Model, at: str) -> tuple[float, ...]:
    """Return the coordinates (d,) of a table with q, or theta and phi, or refuse it.

    theta and phi are those of the first bending vector of each section; all else is zero then.
    """
    try:
        q = np.array(table["q"]) if "q" in table else model.coordinates(_bent(table, model))
    except ValueError as error:
        raise ValueError(f"{at}: {error}") from None
    for i, angle in enumerate(model.polar(q)[0].tolist()):
        if angle > max_bending:
            key = next(name for name in ("q", "theta", "theta_deg") if name in table)
            raise ValueError(
                f"{at}.{key} must bend each section by at most 3 pi rad, 540 deg, got "
                f"{angle:.6g} rad, {math.degrees(angle):.6g} deg, in section {i + 1}"
            )
    return tuple(map(float, q))


def _bent(table: Mapping[str, Any], model: Model) -> FloatArray:
    straight = [0.0] * model.num_sections
    theta = table.get("theta", np.deg2rad(table.get("theta_deg", straight)))
    phi = table.get("phi", np.deg2rad(table.get("phi_deg", straight)))
    return bending(theta, phi)


def refuse_function(model: Model, instead: str) -> None:
    """Refuse commands as a function of time for drives with backlash, and say what to write."""
    for j, cable in enumerate(model.robot.all_cables):
        if cable.backlash > 0.0:
            raise ValueError(
                "a drive with backlash takes tables and constants, whose turns are known, and no "
                f"function of time; cable {j + 1} has {cable.backlash:g} m: {instead}"
            )


def of_sections(
    table: Mapping[str, Any], key: str, num_sections: int, at: str, default: float | None = None
) -> FloatArray:
    """Return a value of every section (n,), from a number for all or an array.

    `key` may be given in degrees as well, with ``_deg`` at its end; without a default it must be
    given.
    """
    given = [name for name in (key, f"{key}_deg") if name in table]
    if len(given) == 2:
        raise ValueError(f"{at} must have {key} or {key}_deg, not both")
    if not given and default is None:
        raise ValueError(f"{at} must have {key} or {key}_deg")
    value = table[given[0]] if given else default
    values = np.atleast_1d(np.asarray(value, dtype=np.float64))
    if isinstance(value, list) and len(value) != num_sections:
        raise ValueError(
            f"{at}.{given[0]} must be a number, or an array with {count(num_sections, 'number')}, "
            f"got {format_toml(value)}"
        )
    if given and given[0].endswith("_deg"):
        values = np.deg2rad(values)
    return np.broadcast_to(values, num_sections)
