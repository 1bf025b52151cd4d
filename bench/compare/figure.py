"""The figure: processor time over error of the swing, a line for each integrator."""

from __future__ import annotations

from itertools import cycle
from pathlib import Path

from turns import Entry, Spread

from cdcr.plotting.style import BLACK, COLORS, style

MARKERS = ("o", "s", "^", "v", "D", "P", "X")
WIDTH, HEIGHT = 7.4, 5.2  # [in]


def draw(entries: list[Entry], path: Path) -> None:
    """Write it; cdcr's lines are thick, the others thin."""
    from matplotlib.figure import Figure

    with style():
        figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
        axes = figure.add_subplot()
        others = cycle(zip(COLORS * 2, MARKERS * 2, strict=False))
        shades = iter(("-", "--", "-.", ":"))
        for name in dict.fromkeys(entry.method for entry in entries):
            mine = [one for one in entries if one.method == name and one.error > 0.0]
            x = [one.error for one in mine]
            y = [1e3 * Spread(one.times).median for one in mine]
            if name.startswith("cdcr"):
                axes.plot(x, y, next(shades), color=BLACK, linewidth=2.6, label=name)
            else:
                color, marker = next(others)
                axes.plot(x, y, marker=marker, markersize=4, color=color, linewidth=1.0, label=name)
        axes.set(
            xscale="log",
            yscale="log",
            xlabel="largest error of the bending vector in 10 s [rad]",
            ylabel="processor time of the run [ms]",
        )
        axes.invert_xaxis()
        # Handles as long as a whole period of dashes and dots of a thick line.
        figure.legend(loc="outside right upper", fontsize=8, handlelength=4.2)
        figure.savefig(path)
