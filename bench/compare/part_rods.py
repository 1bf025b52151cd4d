"""A rod pulled by a cable: error of the tip and processor time, a row for each description."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import rods
from rows import layout
from turns import Entry, Spread, measure


def report(turns: int, figure: Path | None) -> None:
    """Measure, and print the table."""
    truth = rods.cdcr_rod(4, "dop853", 1e-9, parts=2)()
    less = np.linalg.norm(rods.cdcr_rod(3, "dop853", 1e-9, parts=2)() - truth, axis=1).max()
    print(f"truth: two rods of bending order 4; two of order 3 differ by {1e3 * less:.2g} mm")
    kinds: dict[str, Callable[[], np.ndarray]] = {
        f"cdcr, {f'order {order}' if order else 'one arc'}, {method}, rtol {rtol:.0e}":
            rods.cdcr_rod(order, method, rtol)
        for order, method, rtol in ((0, "dop853", 1e-5), (1, "dop853", 1e-5), (2, "dop853", 1e-5),
                                    (2, "dopri5", 1e-5), (3, "dop853", 1e-5), (4, "dop853", 1e-5))
    }  # fmt: skip
    if find_spec("mujoco"):
        for links, steps in ((4, 5), (7, 5), (7, 10), (7, 20), (10, 10), (10, 40), (14, 40)):
            name = f"MuJoCo, {links} links, step {10 / steps:g} ms"
            kinds[name] = rods.mujoco_chain(links, steps)
    entries = []
    for name, run in kinds.items():
        error = float(np.linalg.norm(run() - truth, axis=1).max())
        entries.append(Entry(name, 0.0, error, run))
    measure(entries, turns)
    if find_spec("elastica"):
        for elements, step in ((10, 2e-5), (20, 1e-5)):
            entries.append(elastica(elements, step, truth))
    print(
        layout(
            ["1 s of a pulled rod", "ms", "error of the tip [mm]"], [row(one) for one in entries]
        )
    )


def elastica(elements: int, step: float, truth: np.ndarray) -> Entry:
    """Time one run, after one of two elements has compiled what it needs: it takes seconds."""
    run = rods.elastica_rod(elements, step)
    rods.elastica_rod(elements, 1e-2)()
    tips: list[np.ndarray] = []
    entry = Entry(
        f"PyElastica, {elements} elements, step {1e3 * step:g} ms",
        0.0,
        0.0,
        lambda: tips.append(run()),
    )
    entry.times.append(entry.sample())
    entry.error = float(np.linalg.norm(tips[0] - truth, axis=1).max())
    return entry


def row(entry: Entry) -> list[str]:
    """Show time and error."""
    return [entry.method, str(Spread([1e3 * t for t in entry.times])), f"{1e3 * entry.error:.3g}"]
