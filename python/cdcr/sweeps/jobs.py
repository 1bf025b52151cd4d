"""What is computed of a sweep, wherever that is: the runs of some rows, and their metrics."""

from __future__ import annotations

import copy
import inspect
import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import NamedTuple, TypeAlias

from cdcr import scenarios
from cdcr._core import __version__
from cdcr.base.arrays import FloatArray
from cdcr.base.check import known_name, nearest
from cdcr.robot.numbers import Table, put, refuse_shared
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.file.whole import scenario_from_table, whole_table
from cdcr.scenarios.scenario import Scenario
from cdcr.sweeps.metrics import Asked, values_of
from cdcr.sweeps.paths import places

REFUSED = "refused"  # status of a run that did not begin
# What values of parameters may do to a robot; anything else is a fault of the program.
Refusal = (ValueError, RuntimeError, ArithmeticError)

Ran: TypeAlias = tuple[Scenario | None, Trajectory]


@dataclass(frozen=True, eq=False)
class FileSource:
    """Runs of a scenario file, of which it holds all: it needs no file where it is computed."""

    file: Path
    table: Table
    names: tuple[str, ...]

    def scenario(self, row: Sequence[float]) -> Scenario:
        """Return the scenario with values of the parameters."""
        table = copy.deepcopy(self.table)
        found = [places(table, name) for name in self.names]
        for there, value in zip(found, row, strict=True):
            put(there, value)
        return scenario_from_table(table, self.file)

    def run(self, row: Sequence[float]) -> Ran:
        """Run it."""
        scenario = self.scenario(row)
        return scenario, scenario.simulate()


@dataclass(frozen=True, eq=False)
class FunctionSource:
    """Runs that a function of the user's gives."""

    function: Callable[..., Trajectory]
    names: tuple[str, ...]

    def run(self, row: Sequence[float]) -> Ran:
        """Call it."""
        run = self.function(**dict(zip(self.names, row, strict=True)))
        if not isinstance(run, Trajectory):
            raise TypeError(f"what is swept must return a run, got {type(run).__name__}")
        return None, run


Source: TypeAlias = FileSource | FunctionSource


def file_source(source: str | PathLike[str], names: tuple[str, ...]) -> FileSource:
    """Return the runs of a scenario, by name or file, or refuse it or parameters."""
    is_known = isinstance(source, str) and source.replace("_", "-") in scenarios.names()
    if isinstance(source, str) and source == Path(source).stem and not Path(source).exists():
        source = known_name("scenario", source, scenarios.names())  # or refuses it
    file = scenarios.source_file(str(source)) if is_known else Path(source)
    table = whole_table(file)
    refuse_shared({name: places(table, name) for name in names})
    return FileSource(Path(file.name) if is_known else file, table, names)


def function_source(function: Callable[..., Trajectory], names: tuple[str, ...]) -> FunctionSource:
    """Return the runs of a function, or refuse parameters that it does not take."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):  # of what is not written in Python
        return FunctionSource(function, names)
    by_keyword = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    known = [one.name for one in parameters if one.kind in by_keyword]
    takes_any = any(one.kind is inspect.Parameter.VAR_KEYWORD for one in parameters)
    for name in () if takes_any else names:
        if name not in known:
            listed = f"Known: {', '.join(known)}" if known else "The function takes none"
            raise ValueError(f"there is no parameter {name!r}.{nearest(name, known)} {listed}")
    missing = [
        one.name
        for one in parameters
        if one.kind in by_keyword and one.default is one.empty and one.name not in names
    ]
    if missing:
        raise ValueError(f"the function needs a parameter {missing[0]!r} that is not swept")
    return FunctionSource(function, names)


class Outcome(NamedTuple):
    """What is kept of a run: its metrics, how it ended, and why where that was not well."""

    values: tuple[float, ...]
    status: str
    message: str


@dataclass(frozen=True, eq=False)
class Job:
    """A sweep, as those who compute parts of it are told."""

    source: Source
    metrics: tuple[Asked, ...]
    version: str = __version__

    @property
    def is_plain(self) -> bool:
        """Whether it holds nothing but data, so that any process of this machine can take it."""
        own = any(one.function is not None for one in self.metrics)
        return isinstance(self.source, FileSource) and not own


class Chunk(NamedTuple):
    """Runs that are computed together: their numbers, and their values (k, d)."""

    numbers: tuple[int, ...]
    rows: FloatArray


class Done(NamedTuple):
    """A chunk that has been computed, and how long that took [s]."""

    numbers: tuple[int, ...]
    outcomes: tuple[Outcome, ...]
    seconds: float


def compute(job: Job, chunk: Chunk) -> Done:
    """Compute a chunk: the one thing that is called on other machines."""
    if job.version != __version__:
        raise RuntimeError(
            f"the sweep is of cdcr {job.version}, and {__version__} is installed where it runs"
        )
    start = time.perf_counter()
    outcomes = tuple(_outcomes(job, chunk.rows))
    return Done(chunk.numbers, outcomes, time.perf_counter() - start)


def _outcomes(job: Job, rows: FloatArray) -> Iterator[Outcome]:
    for ran in _runs(job.source, rows):
        if isinstance(ran, Exception):
            yield _nothing(job, REFUSED, str(ran))
            continue
        scenario, run = ran
        if not run.success:
            yield _nothing(job, run.status.name, run.message)
            continue
        try:
            yield Outcome(tuple(values_of(job.metrics, scenario, run)), run.status.name, "")
        except Refusal as error:
            yield _nothing(job, run.status.name, f"its metrics failed: {error}")


def _runs(source: Source, rows: FloatArray) -> Iterator[Ran | Exception]:
    """Yield the run of each row, or what its values did to it; a batch of the core fits here."""
    for row in rows.tolist():
        try:
            yield source.run(row)
        except Refusal as error:
            yield error


def _nothing(job: Job, status: str, message: str) -> Outcome:
    return Outcome((math.nan,) * len(job.metrics), status, message)
