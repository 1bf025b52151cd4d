"""What ``cdcr validate`` does: read robot and scenario files as ``cdcr run`` does, and not run."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from cdcr.base.check import count
from cdcr.cli import complete
from cdcr.cli.plain import AsJson, print_json, told_plainly
from cdcr.cli.run import load_robot
from cdcr.files.refusals import os_or_value
from cdcr.files.toml import read_toml
from cdcr.robot.robot import Robot
from cdcr.scenarios.file.reader import load_scenario

commands = typer.Typer()


@dataclass(frozen=True)
class Verdict:
    """What was found in a file: what it holds, or what is wrong with it, a sentence each."""

    file: str
    holds: str = ""
    faults: tuple[str, ...] = ()

    def as_dict(self) -> dict[str, Any]:
        """Return it as JSON has it."""
        return {"ok": not self.faults} | asdict(self)


def validate(file: str) -> Verdict:
    """Return what a file holds, or what is wrong with it. Nothing runs."""
    try:
        return Verdict(file, holds=_what_it_holds(Path(file)))
    except (OSError, ValueError) as error:
        return Verdict(file, faults=tuple(os_or_value(error).split("\n")))


def _what_it_holds(path: Path) -> str:
    if "sections" in read_toml(path, "robot or scenario file"):
        return f"a robot of {_size(load_robot(path))}"
    scenario = load_scenario(path)
    return f"a scenario of {scenario.t_end:g} s, {scenario.method}, {_size(scenario.robot)}"


def _size(robot: Robot) -> str:
    return f"{count(len(robot.sections), 'section')}, {count(robot.num_cables, 'cable')}"


@commands.command("validate", short_help="Check robot and scenario files without running.")
def validate_command(
    files: Annotated[
        list[str],
        typer.Argument(
            metavar="FILE.toml...",
            help="Files of robots and scenarios.",
            autocompletion=complete.toml_files,
        ),
    ],
    as_json: AsJson = False,
) -> None:
    """Check robot and scenario files, and the files they name, without running.

    One sentence for each fault, with its line where that is known. Exit code 2 where there is any.
    """
    with told_plainly():
        verdicts = [validate(file) for file in files]
    if as_json:
        print_json({"files": [verdict.as_dict() for verdict in verdicts]})
    for verdict in verdicts if not as_json else ():
        if verdict.holds:
            typer.echo(f"{verdict.file}: ok, {verdict.holds}")
        for fault in verdict.faults:
            typer.echo(f"cdcr: {fault}", err=True)
    if any(verdict.faults for verdict in verdicts):
        raise typer.Exit(2)
