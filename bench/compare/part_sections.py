"""One arc, three and a rod, by cdcr and by SoRoMoX: accelerations, and runs at equal error."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import soromox_arms
from numpy.typing import NDArray
from rows import layout
from turns import Entry, Spread, measure, over, time_at

import cdcr

Array = NDArray[np.float64]
STATES = 1_000
# Sections, bending order, seconds of a run.
CASES = {"n = 1": (1, 0, 10.0), "n = 3": (3, 0, 1.0), "rod of order 2": (1, 2, 0.05)}
ERRORS = (1e-4, 1e-6)
OURS = ("dop853", "dopri5")
EXPONENTS = {"dop853": range(4, 10), "dopri5": range(4, 10), "SoRoMoX Tsit5": (4, 6, 8)}


def report(turns: int, figure: Path | None) -> None:
    """Measure, and print the tables."""
    try:
        import soromox  # noqa: F401
    except ImportError:
        print("soromox is not installed")
        return
    heads = [text for error in ERRORS for text in (f"ms at {error:.0e}", "over our best")]
    for name, (count, order, seconds) in CASES.items():
        arm = soromox_arms.robot(count, order)
        pair = Pair(name, cdcr.Model(arm), soromox_arms.soromox(arm))
        rows = list(pair.accelerations(turns))
        print(layout(["accelerations", "us a state", "over cdcr", "first [s]", "differ by"], rows))
        print(
            layout(["runs", "first [s]", *heads], list(pair.runs(turns, seconds))),
            flush=True,
        )


class Pair:
    """A robot as both know it."""

    def __init__(self, name: str, model: cdcr.Model, system: Any) -> None:
        self.name, self.model, self.system = name, model, system
        self.theirs = partial(soromox_arms.theirs, arm=model.robot)
        self.back = partial(soromox_arms.back, arm=model.robot)

    def derivative(self, y: Any) -> Any:
        """Return y' by SoRoMoX, without actuation."""
        return self.system.forward_dynamics(0.0, y)

    def accelerations(self, turns: int) -> Iterator[list[str]]:
        """Time 1,000 states in a compiled loop, and at once."""
        import jax

        random = np.random.default_rng(1)
        d = self.model.num_coordinates
        q, qd = random.uniform(-0.6, 0.6, (STATES, d)), random.uniform(-3.0, 3.0, (STATES, d))
        still = np.zeros(self.model.num_cables)
        y = jax.device_put(np.hstack((self.theirs(q), self.theirs(qd))))
        ours = Entry("cdcr", 0.0, 0.0, lambda: self.model.forward_dynamics(q, qd, still))
        kinds: dict[str, Callable[[Any], Any]] = {
            "loop": jax.jit(lambda many: jax.lax.map(self.derivative, many)),
            "vmap": jax.jit(jax.vmap(self.derivative)),
        }
        firsts, entries = {}, [ours]
        for name, function in kinds.items():
            before = time.process_time()
            found = np.asarray(function(y))
            firsts[name] = time.process_time() - before
            entries.append(Entry(name, 0.0, 0.0, partial(_wait, function, y)))
        measure(entries, turns)
        differ = self.back(found[:, d:]) - self.model.forward_dynamics(q, qd, still)
        scale = np.abs(found[:, d:]).max(axis=1)
        for entry in entries:
            each = Spread([1e6 * t / STATES for t in entry.times])
            ratio = Spread([t / own for t, own in zip(entry.times, ours.times, strict=True)])
            name = "cdcr, an array" if entry is ours else f"SoRoMoX, {entry.method}"
            first = f"{firsts[entry.method]:.1f}" if entry is not ours else ""
            off = "" if entry is ours else f"{np.max(np.abs(differ).max(axis=1) / scale):.0e}"
            yield [f"{name}, {self.name}", f"{each.median:.3g}", str(ratio), first, off]

    def runs(self, turns: int, seconds: float) -> Iterator[list[str]]:
        """Time free motions; each model's error is that against a tight run of its own."""
        d = self.model.num_coordinates
        q0, qd0 = np.resize([0.5, 0.1], d), np.resize([0.0, 1.0], d)
        times = np.linspace(0.0, seconds, 101)
        solve = self.soromox_run(q0, qd0, times)
        before = time.process_time()
        solve(1e-6)
        first = {"SoRoMoX Tsit5": time.process_time() - before}
        by: dict[str, Callable[[float], Array]] = {
            name: partial(self.cdcr_run, name, q0, qd0, times) for name in OURS
        }
        tight = {name: by["dop853"](1e-13) for name in OURS}
        by["SoRoMoX Tsit5"], tight["SoRoMoX Tsit5"] = solve, solve(1e-11)
        entries = []
        for name, run in by.items():
            for rtol in (10.0**-k for k in EXPONENTS[name]):
                error = float(np.abs(run(rtol) - tight[name]).max())
                entries.append(Entry(name, rtol, error, partial(run, rtol)))
        measure(entries, turns)
        for name in by:
            row = [f"{name}, {self.name}, {seconds:g} s", f"{first.get(name, 0.0):.1f}"]
            for error in ERRORS:
                mine = [entry for entry in entries if entry.method == name]
                known = [t for k in range(turns) if (t := time_at(mine, error, k)) is not None]
                ratio = over(entries, name, OURS, error)
                row += [f"{1e3 * Spread(known).median:.3g}" if known else "", str(ratio or "")]
            yield row

    def cdcr_run(self, method: Any, q0: Array, qd0: Array, times: Array, rtol: float) -> Array:
        """Bending vectors by cdcr."""
        options: dict[str, Any] = {"method": method, "rtol": rtol, "atol": rtol / 100}
        return cdcr.simulate(self.model, q0, qd0, t=times, **options).q

    def soromox_run(self, q0: Array, qd0: Array, times: Array) -> Callable[[float], Array]:
        """Bending vectors by SoRoMoX and diffrax, compiled once for all tolerances."""
        import diffrax
        import jax

        y0 = np.concatenate((self.theirs(q0), self.theirs(qd0)))
        term = diffrax.ODETerm(lambda t, y, args: self.derivative(y))

        @jax.jit
        def solve(rtol: Any) -> Any:
            control = diffrax.PIDController(rtol=rtol, atol=rtol / 100)
            saveat = diffrax.SaveAt(ts=times)
            return diffrax.diffeqsolve(
                term, diffrax.Tsit5(), 0.0, times[-1], 1e-3, y0,
                stepsize_controller=control, saveat=saveat, max_steps=1_000_000,
            ).ys  # fmt: skip

        return lambda rtol: self.back(np.asarray(solve(rtol))[:, : q0.size])


def _wait(function: Callable[[Any], Any], y: Any) -> None:
    function(y).block_until_ready()
