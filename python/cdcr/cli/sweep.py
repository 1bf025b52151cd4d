"""The command ``cdcr sweep``: many runs of a scenario, its table, its file and its picture."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from rich.console import Console
from rich.text import Text

from cdcr import sweeps
from cdcr.base.extras import require
from cdcr.cli import complete
from cdcr.cli.plain import (
    INTERRUPTED,
    AsJson,
    Jobs,
    Overwrite,
    Quiet,
    Scenario,
    Size,
    end,
    print_json,
    told_plainly,
    whole,
)
from cdcr.cli.run import DelayedBar, Mistake, RunFailed, check_size, first_as_option, mistakes
from cdcr.cli.sweep_values import grid, sampled
from cdcr.cli.tables import new_table
from cdcr.files import new_file
from cdcr.sweeps.result import check_name, metric_names, parameter_names
from cdcr.sweeps.store import partial_path

if TYPE_CHECKING:
    import xarray

commands = typer.Typer()

REPLACE = "give --overwrite to replace, or another file with --out"


@commands.command("sweep", short_help="Run a scenario for many values of its parameters.")
def sweep_command(
    scenario: Scenario,
    parameters: Annotated[
        list[str] | None,
        typer.Option(
            "--param",
            metavar="PATH=VALUES",
            help="A number of the file, such as payload, gravity.z, sections.1.youngs_modulus, "
            "sections.*.damping or tension.1, and its values: LOW:HIGH:COUNT, LOW:HIGH:COUNT:log "
            "or numbers with commas; with --samples LOW:HIGH, LOW:HIGH:log or normal:MEAN:SD. May "
            "be given several times.",
            autocompletion=complete.parameters,
        ),
    ] = None,
    metrics: Annotated[
        list[str] | None,
        typer.Option(
            "--metric",
            metavar="NAME,...",
            help="Numbers to keep of each run, such as settling_time or peak_tension; one that "
            "there is not lists them all. May be given several times.",
            autocompletion=complete.metrics,
        ),
    ] = None,
    samples: Annotated[
        str | None,
        typer.Option(
            metavar="KIND:NUMBER",
            help="Sample the ranges in place of a grid: sobol, lhs (Latin hypercube), random, or "
            "saltelli, which tells what each parameter does.",
            autocompletion=complete.samples,
        ),
    ] = None,
    seed: Annotated[int, typer.Option(metavar="NUMBER", parser=whole, help="Of the samples.")] = 0,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.nc|FILE.zarr",
            help="The file to write, beside its picture; by default out/NAME-sweep.nc.",
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS|local",
            help="Compute on a cluster of Dask: the address of its scheduler, tcp://HOST:PORT, or "
            "local for one of this machine.",
            autocompletion=complete.schedulers,
        ),
    ] = None,
    jobs: Jobs = None,
    picture: Annotated[bool, typer.Option(help="Draw the picture.")] = True,
    size: Size = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
) -> None:
    """Run a scenario for many values of its parameters; keep numbers of each run.

    They are shared out over the processors of this machine, or over a cluster. Runs that are
    finished stay in FILE.nc.partial, whatever ends the command, and the same command goes on from
    there. A run that fails is no number, its message is in the file, and the others go on.

    Exit codes: 0 all went well, 1 no run did, or those who compute were lost, 2 something in the
    command or in a file has to be mended first, 130 interrupted.
    """
    target = out or Path("out") / f"{Path(scenario).stem}-sweep.nc"
    was_complete = target.exists() and not overwrite
    with told_plainly():
        with mistakes():
            check_name(target)
        drawn = _picture_file(target, size, overwrite=overwrite) if picture else None
        values = grid if samples is None else sampled
        with mistakes():
            asked = dict(values(text) for text in parameters or ())
            if len(asked) < len(parameters or ()):
                raise ValueError("each --param must be of another parameter")
        named = [name for text in metrics or () for name in text.split(",")]
        options = {"samples": samples, "seed": seed, "scheduler": scheduler, "jobs": jobs}
        console = Console(stderr=True, quiet=quiet)
        found = _sweep(scenario, asked, named, target, overwrite, console, options)
        files = [] if was_complete else [target]
        if drawn is not None:
            with new_file.new_file(drawn, overwrite=overwrite, replace=REPLACE) as part:
                sweeps.plot(found, size=size).savefig(part, format="png")
            files.append(drawn)
        if as_json:
            print_json(_as_dict(found, files))
        elif not quiet:
            _print_table(Console(), found)
            for file in files or [target]:
                typer.echo(f"{'wrote' if files else 'nothing is missing in'} {file}")
        _tell_failures(found)


def _picture_file(target: Path, size: str | None, *, overwrite: bool) -> Path | None:
    """Return the file of the picture, None where it is there beside a finished sweep."""
    require("matplotlib", "plot")
    check_size(size)
    file = target.with_suffix(".png")
    if file.exists() and target.exists() and not overwrite:
        return None
    new_file.check_files([file], overwrite=overwrite, replace=REPLACE)
    return file


def _sweep(
    scenario: str,
    parameters: Mapping[str, Any],
    metrics: list[str],
    target: Path,
    overwrite: bool,
    console: Console,
    options: Mapping[str, Any],
) -> xarray.Dataset:
    """Sweep with a bar on a terminal; what ends it tells where finished runs are."""
    finished = 0, 0
    target.parent.mkdir(parents=True, exist_ok=True)
    with DelayedBar(console, target.stem, 1.0) as bar:

        def progress(done: int, total: int) -> None:
            nonlocal finished
            finished = done, total
            bar(done / total, f"{done} of {total} runs")

        try:
            with mistakes(first_as_option):
                return sweeps.sweep(
                    scenario,
                    parameters,
                    metrics=metrics,
                    path=target,
                    overwrite=overwrite,
                    progress=progress,
                    **options,
                )
        except KeyboardInterrupt:
            told = "{} of {} runs are kept in".format(*finished)
            kept = f"{told} {partial_path(target)}: the same command goes on from there"
            end(INTERRUPTED, f"interrupted; {kept if finished[0] else 'no run was finished'}")
        except FileExistsError as error:
            raise Mistake(str(error).replace(new_file.REPLACE, REPLACE)) from error
        except RuntimeError as error:
            raise RunFailed(str(error)) from error


def _print_table(console: Console, found: xarray.Dataset) -> None:
    table = new_table(f"{found.status.size} runs", "", "unit", "least", "median", "largest", "none")
    for name in metric_names(found):
        values = found[name].values
        known = values[np.isfinite(values)]
        numbers = (known.min(), np.median(known), known.max()) if known.size else ()
        told = [f"{number:.4g}" for number in numbers] or ["-"] * 3
        unit = found[name].attrs.get("units", "")
        table.add_row(Text(name), Text(unit), *told, str(values.size - known.size))
    console.print(table)


def _as_dict(found: xarray.Dataset, files: list[Path]) -> dict[str, Any]:
    """Return what was found as JSON has it."""
    return {
        "sweep": json.loads(found.attrs["sweep"]),
        "runs": int(found.status.size),
        "failed": int((found.message != "").sum()),
        "metrics": {name: _metric(found, name) for name in metric_names(found)},
        "files": [str(file) for file in files],
    }


def _metric(found: xarray.Dataset, name: str) -> dict[str, Any]:
    values = found[name].values.ravel()
    known = np.flatnonzero(np.isfinite(values))
    told: dict[str, Any] = {"unit": found[name].attrs.get("units", ""), "known": len(known)}
    for key, pick in {"least": np.argmin, "largest": np.argmax}.items() if len(known) else ():
        run = int(known[pick(values[known])])
        told[key] = {"value": float(values[run]), "at": _values_at(found, run)}
    return told


def _values_at(found: xarray.Dataset, run: int) -> dict[str, float]:
    """Return the parameters of a run, counted from 0 along the last dimension first."""
    place = dict(zip(found.status.dims, np.unravel_index(run, found.status.shape), strict=True))
    return {
        name: float(found[name].isel(place, missing_dims="ignore"))
        for name in parameter_names(found)
    }


def _tell_failures(found: xarray.Dataset) -> None:
    """Say how many runs failed and why the first did; none that went well is a failure."""
    messages = found.message.values.ravel()
    failed = np.flatnonzero(messages != "")
    if not failed.size:
        return
    at = ", ".join(f"{name} {value:g}" for name, value in _values_at(found, failed[0]).items())
    told = f"{failed.size} of {messages.size} runs failed; the first, {at}: {messages[failed[0]]}"
    if failed.size == messages.size:
        raise RunFailed(told)
    typer.echo(f"cdcr: {told}", err=True)
