"""What ``cdcr view`` does: find what is meant, and serve it or write it as a page."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from rich.console import Console

from cdcr import robots, scenarios
from cdcr.base.check import nearest
from cdcr.base.extras import require
from cdcr.cli.run import DelayedBar, Mistake, find_robot, find_scenario, mistakes
from cdcr.files.new_file import check_files
from cdcr.files.toml import read_toml
from cdcr.robot.robot import Robot
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios import Scenario
from cdcr.scenarios.file.tracking import TrackedMotion

if TYPE_CHECKING:
    from cdcr.plotting.geometry import Motion
    from cdcr.view import View

REPLACE = "give --overwrite to replace it"


@dataclass(frozen=True, kw_only=True)
class Shown:
    """What is to be seen: a robot, or a run of it."""

    robot: Robot
    formulation: str = "exact"
    run: Trajectory | None = None
    reference: Motion | None = None


def view(
    target: str,
    *,
    live: bool,
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
    shown = _find(target, console)
    beside = shown.reference if reference is None else _load(reference)
    with mistakes():
        session = Session(
            shown.robot, shown.formulation, run=shown.run, reference=beside, speed=speed
        )
        if live:
            session.go_live()
        found = View(session, Path(target).stem)
    if record is None:
        return found, None
    return found, found.record(record, overwrite=overwrite)


def _find(target: str, console: Console) -> Shown:
    """Return what a name or a file stands for."""
    suffix = Path(target).suffix
    known = (*robots.names(), *scenarios.names())
    if _is_one(target, scenarios.names()):
        return _run(find_scenario(target), console)
    if _is_one(target, robots.names()):
        return Shown(robot=find_robot(target))
    if suffix == ".nc":
        run = _load(target)
        return Shown(robot=run.model.robot, formulation=run.model.formulation, run=run)
    if suffix == ".toml":
        with mistakes():
            is_robot = "sections" in read_toml(Path(target), "robot or scenario file")
        return Shown(robot=find_robot(target)) if is_robot else _run(find_scenario(target), console)
    if suffix == ".csv" and Path(target).is_file():
        raise Mistake(f"{target} holds numbers and no robot; give the run's file .nc")
    raise Mistake(
        f"{target!r} is no robot or scenario of `cdcr list`, no file .toml of one, and no run .nc."
        f"{nearest(target, known)}"
    )


def _is_one(name: str, known: tuple[str, ...]) -> bool:
    return name.replace("_", "-") in (one.replace("_", "-") for one in known)


def _run(scenario: Scenario, console: Console) -> Shown:
    """Run a scenario, with a bar where it takes long."""
    with mistakes():
        scenario.times()
    with DelayedBar(console, scenario.name, scenario.t_end) as bar, mistakes():
        run = scenario.simulate(progress=_to(bar))
    if not run.success:
        console.print(f"cdcr: {run.message}", markup=False)
    source = scenario.input_source
    reference = None
    if isinstance(source, TrackedMotion) and source.simulate:
        reference = source.reference(np.asarray(run.t))
    return Shown(
        robot=scenario.robot, formulation=scenario.formulation, run=run, reference=reference
    )


def _to(bar: DelayedBar) -> Callable[[float], None]:
    return lambda time: bar(time)


def _load(path: str) -> Trajectory:
    with mistakes():
        return Trajectory.load(path)
