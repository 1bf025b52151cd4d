"""The picture of a robot driven by cable lengths: angles, errors, tensions, and its shape."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from cdcr.plotting import space
from cdcr.plotting.geometry import states_at
from cdcr.plotting.robot3d import RobotArtists, show_robot
from cdcr.plotting.style import BLACK, GREY, LIGHT_GREY, StyledFigure, line_colors, style
from cdcr.scenarios.figures.drawing import legend_over, name_point, note, share_time
from cdcr.scenarios.figures.workspace import add_panels, new_figure
from cdcr.scenarios.studies.length_drive import BACK, GO, errors, stiffer, wanted

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory
    from cdcr.scenarios.scenario import Scenario

SIZE = (12.4, 6.8)  # of the picture [in]
ROOM = np.array([6.1, 6.0])  # of the robot in space, left [in]
MIN_ERROR = 1e-3  # errors of less than that are as good as none, and not drawn [deg]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw the robot where it starts and where it is held, and four panels over time."""
    with style():
        figure = new_figure(scenario.title, SIZE)
        _draw_robot(figure, scenario, run)
        place = {"left": 0.56, "right": 0.945, "bottom": 0.075, "top": 0.91, "hspace": 0.3}
        theta, error, tension = add_panels(figure, [1.2, 1.0, 1.6], **place)
        _draw_theta(theta, scenario, run)
        _draw_errors(error, scenario, run)
        _draw_tensions(tension, run)
        share_time(figure, [theta, error, tension], run)
    return figure


def _draw_robot(figure: StyledFigure, scenario: Scenario, run: Trajectory) -> None:
    times = np.unique(np.clip([GO, BACK], run.t[0], run.t[-1]))
    shapes = states_at(run, times)
    ideal = wanted(scenario, times[-1:])[0]
    axes: Any = space.add_axes(figure)
    show_robot(axes, run.model, [*shapes, ideal], run.tip)
    for k, (q, alpha) in enumerate(zip(shapes, (0.3, 1.0)[-len(shapes) :], strict=True)):
        RobotArtists(axes, run.model, q, alpha=alpha, layer=3.0 + k)
    sections = range(run.model.num_sections)
    places = np.linspace(0.0, 1.0, 25)
    line = np.array([run.model.pose(ideal, i, x)[1] for i in sections for x in places])
    axes.plot(*line.T, color=BLACK, linewidth=1.8, linestyle=":", zorder=20, label="wanted")
    axes.plot(*run.tip.T, color=GREY, linewidth=1.0, zorder=19, label="path of the tip")
    space.fill(axes, ROOM)
    legend_over(figure, axes, ROOM, 0.86)


def _draw_theta(axes: Axes, scenario: Scenario, run: Trajectory) -> None:
    asked = np.rad2deg(np.linalg.norm(wanted(scenario, run.t).reshape(len(run), -1, 2), axis=2))
    reached = np.rad2deg(np.abs(run.theta))
    colors = line_colors(run.model.num_sections)
    for i, color in enumerate(colors):
        axes.plot(run.t, asked[:, i], color=color, linestyle="--", linewidth=1.2)
        axes.plot(run.t, reached[:, i], color=color)
    axes.set_ylabel(r"bending angle $\theta$ [deg]")
    axes.margins(y=0.2)
    note(axes, "dashed: commanded; full: reached")
    held = int(np.searchsorted(run.t, min((GO + 3.0 * BACK) / 4.0, run.t[-1])))
    for i, color in enumerate(colors):
        point = (run.t[held], asked[held, i])
        name_point(axes, f"section {i + 1}", point, (0, 2), ha="center", va="bottom", color=color)


def _draw_errors(axes: Axes, scenario: Scenario, run: Trajectory) -> None:
    better = stiffer(scenario, float(run.t[-1]))
    stiffness = better.model.robot.sections[0].cable_stiffness
    colors = line_colors(run.model.num_sections)
    for one, dashes in ((run, "-"), (better, "-.")):
        for values, color in zip(np.rad2deg(errors(scenario, one)).T, colors, strict=True):
            axes.plot(
                one.t, np.where(values > MIN_ERROR, values, np.nan), color=color, linestyle=dashes
            )
    axes.set_yscale("log")
    axes.set_ylabel("error [deg]")
    note(axes, f"full: as above; dash-dotted: cables of {1e-3 * stiffness:g} N/mm")


def _draw_tensions(axes: Axes, run: Trajectory) -> None:
    """Draw each cable in a lane of its own, grey where it is slack."""
    top = float(np.max(run.tension))
    owners = [cable.end_section for cable in run.model.robot.all_cables]
    colors = line_colors(run.model.num_sections)
    for j, (values, owner) in enumerate(zip(run.tension.T, owners, strict=True)):
        base = float(-j)
        axes.fill_between(
            run.t, base, base + 0.9, where=values <= 0.0, color=LIGHT_GREY, linewidth=0
        )
        axes.plot(run.t, base + 0.85 * values / top, color=colors[owner], linewidth=1.3)
    for event in run.slack_events:
        axes.plot([event.time] * 2, [-event.cable, 0.9 - event.cable], color=BLACK, linewidth=0.8)
    count = len(owners)
    axes.set_yticks([-j + 0.4 for j in range(count)], [str(j + 1) for j in range(count)])
    axes.set_ylim(-count + 0.9, 1.0)
    axes.set_ylabel("tension of cable")
    axes.grid(visible=False, axis="y")
    axes.spines["left"].set_visible(False)
    axes.tick_params(axis="y", length=0)
    note(axes, "grey: slack")
    axes.plot(
        [1.012] * 2,
        [0.0, 0.85],
        color=BLACK,
        linewidth=1.2,
        clip_on=False,
        transform=axes.get_yaxis_transform(),
    )
    axes.text(
        1.02, 0.42, f"{top:.1f} N", transform=axes.get_yaxis_transform(), va="center", fontsize=9.5
    )
