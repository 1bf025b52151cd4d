"""The free oscillation by cdcr and by SciPy from the same Python, compared at the same error."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import scipy_reference
from python_rows import Q0, ROBOT, TIMES, Timed, oscillation
from rows import Row, make_row

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

SAME_ERROR = 1e-6  # [rad]
RTOLS = (1e-6, 1e-7, 1e-8, 1e-9, 1e-10)  # some give less and some more than that error
SECTION = ROBOT.sections[0]
PAIRS = {"RK45": "dopri5", "DOP853": "dopri5", "LSODA": "dopri5", "BDF": "bdf"}


def cdcr_run(method: str) -> Callable[[float], scipy_reference.Array]:
    """Bending vectors of the oscillation as a function of rtol."""
    return lambda rtol: oscillation(method, rtol).q


def scipy_run(method: str) -> Callable[[float], scipy_reference.Array]:
    """Do the same by solve_ivp."""
    return lambda rtol: scipy_reference.solve(SECTION, Q0, TIMES, method, rtol)


class Curve:
    """Time against error of one method: a row for each tolerance."""

    def __init__(
        self,
        name: str,
        run: Callable[[float], scipy_reference.Array],
        rtols: Sequence[float],
        count: int,
    ) -> None:
        truth = oscillation("dopri5", 1e-13).q
        self.rows = []
        for rtol in rtols:
            error = float(np.abs(run(rtol) - truth).max())
            times = Timed(partial(run, rtol), count, 1e-3)
            self.rows.append(times.row(f"{name} rtol {rtol:.0e}", "ms", error=error))

    def time_at(self, error: float) -> float:
        """Processor time needed for that error, between the rows on both sides of it.

        Not the clock's: runs of a second are always interrupted on a shared machine.
        """
        rows = sorted(self.rows, key=lambda row: row["error"])
        errors = [math.log(row["error"]) for row in rows]
        if not errors[0] <= math.log(error) <= errors[-1]:
            raise ValueError(f"no rows on both sides of an error of {error} rad: {rows}")
        return math.exp(np.interp(math.log(error), errors, [math.log(row["own"]) for row in rows]))


def check() -> Row:
    """Compare the truth with an independent one: other equations, other integrator."""
    independent = scipy_run("DOP853")(1e-13)
    difference = float(np.abs(independent - cdcr_run("dopri5")(1e-13)).max())
    return make_row("dopri5 against solve_ivp DOP853, both rtol 1e-13", "rad", [difference])


def right_hand_side() -> Row:
    """Time one evaluation of the NumPy equations of motion."""
    equations = scipy_reference.RightHandSide.of(SECTION)
    state = np.array([*Q0, 0.1, 0.2])
    times = Timed(lambda: [equations(0.0, state) for _ in range(1000)], 20, 1e-3)
    return times.row("NumPy right-hand side", "us", calls_per_block=1000)


def scipy_rows(quick: bool) -> Iterator[Row]:
    """All rows of this file."""
    yield check()
    yield right_hand_side()
    ours = {}
    for method in ("dopri5", "bdf"):
        name = f"free oscillation from Python, {method}"
        curve = Curve(name, cdcr_run(method), RTOLS, 10 if quick else 50)
        ours[method] = curve.time_at(SAME_ERROR)
        yield from curve.rows
    for method, our_method in PAIRS.items():
        name = f"free oscillation, solve_ivp {method}"
        curve = Curve(name, scipy_run(method), RTOLS, 1 if quick else 3)
        ratio = curve.time_at(SAME_ERROR) / ours[our_method]
        yield from curve.rows
        name = f"solve_ivp {method} over cdcr {our_method}, both at {SAME_ERROR:.0e} rad"
        yield make_row(name, "times", [ratio])
