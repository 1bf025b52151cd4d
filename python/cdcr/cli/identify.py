"""The command ``cdcr identify``: parameters of a robot from measurements of it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from cdcr.cli import complete
from cdcr.cli.plain import AsJson, Overwrite, print_json, told_plainly
from cdcr.cli.run import RunFailed, mistakes
from cdcr.files.new_file import new_files

commands = typer.Typer()

_REPLACE = "give --overwrite to replace them"


@commands.command("identify", short_help="Find parameters of a robot from measurements.")
def identify_command(
    file: Annotated[
        str,
        typer.Argument(
            metavar="FILE.toml",
            help="Robot, parameters sought, and files of measurements.",
            autocompletion=complete.toml_files,
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Write identified.toml, robot.toml and identified.png there.",
            file_okay=False,
        ),
    ] = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
) -> None:
    """Find parameters of a robot from measurements of it, with their uncertainty.

    Prints estimates with standard errors, what is left over, and what the data cannot tell; with
    `folds` in the file, also how well parts of the data are predicted that were not used.
    """
    from cdcr.identification.report import provenance_comments, text
    from cdcr.identification.task import load_task
    from cdcr.robot.file import robot_text

    with told_plainly():
        with mistakes():
            task = load_task(file)
            found = task.run()
            crossed = None if task.folds is None else found.cross_validate(task.folds)
        if as_json:
            print_json(_as_dict(found, crossed))
        else:
            typer.echo(found.report())
            for name, rms in (crossed.held_out if crossed else {}).items():
                typer.echo(f"{name}: RMS {rms:.4g} where it was predicted and not used")
        if out is not None:
            head = "\n".join(provenance_comments(found))
            names = ("identified.toml", "robot.toml", "identified.png")
            paths = [out / name for name in names]
            figure = found.plot()
            with new_files(paths, overwrite=overwrite, replace=_REPLACE) as parts:
                parts[0].write_text(text(found), encoding="utf-8", newline="\n")
                parts[1].write_text(
                    f"{head}\n{robot_text(found.robot)}", encoding="utf-8", newline="\n"
                )
                figure.savefig(parts[2], format="png")
            if not as_json:
                for path in paths:
                    typer.echo(f"wrote {path}")
        if not found.success:
            raise RunFailed(found.message)


def _as_dict(found: Any, crossed: Any) -> dict[str, Any]:
    from dataclasses import asdict

    def plain(value: float) -> float | None:
        return value if abs(value) < float("inf") else None  # NaN too is not below it

    table = {
        "estimates": [
            {key: plain(value) if isinstance(value, float) else value
             for key, value in asdict(one).items()}
            for one in found.estimates
        ],
        "residuals": [
            {"data": one.data, "channel": one.channel, "unit": one.unit, "rms": plain(one.rms),
             "noise": plain(one.noise), "noise_given": one.noise_given}
            for one in found.residuals
        ],
        "not_told": found.untold,
        "misfit": plain(found.misfit),
    }  # fmt: skip
    if crossed is not None:
        table["held_out"] = {name: plain(rms) for name, rms in crossed.held_out.items()}
    return json.loads(json.dumps(table))  # type: ignore[no-any-return]
