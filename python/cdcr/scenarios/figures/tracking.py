"""The picture of a path: on the surface of tips, its tensions, and how well they lead there."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting import panels
from cdcr.plotting.style import ALARM, BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures import workspace
from cdcr.scenarios.figures.drawing import legend_above, note
from cdcr.scenarios.studies.tracking import FINE_STEP, STEP, Sweep

SMALLEST = 1e-11  # error shown on the logarithmic axis [deg]


def tracking_figure(title: str, sweep: Sweep, run: Trajectory, shapes: int) -> StyledFigure:
    """Draw a run that was fed with the tensions of inverse dynamics, and what was asked for."""
    with style():
        figure = workspace.new_figure(title)
        _draw_paths(figure, sweep, run, shapes)
        angles, tensions, errors = workspace.add_panels(figure, [1.0, 1.2, 1.0])
        _draw_angles(angles, sweep, run)
        _draw_tensions(tensions, sweep, run)
        _draw_errors(errors, sweep, run)
        for axes in (angles, tensions, errors):
            panels.show_time(axes, run, named=axes is errors)
        figure.align_ylabels([angles, tensions, errors])
    return figure


def _draw_paths(figure: StyledFigure, sweep: Sweep, run: Trajectory, shapes: int) -> None:
    asked = sweep.reference(run.t)
    chosen = np.linspace(0, len(run) - 1, shapes).astype(int)
    axes = workspace.add_surface(figure, run.model, asked.q[chosen], float(asked.theta.max()))
    wanted, reached = run.model.tips(asked.q), run.tip
    axes.plot(*wanted.T, color=ALARM, linewidth=4.0, alpha=0.35, zorder=20, label="path asked for")
    axes.plot(*reached.T, color=BLACK, linewidth=1.2, ls="--", zorder=21, label="path of the tip")
    workspace.finish_surface(figure, axes)


def _draw_angles(axes: Axes, sweep: Sweep, run: Trajectory) -> None:
    asked = sweep.reference(run.t)
    for values, wanted, color, name in (
        (run.theta[:, 0], asked.theta[:, 0], COLORS[0], r"$\theta$"),
        (run.phi[:, 0], asked.phi[:, 0], COLORS[1], r"$\varphi$"),
    ):
        axes.plot(run.t, np.rad2deg(wanted), color=color, linewidth=4.0, alpha=0.35)
        axes.plot(run.t, np.rad2deg(values), color=color, linestyle="--", label=name)
    axes.set_ylabel("angles [deg]")
    note(axes, "wide: asked for, dashed: reached")
    legend_above(axes)


def _draw_tensions(axes: Axes, sweep: Sweep, run: Trajectory) -> None:
    t_end = float(run.t[-1])
    fine = sweep.inverse(run.model, t_end, FINE_STEP)
    coarse = sweep.inverse(run.model, t_end, STEP)
    for j in range(run.model.num_cables):
        name = f"{j + 1}" if j else "cable 1"
        axes.plot(fine.t, fine.tension[:, j], color=COLORS[j], label=name)
        axes.plot(coarse.t, coarse.tension[:, j], ".", color=COLORS[j], markersize=4.5)
    axes.set_ylabel("tension [N]")
    note(axes, f"by inverse dynamics; dots every {STEP:g} s")
    legend_above(axes)


def _draw_errors(axes: Axes, sweep: Sweep, run: Trajectory) -> None:
    for other, step, color in (
        (run, STEP, COLORS[0]),
        (sweep.fine_run(run), FINE_STEP, COLORS[1]),
    ):
        error = np.rad2deg(sweep.error(other))
        axes.semilogy(other.t, np.maximum(error, SMALLEST), color=color, label=f"{step:g} s")
    axes.set_ylabel("path error [deg]")
    note(axes, "tensions fed back, lines between samples every")
    legend_above(axes)
