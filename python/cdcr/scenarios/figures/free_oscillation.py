"""The picture of the released robot: undamped, damped, and integrated loosely."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting import panels
from cdcr.plotting.style import ALARM, BLACK, COLORS, GREY, StyledFigure, line_colors, style
from cdcr.scenarios.figures.drawing import legend_below, new_figure, note
from cdcr.scenarios.studies import free_oscillation as study

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory
    from cdcr.scenarios.scenario import Scenario

FIRST = 4.0  # the swings that are drawn one by one [s]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the bending angle of the run, of the damped robot, and amplitudes."""
    others = study.variants(scenario, float(run.t[-1]))
    with style():
        figure = new_figure(scenario.title, (10.4, 7.6))
        grid = figure.add_gridspec(3, 2, height_ratios=[1.0, 1.0, 1.15], width_ratios=[1.0, 1.6])
        free, damped = (figure.add_subplot(grid[row, 1]) for row in (0, 1))
        loose = figure.add_subplot(grid[2, :])
        for row, one in enumerate((run, others["damped"])):
            _draw_first(figure.add_subplot(grid[row, 0]), one)
        _draw_range(free, run)
        note(free, "the paper's equations: no damping, the amplitude stays")
        _draw_range(damped, others["damped"])
        _draw_band(damped, others["damped"])
        note(damped, rf"with a damping of {1e4 * study.DAMPING:.2f}$\cdot 10^{{-4}}$ N m s/rad")
        _draw_amplitudes(loose, run, others)
        note(loose, "no damping, loose integrators: none drawn here explains the settling")
        for axes in (free, damped, loose):
            panels.show_time(axes, run, named=True)
        legend_below(figure, loose, ncols=4)
    return figure


def _draw_first(axes: Axes, run: Trajectory) -> None:
    """Draw the first swings."""
    axes.plot(run.t, np.rad2deg(run.theta[:, 0]), linewidth=1.2)
    _show_theta(axes)
    axes.set_xlim(run.t[0], min(FIRST, run.t[-1]))
    axes.set_xlabel("time [s]")


def _draw_range(axes: Axes, run: Trajectory) -> None:
    """Draw between which bending angles the robot swings, over the whole run."""
    edge = np.rad2deg(study.amplitude(run))
    axes.fill_between(run.t, -edge, edge, color=COLORS[0], alpha=0.35, linewidth=0)
    _show_theta(axes)


def _show_theta(axes: Axes) -> None:
    axes.set_ylabel(r"$\theta$ [deg]")
    axes.set_ylim(-52.0, 52.0)
    axes.set_yticks([-45, 0, 45])


def _draw_band(axes: Axes, run: Trajectory) -> None:
    band = np.rad2deg(study.SETTLED * study.amplitude(run)[0])
    for side in (-band, band):
        axes.axhline(side, color=BLACK, linewidth=0.8, linestyle="--")
    if run.t[-1] > study.PAPER_TIME:
        axes.axvline(study.PAPER_TIME, color=ALARM, linewidth=1.2, linestyle=":")
        axes.text(
            study.PAPER_TIME + 0.4,
            30.0,
            f"the paper: {study.PAPER_TIME} s",
            color=ALARM,
            fontsize=9.5,
        )


def _draw_amplitudes(axes: Axes, run: Trajectory, others: dict[str, Trajectory]) -> None:
    kept = np.rad2deg(study.amplitude(run))
    axes.plot(run.t, kept, color=GREY, linewidth=3.4, alpha=0.6, label="undamped")
    damped = others["damped"]
    axes.plot(
        damped.t, np.rad2deg(study.amplitude(damped)), color=BLACK, linestyle="--", label="damped"
    )
    for name, color in zip(study.LOOSE, line_colors(len(study.LOOSE)), strict=True):
        other = others[name]
        axes.plot(other.t, np.rad2deg(study.amplitude(other)), color=color, label=name)
    axes.set_ylabel("amplitude [deg]")
    axes.set_ylim(0.0, None)
