"""The commands; those that need more stand in files of their own, which this one adds."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

import cdcr
from cdcr.cli import (
    audit,
    complete,
    doctor,
    export,
    figures,
    identify,
    info,
    info_json,
    new,
    run,
    schema,
    sweep,
    tables,
    validate,
    view,
    watch,
)
from cdcr.cli.plain import (
    AsJson,
    Jobs,
    Overwrite,
    Quiet,
    Robot,
    Scenario,
    Size,
    number,
    print_json,
    told_plainly,
    whole,
)

app = typer.Typer(
    help="Dynamics of cable-driven continuum robots.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for group in (sweep, validate, schema, doctor, export, identify, view):
    app.add_typer(group.commands)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"cdcr {cdcr.__version__}")
        raise typer.Exit


@app.callback()
def cdcr_command(
    version: Annotated[
        bool,
        typer.Option("--version", callback=_version, is_eager=True, help="Print the version."),
    ] = False,
) -> None:
    """Dynamics of cable-driven continuum robots: scenarios, robots, pictures and data."""


@app.command("list", short_help="List the known scenarios and robots.")
def list_command(as_json: AsJson = False) -> None:
    """List the scenarios and robots that `run` and `info` know by name."""
    with told_plainly():
        if as_json:
            print_json(tables.known())
        else:
            tables.print_list(Console())


@app.command("info", short_help="Show what a robot is made of.")
def info_command(
    robot: Robot,
    as_json: AsJson = False,
) -> None:
    """Show what a robot is made of and how it is at rest.

    Sections, cables, masses, natural frequencies, stiffness of the tip, largest stable step.
    """
    with told_plainly():
        found = run.find_robot(robot)
        if as_json:
            print_json(info_json.as_dict(robot, found))
        else:
            info.print_robot(Console(), robot, found)


@app.command("run", short_help="Run a scenario; write picture and data; print a summary.")
def run_command(
    scenario: Scenario,
    out: Annotated[
        Path, typer.Option(help="Folder for the picture and the data; made where missing.")
    ] = Path("out"),
    method: Annotated[
        str | None,
        typer.Option(
            metavar="METHOD",
            help="Integrator: auto, bdf, adams, dopri5, dop853, rk4 or rosenbrock.",
            autocompletion=complete.methods,
        ),
    ] = None,
    t_end: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS", parser=number, help="End of the run; samples keep their spacing."
        ),
    ] = None,
    rtol: Annotated[
        float | None,
        typer.Option(metavar="NUMBER", parser=number, help="Relative tolerance of one step."),
    ] = None,
    atol: Annotated[
        float | None,
        typer.Option(
            metavar="NUMBER", parser=number, help="Absolute tolerance of one step [rad], [rad/s]."
        ),
    ] = None,
    max_steps: Annotated[
        int | None,
        typer.Option(
            metavar="NUMBER",
            parser=whole,
            help="Internal steps after which the run is given up.",
        ),
    ] = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    size: Size = None,
    formats: Annotated[
        list[str] | None,
        typer.Option(
            "--format",
            metavar="FORMAT",
            help="Write picture, csv, nc or mcap in place of the scenario's own files; may be "
            "given several times.",
            autocompletion=complete.formats,
        ),
    ] = None,
    film: Annotated[
        str | None,
        typer.Option(
            metavar="FORMAT",
            help="Write a film too: mp4 (needs ffmpeg), gif or html, a page that any browser "
            "plays; a minute at most, so longer runs play faster. In Python, `run.animate` also "
            "takes speed and frames a second.",
            autocompletion=complete.films,
        ),
    ] = None,
    watching: Annotated[
        bool,
        typer.Option("--watch", help="Run again each time the file, or one it names, changes."),
    ] = False,
    quiet: Quiet = False,
) -> None:
    """Run a scenario; write a picture (.png) and the data (.csv, .nc); print a summary.

    With --format other files, such as mcap, a log for Foxglove.

    Exit codes: 0 all went well, 1 the integration failed, 2 something in the command or in a file
    has to be mended first, 130 interrupted. Files appear when all are complete; a run that failed
    leaves its numbers, in files whose names end in -incomplete.
    """
    options = {"t_end": t_end, "method": method, "rtol": rtol, "atol": atol}
    console, own = Console(stderr=True, quiet=quiet), set[Path]()

    def run_once() -> None:
        report = run.run(
            scenario,
            out,
            overwrite=overwrite,
            console=console,
            size=size,
            formats=formats or (),
            film=film,
            own=own,
            max_steps=max_steps,
            **options,
        )
        own.update(report.files)
        if as_json:
            print_json(report.as_dict())
        elif not quiet:
            tables.print_report(Console(), report)
        if report.run is not None and not report.run.success:
            kept = ", ".join(map(str, report.files))
            raise run.RunFailed(
                f"{run.as_options(report.run.message)} What was reached is in {kept}."
            )

    if watching:
        watch.run_and_watch(scenario, run_once, quiet=quiet)
        return
    with told_plainly():
        run_once()


@app.command("new", short_help="Write a scenario file or a robot file to start from.")
def new_command(
    file: Annotated[Path, typer.Argument(metavar="FILE.toml", help="The file to write.")],
    name: Annotated[
        str | None,
        typer.Option(
            "--from",
            metavar="NAME",
            help="The scenario of `cdcr list` to start from.",
            autocompletion=complete.scenario_names,
        ),
    ] = None,
    robot: Annotated[
        str | None,
        typer.Option(
            metavar="NAME",
            help="Write a robot file: the robot of `cdcr list` to start from.",
            autocompletion=complete.robot_names,
        ),
    ] = None,
    overwrite: Overwrite = False,
) -> None:
    """Write a scenario file that `run` takes as it is, with every option in a comment.

    With --from, the file of a scenario of `cdcr list`; with --robot, a robot file, which a scenario
    file names in `robot = "FILE.toml"`.
    """
    with told_plainly(), run.mistakes():
        if robot is None:
            new.write_scenario(file, name, overwrite=overwrite)
        elif name is not None:
            raise run.Mistake("give either --from or --robot, not both")
        else:
            new.write_robot(file, robot, overwrite=overwrite)
        told = shlex.quote(f"./{file}" if str(file).startswith("-") else str(file))
        typer.echo(f"wrote {file}; next: cdcr {'run' if robot is None else 'info'} {told}")


@app.command("audit", short_help="Hold the origin paper's claims against its own equations.")
def audit_command(
    as_json: Annotated[
        bool, typer.Option("--json", help="Print one JSON array in place of the table.")
    ] = False,
) -> None:
    """Hold the claims of the origin paper against its own equations and Table 1.

    One row per claim: where it stands, what the paper says, what follows from its equations, and a
    verdict. Every number is computed by this command. Exit code 0, whatever the verdicts.
    """
    with told_plainly():
        claims = audit.compute(Console(stderr=True))
        if as_json:
            typer.echo(audit.as_json(claims))
        else:
            audit.print_audit(Console(), claims)


@app.command("figures", short_help="Redraw all figures of the origin paper.")
def figures_command(
    out: Annotated[Path, typer.Option(help="Folder for the files; made where missing.")] = Path(
        "figures"
    ),
    overwrite: Overwrite = False,
    size: Size = None,
    jobs: Jobs = None,
    quiet: Quiet = False,
) -> None:
    """Redraw all figures of the origin paper (.png, .svg); write index.html, which shows them.

    Files appear only when all are complete.
    """
    with told_plainly():
        written = figures.figures(
            out,
            overwrite=overwrite,
            size=size,
            jobs=jobs,
            console=Console(stderr=True, quiet=quiet),
        )
    if not quiet:
        typer.echo(f"wrote {len(written) - 1} pictures and {written[-1]}")
