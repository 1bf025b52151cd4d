"""What the commands print for people."""

from __future__ import annotations

from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table
from rich.text import Text

from cdcr import robots, scenarios
from cdcr.cli.run import Report
from cdcr.runs.stats import STATS, chosen


def new_table(title: str, *columns: str) -> Table:
    """Return an empty table; its first column is for words, the others for numbers."""
    table = Table(title=Text(title), title_justify="left", title_style="bold", box=SIMPLE_HEAD)
    for i, column in enumerate(columns):
        table.add_column(Text(column), justify="right" if i else "left")
    return table


def print_list(console: Console) -> None:
    """Print scenarios and robots."""
    table = new_table("Scenarios", "name")
    table.add_column("what happens, and its source")
    for name in scenarios.names():
        scenario = scenarios.get(name)
        table.add_row(Text(name, no_wrap=True), Text(f"{scenario.title}\n{scenario.source}"))
    console.print(table)
    table = new_table("Robots", "name", "sections", "cables", "length [m]", "mass [kg]")
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


def known() -> dict[str, Any]:
    """Return scenarios and robots as JSON has them."""
    return {
        "scenarios": [
            {"name": one.name, "title": one.title, "source": one.source, "runs": one.has_run}
            for one in map(scenarios.get, scenarios.names())
        ],
        "robots": [
            {
                "name": name,
                "num_sections": len(robot.sections),
                "num_cables": robot.num_cables,
                "length_m": robot.length,
                "mass_kg": robot.mass,
            }
            for name, robot in ((name, robots.get(name)) for name in robots.names())
        ],
    }


def print_report(console: Console, report: Report) -> None:
    """Print what a run showed, what it cost and what was written."""
    scenario, run = report.scenario, report.run
    console.print(Text(scenario.title, style="bold"))
    if scenario.description:
        console.print(Text(scenario.description))
    console.print(Text(f"Source: {scenario.source}", style="dim"))
    told = scenario.name
    if run is not None:
        told += f", {report.method}{chosen(run.stats)}, {len(run)} samples"
    table = new_table(told, "", "value", "unit")
    for metric in report.metrics:
        table.add_row(Text(metric.label), _number(metric.value), metric.unit)
    if run is not None:
        for name in STATS:
            table.add_row(name.replace("_", " "), str(getattr(run.stats, name)), "")
        table.add_row("wall time of the integration", f"{1e3 * report.wall_time:.3g}", "ms")
        speed = float(run.t[-1] - run.t[0]) / report.wall_time
        table.add_row("times faster than real time", f"{speed:.3g}", "")
    console.print(table)
    for path in report.files:
        console.print(Text(f"wrote {path}"), soft_wrap=True)


def _number(value: float) -> str:
    if isinstance(value, int):  # a count
        return f"{value}"
    return f"{value:.1e}" if 0.0 < abs(value) < 1e-3 else f"{value:.4f}"
