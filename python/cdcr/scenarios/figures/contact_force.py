"""The picture of a force on the tip: what is found, over the truth."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures.drawing import legend_below, new_figure, note, share_time
from cdcr.scenarios.studies.contact_force import forces, truth

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (9.0, 6.2)  # [in]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the components of the force, one below the other."""
    with style():
        figure = new_figure(scenario.title, SIZE)
        rows = list(figure.subplots(3, 1, sharex=True))
        t, found = forces(scenario, float(run.t[-1]))
        wanted = truth(scenario)
        for i, (axes, axis) in enumerate(zip(rows, "xyz", strict=True)):
            for color, (name, force) in zip(COLORS, found.items(), strict=False):
                axes.plot(t, force[:, i], color=color, label=name)
            axes.axhline(wanted[i], color=BLACK, linewidth=0.9, linestyle=":")
            axes.set_ylabel(f"$f_{axis}$ [N]")
            axes.set_ylim(wanted[i] - 0.25, wanted[i] + 0.25)
        note(rows[0], "dotted: the force that acts")
        share_time(figure, rows, run)
        legend_below(figure, rows[-1])
    return figure
