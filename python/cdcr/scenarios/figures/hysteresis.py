"""The picture of friction that remembers: its loops, and what is held."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting import panels
from cdcr.plotting.style import BLACK, COLORS, GREY, StyledFigure, style
from cdcr.scenarios.figures.drawing import new_figure, note
from cdcr.scenarios.studies import hysteresis as study

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory
    from cdcr.scenarios.scenario import Scenario

MEMORY, NONE = COLORS[1], COLORS[0]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the loops of angle and of friction over tension, and both laws over time."""
    other = study.forgetting(scenario, float(run.t[-1]))
    with style():
        figure = new_figure(scenario.title, (12.4, 7.4))
        left, right = figure.subfigures(1, 2, squeeze=False)[0]
        loop, friction = left.subplots(2, 1)
        angle, creep = right.subplots(2, 1)
        _draw_loop(loop, run)
        _draw_friction(friction, run)
        _draw_angle(angle, run, other)
        _draw_creep(creep, run, other)
        for part in (left, right):
            part.align_ylabels()
    return figure


def _draw_loop(axes: Axes, run: Trajectory) -> None:
    still = study.slowly(run)
    axes.plot(run.tension[:, 0], np.degrees(run.theta[:, 0]), color=MEMORY, label="in motion")
    axes.plot(
        still.tension[:, 0],
        np.degrees(still.q[:, 0]),
        color=BLACK,
        linewidth=0.9,
        linestyle="--",
        label="without time",
    )
    axes.set_xlabel("tension of cable 1 [N]")
    axes.set_ylabel("bending angle [deg]")
    panels.legend_above(axes)


def _draw_friction(axes: Axes, run: Trajectory) -> None:
    still = study.slowly(run)
    axes.plot(still.tension[:, 0], still.friction[:, 0], color=MEMORY)
    axes.axhline(0.0, color=GREY, linewidth=0.6)
    axes.set_xlabel("tension of cable 1 [N]")
    axes.set_ylabel("lost to friction [N]")
    note(axes, "above zero pulled in, below paid out")


def _draw_angle(axes: Axes, run: Trajectory, other: Trajectory) -> None:
    axes.plot(run.t, np.degrees(run.theta[:, 0]), color=MEMORY, label="with memory")
    axes.plot(other.t, np.degrees(other.theta[:, 0]), color=NONE, label="without")
    axes.set_ylabel("bending angle [deg]")
    axes.margins(x=0.0)
    panels.legend_above(axes)
    panels.show_time(axes, run, named=True)


def _draw_creep(axes: Axes, run: Trajectory, other: Trajectory) -> None:
    for one, color in ((run, MEMORY), (other, NONE)):
        held = one.t >= min(study.SETTLED, float(one.t[-1]))
        theta = np.degrees(one.theta[held, 0])
        axes.plot(one.t[held], theta - theta[0], color=color)
    axes.set_ylabel("moved since 54.5 s [deg]")
    axes.margins(x=0.0)
    note(axes, "the tension is held from 52.5 s on")
    axes.set_xlabel("time [s]")
