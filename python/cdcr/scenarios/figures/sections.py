"""Pictures of robots of several sections: the robot in space beside panels over time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from cdcr.plotting import panels, space
from cdcr.plotting.geometry import states_at
from cdcr.plotting.robot3d import RobotArtists, section_colors, show_robot
from cdcr.plotting.style import BLACK, GREY, StyledFigure, line_colors, style
from cdcr.scenarios.figures.drawing import legend_above, note
from cdcr.scenarios.figures.workspace import new_figure
from cdcr.scenarios.studies.energy import cable_work, dissipated
from cdcr.scenarios.studies.three_sections import BENT, PHASE, ends, goals

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory

Array = NDArray[np.float64]

SIZE = (12.4, 8.0)  # of the picture [in]
ROOM = np.array([5.9, 7.0])  # of the robot in space, left [in]
FAINTEST = 0.3  # opacity of the earliest of several shapes
STILL = 1e-6  # a bending component that moves less is not drawn [rad]
BEYOND = 0.045  # from a tip to the name of the shape [m]
SLANTED = 0.3  # a name beside a tip starts or ends there, one above or below is centred


def three_sections_figure(title: str, run: Trajectory) -> StyledFigure:
    """Draw the robot at the end of each phase, how its sections bend, and its tensions."""
    last = [sample for _, sample in ends(run)] or [len(run) - 1]
    names = [f"{k + 1} driven" for k in range(len(last))]
    with style():
        figure = new_figure(title, SIZE)
        states = np.concatenate([[run.q[0]], run.q[last]])
        _draw_robot(figure, run, states, ["straight", *names], np.ones(len(states)))
        heights = [1.4, 1.4, *[1.0] * len(BENT)]
        bend_x, bend_y, *pulls = charts = _add_panels(figure, heights)
        for axes, k, name in ((bend_x, 0, "x"), (bend_y, 1, "y")):
            _draw_bending(axes, run, k)
            _draw_goals(axes, run, k)
            axes.set_ylabel(f"bending to {name} [deg]", fontsize=9.5)
        note(bend_x, "of each section, in the frame of its base; dashed: asked for")
        for i, axes in enumerate(pulls):
            _draw_tensions(axes, run, i)
        _finish(figure, charts, run)
    return figure


def release_figure(
    title: str, run: Trajectory, rest: Array, shown: Sequence[float], fallen: str = ""
) -> StyledFigure:
    """Draw a robot on a wall that swings to rest at q = `rest` (2n,): shapes, bending, tip, energy.

    Shapes are drawn at the times `shown` [s]; `fallen` names what has just fallen off at the start.
    """
    times = np.array([time for time in shown if time <= run.t[-1]])
    with style():
        figure = new_figure(title, SIZE)
        states = np.concatenate([states_at(run, times), [rest]])
        names = [*(f"{time:g} s" for time in times), "at rest"]
        names[0] = "" if fallen else names[0]  # the legend tells
        fading = np.append(np.linspace(FAINTEST, 0.8, len(times)), 1.0)
        _draw_robot(figure, run, states, names, fading, fallen)
        moving = [k for k in (0, 1) if np.ptp(run.q[:, k::2]) > STILL]
        pulled = bool(run.tension.any())
        charts = _add_panels(figure, [1.2] * (len(moving) + 2) + [0.9] * pulled)
        *bends, tip, energy = timed = charts[: len(moving) + 2]
        for k, axes in zip(moving, bends, strict=True):
            _draw_bending(axes, run, k)
            axes.set_ylabel(f"bending {('up', 'sideways')[k]} [deg]", fontsize=9.5)
        note(bends[0], "of each section, in the frame of its base")
        _draw_tip(tip, run, run.model.tip(rest)[1])
        _draw_energy(energy, run)
        _finish(figure, timed, run)
        if pulled:
            _draw_held_tensions(charts[-1], run)
            figure.align_ylabels(charts)
    return figure


def _draw_robot(
    figure: StyledFigure,
    run: Trajectory,
    states: Array,
    names: Sequence[str],
    fading: Array,
    fallen: str = "",
) -> None:
    """Draw the robot at states (M, 2n), each named at its tip, and the path of the tip."""
    axes = space.add_axes(figure)
    model = run.model
    show_robot(axes, model, states, run.tip)
    axes.plot(*run.tip.T, color=GREY, linewidth=0.9, linestyle=":", label="path of the tip")
    for k, (q, alpha) in enumerate(zip(states, fading, strict=True)):
        robot = RobotArtists(axes, model, q, alpha=float(alpha), layer=3.0 + k)
    robot.name_cables()
    scale, _ = space.fit(axes, ROOM)
    space.place(axes, scale, ROOM)
    if fallen:
        axes.plot(*run.tip[:1].T, "o", color=BLACK, markersize=9, zorder=25, label=f"{fallen}, 0 s")
    for q, name in zip(states, names, strict=True):
        _name_shape(axes, *model.tip(q), name)
    handles, labels = axes.get_legend_handles_labels()
    middle = ROOM[0] / SIZE[0] / 2.0
    figure.legend(
        handles,
        labels,
        loc="upper center",
        bbox_to_anchor=(middle, 0.95),
        ncols=len(labels),
        handlelength=1.4,
        columnspacing=1.2,
    )


def _name_shape(axes: Any, R: Array, p: Array, name: str) -> None:
    """Write a name beyond the tip of a shape."""
    paper = space.paper_directions(axes)
    across, _ = away = paper @ R[:, 2] / np.linalg.norm(paper @ R[:, 2])
    side = "center" if abs(across) < SLANTED else "left" if across > 0.0 else "right"
    place = p + BEYOND * away @ paper
    axes.text(*place, name, fontsize=9.5, color=BLACK, ha=side, va="center", zorder=30)


def _add_panels(figure: StyledFigure, heights: Sequence[float]) -> list[Axes]:
    grid = figure.add_gridspec(
        len(heights),
        1,
        left=0.545,
        right=0.98,
        bottom=0.075,
        top=0.91,
        hspace=0.42,
        height_ratios=list(heights),
    )
    return [figure.add_subplot(grid[row]) for row in range(len(heights))]


def _finish(figure: StyledFigure, charts: Sequence[Axes], run: Trajectory) -> None:
    for axes in charts:
        panels.show_time(axes, run, named=axes is charts[-1])
    figure.align_ylabels(charts)


def _draw_bending(axes: Axes, run: Trajectory, component: int) -> None:
    """Draw a component of the bending vectors over time."""
    for i, color in enumerate(section_colors(run.model)):
        column = 2 * i + component
        axes.plot(run.t, np.rad2deg(run.q[:, column]), color=color, label=f"section {i + 1}")
    panels.keep_span(axes, panels.MIN_ANGLE)


def _draw_goals(axes: Axes, run: Trajectory, component: int) -> None:
    """Draw where the section that is driven should come to rest."""
    for k, last in ends(run):
        asked = np.rad2deg(goals()[k, 2 * k + component])
        edges = [k * PHASE, run.t[last]]
        axes.plot(edges, [asked, asked], color=BLACK, linewidth=0.9, dashes=(6, 4))


def _draw_tensions(axes: Axes, run: Trajectory, section: int) -> None:
    """Draw the tensions of the cables that end at a section."""
    model = run.model
    colors, dashes = panels.cable_colors(model), panels.cable_dashes(model)
    for j, cable in enumerate(model.robot.all_cables):
        if cable.end_section == section:
            label = f"cable {j + 1}"
            values = run.tension[:, j]
            axes.plot(run.t, values, color=colors[j], linestyle=dashes[j], label=label)
    axes.set_ylim(-0.05 * run.tension.max(), 1.08 * run.tension.max())
    axes.set_ylabel("tension [N]")
    note(axes, f"cables that end at section {section + 1}")
    legend_above(axes)


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


def _draw_tip(axes: Axes, run: Trajectory, rest: Array) -> None:
    for k, (name, color) in enumerate(zip("xyz", line_colors(6)[3:], strict=True)):
        axes.plot(run.t, run.tip[:, k], color=color, label=name)
        axes.axhline(rest[k], color=color, linewidth=0.9, dashes=(6, 4))
    axes.set_ylabel("tip position [m]")
    note(axes, "dashed: at rest")
    legend_above(axes)


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
    legend_above(axes)
