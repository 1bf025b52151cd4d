"""The picture of gravity: energy ratio, equilibria over tension, and the robot at rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr._core import taylor_range
from cdcr.plotting.geometry import robot_shape
from cdcr.plotting.style import ALARM, BLACK, COLORS, StyledFigure, style
from cdcr.scenarios.figures.drawing import NUM_ANGLES, legend_below, new_figure, note
from cdcr.scenarios.studies import gravity_ratio as study

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

HUES = dict(zip(study.WAYS, (BLACK, COLORS[0], COLORS[1]), strict=True))
TENSIONS = np.linspace(0.0, 10.0, 41)  # [N]


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw the three ways to stand in the field of gravity."""
    with style():
        figure = new_figure(scenario.title, (12.4, 5.2))
        ratio, angle, shape = figure.subplots(1, 3, width_ratios=[1.2, 1.2, 0.45])
        _draw_ratio(ratio)
        _draw_angles(angle)
        _draw_shapes(shape)
        legend_below(figure, angle)
    return figure


def _draw_ratio(axes: Axes) -> None:
    theta = np.linspace(0.01, taylor_range, NUM_ANGLES)
    color = HUES["upright"]
    axes.plot(np.rad2deg(theta), -100.0 * study.energy_ratio(theta, "upright"), color=color)
    axes.axhline(study.CLAIM, color=ALARM, linestyle=":", linewidth=1.3)
    axes.text(
        2.0, study.CLAIM + 0.35, f"the paper: below {study.CLAIM} %", color=ALARM, fontsize=9.5
    )
    axes.set(xlim=(0.0, np.rad2deg(taylor_range)), ylim=(0.0, 27.0))
    axes.set_xticks(np.arange(0, 91, 30))
    axes.set_xlabel(r"bending angle $\theta$ [deg]")
    axes.set_ylabel("gravitational over elastic energy [%]")
    note(axes, "magnitude, upright or hanging")


def _draw_angles(axes: Axes) -> None:
    for way, color in HUES.items():
        angles = [study.theta_deg(tension, way) for tension in TENSIONS]
        here = study.theta_deg(study.TENSION, way)
        axes.plot(
            TENSIONS, angles, color=color, label=f"{way}: {here:.2f} deg at {study.TENSION:g} N"
        )
        axes.plot(study.TENSION, here, "o", color=color, markersize=5)
    axes.set(xlim=(0.0, TENSIONS[-1]), ylim=(0.0, None))
    axes.set_xlabel("tension of cable 1 [N]")
    axes.set_ylabel(r"bending angle at rest $\theta$ [deg]")
    note(axes, f"marked: at {study.TENSION:g} N")


def _draw_shapes(axes: Axes) -> None:
    for way, color in HUES.items():
        model = study.model_of(way)
        shape = robot_shape(model, model.equilibrium([study.TENSION, 0.0, 0.0]))
        axes.plot(*shape.backbone[:, [0, 2]].T, color=color, linewidth=2.2)
        for disk in shape.disks:
            rim = disk[[0, len(disk) // 2]]
            axes.plot(*rim[:, [0, 2]].T, color=color, linewidth=1.2, alpha=0.6)
    axes.axhline(0.0, color=BLACK, linewidth=2.0)
    axes.set_aspect("equal")
    axes.set_xlim(-0.1, 0.2)
    axes.set_xticks([0.0, 0.1, 0.2])
    axes.set_xlabel("x [m]")
    axes.set_ylabel("z [m]")
    note(axes, f"at rest under {study.TENSION:g} N")
