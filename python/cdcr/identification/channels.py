"""What is measured: arrays with names, units and noise, and the refusal of what is no number."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cdcr.base.arrays import FloatArray, numbers
from cdcr.base.check import Check
from cdcr.model.model import Model
from cdcr.robot.robot import Robot

MANY = 2**31 - 1
# Beyond which units are asked: distance between two tips, and of one from the base, in lengths of
# the robot (that of a motion capture may lie elsewhere in the room); time that a motion lasts [s];
# a measured tension over the largest told.
FARTHEST, FARTHEST_FROM_BASE, LONGEST, STRONGEST = 3.0, 50.0, 1e4, 100.0


_TOLD = ("command", "candidates")  # arrays of what cables are told, and never measured


@dataclass(frozen=True, eq=False)
class Channel:
    """One thing measured, a row for each pose or time.

    Attributes
    ----------
    name : str
        Such as "tip", or "marker 1".
    unit : str
    values : (N, k) array
        NaN where nothing was measured and that is allowed.
    noise : float or None
        Standard deviation of one number; None where it is to be found.
    """

    name: str
    unit: str
    values: FloatArray
    noise: float | None = None


Where = Callable[[int, str], str]  # names a row and a column of the data


def row_of(name: str) -> Where:
    """Return what names rows of arrays: they count from 1, as in tables and files."""

    def where(row: int, column: str) -> str:
        return f"{name}, row {row + 1}, {column}"

    return where


def column_name(item: str, k: int) -> str:
    """Name a column: 'tip x', 'marker 1 y', 'base force z', 'cable 2' of commands, 'tension 3'."""
    if item in ("tip", "base_force", "base_moment") or item.startswith("marker"):
        return f"{item.replace('_', ' ')} {'xyz'[k]}"
    return f"{'cable' if item in _TOLD else item} {k + 1}"


def measured(
    item: str, value: object, shape: tuple[int | None, ...], where: Where, *, gaps: bool = False
) -> FloatArray:
    """Return an array of that shape, None for any length, or refuse it by row and column."""
    array = numbers(value, f"{item} must be an array of numbers")
    fits = array.ndim == len(shape) and all(
        want in (None, got) for want, got in zip(shape, array.shape, strict=False)
    )
    if not fits:
        told = ", ".join("any" if one is None else str(one) for one in shape)
        comma = "," if len(shape) == 1 else ""
        raise ValueError(f"{item} must have shape ({told}{comma}), got {array.shape}")
    bad = np.isinf(array) if gaps else ~np.isfinite(array)
    if bad.any():
        at = tuple(int(k) for k in np.argwhere(bad)[0])
        column = column_name(item, at[1]) if len(at) > 1 else item
        got = array[at]
        skip = np.isnan(got) and len(at) > 1 and item not in _TOLD
        hint = "; gaps='skip' leaves out what was not measured" if skip else ""
        raise ValueError(f"{where(at[0], column)} must be a finite number, got {got}{hint}")
    return array


def of_numbers(value: object) -> bool:
    """Whether a value can be an array of plain numbers, none of them missing."""
    try:
        return numbers(value, "it").size > 0
    except ValueError:
        return False


def increasing(t: FloatArray, where: Where) -> None:
    """Refuse times that do not increase."""
    back = np.flatnonzero(np.diff(t) <= 0.0) + 1
    if back.size:
        k = int(back[0])
        raise ValueError(
            f"{where(k, 't')} must be later than the time before, got {t[k]:g} s after "
            f"{t[k - 1]:g} s"
        )


def noise_levels(noise: Mapping[str, float] | float | None, names: Sequence[str]) -> dict[str, Any]:
    """Return the noise of each channel, one for all where one number is given."""
    if noise is None:
        return {}
    levels: Mapping[str, Any]
    levels = noise if isinstance(noise, Mapping) else dict.fromkeys(names, noise)
    for name in levels:
        if name not in names:
            known = ", ".join(names)
            raise ValueError(f"noise: there is no channel {name!r}; measured are {known}")
    check = Check()
    found = {
        name: check.number(f"noise of {name}", level, "a number > 0 and finite", above=0.0)
        for name, level in levels.items()
    }
    check.done()
    return found


def ask_about_times(t: FloatArray, where: Where) -> None:
    """Refuse a motion of many hours: it asks for a unit."""
    lasts = t[-1] - t[0]
    if lasts > LONGEST:
        raise ValueError(
            f"{where(len(t) - 1, 't')} = {t[-1]:g} s: the motion lasts {lasts:g} s, where at most "
            f"{LONGEST:g} s are computed: is it in ms?"
        )


def ask_about_places(values: FloatArray, robot: Robot, where: Where, name: str) -> None:
    """Refuse places that a robot never reaches, whatever the frame: they ask for a unit.

    Raises
    ------
    ValueError
        As a question.
    """
    length = robot.length
    there = np.flatnonzero(np.isfinite(values).all(axis=1))
    if not there.size:
        return
    middle = np.median(values[there], axis=0)
    away = np.linalg.norm(values[there] - middle, axis=1)
    base = np.linalg.norm(middle - np.array(robot.base_position))
    if base > FARTHEST_FROM_BASE * length:
        row, far = int(there[0]), int(np.argmax(np.abs(middle)))
        raise ValueError(
            f"{where(row, column_name(name, far))} = {values[row, far]:g} m, the places are "
            f"{base:g} m from the base, and the robot is {length:g} m long: is it in mm?"
        )
    if away.max() > FARTHEST * length:
        row = int(there[np.argmax(away)])
        far = int(np.argmax(np.abs(values[row] - middle)))
        column = column_name(name, far)
        raise ValueError(
            f"{where(row, column)} = {values[row, far]:g} m is {away.max():g} m from the others, "
            f"and the robot is {length:g} m long: is it in mm?"
        )


def ask_about_cables(channel: Channel, command: FloatArray, robot: Robot, where: Where) -> None:
    """Refuse measured lengths and tensions [mm], [mN] that are taken for [m], [N]: they ask."""
    driven, straight = _straight(robot)
    values = channel.values
    if channel.name == "length":
        odd = np.abs(values) > 3.0 * straight
        beside = [f"where the straight robot takes {one:.4g} m: is it in mm?" for one in straight]
    else:
        told = 0.0 if driven.any() else float(np.max(command, initial=0.0))
        odd = np.abs(values) > STRONGEST * (told or np.inf)
        beside = [f"where at most {told:g} N was told: is it in mN?"] * len(straight)
    for row, j in np.argwhere(odd)[:1]:
        column = column_name(channel.name, j)
        raise ValueError(f"{where(row, column)} = {values[row, j]:g} {channel.unit}, {beside[j]}")


def ask_about_shapes(values: FloatArray, robot: Robot, where: Where) -> None:
    """Refuse bending vectors beyond what the model allows: they ask for a unit."""
    bends = np.array([name.startswith("q") for name in Model(robot).coordinate_names])
    for row, k in np.argwhere((np.abs(values) > 3.0 * np.pi) & bends)[:1]:
        raise ValueError(
            f"{where(row, column_name('q', k))} = {values[row, k]:g} rad, and no section bends "
            "beyond 3 pi rad: is it in deg?"
        )


def _straight(robot: Robot) -> tuple[NDArray[np.bool_], FloatArray]:
    """Return which cables are driven by length, and the lengths of all in the straight robot."""
    model = Model(robot)
    driven = np.array([cable.length_driven for cable in robot.all_cables], dtype=bool)
    return driven, model.cable_lengths(np.zeros(model.num_coordinates))


def check_commands(
    command: FloatArray, robot: Robot, where: Where, name: str, *, pulled: bool
) -> None:
    """Refuse commands (N, num_cables) that do not fit a robot.

    Lengths that are tensions or millimetres are asked about, by what the robot takes.
    """
    if command.shape[1] != robot.num_cables:
        raise ValueError(
            f"{name}: command must have shape ({len(command)}, {robot.num_cables}), got "
            f"{command.shape}"
        )
    driven, lengths = _straight(robot)
    straight = np.where(driven, lengths, np.inf)
    odd = np.abs(command) > (1.0 if pulled else 3.0) * straight
    if not pulled:
        odd |= driven & (command >= 0.0) & (command < straight / 10.0)
    for row, j in np.argwhere(odd)[:1]:
        what = "pulled by" if pulled else "told"
        raise ValueError(
            f"{where(row, column_name('command', j))} is {what} {command[row, j]:g} m, where the "
            f"straight robot takes {straight[j]:.4g} m: is it in mm, a tension [N], or a pull?"
        )
    for row, j in np.argwhere((command < 0.0) & ~(driven & pulled))[:1]:
        hint = "; of cables driven by length, pulls may be negative (pulled=True)"
        raise ValueError(
            f"{where(row, column_name('command', j))} must be >= 0 (a cable cannot push), got "
            f"{command[row, j]:g}{hint if driven[j] else ''}"
        )


def whole(item: str, value: object, low: int, high: int | None = None) -> int:
    """Return a whole number in a range, or refuse it."""
    check = Check()
    allowed = f">= {low}" if high is None else f"from {low} to {high}"
    found = check.whole(item, value, f"a whole number {allowed}", low, high or MANY)
    check.done()
    return found
