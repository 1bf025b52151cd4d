"""What ``cdcr info`` prints."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import Field, fields
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table
from rich.text import Text

from cdcr.cli.tables import new_table
from cdcr.model.rest import Rest, at_rest
from cdcr.model.statics import ConvergenceError
from cdcr.robot.cable import Cable
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section

_LABELS = {"youngs_modulus": "Young's modulus", "num_disks": "disks"}
# Told by the table of cables.
_OF_CABLES = ("cable_radius", "cable_angles", "cable_stiffness", "cable_damping", "cable_friction")
_MORE = ("entry_friction", "sheath_friction", "viscosity", "pretension", "backlash")
_MAX_MODES = 8  # rows, slowest first
_SAME = 1e-6  # relative; two modes closer than this are shown as one


def print_robot(console: Console, name: str, robot: Robot) -> None:
    """Print what a robot is made of, and how it is at rest."""
    console.print(_sections(robot))
    rest: Rest | None = None
    try:
        rest = at_rest(robot)
        how = f"at rest without tension: {rest.words}"
    except ConvergenceError as error:
        how = str(error)
    if robot.num_cables:
        console.print(_cables(robot, rest))
        for line in (*_drives(robot), *_rubbing(robot)):
            console.print(Text(f"cables {line}\n"))
    console.print(_masses(robot))
    if rest is not None:
        console.print(_modes(rest))
    console.print(_whole(robot, rest))
    console.print(Text(f"{name}, {how}"), soft_wrap=True)


def _sections(robot: Robot) -> Table:
    numbers = [str(i + 1) for i in range(len(robot.sections))]
    table = new_table("Sections, base to tip", "", *numbers)
    for item in fields(Section):
        values = [getattr(section, item.name) for section in robot.sections]
        if item.metadata["advanced"] and all(value == item.default for value in values):
            continue
        if item.name not in _OF_CABLES:
            label = _LABELS.get(item.name, item.name.replace("_", " "))
            texts = [_field_text(item, value) for value in values]
            _add_row(table, label, item.metadata["unit"], texts)
    stiffness = [_text(section.stiffness) for section in robot.sections]
    _add_row(table, "bending stiffness E I / l", "N m/rad", stiffness)
    return table


def _cables(robot: Robot, rest: Rest | None) -> Table:
    """Tell how each cable runs and is driven, and how far the tip goes for a pull on it."""
    cables = robot.all_cables
    by_length = any(cable.length_driven for cable in cables)
    by_tension = not all(cable.length_driven for cable in cables)
    columns = ["on section", "radius [m]", "angle [deg]", "drive", "friction"]
    if rest is not None and rest.is_nondegenerate:
        columns += ["tip [mm/N]"] * by_tension + ["tip [mm/mm]"] * by_length
        motions = rest.tip_motion
    else:
        by_tension = by_length = False
        motions = np.zeros(len(cables))
    table = new_table("Cables, in the order of the commands", "", *columns)
    for j, (cable, motion) in enumerate(zip(cables, motions, strict=True)):
        row = [_passed(cable), _along(cable, 0), _along(cable, 1)]
        row.append("length" if cable.length_driven else "tension")
        row.append(_friction(robot, cable))
        if by_tension:
            row.append("" if cable.length_driven else f"{1e3 * motion:.4g}")
        if by_length:
            wound = f"{motion:.4g}" if motion else "slack"
            row.append(wound if cable.length_driven else "")
        table.add_row(f"cable {j + 1}", *row)
    return table


def _passed(cable: Cable) -> str:
    """Return the section where it ends, after the one at whose base it begins if not the first."""
    first, last = cable.start_section + 1, cable.end_section + 1
    return f"{last}" if first == 1 else f"{first} to {last}"


def _along(cable: Cable, which: int) -> str:
    """Return its radius [m] or angle [deg], or both ends of it in each section passed."""
    passed = range(cable.start_section, cable.end_section + 1)
    found = [_ends(cable.route(section)[which], which) for section in passed]
    return found[0] if len(set(found)) == 1 else "\n".join(found)


def _ends(pair: tuple[float, float], which: int) -> str:
    base, tip = (f"{math.degrees(x):.4g}" if which else _text(x) for x in pair)
    return base if base == tip else f"{base}→{tip}"


def _drives(robot: Robot) -> Iterator[str]:
    """Yield a line for all cables driven by length with one stiffness and damping."""
    groups: dict[tuple[float, float], list[str]] = {}
    for j, cable in enumerate(robot.all_cables):
        if cable.length_driven:
            groups.setdefault((cable.stiffness, cable.damping), []).append(str(j + 1))
    for (stiffness, damping), names in groups.items():
        yield f"driven by length, {stiffness:g} N/m, {damping:g} N s/m: {', '.join(names)}"


def _rubbing(robot: Robot) -> Iterator[str]:
    """Yield a line for all cables with the same of what else a cable may have, if it has any."""
    groups: dict[str, list[str]] = {}
    for j, cable in enumerate(robot.all_cables):
        told = ", ".join(
            f"{item.name.replace('_', ' ')} {getattr(cable, item.name):g} {item.metadata['unit']}"
            for item in fields(Cable)
            if item.name in _MORE and getattr(cable, item.name)
        )
        if told:
            groups.setdefault(told.replace(" ,", ",").strip(), []).append(str(j + 1))
    for told, names in groups.items():
        yield f"with {told}: {', '.join(names)}"


def _friction(robot: Robot, cable: Cable) -> str:
    """Return its coefficient, or those of the sections it runs through where they differ."""
    if cable.friction is not None:
        return f"{cable.friction:g}"
    passed = robot.sections[cable.start_section : cable.end_section + 1]
    values = [f"{section.cable_friction:g}" for section in passed]
    return values[0] if len(set(values)) == 1 else ", ".join(values)


def _masses(robot: Robot) -> Table:
    table = new_table("Masses [kg]", "", "backbone", "disks", "mass")
    for i, section in enumerate(robot.sections):
        disks = sum(disk.mass for disk in section.disks)
        row = (section.backbone_mass, disks, section.mass)
        table.add_row(f"section {i + 1}", *map(_text, row))
    table.add_row("payload", "", "", _text(robot.payload))
    table.add_row("total", "", "", _text(robot.mass))
    return table


def _modes(rest: Rest) -> Table | Text:
    try:
        rows = list(mode_rows(rest))
    except ValueError as error:
        return Text(f"No natural frequencies: {error}.\n")
    table = new_table(
        "Natural frequencies about this rest", "modes", "Hz", "rad/s", "damping ratio"
    )
    for row in rows[:_MAX_MODES]:
        table.add_row(*row)
    if len(rows) > _MAX_MODES:
        table.add_row(f"and {len(rows) - _MAX_MODES} faster")
    return table


def mode_rows(rest: Rest) -> Iterator[tuple[str, str, str, str]]:
    """Yield numbers, frequency [Hz] and [rad/s] and damping ratio of each mode, slowest first.

    Modes of one frequency and damping share a row.
    """
    modes = rest.modes
    frequency, ratio = modes.frequency, modes.damping_ratio
    scale = float(np.max(np.abs(modes.squared_frequency)))
    k = 0
    while k < len(frequency):
        end = k + 1
        while end < len(frequency) and _same(frequency, k, end) and _same(ratio, k, end):
            end += 1
        numbers = f"{k + 1}" if end == k + 1 else f"{k + 1}, {end}"
        if end > k + 2:
            numbers = f"{k + 1} to {end}"
        squared = float(modes.squared_frequency[k])
        if squared < -_SAME * scale:
            yield numbers, "unstable", "", ""
        elif squared <= _SAME * _SAME * scale:
            yield numbers, "0", "0", ""
        else:
            hertz = frequency[k] / (2.0 * math.pi)
            yield numbers, f"{hertz:.6g}", f"{frequency[k]:.6g}", f"{ratio[k]:.3g}"
        k = end


def _same(values: np.ndarray[tuple[int], np.dtype[np.float64]], i: int, j: int) -> bool:
    return bool(abs(values[i] - values[j]) <= _SAME * abs(values[i]))


def _whole(robot: Robot, rest: Rest | None) -> Table:
    table = new_table("Robot", "", "value")
    _add_row(table, "length", "m", [_text(robot.length)])
    _add_row(table, "gravity", "m/s^2", [", ".join(map(_text, robot.gravity))])
    for name, place in (
        ("base", robot.base_position),
        ("tool", [row[3] for row in robot.tool[:3]]),
    ):
        if any(place):
            _add_row(table, f"{name} at", "m", [", ".join(map(_text, place))])
    if robot.presliding_stiffness:
        text = _text(robot.presliding_stiffness)
        _add_row(table, "stiffness of cables that stick", "N/m", [text])
    if rest is None:
        return table
    if not rest.is_nondegenerate:
        _add_row(table, "tip stiffness", "", ["none: some small forces move it far"])
    else:
        for axis, stiffness in zip("xy", rest.tip_stiffness, strict=True):
            text = _text(stiffness) if math.isfinite(stiffness) else "rigid"
            _add_row(table, f"tip stiffness along its {axis}", "N/m", [text])
    with suppress(ValueError):  # no inertia, told already
        _add_row(table, "largest stable step of rk4", "s", [_text(rest.step)])
    return table


def _add_row(table: Table, label: str, unit: str, values: list[str]) -> None:
    table.add_row(Text(f"{label} [{unit}]" if unit else label), *map(Text, values))


def _field_text(item: Field[Any], value: Any) -> str:
    if value is None:
        return "locked" if item.metadata["kind"] == "order" else "none"
    return _text(value)


def _text(value: float | tuple[float, ...]) -> str:
    if isinstance(value, tuple):
        return "\n".join(map(_text, value)) or "none"
    return f"{value:.6g}"
