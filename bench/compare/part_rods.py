"""A rod pulled by a cable: error of the tip and processor time, a row for each description."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import rods
from rows import layout
from turns import Entry, Spread, measure

KINDS = ((0, "dop853"), (1, "dop853"), (1, "bdf"), (2, "bdf"), (3, "bdf"))  # bending order, method
CHAINS = ((4, 5), (7, 5), (7, 20), (10, 10), (10, 40))  # links, steps in 10 ms


def report(turns: int, figure: Path | None) -> None:
    """Measure, and print the table."""
    truth = rods.cdcr_rod(4, "bdf", 1e-9)()
    other = np.linalg.norm(rods.cdcr_rod(2, "bdf", 1e-9, parts=2)() - truth, axis=1).max()
    print(f"truth: a rod of bending order 4; two of order 2 differ by {1e3 * other:.1e} mm")
    kinds: dict[str, Callable[[], np.ndarray]] = {}
    for order, method in KINDS:
        what = f"bending order {order}" if order else "one arc"
        kinds[f"cdcr, {what}, {method}, rtol 1e-6"] = rods.cdcr_rod(order, method, 1e-6)
    for links, steps in CHAINS if find_spec("mujoco") else ():
        name = f"MuJoCo, {links} links, step {10 / steps:g} ms"
        kinds[name] = rods.mujoco_chain(links, steps)
    entries = []
    for name, run in kinds.items():
        error = float(np.linalg.norm(run() - truth, axis=1).max())
        entries.append(Entry(name, 0.0, error, run))
    measure(entries, turns)
    show([row(one) for one in entries])
    if find_spec("elastica"):
        show([elastica(10, 2e-5)])


def show(rows: list[list[str]]) -> None:
    """Print a table."""
    print(layout(["1 s of a pulled rod", "ms", "error of the tip [mm]"], rows), flush=True)


def elastica(elements: int, step: float) -> list[str]:
    """Time one run, after another has compiled what it needs."""
    rods.elastica_rod(4, 1e-2)()
    entry = Entry("", 0.0, 0.0, rods.elastica_rod(elements, step))
    return [
        f"PyElastica, {elements} elements, step {1e3 * step:g} ms, undamped",
        f"{1e3 * entry.sample():.0f}",
        "",
    ]


def row(entry: Entry) -> list[str]:
    """Show time and error."""
    return [entry.method, str(Spread([1e3 * t for t in entry.times])), f"{1e3 * entry.error:.3g}"]
