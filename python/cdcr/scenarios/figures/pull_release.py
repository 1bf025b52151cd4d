"""The picture of a cable with friction: its loop, its tensions, and the heat it makes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting import panels
from cdcr.plotting.style import BLACK, COLORS, GREY, StyledFigure, style
from cdcr.scenarios.figures.drawing import new_figure, note
from cdcr.scenarios.studies import pull_release as study
from cdcr.scenarios.studies.energy import integral

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory
    from cdcr.scenarios.scenario import Scenario

RUB, SMOOTH, FAR = COLORS[1], BLACK, COLORS[0]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the loop in space and in work, the tensions, and the power of friction."""
    smooth = study.frictionless(scenario, float(run.t[-1]))
    with style():
        figure = new_figure(scenario.title, (12.4, 7.4))
        left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=[1.0, 1.05])[0]
        loop, work = left.subplots(2, 1)
        tension, power = right.subplots(2, 1, height_ratios=[1.35, 1.0])
        _draw_loop(loop, run, smooth)
        _draw_work(work, run, smooth)
        _draw_tension(tension, run)
        _draw_power(power, run)
        for part in (left, right):
            part.align_ylabels()
    return figure


def _draw_loop(axes: Axes, run: Trajectory, smooth: Trajectory) -> None:
    friction = study.coefficients(run)[0]
    axes.plot(1e3 * run.tip[:, 0], run.tension[:, 0], color=RUB, label=rf"$\mu$ = {friction:g}")
    way = 1e3 * smooth.tip[:, 0]
    axes.plot(way, smooth.tension[:, 0], color=SMOOTH, linewidth=1.2, label=r"$\mu$ = 0")
    axes.set_xlabel("tip displacement x [mm]")
    axes.set_ylabel("tension at the base [N]")
    axes.set_ylim(-0.4, 1.12 * study.FULL)
    note(axes, "pulled above, released below, both times")
    panels.legend_above(axes)
    band = study.dead_band(run)
    if band is not None:
        right = 1e3 * float(np.max(smooth.tip[:, 0])) * 1.035
        axes.annotate(
            "",
            xy=(right, study.FULL - band[0]),
            xytext=(right, study.FULL),
            arrowprops={"arrowstyle": "<->", "color": GREY, "shrinkA": 0, "shrinkB": 0},
        )
        middle = study.FULL - band[0] / 2.0
        axes.text(1.02 * right, middle, f"dead band\n{band[0]:.2f} N", va="center", color=BLACK)
        axes.set_xlim(None, 1.27 * right)


def _draw_work(axes: Axes, run: Trajectory, smooth: Trajectory) -> None:
    cycle = run.t <= run.t[0] + 2.0 * study.RAMP
    way, force = 1e3 * study.pulled(run)[cycle], run.tension[cycle, 0]
    axes.fill(way, force, color=RUB, alpha=0.18, linewidth=0)
    axes.plot(way, force, color=RUB)
    axes.plot(1e3 * study.pulled(smooth), smooth.tension[:, 0], color=SMOOTH, linewidth=1.2)
    axes.set_xlabel("cable 1 pulled out of the robot [mm]")
    axes.set_ylabel("tension at the base [N]")
    axes.set_ylim(-0.4, 1.12 * study.FULL)
    if run.t[-1] >= run.t[0] + 2.0 * study.RAMP:
        area = float(integral(force, way))  # N mm
        rate = np.sum(run.qd[cycle] ** 2, axis=1)
        damped = 1e3 * study.coefficients(run)[1] * float(integral(rate, run.t[cycle]))
        axes.text(
            0.03,
            0.95,
            f"area: {area:.2f} mJ a cycle,\n{area - damped:.2f} mJ of it to friction",
            transform=axes.transAxes,
            va="top",
        )


def _draw_tension(axes: Axes, run: Trajectory) -> None:
    far, theta = study.beyond(run), np.abs(run.theta[:, 0])
    base, friction = run.tension[:, 0], study.coefficients(run)[0]
    axes.fill_between(
        run.t,
        base * np.exp(-friction * theta),
        base * np.exp(friction * theta),
        color=FAR,
        alpha=0.15,
        linewidth=0,
    )
    axes.plot(run.t, base, color=BLACK, linewidth=1.2, label="at the base")
    axes.plot(run.t, far, color=FAR, label="beyond the section")
    axes.set_ylabel("tension of cable 1 [N]")
    axes.set_ylim(-0.4, 1.34 * study.FULL)
    axes.margins(x=0.0)
    note(axes, r"shaded: allowed by friction, $F\,e^{\pm\mu\theta}$")
    panels.legend_above(axes)
    panels.show_time(axes, run, named=False)


def _draw_power(axes: Axes, run: Trajectory) -> None:
    axes.fill_between(run.t, 1e3 * study.friction_power(run), color=RUB, alpha=0.18, linewidth=0)
    axes.plot(run.t, 1e3 * study.friction_power(run), color=RUB)
    axes.set_ylabel("power of friction [mW]")
    axes.set_ylim(0.0, None)
    panels.show_time(axes, run, named=True)
