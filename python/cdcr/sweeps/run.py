"""Sweeps: many runs that differ in parameters, shared out, kept as they finish."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing
from functools import partial
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, format_value, require_truth
from cdcr.base.extras import require
from cdcr.files.new_file import REPLACE, file_path
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.sweeps import result
from cdcr.sweeps.design import Design, Values, make_design
from cdcr.sweeps.jobs import (
    Chunk,
    Done,
    FileSource,
    Job,
    Outcome,
    Refusal,
    file_source,
    function_source,
)
from cdcr.sweeps.metrics import MetricNames, find_metrics
from cdcr.sweeps.paths import unit
from cdcr.sweeps.store import Store, differences, partial_path, store
from cdcr.sweeps.workers import AHEAD, LOCAL, Workers, WorkersLost, workers

if TYPE_CHECKING:
    import xarray

SECONDS = 1.0  # that a chunk takes, as near as it can be told
LARGEST = 1000  # runs of a chunk
ATTEMPTS = 3  # of processes that end without a chunk in between
_SWEPT = "the name of a scenario, a scenario file or a function that returns a run"

Progress: TypeAlias = Callable[[int, int], object]


def sweep(
    source: str | PathLike[str] | Callable[..., Trajectory],
    parameters: Mapping[str, Values] | Iterable[str],
    *,
    metrics: MetricNames,
    samples: str | ArrayLike | None = None,
    seed: int = 0,
    path: str | PathLike[str] | None = None,
    overwrite: bool = False,
    executor: Any = None,
    scheduler: str | None = None,
    jobs: int | None = None,
    chunk: int | None = None,
    progress: Progress | None = None,
) -> xarray.Dataset:
    """Run a scenario for many values of its parameters, and keep numbers of each run.

    Runs are shared out over processes of this machine, an executor or a cluster of Dask, and the
    result is the same wherever they are computed. Needs the extra ``sweep``.

    Parameters
    ----------
    source : str or path or callable
        A scenario by name or file, or a function that takes the parameters by keyword and returns
        a `Trajectory`.
    parameters : mapping or iterable of str
        Values of each parameter: a sequence for a grid; where they are sampled, a pair (low, high)
        or a distribution with ``ppf``, such as ``scipy.stats.norm(0.1, 0.01)``. Of a scenario they
        are paths to numbers as they stand in its file, ``"sections.1.youngs_modulus"``,
        ``"payload"``, ``"gravity.z"``, ``"tension.1"``, ``"controller.kp"``, ``"t_end"``; what is
        left of the robot's table counts as its own, entries count from 1, and ``*`` is all of them.
        Names alone where `samples` are values.
    metrics : str, callable, or a sequence or mapping of them
        Names of `cdcr.sweeps.METRICS` or of the scenario's summary, or functions of a run that
        return a number.
    samples : str or (N, d) array_like, optional
        Without it, all pairs of the values: a grid. "sobol:N", "lhs:N" (Latin hypercube) or
        "random:N" are N points; "saltelli:N" are N (d + 2), from which `sobol_indices` tells what
        each parameter does. An array is the values themselves, a row for each run.
    seed : int, optional
        Of what is drawn.
    path : str or path, optional
        A file .nc, or a folder .zarr (extra ``zarr``). Finished runs are kept beside it meanwhile,
        in a file whose name ends in .partial, and the same sweep goes on from there.
    overwrite : bool, optional
        Whether another sweep at that place may be replaced.

    Returns
    -------
    xarray.Dataset
        Each metric, and ``status`` and ``message`` of each run, along the parameters of a grid, or
        along ``run``. A metric of a run that failed is NaN.

    Other Parameters
    ----------------
    executor : concurrent.futures.Executor or dask.distributed.Client, optional
        Where the runs are computed. By default in processes of this machine, in threads where the
        source or a metric is a function.
    scheduler : str, optional
        "local", a cluster of Dask of this machine, or the address of a scheduler, such as
        ``"tcp://10.0.0.1:8786"`` (extra ``dask``).
    jobs : int, optional
        Number of processes or threads of this machine; by default that of its processors.
    chunk : int, optional
        Runs that are computed together; by default as many as take a second.
    progress : callable, optional
        Told how many runs are done, and of how many.

    Raises
    ------
    ValueError
        For a parameter or a metric that there is not, with those there are; for values, samples or
        a scenario that cannot be.
    FileExistsError
        Where another sweep is at `path`, or another process writes to it.
    OSError
        Where no scheduler answers.
    RuntimeError
        Where those who compute end before their time. Finished runs stay.

    Examples
    --------
    >>> import cdcr
    >>> found = cdcr.sweep(
    ...     "step-tension",
    ...     {"payload": [0.0, 0.02], "tension.1": [2.0, 4.0, 6.0]},
    ...     metrics=["peak_theta", "peak_tip_speed"],
    ...     jobs=1,
    ... )
    >>> found.peak_theta.sel({"payload": 0.02}).values.round(3)
    array([0.209, 0.418, 0.627])
    """
    require("xarray", "sweep")
    check = Check()
    if chunk is not None:
        check.whole("chunk", chunk, f"a whole number 1 to {LARGEST}", low=1, high=LARGEST)
    check.done()
    require_truth("overwrite", overwrite)
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function of two numbers, got {format_value(progress)}")
    if scheduler is not None and not isinstance(scheduler, str):
        must = f"an address, such as 'tcp://10.0.0.1:8786', or {LOCAL!r}"
        raise TypeError(f"scheduler must be {must}, got {format_value(scheduler)}")
    target = None if path is None else file_path(path)
    if target is not None:
        result.check_path(target)
    design = make_design(parameters, samples, seed)
    job = _job(source, design, metrics)
    _check_names(job, design)
    about = _about(job, design)
    if target is not None and target.exists() and not overwrite:
        return _known(target, about)
    with ExitStack() as stack:
        kept: Store | None = None
        if target is not None:
            kept = stack.enter_context(store(partial_path(target), about, overwrite=overwrite))
            if target.exists() and not overwrite:  # since a moment ago
                kept.remove()
                return _known(target, about)
        work = _Work(job, design.rows, kept, chunk, progress)
        work.compute(executor, scheduler, jobs)
        units = {name: unit(name) for name in design.names if isinstance(job.source, FileSource)}
        found = result.make_dataset(design, job.metrics, work.outcomes, units, about)
        if target is not None and kept is not None:
            result.write(found, target, overwrite=overwrite)
            kept.remove()
    return found


def _job(source: Any, design: Design, metrics: MetricNames) -> Job:
    """Return what is computed, or refuse source, parameters or metrics."""
    if callable(source):
        return Job(function_source(source, design.names), find_metrics(metrics, tuple))
    if not isinstance(source, (str, PathLike)):
        raise TypeError(f"what is swept must be {_SWEPT}, got {format_value(source)}")
    runs = file_source(source, design.names)
    _check_values(runs, design)
    return Job(runs, find_metrics(metrics, partial(_summary, runs)))


def _check_names(job: Job, design: Design) -> None:
    """Refuse metrics with names that the result has for something else."""
    for metric in job.metrics:
        if metric.name in design.names:
            raise ValueError(f"metric {metric.name!r} must not have the name of a parameter")
        if metric.name in result.NAMES:
            raise ValueError(f"metric {metric.name!r} must not have a name of the result itself")


def _summary(runs: FileSource) -> Sequence[Metric]:
    """Return the summary of the scenario as it is."""
    scenario, run = FileSource(runs.file, runs.table, ()).run(())
    if scenario is None or not run.success:
        raise ValueError(f"{runs.file} does not run, so it has no summary: {run.message}")
    return scenario.summary(run)


def _check_values(runs: FileSource, design: Design) -> None:
    """Refuse the least or the largest value of a parameter where no run can take it."""
    for i, name in enumerate(design.names):
        for k in (int(np.argmin(design.rows[:, i])), int(np.argmax(design.rows[:, i]))):
            row = design.rows[k].tolist()
            alone = FileSource(runs.file, runs.table, (name,))
            refused = _refusal(alone, [row[i]])
            if refused and _refusal(runs, row):
                raise ValueError(f"parameter {name!r} cannot be {row[i]:g}: {refused}")


def _refusal(runs: FileSource, row: Sequence[float]) -> str:
    try:
        runs.scenario(row)
    except Refusal as error:
        return str(error).partition("\n")[0]
    return ""


def _about(job: Job, design: Design) -> dict[str, Any]:
    """Return what makes a sweep another one."""
    if isinstance(job.source, FileSource):
        table = json.dumps(job.source.table, sort_keys=True, default=str)
        source = f"{job.source.file.stem} {_digest(table.encode())}"
    else:
        source = getattr(job.source.function, "__qualname__", type(job.source.function).__name__)
    return {
        "version": job.version,
        "source": source,
        "parameters": list(design.names),
        "values": _digest(np.ascontiguousarray(design.rows).tobytes()),
        "metrics": [metric.name for metric in job.metrics],
    }


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:16]


def _known(target: Path, about: Mapping[str, Any]) -> xarray.Dataset:
    """Return the sweep that a file holds where it is the one that is asked for."""
    found = result.read(target)
    different = differences(about, json.loads(found.attrs["sweep"]))
    if different:
        raise FileExistsError(f"{target} exists already, of a sweep with {different}; {REPLACE}")
    return found


class _Work:
    """The runs of a sweep: which are finished, and the next to compute."""

    def __init__(
        self,
        job: Job,
        rows: FloatArray,
        kept: Store | None,
        chunk: int | None,
        progress: Progress | None,
    ) -> None:
        self.job, self.rows, self.kept, self.chunk = job, rows, kept, chunk
        self.progress = progress or (lambda done, total: None)
        self.outcomes: dict[int, Outcome] = {} if kept is None else kept.outcomes
        self.seconds, self.timed = 0.0, 0  # of runs computed now, and their number

    def compute(self, executor: Any, scheduler: str | None, jobs: int | None) -> None:
        """Compute what is missing; processes of our own that end early are started again."""
        left = ATTEMPTS if executor is None and scheduler is None else 1
        self.progress(len(self.outcomes), len(self.rows))
        while missing := [i for i in range(len(self.rows)) if i not in self.outcomes]:
            before = len(self.outcomes)
            with workers(self.job, executor, scheduler, jobs, len(missing)) as crew:
                try:
                    with closing(crew.run(self.job, self._chunks(missing, crew))) as computed:
                        for done in computed:
                            self._take(done)
                except WorkersLost as error:
                    left = ATTEMPTS if len(self.outcomes) > before and left > 1 else left - 1
                    if not left:
                        raise RuntimeError(f"{error}; {self._finished()}") from None

    def _chunks(self, missing: Sequence[int], crew: Workers) -> Iterator[Chunk]:
        """Yield the missing runs, as many at once as take about a second, and fewer at the end."""
        at = 0
        while at < len(missing):
            share = -(-(len(missing) - at) // (AHEAD * crew.number()))
            timely = int(SECONDS * self.timed / self.seconds) if self.seconds else 1
            size = self.chunk or max(1, min(timely, share, LARGEST))
            numbers = tuple(missing[at : at + size])
            yield Chunk(numbers, self.rows[list(numbers)])
            at += size

    def _take(self, done: Done) -> None:
        if self.kept is None:
            self.outcomes.update(zip(done.numbers, done.outcomes, strict=True))
        else:
            self.kept.keep(done)
        self.seconds += done.seconds
        self.timed += len(done.numbers)
        self.progress(len(self.outcomes), len(self.rows))

    def _finished(self) -> str:
        told = f"{len(self.outcomes)} of {len(self.rows)} runs are finished"
        return told if self.kept is None else f"{told}; the same sweep goes on from there"
