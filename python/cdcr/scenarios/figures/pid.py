"""The picture of the PID loop: one column for each reading of the gains."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.base.arrays import FloatArray
from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures.drawing import legend_below, new_figure, note
from cdcr.scenarios.studies.pid import LOOPS, READINGS, RECOMMENDED, TARGET, Loop, runs

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (12.4, 6.6)  # [in]
ALONE, FORWARD = COLORS[1], COLORS[0]
TICKS = (-5.0, 0.0, 5.0, 10.0, 20.0, 50.0, 100.0, 1000.0)  # of the tensions [N]
SHOWN = {"radians": 6.0, "degrees": 1.0, "moment": 1.0}  # what comes after is steady or slow [s]
LINEAR = 10.0  # tensions up to that on a linear scale, the first instants' beyond [N]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw bending angle and tension of every loop."""
    others = runs(float(run.t[-1]))
    with style():
        figure = new_figure(scenario.title, SIZE)
        panels = figure.subplots(2, 3, sharex="col", sharey="row")
        for column, (reading, (words, _)) in enumerate(READINGS.items()):
            angle, tension = panels[:, column]
            for loop in (one for one in LOOPS if one.reading == reading):
                _draw(angle, loop, others[loop].t, np.rad2deg(others[loop].theta[:, 0]))
                _draw(tension, loop, others[loop].t, others[loop].tension[:, 0])
            angle.axhline(TARGET, color=BLACK, linewidth=0.9, linestyle=":")
            tension.axhline(0.0, color=BLACK, linewidth=0.9)
            note(angle, f"{words} (recommended)" if reading == RECOMMENDED.reading else words)
            tension.set_xlabel("time [s]")
            tension.set(xlim=(0.0, min(SHOWN[reading], float(run.t[-1]))))
            tension.set_yscale("symlog", linthresh=LINEAR, linscale=2.0)
        panels[0, 0].set_ylabel(r"bending angle $\theta$ [deg]")
        panels[1, 0].set_ylabel("tension of cable 1 [N]")
        low, high = panels[1, 0].get_ylim()
        shown = [tick for tick in TICKS if low <= tick <= high]
        panels[1, 0].set_yticks(shown, [f"{tick:g}" for tick in shown])
        figure.align_ylabels()
        legend_below(figure, panels[0, 0])
    return figure


def _draw(axes: Axes, loop: Loop, t: FloatArray, values: FloatArray) -> None:
    chosen = loop._replace(reading=RECOMMENDED.reading) == RECOMMENDED
    axes.plot(
        t,
        values,
        color=FORWARD if loop.feed_forward else ALONE,
        linestyle="--" if loop.limited else "-",
        linewidth=1.6 if loop.limited else 3.4,
        alpha=1.0 if loop.limited else 0.4,
        label=f"{loop.label} (recommended)" if chosen else loop.label,
    )
