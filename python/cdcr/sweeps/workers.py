"""Where chunks are computed: processes or threads of this machine, an executor, or Dask."""

from __future__ import annotations

import signal
import warnings
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ThreadPoolExecutor,
    wait,
)
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from logging import CRITICAL
from typing import Any, TypeAlias

from cdcr.base import processes
from cdcr.base.check import Check, format_value
from cdcr.base.extras import require
from cdcr.sweeps.jobs import Chunk, Done, Job, compute

LOCAL = "local"  # in place of a scheduler's address: a cluster of this machine
ANSWER = 5.0  # within which a scheduler has to answer [s]
AHEAD = 2  # chunks for each worker that are sent at once
UNKNOWN = 16  # workers of an executor that does not tell
_JOBS = "a whole number >= 1"
_LOST = ("KilledWorker", "CommClosedError", "FutureCancelledError")  # of Dask

Chunks: TypeAlias = Iterable[Chunk]


class WorkersLost(Exception):
    """The processes that computed have ended before their time."""


@dataclass(frozen=True)
class Workers:
    """Those who compute chunks: how they do it, and how many they are at the moment."""

    run: Callable[[Job, Chunks], Generator[Done]]
    number: Callable[[], int]


@contextmanager
def workers(
    job: Job, executor: Any, scheduler: str | None, jobs: int | None, most: int
) -> Iterator[Workers]:
    """Give those who compute; what was started for it has ended afterwards.

    They are an executor or a client of Dask, those of a scheduler of Dask, or, where neither is
    given, `jobs` processes of this machine, which are threads where a function is the user's. There
    is no use for more than `most` of them.
    """
    check = Check()
    own = processes.usable() if jobs is None else check.whole("jobs", jobs, _JOBS, low=1)
    check.done()
    own = min(own, most)
    if executor is not None and (scheduler is not None or jobs is not None):
        raise ValueError("give either an executor, or scheduler and jobs")
    if scheduler not in (None, LOCAL) and jobs is not None:
        raise ValueError(f"jobs are for this machine, and {scheduler} has workers of its own")
    if executor is not None:
        yield _of_executor(executor)
    elif scheduler is not None:
        with _cluster(scheduler, own) as client:
            yield _of_client(client)
    elif job.is_plain:
        yield Workers(partial(_by_processes, number=own), lambda: own)
    else:
        with _threads(own) as pool:
            yield _of_executor(pool)


def _by_processes(job: Job, chunks: Chunks, number: int) -> Generator[Done]:
    try:
        for _, done in processes.results(partial(compute, job), chunks, number):
            yield done
    except processes.JobFailed as failure:
        if failure.__cause__ is not None:
            raise failure.__cause__ from None
        if failure.reason.startswith("its process ended"):
            raise WorkersLost(failure.reason) from None
        raise RuntimeError(failure.reason) from None


@contextmanager
def _threads(number: int) -> Iterator[Executor]:
    pool = ThreadPoolExecutor(number)
    try:
        yield pool
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _of_executor(executor: Any) -> Workers:
    if hasattr(executor, "get_executor"):
        return _of_client(executor)
    if not isinstance(executor, Executor):
        must = "a concurrent.futures.Executor or a dask.distributed.Client"
        raise TypeError(f"executor must be {must}, got {format_value(executor)}")
    number = getattr(executor, "_max_workers", UNKNOWN)
    return Workers(partial(_by_executor, executor=executor, number=lambda: number), lambda: number)


def _of_client(client: Any) -> Workers:
    def number() -> int:
        return max(1, sum(map(int, client.nthreads().values())))

    executor = client.get_executor(pure=False)
    return Workers(partial(_by_executor, executor=executor, number=number), number)


def _by_executor(
    job: Job, chunks: Chunks, executor: Executor, number: Callable[[], int]
) -> Generator[Done]:
    waiting, pending = iter(chunks), list[Future[Done]]()
    try:
        while True:
            for chunk in _first(waiting, AHEAD * number() - len(pending)):
                pending.append(executor.submit(compute, job, chunk))
            if not pending:
                return
            done, _ = wait(pending, return_when=FIRST_COMPLETED)
            # In the order in which they were sent, which one worker keeps to.
            ready = [future for future in pending if future in done]
            pending = [future for future in pending if future not in done]
            for future in ready:
                yield _result(future)
    finally:
        for future in pending:
            future.cancel()


def _first(chunks: Iterator[Chunk], number: int) -> Iterator[Chunk]:
    """Yield so many of the next chunks, none of which is taken and not given."""
    for _ in range(number):
        chunk = next(chunks, None)
        if chunk is None:
            return
        yield chunk


def _result(future: Future[Done]) -> Done:
    try:
        return future.result()
    except BrokenExecutor as error:
        raise WorkersLost(f"a process of the executor ended: {error}") from None
    except ModuleNotFoundError as error:
        if error.name != "cdcr":
            raise
        raise RuntimeError("the workers cannot import cdcr: install it where they run") from None
    except Exception as error:
        if type(error).__name__ in _LOST:
            raise WorkersLost(str(error)) from None
        raise


@contextmanager
def _cluster(scheduler: str, jobs: int) -> Iterator[Any]:
    """Give a client of Dask, of a cluster of this machine or of a scheduler elsewhere."""
    distributed: Any = require("distributed", "dask")
    if scheduler == LOCAL:
        with _started_once(), _deaf_to_control_c():
            cluster = distributed.LocalCluster(
                n_workers=jobs, threads_per_worker=1, dashboard_address=None, silence_logs=CRITICAL
            )
        with cluster, distributed.Client(cluster) as client:
            yield client
        return
    try:
        client = distributed.Client(scheduler, timeout=ANSWER)
    except Exception as error:  # of many kinds, the more so where something else answers
        reason = str(error).partition("\n")[0]
        raise OSError(f"no scheduler of Dask answers at {scheduler}: {reason}") from None
    with client:
        if not client.nthreads():
            warnings.warn(f"the scheduler at {scheduler} has no workers yet", stacklevel=2)
        yield client


@contextmanager
def _started_once() -> Iterator[None]:
    """Say why processes do not start that import the script which starts them."""
    try:
        yield
    except RuntimeError as error:
        raise RuntimeError(
            f"a cluster of this machine does not start ({error}): in a script, what starts it must "
            'stand under `if __name__ == "__main__":`'
        ) from None


@contextmanager
def _deaf_to_control_c() -> Iterator[None]:
    """Keep Ctrl-C, which reaches all processes of a terminal, from those that start here."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
