"""The commands: list, info, run, new, audit, figures, view."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer
from rich.console import Console

import cdcr
from cdcr.cli import audit, figures, info, info_json, new, run, tables, view

app = typer.Typer(
    help="Dynamics of cable-driven continuum robots.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)


Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace files that are there.")]

Size = Annotated[
    str | None,
    typer.Option(
        metavar="SIZE",
        help="Of the pictures: journal (8.5 cm wide), slide (16:9), or WIDTHxHEIGHT in cm.",
    ),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON object in place of tables.")]


def _print_json(table: dict[str, Any]) -> None:
    typer.echo(json.dumps(table, indent=2, allow_nan=False))


def _end(code: int, sentence: object) -> NoReturn:
    """Say why on stderr, and end with an exit code."""
    typer.echo(f"cdcr: {sentence}", err=True)
    raise typer.Exit(code) from None


def _warn_plainly(message: Warning | str, *_: object, **__: object) -> None:
    """Show a warning as the sentence it is, without the place in the code it came from."""
    typer.echo(f"cdcr: warning: {message}", err=True)


@contextmanager
def _told_plainly() -> Iterator[None]:
    """Turn what users can mend into a sentence on stderr and an exit code, without a traceback."""
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _warn_plainly
            yield
    except KeyboardInterrupt:
        _end(130, "interrupted, no file was written")
    except run.RunFailed as failure:
        _end(1, failure)
    except (run.Mistake, ImportError) as error:
        _end(2, error)
    except OSError as error:  # the system's own have a file and a reason, ours are sentences
        _end(2, f"{error.filename}: {error.strerror}" if error.strerror else error)


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
    with _told_plainly():
        if as_json:
            _print_json(tables.known())
        else:
            tables.print_list(Console())


@app.command("info", short_help="Show what a robot is made of.")
def info_command(
    robot: Annotated[
        str, typer.Argument(metavar="ROBOT|FILE.toml", help="A name from `cdcr list` or a file.")
    ],
    as_json: AsJson = False,
) -> None:
    """Show what a robot is made of and how it is at rest.

    Sections, cables, masses, natural frequencies, stiffness of the tip, largest stable step.
    """
    with _told_plainly():
        found = run.find_robot(robot)
        if as_json:
            _print_json(info_json.as_dict(robot, found))
        else:
            info.print_robot(Console(), robot, found)


@app.command("run", short_help="Run a scenario; write picture and data; print a summary.")
def run_command(
    scenario: Annotated[
        str,
        typer.Argument(
            metavar="NAME|FILE.toml", help="A scenario from `cdcr list` or a file of your own."
        ),
    ],
    out: Annotated[
        Path, typer.Option(help="Folder for the picture and the data; made where missing.")
    ] = Path("out"),
    method: Annotated[
        str | None,
        typer.Option(metavar="METHOD", help="Integrator: bdf, adams, dopri5 or rk4."),
    ] = None,
    t_end: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", help="End of the run; samples keep their spacing."),
    ] = None,
    rtol: Annotated[
        float | None, typer.Option(metavar="NUMBER", help="Relative tolerance of one step.")
    ] = None,
    atol: Annotated[
        float | None,
        typer.Option(metavar="NUMBER", help="Absolute tolerance of one step [rad], [rad/s]."),
    ] = None,
    max_steps: Annotated[
        int | None,
        typer.Option(metavar="NUMBER", help="Internal steps after which the run is given up."),
    ] = None,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
    size: Size = None,
) -> None:
    """Run a scenario; write a picture (.png) and the data (.csv, .nc); print a summary.

    Exit codes: 0 all went well, 1 the integration failed, 2 something in the command or in a file
    has to be mended first, 130 interrupted. Files appear when all are complete; a run that failed
    leaves its numbers, in files whose names end in -incomplete.
    """
    with _told_plainly():
        report = run.run(
            scenario,
            out,
            overwrite=overwrite,
            console=Console(stderr=True),
            size=size,
            t_end=t_end,
            method=method,
            rtol=rtol,
            atol=atol,
            max_steps=max_steps,
        )
        if as_json:
            _print_json(report.as_dict())
        else:
            tables.print_report(Console(), report)
        if report.run is not None and not report.run.success:
            kept = ", ".join(map(str, report.files))
            raise run.RunFailed(
                f"{run.as_options(report.run.message)} What was reached is in {kept}."
            )


@app.command("new", short_help="Write a scenario file to start from.")
def new_command(
    file: Annotated[Path, typer.Argument(metavar="FILE.toml", help="The file to write.")],
    name: Annotated[
        str | None,
        typer.Option("--from", metavar="NAME", help="The scenario of `cdcr list` to start from."),
    ] = None,
    overwrite: Overwrite = False,
) -> None:
    """Write a scenario file that `run` takes as it is, with every option in a comment.

    With --from, the file of a scenario of `cdcr list`.
    """
    with _told_plainly(), run.mistakes():
        new.write_scenario(file, name, overwrite=overwrite)
        typer.echo(f"wrote {file}; next: cdcr run {file}")


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
    with _told_plainly():
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
) -> None:
    """Redraw all figures of the origin paper (.png, .svg); write index.html, which shows them.

    Files appear only when all are complete.
    """
    with _told_plainly():
        written = figures.figures(out, overwrite=overwrite, size=size, console=Console(stderr=True))
    typer.echo(f"wrote {len(written) - 1} pictures and {written[-1]}")


@app.command("view", short_help="Show a robot or a run in the browser, live.")
def view_command(
    target: Annotated[
        str,
        typer.Argument(
            metavar="ROBOT|SCENARIO|FILE",
            help="A name from `cdcr list`, a file .toml of a robot or a scenario, or a run .nc.",
        ),
    ],
    live: Annotated[
        bool, typer.Option("--live", help="Begin where the run does, but simulate at once.")
    ] = False,
    reference: Annotated[
        str | None, typer.Option(metavar="FILE.nc", help="A run to show beside it, faintly.")
    ] = None,
    speed: Annotated[
        float, typer.Option(metavar="NUMBER", help="Time simulated or played over real time.")
    ] = 1.0,
    port: Annotated[
        int, typer.Option(min=0, max=65535, help="On this machine; 0 for any free one.")
    ] = 8080,
    browser: Annotated[
        bool, typer.Option("--browser/--no-browser", help="Open it in the browser.")
    ] = True,
    record: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE.html",
            help="Serve nothing; write one page that plays without a network.",
        ),
    ] = None,
    overwrite: Overwrite = False,
) -> None:
    """Show a robot or a run in the browser. Needs the extra `view`.

    A robot is simulated live. A scenario is run first and, as a run of a file, played; where a name
    is both, the scenario is meant. Sliders of the cables, gravity and payload, and the mouse, which
    pulls the backbone, go on from there live. Ctrl-C ends it, with exit code 0. On a recorded page
    a robot goes round in a circle.
    """
    with _told_plainly():
        found, page = view.view(
            target,
            live=live,
            reference=reference,
            speed=speed,
            record=record,
            overwrite=overwrite,
            console=Console(stderr=True),
        )
        if page is not None:
            typer.echo(f"wrote {page} ({page.stat().st_size / 1e6:.1f} MB)")
            return
        with found.serve(port, browser=browser), suppress(KeyboardInterrupt):
            typer.echo(f"{found.url} - Ctrl-C ends")
            found.wait()
