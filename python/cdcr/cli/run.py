"""What ``cdcr run`` does: check first, run, then write all files or none."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from cdcr import robots, scenarios
from cdcr.base.extras import require
from cdcr.cli.complete import FILMS
from cdcr.files.new_file import check_files, new_files
from cdcr.model.model import Model
from cdcr.robot.robot import Robot
from cdcr.runs.save import write_run
from cdcr.runs.stats import STATS
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios import Scenario
from cdcr.scenarios.file.reader import load_scenario
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import FILES

# Files of a run, the modules they are written with, and the extras that bring these.
NEEDED = {
    ".png": (("matplotlib", "plot"),),
    ".csv": (),
    ".mcap": (("mcap", "mcap"),),
    ".nc": (("xarray", "data"), ("h5netcdf", "data"), ("h5py", "data")),
}
REPLACE = "give --overwrite to replace, or another folder with --out"
# Of what other messages begin with.
_FIRST = r"^(speed|fmi|steps?|acados|links|samples|seed|jobs)\b(?= must| of | are )"
_ARGUMENTS = r"\b(t_end|method|rtol|atol|max_steps)\b"  # options too, with dashes
LONGEST_FILM = 60.0  # longer runs are played faster [s]
BAR_DELAY = 1.0  # shorter runs show no progress bar [s]


class RunFailed(Exception):
    """The integration ended before its time."""


class Mistake(Exception):
    """Something the user can mend in the command or in a file."""


def as_options(message: str) -> str:
    """Return a message about arguments of `Scenario.simulate` in the words of `cdcr run`."""
    return re.sub(_ARGUMENTS, lambda word: f"--{word[0].replace('_', '-')}", message)


def first_as_option(message: str) -> str:
    """Return a message that begins with an argument in the words of the command line."""
    return re.sub(_FIRST, r"--\1", message)


@contextmanager
def mistakes(words: Callable[[str], str] = str) -> Iterator[None]:
    """Take a ValueError for a mistake of the user: only where user's values are looked at."""
    try:
        yield
    except ValueError as error:
        raise Mistake(words(str(error))) from error


@dataclass(frozen=True, kw_only=True, eq=False)
class Report:
    """A scenario from the command line and what came of it; no run where nothing runs in it."""

    scenario: Scenario
    metrics: tuple[Metric, ...]
    files: tuple[Path, ...]
    method: str = ""
    run: Trajectory | None = None
    wall_time: float = 0.0  # of the integration alone [s]

    def as_dict(self) -> dict[str, Any]:
        """Return everything as JSON has it."""
        told = {
            "scenario": self.scenario.name,
            "title": self.scenario.title,
            "source": self.scenario.source,
            "robot": asdict(self.scenario.robot),
            "formulation": self.scenario.formulation,
            "findings": {metric.key: metric.value for metric in self.metrics},
            "files": [str(path) for path in self.files],
        }
        run = self.run
        if run is None:
            return told
        return told | {
            "method": self.method,
            "t_end": float(run.t[-1]),
            "num_samples": len(run),
            "success": run.success,
            "status": run.status.name,
            "message": run.message,
            "chosen_method": run.stats.method,
            "stiff_from_s": run.stats.stiff,
            "stats": {name: getattr(run.stats, name) for name in STATS},
            "wall_time_s": self.wall_time,
        }


def run(
    name: str,
    out: Path,
    *,
    overwrite: bool,
    console: Console,
    size: str | None = None,
    formats: Collection[str] = (),
    film: str | None = None,
    own: Collection[Path] = (),
    **options: Any,
) -> Report:
    """Run a scenario by name or file and write its files; of a failed run its numbers.

    `formats` are those of its files in place of the scenario's own, `film` is that of a film to
    write too; files in `own` may be replaced. `options` are those of `Scenario.simulate`, None
    where not given.
    """
    scenario = find_scenario(name)
    if not scenario.has_run:
        _refuse_options(scenario, options | {"film": film, "format": formats or None})
        return _picture(scenario, out, overwrite=overwrite, size=size)
    _check_film(film)
    files = (*_files(scenario, formats), *([f".{film}"] if film else ()))
    targets = tuple(out / f"{scenario.name}{suffix}" for suffix in files)
    there = {path for path in targets if path.exists()}
    overwrite = overwrite or (bool(there) and there <= set(own))
    of_integrator = {key: value for key, value in options.items() if key != "t_end"}
    with mistakes(as_options):
        scenario.times(options["t_end"])
        scenario.options(**of_integrator)
    for suffix in files:
        for module, extra in NEEDED.get(suffix, ()):
            require(module, extra)
    check_size(size)
    check_files(targets, overwrite=overwrite, replace=REPLACE)
    with DelayedBar(console, scenario.name, options["t_end"] or scenario.t_end, real=True) as bar:
        start = time.perf_counter()
        with mistakes():
            trajectory = scenario.simulate(**options, progress=bar)
        wall_time = time.perf_counter() - start
    if not trajectory.success:
        targets, overwrite = _incomplete(targets), True
    write(scenario, trajectory, targets, overwrite=overwrite, size=size, console=console)
    return Report(
        scenario=scenario,
        method=options["method"] or scenario.method,
        run=trajectory,
        wall_time=wall_time,
        metrics=scenario.summary(trajectory) if trajectory.success else (),
        files=targets,
    )


def _incomplete(targets: tuple[Path, ...]) -> tuple[Path, ...]:
    """Return the files of numbers that a failed run leaves, under names that say so."""
    numbers = [path for path in targets if path.suffix in FILES.values() and path.suffix != ".png"]
    numbers = numbers or [targets[0].with_suffix(".csv")]
    return tuple(path.with_stem(f"{path.stem}-incomplete") for path in numbers)


def _refuse_options(scenario: Scenario, given: dict[str, Any]) -> None:
    pointless = [f"--{key.replace('_', '-')}" for key, value in given.items() if value is not None]
    if pointless:
        raise Mistake(
            f"nothing runs in the scenario {scenario.name!r}, so it takes no {', '.join(pointless)}"
        )


def check_size(size: str | None) -> None:
    """Refuse a size that no picture has."""
    if size is not None:
        require("matplotlib", "plot")
        from cdcr.plotting.sizes import checked_size

        with mistakes(lambda message: f"--{message}"):
            checked_size(size)


def _files(scenario: Scenario, formats: Collection[str]) -> tuple[str, ...]:
    """Return the suffixes of the files to write: the scenario's own, or those of some formats."""
    for one in formats:
        if one not in FILES:
            raise Mistake(f"--format must be one of {', '.join(FILES)}, got {one!r}")
    return tuple(FILES[one] for one in FILES if one in formats) or scenario.files


def _check_film(film: str | None) -> None:
    """Refuse a kind of film that cannot be written."""
    if film is not None:
        require("matplotlib", "plot")
        from cdcr.plotting.video import film_path

        if film not in FILMS:
            raise Mistake(f"--film must be one of {', '.join(FILMS)}, got {film!r}")
        try:
            film_path(Path(f"film.{film}"))
        except RuntimeError as error:
            raise Mistake(str(error).replace("writing film.", "--film ")) from error


def _picture(scenario: Scenario, out: Path, *, overwrite: bool, size: str | None) -> Report:
    """Draw a scenario in which nothing runs."""
    targets = (out / f"{scenario.name}.png",)
    check_size(size)
    check_files(targets, overwrite=overwrite, replace=REPLACE)
    require("matplotlib", "plot")
    write(scenario, None, targets, overwrite=overwrite, size=size)
    return Report(scenario=scenario, metrics=scenario.summary(), files=targets)


def find_scenario(name: str) -> Scenario:
    """Return a scenario of the package by name, or a user's one by its file."""
    with mistakes():
        if is_scenario_file(name):
            return load_scenario(name)
        if not is_one(name, scenarios.names()) and is_one(name, robots.names()):
            raise Mistake(f"{name} is a robot: `cdcr info {name}` or `cdcr view {name}`")
        return scenarios.get(name)


def is_scenario_file(name: str) -> bool:
    """Return whether a user's file is meant, not a scenario of the package."""
    return _is_file(name, scenarios.names())


def find_robot(name: str) -> Robot:
    """Return a robot of the package by name, or a user's one by its file."""
    with mistakes():
        if _is_file(name, robots.names()):
            return load_robot(Path(name))
        if not is_one(name, robots.names()) and is_one(name, scenarios.names()):
            raise Mistake(f"{name} is a scenario: `cdcr run {name}` or `cdcr view {name}`")
        return robots.get(name)


def load_robot(path: Path) -> Robot:
    """Return the robot of a file, or refuse one of which there is no model."""
    robot = Robot.load(path)
    try:
        Model(robot)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    return robot


def _is_file(name: str, known: tuple[str, ...]) -> bool:
    return not is_one(name, known) and (name.endswith(".toml") or Path(name).is_file())


def is_one(name: str, known: tuple[str, ...]) -> bool:
    """Return whether a name is one of the known ones, with dashes or underscores."""
    return name.replace("_", "-") in (one.replace("_", "-") for one in known)


def write(
    scenario: Scenario,
    run: Trajectory | None,
    targets: tuple[Path, ...],
    *,
    overwrite: bool,
    size: str | None = None,
    console: Console | None = None,
) -> None:
    """Write pictures and data of a run; they appear together when all are complete."""
    with new_files(targets, overwrite=overwrite, replace=REPLACE) as parts:
        for part, target in zip(parts, targets, strict=True):
            if target.suffix == ".png":
                scenario.figure(run, size=size).savefig(part, format="png")
            elif run is not None and target.suffix[1:] in FILMS:
                _write_film(run, part, target, size, console or Console(quiet=True))
            elif run is not None:
                write_run(run, part, target.suffix)


def _write_film(
    run: Trajectory, part: Path, target: Path, size: str | None, console: Console
) -> None:
    from cdcr.plotting.animation import write_frames

    speed = max(1.0, float(run.t[-1] - run.t[0]) / LONGEST_FILM)
    with DelayedBar(console, target.name, 1.0) as bar:
        write_frames(
            run,
            part,
            target.suffix,
            speed=speed,
            size=size,
            progress=lambda done, total: bar(done / total),
        )


class DelayedBar:
    """A progress bar on a terminal, for what lasts longer than BAR_DELAY.

    What is left is estimated. Of a run in time, which is `real`, it also tells the time simulated
    and how many times faster than real time it was.
    """

    def __init__(self, console: Console, name: str, total: float, *, real: bool = False) -> None:
        self._bar = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            TaskProgressColumn(),
            *([TextColumn("{task.fields[told]}")] if real else []),
            TimeRemainingColumn(),
            TextColumn("left"),
            console=console,
            transient=True,
        )
        self._total = total
        self._task = self._bar.add_task(name, total=total, told="")
        self._start = time.monotonic()
        self._shown_from = self._start + BAR_DELAY
        self._is_shown = False

    def __enter__(self) -> DelayedBar:
        return self

    def __call__(self, done: float, name: str | None = None) -> None:
        """Show how much is done, such as the time reached [s], and of what."""
        is_late = time.monotonic() >= self._shown_from
        if is_late and not self._is_shown and self._bar.console.is_terminal:
            self._bar.start()
            self._is_shown = True
        speed = done / max(time.monotonic() - self._start, 1e-9)
        told = f"{done:.4g} of {self._total:g} s, {speed:.3g} times real time"
        self._bar.update(self._task, completed=done, description=name, told=told)

    def __exit__(self, *_: object) -> None:
        if self._is_shown:
            self._bar.stop()
