"""The commands ``cdcr export-c``, ``export-fmu`` and ``export-mjcf``: a robot for others."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from cdcr import _core
from cdcr.cli.plain import Overwrite, Robot, number, told_plainly, whole
from cdcr.cli.run import find_robot, first_as_option, mistakes
from cdcr.export.c import c_texts
from cdcr.export.fmu import fmu_bytes
from cdcr.export.mjcf import mjcf_text
from cdcr.files.new_file import new_file, new_files

commands = typer.Typer()

_REPLACE = "give --overwrite to replace it"


@commands.command("export-c", short_help="Write a robot as C that depends on nothing.")
def export_c_command(
    robot: Robot,
    out: Annotated[Path, typer.Option(metavar="FOLDER", help="Where the files go.")],
    name: Annotated[
        str, typer.Option(metavar="NAME", help="Of the files and what is in them.")
    ] = "robot",
    max_bending: Annotated[
        float,
        typer.Option(
            metavar="RAD",
            parser=number,
            help="Largest bending angle of a section; the tables grow with it.",
        ),
    ] = _core.max_bending,
    casadi: Annotated[
        bool,
        typer.Option(
            "--casadi",
            help="Write NAME_casadi.c too: functions for casadi.external, with Jacobians.",
        ),
    ] = False,
    acados: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS",
            parser=number,
            help="Write NAME_acados.c too: discrete dynamics over shooting intervals of so long.",
        ),
    ] = None,
    steps: Annotated[
        int,
        typer.Option(metavar="NUMBER", parser=whole, help="Of Runge-Kutta 4 in such an interval."),
    ] = 1,
    overwrite: Overwrite = False,
) -> None:
    """Write a robot of arcs as C99 for the loop of a controller: no library, no heap.

    Accelerations and their derivatives, steps of Runge-Kutta 4 and theirs, cable lengths and the
    tip, in double or in single precision; for CasADi and acados in the form in which these call.
    """
    with told_plainly():
        described = find_robot(robot)
        with mistakes(first_as_option):
            texts = c_texts(
                described,
                name=name,
                max_bending=max_bending,
                casadi=casadi,
                acados=acados,
                steps=steps,
            )
        files = [out / file for file in texts]
        with new_files(files, overwrite=overwrite, replace=_REPLACE) as parts:
            for part, text in zip(parts, texts.values(), strict=True):
                part.write_text(text, encoding="utf-8", newline="\n")
        typer.echo(f"wrote {', '.join(map(str, files))}")


@commands.command("export-fmu", short_help="Write a robot as an FMU, for co-simulation.")
def export_fmu_command(
    robot: Robot,
    out: Annotated[Path, typer.Option(metavar="FILE.fmu", help="The file to write.")],
    fmi: Annotated[
        int, typer.Option(metavar="3|2", parser=whole, help="Version of the standard.")
    ] = 3,
    step: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS",
            parser=number,
            help="Fixed step of Runge-Kutta 4 inside; without it, dopri5 with its tolerances.",
        ),
    ] = None,
    overwrite: Overwrite = False,
) -> None:
    """Write a robot as a functional mock-up unit (FMI 3 or 2) for co-simulation on Linux.

    Inputs are tensions, or lengths where a cable is driven by length; parameters gravity and the
    state at the start; outputs the state, the tip, lengths and tensions of the cables.
    """
    with told_plainly():
        described = find_robot(robot)
        with mistakes(first_as_option):
            content = fmu_bytes(described, out, fmi=fmi, step=step)
        with new_file(out, overwrite=overwrite, replace=_REPLACE) as part:
            part.write_bytes(content)
        typer.echo(f"wrote {out}, for FMI {fmi}")


@commands.command("export-mjcf", short_help="Write a robot as a model of MuJoCo.")
def export_mjcf_command(
    robot: Robot,
    out: Annotated[Path, typer.Option(metavar="FILE.xml", help="The file to write.")],
    links: Annotated[
        int,
        typer.Option(metavar="NUMBER", parser=whole, help="Rigid links of each section, from 1."),
    ] = 10,
    overwrite: Overwrite = False,
) -> None:
    """Write a robot as a chain of rigid links for MuJoCo, with its cables, gravity and payload.

    Friction of cables is left out.
    """
    with told_plainly():
        described = find_robot(robot)
        with mistakes(first_as_option):
            text = mjcf_text(described, out, links=links)
        with new_file(out, overwrite=overwrite, replace=_REPLACE) as part:
            part.write_text(text, encoding="utf-8", newline="\n")
        typer.echo(f"wrote {out}")
