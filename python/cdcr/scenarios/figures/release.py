"""The picture of a robot that swings to rest: shapes, bending, tip, energy and tensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.base.arrays import FloatArray
from cdcr.plotting import panels
from cdcr.plotting.geometry import states_at
from cdcr.plotting.style import BLACK, StyledFigure, line_colors, style
from cdcr.scenarios.figures.drawing import note, share_time
from cdcr.scenarios.figures.sections import PLACE, SIZE, draw_bending, draw_robot
from cdcr.scenarios.figures.workspace import add_panels, new_figure
from cdcr.scenarios.studies.energy import cable_work, dissipated
from cdcr.scenarios.studies.release import at_rest

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory
    from cdcr.scenarios.scenario import Scenario

# Times of the shapes [s], and what has just fallen off at the start.
SHOWN = {
    "hanging-arm": ((0.0, 0.12, 0.24, 0.5, 1.0), ""),
    "payload-drop": ((0.0, 0.15, 0.25, 0.36, 0.5, 0.8), "payload"),
}
FAINTEST = 0.3  # opacity of the earliest of several shapes
STILL = 1e-6  # a bending component that moves less is not drawn [rad]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw a robot on a wall that swings to rest: shapes, bending, tip and energy."""
    shown, fallen = SHOWN[scenario.name]
    times, rest = np.array([time for time in shown if time <= run.t[-1]]), at_rest(run)
    with style():
        figure = new_figure(scenario.title, SIZE)
        states = np.concatenate([states_at(run, times), [rest]])
        names = [*(f"{time:g} s" for time in times), "at rest"]
        names[0] = "" if fallen else names[0]  # the legend tells
        fading = np.append(np.linspace(FAINTEST, 0.8, len(times)), 1.0)
        draw_robot(figure, run, states, names, fading, fallen)
        moving = [k for k in (0, 1) if np.ptp(run.q[:, k::2]) > STILL]
        pulled = bool(run.tension.any())
        charts = add_panels(figure, [1.2] * (len(moving) + 2) + [0.9] * pulled, **PLACE)
        *bends, tip, energy = timed = charts[: len(moving) + 2]
        for k, axes in zip(moving, bends, strict=True):
            draw_bending(axes, run, k)
            axes.set_ylabel(f"bending {('up', 'sideways')[k]} [deg]", fontsize=9.5)
        note(bends[0], "of each section, in the frame of its base")
        _draw_tip(tip, run, run.model.tip(rest)[1])
        _draw_energy(energy, run)
        share_time(figure, timed, run)
        if pulled:
            _draw_held_tensions(charts[-1], run)
            figure.align_ylabels(charts)
    return figure


def _draw_held_tensions(axes: Axes, run: Trajectory) -> None:
    """Draw tensions that stay the same as bars, in the colours of the sections."""
    names = [f"{j + 1}" for j in range(run.model.num_cables)]
    axes.bar(names, run.tension[0], color=panels.cable_colors(run.model), width=0.6)
    for j, value in enumerate(run.tension[0]):
        axes.text(j, value, f" {value:.2f}", ha="center", va="bottom", fontsize=9, color=BLACK)
    axes.grid(visible=False, axis="x")
    axes.margins(y=0.25)
    axes.set_ylabel("tension [N]")
    axes.set_xlabel("cable; colour: section where it ends")


def _draw_tip(axes: Axes, run: Trajectory, rest: FloatArray) -> None:
    for k, (name, color) in enumerate(zip("xyz", line_colors(6)[3:], strict=True)):
        axes.plot(run.t, run.tip[:, k], color=color, label=name)
        axes.axhline(rest[k], color=color, linewidth=0.9, dashes=(6, 4))
    axes.set_ylabel("tip position [m]")
    note(axes, "dashed: at rest")
    panels.legend_above(axes)


def _draw_energy(axes: Axes, run: Trajectory) -> None:
    """Draw where the energy is: stored is what elasticity, weight and cables have more at first.

    The cables' tensions are constant: their work is taken from what they have stored.
    """
    stored = run.potential_energy - cable_work(run)
    parts = {
        "kinetic": run.kinetic_energy,
        "stored": stored - stored.min(),
        "taken by damping": dissipated(run),
    }
    for (name, values), color in zip(parts.items(), line_colors(6)[3:], strict=True):
        axes.plot(run.t, 1e3 * values, color=color, label=name)
    axes.plot(run.t, 1e3 * sum(parts.values()), color=BLACK, linewidth=1.0, label="sum")
    axes.set_ylabel("energy [mJ]")
    panels.legend_above(axes)
