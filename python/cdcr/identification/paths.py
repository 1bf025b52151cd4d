"""Parameters by path: which numbers of a laboratory they are, as one or as several unknowns."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields
from typing import Any

from cdcr.base.check import entry, nearest, short
from cdcr.identification.setup import MOUNTING, Plain
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

Slot = tuple[str | int, ...]  # the way to a number through lists and tables

_PATH = re.compile(r"(scale )?(\w+)(?:\[([\d*:]+)\])?(?:\.(\w+)((?:\[[\d*:]+\]){0,2}))?")
_AXES = "xyz"
# Numbers that words name, with their unit; those of three axes or two are one each.
_WORDS: dict[str, tuple[tuple[Slot, ...], str]] = {
    "base tilt": ((("base_tilt", 0), ("base_tilt", 1)), "rad"),
    "base yaw": ((("base_yaw",),), "rad"),
    "base position": (tuple(("base_position", k) for k in range(3)), "m"),
    "tip offset": (tuple(("tool", k, 3) for k in range(3)), "m"),
    "time shift": ((("time_shift",),), "s"),
}
# What all cables of a section share, and no field says: the list of numbers, and the unit.
_SHARED = {
    "cable_rotation": "rad",
    "command_offset": "N or m",
    "command_gain": "",
}
# What has so many numbers that words name what can be sought of them.
_WHOLES = {
    "tool": "; 'tip offset' can",
    "base_orientation": "; 'base tilt' and 'base yaw' can",
    "payload_inertia": "",
}
_NO_NUMBERS = ("sections", "cables", *MOUNTING, "places", "marker_offset")
_OF_CABLES = (
    "radius", "stiffness", "damping", "friction", "entry_friction", "sheath_friction", "viscosity",
    "pretension", "backlash",
)  # fmt: skip


@dataclass(frozen=True)
class Quantity:
    """One unknown number, and every place in a laboratory where it stands.

    Attributes
    ----------
    path : str
        As the user gave it.
    name : str
        What tables call it; sections and cables count from 1.
    unit : str
    slots : tuple
        Where it stands.
    start, low, high : float
        Where the search begins, and what the model allows.
    typical : float
        A size of it that matters.
    relative : str
        "" for a number that stands there itself, "scale" for one that multiplies what stands there,
        "shift" for one that is added to it.
    """

    path: str
    name: str
    unit: str
    slots: tuple[Slot, ...]
    start: float
    low: float
    high: float
    typical: float
    relative: str = ""

    def put(self, plain: Plain, value: float) -> None:
        """Set every place where the number stands."""
        for slot in self.slots:
            home: Any = plain
            for step in slot[:-1]:
                home = home[step]
            if self.relative:
                value_there = home[slot[-1]]
                home[slot[-1]] = (
                    value_there * value if self.relative == "scale" else value_there + value
                )
            else:
                home[slot[-1]] = value


def quantities_of(path: str, robot: Robot, plain: Plain, first: int = 0) -> list[Quantity]:
    """Return the unknowns that a path names.

    ``[2]`` picks one, ``[*]`` all as one unknown, ``[:]`` all as one each. Sections and cables
    count from `first`: 0 in code, 1 in files.

    Raises
    ------
    ValueError
        For a path that names no number of this robot.
    """
    if not isinstance(path, str):
        raise ValueError(f"a parameter must be named by a path, got {short(path)}")
    words = re.fullmatch(r"(.+?)(?: ([xyz]))?", path.strip())
    if words is None:
        raise ValueError(_unknown(path, robot))
    if path in _WORDS or words[1] in _WORDS:
        return list(_by_words(path, *words.groups(), robot=robot, plain=plain))
    if marker := re.fullmatch(r"marker (?:(\d+) )?offset(?: ([xyz]))?", path):
        return list(_of_marker(path, marker, robot, plain, first))
    found = _PATH.fullmatch(path)
    if found is None:
        raise ValueError(_unknown(path, robot))
    scale, home, pick, field, inner = found.groups()
    groups = _slots(path, robot, plain, first, (home, pick, field, inner))
    return [_quantity(path, name, slots, robot, plain, bool(scale)) for name, slots in groups]


def _by_words(
    path: str, word: str, axis: str | None, *, robot: Robot, plain: Plain
) -> Iterator[Quantity]:
    slots, unit = _WORDS[path] if path in _WORDS else _WORDS[word]
    letters = _AXES[: len(slots)]
    if axis is not None and axis not in letters[: len(slots) if len(slots) > 1 else 0]:
        raise ValueError(f"parameter {path!r}: there is no axis {axis} of {word}")
    for letter, slot in zip(letters, slots, strict=True):
        if axis in (None, letter):
            name = f"{word} {letter}" if len(slots) > 1 else word
            size = {"rad": 0.1, "m": 0.02 * robot.length, "s": 0.01}[unit]
            start = _get(plain, slot)
            yield Quantity(path, name, unit, (slot,), start, -math.inf, math.inf, size)


def _of_marker(
    path: str, found: re.Match[str], robot: Robot, plain: Plain, first: int
) -> Iterator[Quantity]:
    count = len(plain["marker_offset"])
    number = int(found[1]) - first if found[1] else None
    if not count or (number is not None and not 0 <= number < count):
        raise ValueError(f"parameter {path!r}: the data have {count or 'no'} markers")
    for k in range(3):
        if found[2] not in (None, _AXES[k]):
            continue
        chosen = range(count) if number is None else (number,)
        slots = tuple(("marker_offset", i, k) for i in chosen)
        which = "" if number is None else f" {number + 1}"
        name, size = f"marker{which} offset {_AXES[k]}", 0.02 * robot.length
        yield Quantity(path, name, "m", slots, 0.0, -math.inf, math.inf, size)


Groups = list[tuple[str, tuple[Slot, ...]]]


def _slots(
    path: str, robot: Robot, plain: Plain, first: int, parts: Sequence[str | None]
) -> Groups:
    """Return name and places of each unknown of a path."""
    home, pick, field, inner = parts
    if home == "cables" and pick is None and field in _OF_CABLES:
        every = [("sections", i, f"cable_{field}") for i, one in enumerate(robot.sections)
                 if one.cable_angles]  # fmt: skip
        every += [("cables", j, field) for j in range(len(robot.cables))]
        for j, cable in enumerate(plain["cables"]):
            if _sizes(cable[field]):
                raise ValueError(
                    f"parameter {path!r}: {field} of cable {j + 1} of cables has several numbers, "
                    f"pick one: cables[{first + j}].{field}[{first}][{first}]"
                )
        return [(f"cables: {field}", tuple(every))]
    if home in ("sections", "cables") and field is not None and pick is not None:
        things = plain[home]
        groups: Groups = []
        for i, chosen in _picked(path, pick, len(things), first):
            who = f"all {home}" if i is None else entry(home, i)
            groups += _of_things(path, robot, plain, home, who, chosen, field, inner, first)
        return groups
    if field is None and home in _WHOLES:
        raise ValueError(
            f"parameter {path!r}: {home} is no number that can be sought{_WHOLES[home]}"
        )
    if field is None and home in plain and home not in _NO_NUMBERS:
        if isinstance(plain[home], list):
            if pick is None:
                raise ValueError(
                    f"parameter {path!r}: {home} has several numbers, pick one: {home}[{first}]"
                )
            return [
                (home if i is None else f"{home} {i + 1}", tuple((home, k) for k in chosen))
                for i, chosen in _picked(path, pick, len(plain[home]), first)
            ]
        return [(home, ((home,),))]
    raise ValueError(_unknown(path, robot))


def _of_things(
    path: str,
    robot: Robot,
    plain: Plain,
    home: str,
    who: str,
    chosen: tuple[int, ...],
    field: str,
    inner: str | None,
    first: int,
) -> Groups:
    """Return the unknowns of one field of chosen sections or cables."""
    if home == "sections" and field in _SHARED:
        return [(f"{who}: {field}", tuple(_shared(robot, chosen, field)))]
    things = [plain[home][i] for i in chosen]
    if not things or field not in things[0]:
        raise ValueError(_unknown(path, robot))
    picks = re.findall(r"\[([\d*:]+)\]", inner or "")
    values = [thing[field] for thing in things]
    shapes = {_sizes(value) for value in values}
    if len(shapes) > 1:
        raise ValueError(f"parameter {path!r}: {home} have differing numbers of {field}")
    sizes = shapes.pop()
    if len(picks) < len(sizes):
        more = "".join(f"[{first}]" for _ in sizes[len(picks) :])
        raise ValueError(f"parameter {path!r}: {field} has several numbers, pick one: {more}")
    if len(picks) > len(sizes) or isinstance(values[0], bool | int | str):
        raise ValueError(f"parameter {path!r}: {field} is no number that can be sought")
    if any(value is None for value in values):
        raise ValueError(f"parameter {path!r}: {field} has no value to begin with, give it one")
    groups: Groups = [(f"{who}: {field}", tuple((home, i, field) for i in chosen))]
    for pick, size in zip(picks, sizes, strict=True):
        groups = [
            (name if k is None else f"{name} {k + 1}",
             tuple((*slot, one) for slot in slots for one in inside))
            for name, slots in groups
            for k, inside in _picked(path, pick, size, first)
        ]  # fmt: skip
    return groups


def _sizes(value: Any) -> tuple[int, ...]:
    """Return how many numbers a field has: none of a number, one of a list, two of pairs."""
    if not isinstance(value, list):
        return ()
    return (len(value), *(_sizes(value[0]) if value else ()))


def _shared(robot: Robot, chosen: tuple[int, ...], field: str) -> Iterator[Slot]:
    j = 0
    for i, section in enumerate(robot.sections):
        for k in range(len(section.cable_angles)):
            if i in chosen:
                yield (
                    ("sections", i, "cable_angles", k) if field == "cable_rotation" else (field, j)
                )
            j += 1


def _picked(
    path: str, pick: str, count: int, first: int
) -> list[tuple[int | None, tuple[int, ...]]]:
    """Return the indices from 0 that each unknown stands for, and which it is, None for all."""
    if pick == "*":
        return [(None if count > 1 else 0, tuple(range(count)))]
    if pick == ":":
        return [(i, (i,)) for i in range(count)]
    if not pick.isdigit() or not 0 <= int(pick) - first < count:
        last = first + count - 1
        span = f"one of {first} to {last}" if count > 1 else f"{first}"
        allowed = f"{span}, * or :" if count else "one of none, as there are no such things"
        raise ValueError(f"parameter {path!r}: [{pick}] must be {allowed}")
    return [(int(pick) - first, (int(pick) - first,))]


def _quantity(
    path: str, name: str, slots: tuple[Slot, ...], robot: Robot, plain: Plain, scale: bool
) -> Quantity:
    """Return an unknown with its start, its unit and its range."""
    if not slots:
        raise ValueError(f"parameter {path!r}: there is no such number on this robot")
    low, unit = _range(str(slots[0][2] if slots[0][0] in ("sections", "cables") else slots[0][0]),
                       str(slots[0][0]))  # fmt: skip
    if scale:
        return Quantity(path, f"scale of {name}", "", slots, 1.0, 1e-6, math.inf, 0.1, "scale")
    if "cable_rotation" in path:
        return Quantity(path, name, "rad", slots, 0.0, -math.inf, math.inf, 0.1, "shift")
    values = {_get(plain, slot) for slot in slots}
    if len(values) > 1:
        each = path.replace("[*]", "[:]", 1)
        raise ValueError(
            f"parameter {path!r} is one number for what has several: "
            f"{', '.join(f'{value:g}' for value in sorted(values))}; "
            f"seek {each!r}, one each, or 'scale {path}', a common factor"
        )
    start = values.pop()
    size = abs(start) or _typical(unit, robot)
    return Quantity(path, name, unit, slots, start, low, math.inf, size)


def _range(field: str, home: str) -> tuple[float, str]:
    """Return the least value of a field and its unit."""
    if field in _SHARED:
        return -math.inf, _SHARED[field]
    kind: type[Any] = {"sections": Section, "cables": Cable}.get(home, Robot)
    about = {item.name: item.metadata for item in fields(kind)}[field]
    requirement = f"{about['requirement']} {about['each']}"
    if "number > 0" in requirement:
        return 0.0, about["unit"]
    bounded = "number >= 0" in requirement or "0 to 1" in requirement
    return (0.0 if bounded else -math.inf), about["unit"]


def _typical(unit: str, robot: Robot) -> float:
    """Return a size that matters of a number that begins at zero."""
    stiffness = min(section.stiffness for section in robot.sections)
    driven = any(cable.length_driven for cable in robot.all_cables)
    return {
        "rad": 0.1,
        "m": 0.02 * robot.length,
        "N or m": 0.002 * robot.length if driven else 0.1,
        "kg": 0.05 * robot.mass or 0.01,
        "N m s/rad": 0.02 * stiffness,
        "N": 0.5,
        "N/m": 1e3,
        "N s/m": 1.0,
        "m/s": 1e-3,
        "m/s^2": 1.0,
        "s": 0.01,
    }.get(unit, 0.1)


def _get(plain: Plain, slot: Slot) -> float:
    value: Any = plain
    for step in slot:
        value = value[step]
    return float(value)


def _unknown(path: str, robot: Robot) -> str:
    known = [f"sections[*].{item.name}" for item in fields(Section)]
    known += [f"sections[*].{name}" for name in _SHARED]
    known += [f"cables.{name}" for name in _OF_CABLES]
    known += [*_WORDS, "marker offset", "payload", "command_offset[*]", "command_gain[*]"]
    known += ["gravity[0]", "base_position[0]", "payload_position[0]", "sliding_speed"]
    return f"there is no parameter {path!r}.{nearest(path, known)}"
