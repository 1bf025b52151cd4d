"""What ``cdcr export-fmu`` and ``cdcr export-mjcf`` do: write a robot for other software."""

from __future__ import annotations

from pathlib import Path

from cdcr.cli.run import find_robot, mistakes
from cdcr.export.fmu import fmu_bytes
from cdcr.export.mjcf import mjcf_text
from cdcr.files.new_file import new_file

_REPLACE = "give --overwrite to replace it"


def export_fmu(name: str, out: Path, *, fmi: int, step: float | None, overwrite: bool) -> None:
    """Write a robot, known by name or by its file, as an FMU."""
    robot = find_robot(name)
    with mistakes():
        content = fmu_bytes(robot, out, fmi=fmi, step=step)
    with new_file(out, overwrite=overwrite, replace=_REPLACE) as part:
        part.write_bytes(content)


def export_mjcf(name: str, out: Path, *, links: int, overwrite: bool) -> None:
    """Write a robot, known by name or by its file, as a model of MuJoCo."""
    robot = find_robot(name)
    with mistakes():
        text = mjcf_text(robot, out, links=links)
    with new_file(out, overwrite=overwrite, replace=_REPLACE) as part:
        part.write_text(text, encoding="utf-8", newline="\n")
