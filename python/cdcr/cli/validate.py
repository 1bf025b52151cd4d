"""What ``cdcr validate`` does: read robot and scenario files as ``cdcr run`` does, and not run."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from cdcr.base.check import count
from cdcr.cli import complete
from cdcr.cli.plain import AsJson, print_json, told_plainly
from cdcr.files.text import read_text
from cdcr.files.toml import read_toml
from cdcr.files.toml_lines import key_lines, line_of
from cdcr.robot.robot import Robot
from cdcr.scenarios.file.reader import load_scenario

commands = typer.Typer()

# A refusal: the file, the table in it that it is about where one is named, and the rest.
_REFUSAL = re.compile(r"(?P<file>.+?\.toml)(?P<home>, [^:]+)?: (?P<rest>.*)")


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
    except ValueError as error:
        return Verdict(file, faults=tuple(map(_with_line, str(error).split("\n"))))
    except OSError as error:
        told = f"{error.filename}: {error.strerror}" if error.strerror else str(error)
        return Verdict(file, faults=(told,))


def _what_it_holds(path: Path) -> str:
    if "sections" in read_toml(path, "robot or scenario file"):
        return f"a robot of {_size(Robot.load(path))}"
    scenario = load_scenario(path)
    return f"a scenario of {scenario.t_end:g} s, {scenario.method}, {_size(scenario.robot)}"


def _size(robot: Robot) -> str:
    return f"{count(len(robot.sections), 'section')}, {count(robot.num_cables, 'cable')}"


def _with_line(sentence: str) -> str:
    """Return a refusal with the line that it is about, where that is found."""
    refusal = _REFUSAL.match(sentence)
    if refusal is None or re.match(", line ", refusal["home"] or ""):
        return sentence
    try:
        lines = key_lines(read_text(Path(refusal["file"]), "file"))
    except (OSError, ValueError):
        return sentence
    line = line_of(lines, refusal["rest"], ".".join(_tables(refusal["home"] or "")))
    if line is None:
        return sentence
    return f"{refusal['file']}, line {line}{refusal['home'] or ''}: {refusal['rest']}"


def _tables(home: str) -> Iterator[str]:
    """Yield the tables of ', [robot], each_section'."""
    for one in home.split(","):
        if one.strip():
            yield one.strip(" []")


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
