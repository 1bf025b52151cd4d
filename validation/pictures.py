"""Tips measured, or computed by others, and predicted: the picture of docs/explanation/how-true.md.

    python validation/pictures.py DATA --out how-true.png

DATA holds `sorosim_release/` and `ftdcr_v4/`. Nothing is fitted to the rods of SoRoSim; of the real
robot the last fifth of the poses is predicted by a fit to those before.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import ftdcr
import numpy as np
import sorosim
from common import rms
from matplotlib.figure import Figure

from cdcr.plotting.style import BLACK, style

RELEASES = {
    "TPU rod, let go": "TPURodMuJoCo_1.txt",
    "steel rod, let go": "SpringSteelRodMuJoCo_1.txt",
}
KINDS: dict[str, tuple[int, int] | int] = {"arcs in 8 parts": 8, "rod of order 3": (3, 1)}
SIZE = (11.0, 4.2)  # [in]


def draw_release(axes: Any, path: Path) -> None:
    """Draw the path of a tip in the two directions in which it moves most."""
    for k, (name, kind) in enumerate(KINDS.items()):
        told, run, _ = sorosim.moved(path, kind)
        early = told.t <= sorosim.COMPARED
        tip = told.tip[early]
        a, b = sorted(np.argsort(np.ptp(tip, axis=0))[1:])
        found = run.tip[early]
        label = f"{name}, {rms(found - tip):.2f} mm RMS"
        axes.plot(*(1e3 * found[:, [a, b]].T), color=f"C{1 - k}", label=label)
    axes.plot(
        *(1e3 * tip[::4, [a, b]].T),
        ".",
        color=BLACK,
        markersize=3,
        label="SoRoSim, every 4th sample",
    )
    axes.set(xlabel=f"{'xyz'[a]} of the tip [mm]", ylabel=f"{'xyz'[b]} of the tip [mm]")


def draw_poses(axes: Any, path: Path) -> None:
    """Draw the tips of poses that were held out, and lines to where they are predicted."""
    every = ftdcr.poses(path)
    first = np.arange(len(every)) < 4 * len(every) // 5
    found = ftdcr.fit(ftdcr.some(path, first))
    held = ftdcr.some(path, ~first)
    tip = np.asarray(held.tip)
    left = found.errors(held)[0].values
    predicted = tip + left
    for one, other in zip(1e3 * tip, 1e3 * predicted, strict=True):
        axes.plot(*np.stack([one, other])[:, :2].T, color="C2", linewidth=1)
    axes.plot(*(1e3 * predicted[:, :2].T), ".", color="C2", markersize=4,
              label=f"predicted, {rms(left):.2f} mm RMS")  # fmt: skip
    axes.plot(*(1e3 * tip[:, :2].T), ".", color=BLACK, markersize=3, label="measured")
    axes.set(xlabel="x of the tip [mm]", ylabel="y of the tip [mm]", aspect="equal")


def main() -> None:
    """Read the arguments and draw."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", type=Path, help="the folder of the sources")
    parser.add_argument("--out", type=Path, required=True, help="the picture")
    given = parser.parse_args()
    with style():
        figure = Figure(figsize=SIZE, layout="constrained")
        rods = figure.subplots(1, 3)
        for axes, (name, file) in zip(rods, RELEASES.items(), strict=False):
            draw_release(axes, given.data / "sorosim_release" / file)
            axes.set_title(name)
        draw_poses(rods[2], given.data / "ftdcr_v4" / "train.csv")
        rods[2].set_title("real robot, poses held out")
        for axes in rods:
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), fontsize=8)
        figure.savefig(given.out, dpi=150)


if __name__ == "__main__":
    main()
