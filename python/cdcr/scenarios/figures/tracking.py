"""The picture of a path: on the surface of tips, its tensions, and how well they lead there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting import panels
from cdcr.plotting.style import ALARM, BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures import workspace
from cdcr.scenarios.figures.drawing import note, share_time
from cdcr.scenarios.studies.tracking import FINE_STEP, STEP, asked, error, fine_run, inverse

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SMALLEST = 1e-11  # error told from rounding; what is below is not drawn [deg]
NUM_SHAPES = 4  # of the robot, where it does not just go round
SAME = 1e-9  # bending angles that differ by less are one [rad]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw a run under the tensions of inverse dynamics, and what was asked for."""
    with style():
        figure = workspace.new_figure(scenario.title)
        _draw_paths(figure, scenario, run)
        angles, tensions, errors = workspace.add_panels(figure, [1.0, 1.2, 1.0])
        _draw_angles(angles, scenario, run)
        _draw_tensions(tensions, scenario, run)
        _draw_errors(errors, scenario, run)
        share_time(figure, [angles, tensions, errors], run)
    return figure


def _draw_paths(figure: StyledFigure, scenario: Scenario, run: Trajectory) -> None:
    motion = asked(scenario, run)
    shapes = NUM_SHAPES if np.ptp(motion.theta) > SAME else 1
    chosen = np.linspace(0, len(run) - 1, shapes).astype(int)
    axes = workspace.add_surface(figure, run.model, motion.q[chosen], float(motion.theta.max()))
    wanted, reached = run.model.tips(motion.q), run.tip
    axes.plot(*wanted.T, color=ALARM, linewidth=4.0, alpha=0.35, zorder=20, label="path asked for")
    axes.plot(*reached.T, color=BLACK, linewidth=1.2, ls="--", zorder=21, label="path of the tip")
    workspace.finish_surface(figure, axes)


def _draw_angles(axes: Axes, scenario: Scenario, run: Trajectory) -> None:
    motion = asked(scenario, run)
    for values, wanted, color, name in (
        (run.theta[:, 0], motion.theta[:, 0], COLORS[0], r"$\theta$"),
        (run.phi[:, 0], motion.phi[:, 0], COLORS[1], r"$\varphi$"),
    ):
        axes.plot(run.t, np.rad2deg(wanted), color=color, linewidth=4.0, alpha=0.35)
        axes.plot(run.t, np.rad2deg(values), color=color, linestyle="--", label=name)
    axes.set_ylabel("angles [deg]")
    note(axes, "wide: asked for, dashed: reached")
    panels.legend_above(axes)


def _draw_tensions(axes: Axes, scenario: Scenario, run: Trajectory) -> None:
    fine, coarse = (inverse(scenario, run, step) for step in (FINE_STEP, STEP))
    for j, color in enumerate(panels.cable_colors(run.model)):
        name = f"{j + 1}" if j else "cable 1"
        axes.plot(fine.t, fine.tension[:, j], color=color, label=name)
        axes.plot(coarse.t, coarse.tension[:, j], ".", color=color, markersize=4.5)
    axes.set_ylabel("tension [N]")
    note(axes, f"by inverse dynamics; dots every {STEP:g} s")
    panels.legend_above(axes)


def _draw_errors(axes: Axes, scenario: Scenario, run: Trajectory) -> None:
    for other, step, color in (
        (run, STEP, COLORS[0]),
        (fine_run(scenario, run), FINE_STEP, COLORS[1]),
    ):
        angle = np.rad2deg(error(scenario, other))
        shown = np.where(angle > SMALLEST, angle, np.nan)  # rounding hides what is smaller
        axes.semilogy(other.t, shown, color=color, label=f"every {step:g} s")
    axes.set_ylabel("path error [deg]")
    note(axes, "sampled; blank: rounding")
    panels.legend_above(axes)
