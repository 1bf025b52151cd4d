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


def length_errors(table: Mapping[str, Any], num_sections: int, at: str) -> list[str]:
    """Return a sentence for each array that is not a number for each section, or two."""
    found = []
    for key, value in table.items():
        length = num_sections * (2 if key in ("q", "qd") else 1)
        if len(value) != length or any(isinstance(one, list) for one in value):
            found.append(
                f"{at}.{key} must have {count(length, 'number')} for a robot with "
                f"{count(num_sections, 'section')}, got {format_toml(value)}"
            )
    return found


def bending_vector(table: Mapping[str, Any], num_sections: int, at: str) -> tuple[float, ...]:
    """Return the bending vectors (2n,) [rad] of a table with q, or theta and phi, or refuse it."""
    q = _bending_vector(table, num_sections)
    for i in range(num_sections):
        angle = math.hypot(*q[2 * i : 2 * i + 2])
        if angle > max_bending:
            key = next(name for name in ("q", "theta", "theta_deg") if name in table)
            raise ValueError(
                f"{at}.{key} must bend each section by at most 3 pi rad, 540 deg, got "
                f"{angle:.6g} rad, {math.degrees(angle):.6g} deg, in section {i + 1}"
            )
    return q


def _bending_vector(table: Mapping[str, Any], num_sections: int) -> tuple[float, ...]:
    if "q" in table:
        return tuple(map(float, table["q"]))
    straight = [0.0] * num_sections
    theta = table.get("theta", np.deg2rad(table.get("theta_deg", straight)))
    phi = table.get("phi", np.deg2rad(table.get("phi_deg", straight)))
    return tuple(bending(theta, phi).tolist())


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
