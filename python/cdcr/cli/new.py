"""What ``cdcr new`` does: write a scenario file or a robot file to start from."""

from __future__ import annotations

from pathlib import Path

from cdcr import robots, scenarios
from cdcr.cli import schema
from cdcr.files.new_file import new_file
from cdcr.robot.file import robot_text, switched_off
from cdcr.scenarios.file.template import template


def write_scenario(path: Path, name: str | None, *, overwrite: bool) -> None:
    """Write a scenario of the package, or the template, as a file that ``cdcr run`` takes for one.

    Raises
    ------
    ValueError
        Where the name of the file does not end in .toml, or there is no file of that scenario.
    OSError
        Where the folder is missing, or the file exists and is not to be replaced.
    """
    _check_name(path)
    text = scenarios.source_file(name).read_text(encoding="utf-8") if name else template()
    _write(path, schema.comment("scenario") + text, overwrite=overwrite)


def write_robot(path: Path, name: str, *, overwrite: bool) -> None:
    """Write a robot of the package as a file that ``Robot.load`` reads, with what else may be.

    Raises
    ------
    ValueError
        Where the name of the file does not end in .toml, or there is no such robot.
    OSError
        Where the folder is missing, or the file exists and is not to be replaced.
    """
    _check_name(path)
    robot = robots.get(name)
    text = schema.comment("robot") + robot_text(robot) + switched_off(robot)
    _write(path, text, overwrite=overwrite)


def _check_name(path: Path) -> None:
    if path.suffix != ".toml":
        known = {"--from": scenarios.names(), "--robot": robots.names()}
        ways = [f"cdcr new FILE.toml {how} {path}" for how, of in known.items() if str(path) in of]
        hint = f"; start from it by `{'` or `'.join(ways)}`" if ways else ""
        raise ValueError(f"the file name must end in .toml, got {path.name!r}{hint}")


def _write(path: Path, text: str, *, overwrite: bool) -> None:
    with new_file(path, overwrite=overwrite, replace="give --overwrite to replace it") as part:
        part.write_text(text, encoding="utf-8", newline="\n")
