"""What Python costs: calls, runs, import and memory."""

from __future__ import annotations

import json
import math
import statistics
import subprocess
import sys
import time
from typing import TYPE_CHECKING

import numpy as np
from rows import Row, make_row

import cdcr

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

ROBOT = cdcr.robots.amouri2020()
MODEL = cdcr.Model(ROBOT)
TENSION = np.array([5.0, 1.0, 0.0])
Q0 = np.array([math.pi / 4.0, 0.0])
TIMES = np.linspace(0.0, 10.0, 1001)
HEADLINE = "free oscillation, dopri5 rtol 1e-8"


class Timed:
    """Times of `count` calls after one more, in units of `unit` seconds.

    `samples` by the clock, `own` the median of the processor time this thread used.
    """

    def __init__(self, call: Callable[[], object], count: int, unit: float) -> None:
        call()
        self.samples, own = [], []
        for _ in range(count):
            before, start = time.thread_time(), time.perf_counter()
            call()
            self.samples.append((time.perf_counter() - start) / unit)
            own.append((time.thread_time() - before) / unit)
        self.own = statistics.median(own)

    def row(self, name: str, unit: str, **extra: float) -> Row:
        """Make the row of that name."""
        return make_row(name, unit, self.samples, own=self.own, **extra)


def calls(quick: bool) -> Iterator[Row]:
    """Functions of one state, in blocks of 1,024 calls."""
    swing = cdcr.simulate(MODEL, Q0, [0.0, 2.0], t=np.linspace(0.0, 10.0, 64), method="dopri5")
    states = list(zip(swing.q, swing.qd, strict=True)) * 16
    simulator = cdcr.Simulator(MODEL, step=1e-3)

    def dynamics() -> None:
        for q, qd in states:
            MODEL.forward_dynamics(q, qd, TENSION)

    def steps() -> None:
        simulator.reset(Q0, np.zeros(2))
        for _ in states:
            simulator.step(TENSION)

    count, block = 30 if quick else 300, len(states)
    for name, call in (("forward_dynamics", dynamics), ("Simulator.step", steps)):
        times = Timed(call, count, block * 1e-6)
        yield times.row(f"{name} from Python", "us", calls_per_block=block)


def oscillation(method: str, rtol: float) -> cdcr.Trajectory:
    """Run the free oscillation that the C++ executable runs."""
    still = np.zeros(2)
    return cdcr.simulate(MODEL, Q0, still, t=TIMES, method=method, rtol=rtol, atol=rtol * 1e-2)  # type: ignore[arg-type]


def overhead(quick: bool, executable: Path) -> Iterator[Row]:
    """Python over C++: both in turn, so that the machine's mood meets both."""
    in_cpp, in_python = [], []
    for _ in range(3 if quick else 15):
        command = [str(executable), "--quick", "--only", HEADLINE]
        line = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        in_cpp.append(json.loads(line)["p50"])
        times = Timed(lambda: oscillation("dopri5", 1e-8), 30, 1e-3)
        in_python.append(statistics.median(times.samples))
    yield make_row("simulate from Python, dopri5 rtol 1e-8", "ms", in_python)
    over = [python - cpp for python, cpp in zip(in_python, in_cpp, strict=True)]
    yield make_row("simulate: Python over C++", "ms", over)


def in_new_process(code: str) -> float:
    """Run code in a fresh interpreter and return the number it prints."""
    command = [sys.executable, "-c", code]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


IMPORT = """
import time
import numpy
start = time.perf_counter()
import cdcr
print(1e3 * (time.perf_counter() - start))
"""
NUMPY = """
import time
start = time.perf_counter()
import numpy
print(1e3 * (time.perf_counter() - start))
"""
RESIDENT = """
kib = next(int(line.split()[1]) for line in open("/proc/self/status") if "VmHWM" in line)
print(1024e-6 * kib)
"""
ONE_RUN = """
import cdcr, numpy
model = cdcr.Model(cdcr.robots.amouri2020())
cdcr.simulate(model, [0.7, 0.0], [0.0, 0.0], t=numpy.linspace(0.0, 10.0, 1001))
"""


def start_up(quick: bool) -> Iterator[Row]:
    """Import times and peak resident memory [MB], each in fresh processes."""

    def row(name: str, unit: str, code: str) -> Row:
        in_new_process(code)  # so that compiled modules and the disk's cache are there
        return make_row(name, unit, [in_new_process(code) for _ in range(3 if quick else 11)])

    yield row("import numpy", "ms", NUMPY)
    yield row("import cdcr after numpy", "ms", IMPORT)
    yield row("resident memory, bare interpreter", "MB", RESIDENT)
    yield row("resident memory, import numpy", "MB", "import numpy" + RESIDENT)
    yield row("resident memory, import cdcr and one run", "MB", ONE_RUN + RESIDENT)


def python_rows(quick: bool, executable: Path) -> Iterator[Row]:
    """All rows of this file."""
    yield from calls(quick)
    yield from overhead(quick, executable)
    yield from start_up(quick)
