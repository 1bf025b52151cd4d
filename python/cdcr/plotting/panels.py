"""A run over time: angles, tensions, tip and energy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from cdcr.plotting.style import ALARM, BLACK, GREY, StyledFigure, line_colors, style

if TYPE_CHECKING:
    from cdcr._trajectory import Trajectory

__all__ = ["plot_phi", "plot_run", "plot_tension", "plot_theta", "show_time"]

# Smallest spans shown, so that rounding noise does not fill a panel.
MIN_ANGLE = 1.0  # [deg]
MIN_TENSION = 1.0  # [N]
MIN_LENGTH = 1e-3  # [m]
MIN_ENERGY = 1e-9  # [J]
MIN_ERROR = 1e-15  # [1]

MAX_NAMED = 6  # lines named in one legend
DASHES = ("-", "--", "-.", ":")  # lines often coincide: dashes let the lower one be seen


def plot_run(run: Trajectory) -> StyledFigure:
    """Draw a run over time; see Trajectory.plot."""
    left = [plot_theta, plot_phi, plot_tension]
    right = [_plot_tip, _plot_energy] + ([_plot_energy_error] if _is_free(run) else [])
    with style():
        figure = StyledFigure(figsize=(11.0, 6.6), layout="constrained")
        grid = figure.add_gridspec(6, 2)
        for column, panels in enumerate((left, right)):
            height = 6 // len(panels)
            for row, panel in enumerate(panels):
                axes = figure.add_subplot(grid[row * height : (row + 1) * height, column])
                panel(axes, run)
                show_time(axes, run, named=panel is panels[-1])
        figure.align_ylabels()
        if not run.success:
            figure.suptitle(run.message, color=ALARM, wrap=True)
    return figure


def show_time(axes: Axes, run: Trajectory, *, named: bool) -> None:
    """Let the run fill the time axis, which has its name and numbers where `named`."""
    axes.tick_params(labelbottom=named)
    if named:
        axes.set_xlabel("time [s]")
    if len(run) > 1:
        axes.set_xlim(run.t[0], run.t[-1])


def _is_free(run: Trajectory) -> bool:
    """Whether the energy should stay what it was at the start."""
    damped = any(section.damping > 0.0 for section in run.model.robot.sections)
    return not damped and not run.tension.any()


def plot_theta(axes: Axes, run: Trajectory) -> None:
    """Draw the bending angles [deg] over time."""
    _plot_lines(axes, run.t, np.rad2deg(run.theta), _numbered("section", run.model.num_sections))
    axes.set_ylabel(r"bending angle $\theta$ [deg]")
    _keep_span(axes, MIN_ANGLE)


def plot_phi(axes: Axes, run: Trajectory) -> None:
    """Draw the orientation angles [deg] over time."""
    _plot_lines(axes, run.t, np.rad2deg(run.phi), _numbered("section", run.model.num_sections))
    axes.set_ylabel(r"orientation $\varphi$ [deg]")
    _keep_span(axes, MIN_ANGLE)


def plot_tension(axes: Axes, run: Trajectory) -> None:
    """Draw the cable tensions [N] over time."""
    _plot_lines(axes, run.t, run.tension, _numbered("cable", run.model.num_cables))
    axes.set_ylabel("tension [N]")
    top = max(MIN_TENSION, np.max(run.tension, initial=0.0))
    axes.set_ylim(-0.05 * top, 1.08 * top)  # a line along zero stays clear of the frame
    if not run.model.num_cables:
        axes.text(0.5, 0.5, "no cables", transform=axes.transAxes, ha="center", color=GREY)


def _plot_tip(axes: Axes, run: Trajectory) -> None:
    _plot_lines(axes, run.t, run.tip, ["x", "y", "z"])
    axes.set_ylabel("tip position [m]")
    _keep_span(axes, MIN_LENGTH)


def _plot_energy(axes: Axes, run: Trajectory) -> None:
    kinetic, potential, *_ = line_colors(2)
    axes.plot(run.t, run.energy, color=BLACK, label="total")
    axes.plot(run.t, run.kinetic_energy, color=kinetic, label="kinetic")
    axes.plot(run.t, run.potential_energy, color=potential, label="potential", linestyle=DASHES[1])
    _legend(axes, 3)
    axes.set_ylabel("energy [J]")
    _keep_span(axes, MIN_ENERGY)


def _plot_energy_error(axes: Axes, run: Trajectory) -> None:
    axes.plot(run.t, run.energy_error, color=BLACK)
    axes.set_ylabel("relative energy error [1]")
    _keep_span(axes, MIN_ERROR)


def _plot_lines(
    axes: Axes, t: NDArray[np.float64], values: NDArray[np.float64], names: Sequence[str]
) -> None:
    """Draw the columns of values (N, k) over t, with a legend where there are several."""
    count = values.shape[1]
    for k, (name, color) in enumerate(zip(names, line_colors(count), strict=True)):
        dashes = DASHES[k % len(DASHES)] if count <= MAX_NAMED else "-"
        axes.plot(t, values[:, k], color=color, linestyle=dashes, label=name)
    if count > 1:
        _legend(axes, count)


def _numbered(noun: str, count: int) -> list[str]:
    """Names for a legend in one row: noun 1, 2, 3, ..., not more than have room."""
    step = -(-count // MAX_NAMED) or 1
    unnamed = "_"  # Matplotlib leaves it out of the legend
    names = [f"{k + 1}" if k % step == 0 else unnamed for k in range(count)]
    return [f"{noun} 1", *names[1:]] if names else []


def _legend(axes: Axes, count: int) -> None:
    """Above the panel, so that it lies on no data."""
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=min(count, MAX_NAMED),
        borderaxespad=0.1,
        columnspacing=1.2,
        handlelength=1.8,
    )


def _keep_span(axes: Axes, smallest: float) -> None:
    """Widen the y limits evenly where they are closer than `smallest`."""
    low, high = axes.get_ylim()
    missing = smallest - (high - low)
    if missing > 0.0:
        axes.set_ylim(low - missing / 2, high + missing / 2)
