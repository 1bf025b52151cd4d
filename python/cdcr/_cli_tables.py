"""What the commands print for people."""

from __future__ import annotations

import math
from dataclasses import fields

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from cdcr import robots, scenarios
from cdcr._cli_run import STATS, Report
from cdcr._model import Model
from cdcr._robot import Robot, Section

_LABELS = {
    "youngs_modulus": "Young's modulus",
    "num_disks": "disks",
    "cable_angles": "cable angles",
}
_SAME = 1e-9  # relative; two modes closer than this are told as one


def _table(title: str, *columns: str) -> Table:
    """Return an empty table; its first column is for words, the others for numbers."""
    table = Table(title=Text(title), title_justify="left", title_style="bold", box=SIMPLE_HEAD)
    for i, column in enumerate(columns):
        table.add_column(column, justify="right" if i else "left")
    return table


def print_list(console: Console) -> None:
    """Print scenarios and robots."""
    table = _table("Scenarios", "name")
    table.add_column("what happens, and its source")
    for name in scenarios.names():
        scenario = scenarios.get(name)
        table.add_row(Text(name, no_wrap=True), Text(f"{scenario.title}\n{scenario.source}"))
    console.print(table)
    table = _table("Robots", "name", "sections", "cables", "length [m]", "mass [kg]")
    for name in robots.names():
        robot = robots.get(name)
        table.add_row(
            Text(name),
            str(len(robot.sections)),
            str(robot.num_cables),
            f"{robot.length:g}",
            f"{robot.mass:g}",
        )
    console.print(table)


def print_robot(console: Console, name: str, robot: Robot) -> None:
    """Print the sections of a robot, and the robot as a whole."""
    numbers = [str(i + 1) for i in range(len(robot.sections))]
    table = _table("Sections, base to tip", "", *numbers)
    for item in fields(Section):
        values = [getattr(section, item.name) for section in robot.sections]
        if item.metadata["rare"] and all(value == item.default for value in values):
            continue
        unit = item.metadata["unit"]
        label = _LABELS.get(item.name, item.name.replace("_", " "))
        if item.name == "cable_angles":
            unit, values = "deg", [tuple(map(math.degrees, angles)) for angles in values]
        _add_row(table, label, unit, list(map(_text, values)))
    stiffness = [_text(section.stiffness) for section in robot.sections]
    _add_row(table, "bending stiffness E I / l", "N m/rad", stiffness)
    _add_row(table, "mass", "kg", [_text(section.mass) for section in robot.sections])
    console.print(table)

    table = _table(name, "", "robot")
    _add_row(table, "length", "m", [_text(robot.length)])
    _add_row(table, "payload", "kg", [_text(robot.payload)])
    _add_row(table, "total mass", "kg", [_text(robot.mass)])
    _add_row(table, "gravity", "m/s^2", [", ".join(map(_text, robot.gravity))])
    _add_row(table, "cables", "", [str(robot.num_cables)])
    _add_row(table, "vibration about straight", "", ["\n".join(straight_modes(robot))])
    console.print(table)


def _add_row(table: Table, label: str, unit: str, values: list[str]) -> None:
    table.add_row(Text(f"{label} [{unit}]" if unit else label), *map(Text, values))


def _text(value: float | tuple[float, ...]) -> str:
    if isinstance(value, tuple):
        return "\n".join(map(_text, value)) or "none"
    return f"{value:.6g}"


def straight_modes(robot: Robot) -> list[str]:
    """Return a line for each mode of the straight robot at rest without tension, slowest first."""
    try:
        model = Model(robot)
        rest = np.zeros(model.num_coordinates)
        A, _ = model.linearize(rest, rest, np.zeros(model.num_cables))
    except ValueError as error:
        return [str(error)]
    eigenvalues = np.linalg.eigvals(A)
    scale = float(np.max(np.abs(eigenvalues)))
    if np.max(eigenvalues.real) > _SAME * scale:
        return ["none: it does not stay straight"]
    lines = []
    last = 0.0
    for frequency in np.sort(eigenvalues.imag[eigenvalues.imag > _SAME * scale]):
        if frequency - last > _SAME * scale:
            hertz = frequency / (2.0 * math.pi)
            lines.append(f"{frequency:.6g} rad/s = {hertz:.6g} Hz, period {1.0 / hertz:.6g} s")
        last = frequency
    return lines or ["none: it creeps back without swinging"]


def print_report(console: Console, report: Report) -> None:
    """Print what a run showed, what it cost and what was written."""
    scenario, run = report.scenario, report.run
    console.print(Text(scenario.title, style="bold"))
    if scenario.description:
        console.print(Text(scenario.description))
    console.print(Text(f"Source: {scenario.source}", style="dim"))
    told = scenario.name if run is None else f"{scenario.name}, {report.method}, {len(run)} samples"
    table = _table(told, "", "value", "unit")
    for finding in report.findings:
        table.add_row(Text(finding.label), _number(finding.value), finding.unit)
    if run is not None:
        for name in STATS:
            table.add_row(name.replace("_", " "), str(getattr(run.stats, name)), "")
        table.add_row("wall time of the integration", f"{1e3 * report.wall_time:.3g}", "ms")
    console.print(table)
    for path in report.files:
        console.print(Text(f"wrote {path}"), soft_wrap=True)


def _number(value: float) -> str:
    return f"{value:.1e}" if 0.0 < abs(value) < 1e-3 else f"{value:.4f}"
