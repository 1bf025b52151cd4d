"""What ``cdcr view`` does: find what is meant, and serve it or write it as a page."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from rich.console import Console

from cdcr import robots, scenarios
from cdcr._core import Controller, TrackingController
from cdcr.base.check import nearest
from cdcr.base.extras import require
from cdcr.cli import complete
from cdcr.cli.plain import Overwrite, number, told_plainly, whole_from
from cdcr.cli.run import (
    DelayedBar,
    Mistake,
    find_robot,
    find_scenario,
    first_as_option,
    is_one,
    mistakes,
)
from cdcr.files.new_file import check_files
from cdcr.files.toml import read_toml
from cdcr.model.model import Model
from cdcr.robot.robot import Robot
from cdcr.runs.loop import Loop
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios import Scenario
from cdcr.scenarios.file.loop import ClosedLoop
from cdcr.scenarios.file.tracking import TrackedMotion

if TYPE_CHECKING:
    from cdcr.plotting.geometry import Motion
    from cdcr.view import View
    from cdcr.view.live_loop import LoopMaker

commands = typer.Typer()

REPLACE = "give --overwrite to replace it"


@dataclass(frozen=True, kw_only=True)
class Shown:
    """What is to be seen: a robot, or a run of it."""

    robot: Robot
    formulation: str = "exact"
    run: Trajectory | None = None
    reference: Motion | None = None
    estimate: Motion | None = None
    loop: LoopMaker | None = None


def prepare(
    target: str,
    *,
    live: bool,
    robot: bool,
    reference: str | None,
    speed: float,
    record: Path | None,
    overwrite: bool,
    console: Console,
) -> tuple[View, Path | None]:
    """Return the view of what a name or a file stands for, and the page where one was written."""
    require("matplotlib", "view")
    require("viser", "view")
    from cdcr.view import Session, View

    if record is not None:
        if record.suffix != ".html":
            raise Mistake(f"the file name of --record must end in .html, got {record.name!r}")
        check_files([record], overwrite=overwrite, replace=REPLACE)
    shown = _find(target, console, robot_alone=robot)
    beside = shown.reference if reference is None else _load(reference)
    with mistakes(first_as_option):
        session = Session(
            shown.robot,
            shown.formulation,
            run=shown.run,
            reference=beside,
            estimate=shown.estimate,
            loop=shown.loop,
            speed=speed,
        )
        if live:
            session.go_live()
        found = View(session, Path(target).stem)
    if record is None:
        return found, None
    return found, found.record(record, overwrite=overwrite)


def _find(target: str, console: Console, *, robot_alone: bool) -> Shown:
    """Return what a name or a file stands for."""
    suffix = Path(target).suffix
    known = (*robots.names(), *scenarios.names())
    is_robot = is_one(target, robots.names())
    if is_one(target, scenarios.names()) and not (robot_alone and is_robot):
        return _scenario(find_scenario(target), console, robot_alone)
    if is_robot:
        return Shown(robot=find_robot(target))
    if suffix == ".nc":
        run = _load(target)
        shown = None if robot_alone else run
        return Shown(robot=run.model.robot, formulation=run.model.formulation, run=shown)
    if suffix == ".toml":
        with mistakes():
            is_robot = "sections" in read_toml(Path(target), "robot or scenario file")
        if is_robot:
            return Shown(robot=find_robot(target))
        return _scenario(find_scenario(target), console, robot_alone)
    if suffix == ".csv" and Path(target).is_file():
        raise Mistake(f"{target} holds numbers and no robot; give the run's file .nc")
    raise Mistake(
        f"{target!r} is no robot or scenario of `cdcr list`, no file .toml of one, and no run .nc."
        f"{nearest(target, known)}"
    )


def _scenario(scenario: Scenario, console: Console, robot_alone: bool) -> Shown:
    """Return the robot of a scenario alone, or run it, with a bar where that takes long."""
    if robot_alone:
        return Shown(robot=scenario.robot, formulation=scenario.formulation)
    with mistakes():
        scenario.times()
    source = scenario.input_source
    reference: Motion | None = None
    estimate: Motion | None = None
    loop: LoopMaker | None = None
    with DelayedBar(console, scenario.name, scenario.t_end) as bar, mistakes():
        if isinstance(source, ClosedLoop):
            model = scenario.model
            start = scenario.start(model), scenario.qd0
            found = source.run_loop(model, *start, scenario.times(), wrenches=scenario.wrenches)
            run = found.trajectory
            reference = source.controller.reference(np.asarray(run.t))
            estimate = None if source.estimator is None else found.told
            loop = _on_and_on(source, model)
        else:
            run = scenario.simulate(progress=_to(bar))
    if not run.success:
        console.print(f"cdcr: {run.message}", markup=False)
    if isinstance(source, TrackedMotion) and source.simulate:
        reference = source.reference(np.asarray(run.t))
    return Shown(
        robot=scenario.robot,
        formulation=scenario.formulation,
        run=run,
        reference=reference,
        estimate=estimate,
        loop=loop,
    )


def _on_and_on(source: ClosedLoop, model: Model) -> LoopMaker:
    """Return what makes the loop of a scenario around the robot that is simulated live."""

    def made(robot: Robot, around: Callable[[TrackingController], Controller]) -> Loop:
        return source.make(model, Model(robot, model.formulation), around)

    return made


def _to(bar: DelayedBar) -> Callable[[float], None]:
    return lambda time: bar(time)


def _load(path: str) -> Trajectory:
    with mistakes():
        return Trajectory.load(path)


@commands.command("view", short_help="Show a robot or a run in the browser, live.")
def view_command(
    target: Annotated[
        str,
        typer.Argument(
            metavar="ROBOT|SCENARIO|FILE",
            help="A name from `cdcr list`, a file .toml of a robot or a scenario, or a run .nc.",
            autocompletion=complete.shown,
        ),
    ],
    live: Annotated[
        bool, typer.Option("--live", help="Begin where the run does, but simulate at once.")
    ] = False,
    robot: Annotated[
        bool, typer.Option("--robot", help="Show the robot alone, simulated live, and no run.")
    ] = False,
    reference: Annotated[
        str | None, typer.Option(metavar="FILE.nc", help="A run to show beside it, faintly.")
    ] = None,
    speed: Annotated[
        float,
        typer.Option(
            metavar="NUMBER", parser=number, help="Time simulated or played over real time."
        ),
    ] = 1.0,
    port: Annotated[
        int,
        typer.Option(
            metavar="NUMBER",
            parser=whole_from(0, 65535),
            help="On this machine; 0 for any free one.",
        ),
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
    is both, the scenario is meant unless --robot is given. Sliders of the cables, gravity and
    payload, and the mouse, which pulls the backbone, go on from there live. Ctrl-C ends it, with
    exit code 0. On a recorded page a robot goes round in a circle.
    """
    with told_plainly():
        found, page = prepare(
            target,
            live=live,
            robot=robot,
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
