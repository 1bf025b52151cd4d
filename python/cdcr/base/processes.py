"""One function of many arguments, computed by several processes of this machine.

The processes are plain ones that run this module: they take arguments from their standard input
and answer on their standard output. They own no files, and end with the process that started them.
"""

from __future__ import annotations

import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator, Sized
from contextlib import contextmanager, suppress
from selectors import EVENT_READ, DefaultSelector
from typing import Any, BinaryIO

# What a process runs; what it may import comes first through its standard input.
_PROGRAM = (
    "import pickle, sys; sys.path[:] = pickle.load(sys.stdin.buffer); "
    f"from {__name__} import serve; serve()"
)


class JobFailed(Exception):
    """One of the computations failed; `job` is its place among the arguments."""

    def __init__(self, job: int, reason: str) -> None:
        super().__init__(job, reason)
        self.job, self.reason = job, reason


def usable() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1


def results(
    function: Callable[[Any], Any], arguments: Iterable[Any], processes: int
) -> Iterator[tuple[int, Any]]:
    """Yield the place of each argument and what the function gives for it, as they are ready.

    One process, which is this one, takes them in order. Of several, none is left when this ends,
    whatever the reason; function, arguments and results are pickled. An argument is asked for when
    a process is free to take it.

    Raises
    ------
    JobFailed
        Where the function does, or a process ends before its time.
    """
    if isinstance(arguments, Sized):
        processes = min(processes, len(arguments))
    if processes > 1 and sys.executable:
        yield from _side_by_side(function, arguments, processes)
        return
    for job, argument in enumerate(arguments):
        try:
            value = function(argument)
        except Exception as error:
            raise JobFailed(job, _reason(error)) from error
        yield job, value


def _side_by_side(
    function: Callable[[Any], Any], arguments: Iterable[Any], processes: int
) -> Iterator[tuple[int, Any]]:
    waiting = enumerate(arguments)
    at_work: dict[subprocess.Popen[bytes], int] = {}
    with _workers(processes) as workers, DefaultSelector() as ready:

        def employ(worker: subprocess.Popen[bytes]) -> None:
            for job, argument in waiting:
                at_work[worker] = job
                _send(worker.stdin, (function, argument))
                return

        for worker in workers:
            assert worker.stdout is not None
            ready.register(worker.stdout, EVENT_READ, worker)
            employ(worker)
        while at_work:
            for key, _ in ready.select():
                worker = key.data
                job = at_work.pop(worker)
                value = _answer(worker, job)
                employ(worker)
                yield job, value


@contextmanager
def _workers(count: int) -> Iterator[list[subprocess.Popen[bytes]]]:
    """Start processes; none is left afterwards."""
    started: list[subprocess.Popen[bytes]] = []
    try:
        for _ in range(count):
            # Ctrl-C reaches all processes of a terminal, but only this one is to say so.
            before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
            try:
                worker = subprocess.Popen(
                    [sys.executable, "-c", _PROGRAM], stdin=subprocess.PIPE, stdout=subprocess.PIPE
                )
                started.append(worker)
            finally:
                signal.pthread_sigmask(signal.SIG_SETMASK, before)
            _send(worker.stdin, sys.path)
        yield started
    finally:
        for worker in started:
            worker.kill()
        for worker in started:
            worker.wait()
            for stream in (worker.stdin, worker.stdout):
                assert stream is not None
                with suppress(BrokenPipeError):  # of what could not be sent
                    stream.close()


def _send(stream: Any, thing: Any) -> None:
    """Send to a process; one that has ended is noticed where its answer is awaited."""
    with suppress(BrokenPipeError):
        stream.write(pickle.dumps(thing))
        stream.flush()


def _answer(worker: subprocess.Popen[bytes], job: int) -> Any:
    """Return what a process has computed, once it has begun to tell."""
    assert worker.stdout is not None
    try:
        value, reason, told = pickle.load(worker.stdout)
    except (EOFError, pickle.UnpicklingError):
        how = worker.wait()
        ended = f"by signal {-how}" if how < 0 else f"with exit code {how}"
        raise JobFailed(job, f"its process ended {ended}") from None
    for message in told:
        warnings.warn(message, stacklevel=2)
    if reason is not None:
        raise JobFailed(job, reason)
    return value


def _reason(error: Exception) -> str:
    return str(error) or type(error).__name__


def serve() -> None:
    """Compute what is asked for on the standard input until that ends: this is a process."""
    # Nobody else may write where answers go.
    with os.fdopen(os.dup(1), "wb") as out:
        os.dup2(2, 1)
        asked: queue.SimpleQueue[Any] = queue.SimpleQueue()
        threading.Thread(target=_listen, args=(sys.stdin.buffer, asked), daemon=True).start()
        while True:
            function, argument = asked.get()
            out.write(pickle.dumps(_computed(function, argument)))
            out.flush()


def _listen(stream: BinaryIO, asked: queue.SimpleQueue[Any]) -> None:
    """Take what is asked for; where nobody is left to ask, end at once, also amid a computation."""
    while True:
        try:
            asked.put(pickle.load(stream))
        except EOFError:
            os._exit(0)


def _computed(function: Callable[[Any], Any], argument: Any) -> tuple[Any, str | None, list[Any]]:
    """Return a value, or why there is none, and the warnings on the way."""
    with warnings.catch_warnings(record=True) as caught:
        try:
            value, reason = function(argument), None
        except Exception as error:
            value, reason = None, _reason(error)
    return value, reason, [warning.message for warning in caught]
