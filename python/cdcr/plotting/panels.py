"""A run over time: angles, tensions, tip and energy."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes

from cdcr.base.arrays import FloatArray
from cdcr.base.check import require_like
from cdcr.plotting.style import ALARM, BLACK, COLORS, GREY, StyledFigure, line_colors, style

if TYPE_CHECKING:
    from cdcr.model.model import Model
    from cdcr.robot.robot import Robot
    from cdcr.runs.trajectory import Trajectory

# Smallest spans shown, so that rounding noise does not fill a panel.
MIN_ANGLE = 1.0  # [deg]
MIN_TENSION = 0.05  # of what bends the robot by about 1 rad
MIN_LENGTH = 1e-3  # of the robot's length
MIN_ENERGY = 1e-9  # of what bends it by about 1 rad
MIN_ERROR = 1e-15  # [1]

PANEL = 1.9  # height that a name beside a panel needs [in]
MAX_NAMED = 9  # names in one row of a legend
MAX_CABLES = 18  # named in two rows
ROOMY = 6  # lines named without crowding
# Lines often coincide: dashes let the lower one be seen.
DASHES: tuple[Any, ...] = ("-", "--", "-.", ":", (0, (6, 1)), (0, (1, 2.5)))
# The same for short samples in a crowded legend.
SHORT_DASHES: tuple[Any, ...] = (
    "-",
    (0, (2.5, 1.2)),
    (0, (1, 1)),
    (0, (3, 1, 1, 1)),
    (0, (4.5, 0.8)),
    (0, (1, 2.2)),
)
Panel = Callable[[Axes, "Trajectory"], None]
MARKERS = ("", "o", "s", "^", "D", "v")  # of the cables after those that differ in dashes
NUM_MARKED = 8  # places along a line that carry its marker
STRAIGHT = 0.05  # share of the largest bending below which phi of several sections is not drawn


def plot_run(run: Trajectory) -> StyledFigure:
    """Draw a run over time, as `Trajectory.plot` does.

    Parameters
    ----------
    run : Trajectory
        The run.

    Returns
    -------
    Figure

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr.plotting
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> run = cdcr.simulate(model, [0, 0], [0, 0], t=np.linspace(0, 1, 11), tension=[5, 0, 0])
    >>> cdcr.plotting.plot_run(run).axes[0].get_ylabel()[:13]
    'bending angle'
    """
    require_like("run", run, "Trajectory", "model", "tension", "tip")
    left: list[Panel] = [plot_theta, plot_phi, *strain_panels(run.model), plot_tension]
    right: list[Panel] = [_plot_tip, _plot_energy, *[_plot_energy_error] * _is_free(run)]
    with style():
        height = max(6.6, PANEL * len(left))
        figure = StyledFigure(figsize=(11.0, height), layout="constrained")
        rows = math.lcm(len(left), len(right))
        grid = figure.add_gridspec(rows, 2)
        for column, panels in enumerate((left, right)):
            tall = rows // len(panels)
            for row, panel in enumerate(panels):
                axes = figure.add_subplot(grid[row * tall : (row + 1) * tall, column])
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
    return not is_damped(run.model.robot) and not run.tension.any()


def is_damped(robot: Robot) -> bool:
    """Whether any strain of any section loses energy by its rate."""
    return any(
        value > 0.0
        for section in robot.sections
        for value in (
            section.damping,
            section.twist_damping,
            section.stretch_damping,
            section.material_damping,
        )
    )


def plot_theta(axes: Axes, run: Trajectory) -> None:
    """Draw the bending angles [deg] over time."""
    _plot_lines(axes, run.t, np.rad2deg(run.theta), _numbered("section", run.model.num_sections))
    axes.set_ylabel(r"bending angle $\theta$ [deg]")
    keep_span(axes, MIN_ANGLE)


def plot_phi(axes: Axes, run: Trajectory) -> None:
    """Draw the orientation angles [deg] over time."""
    _plot_lines(axes, run.t, shown_phi(run), _numbered("section", run.model.num_sections))
    axes.set_ylabel(r"orientation $\varphi$ [deg]")
    keep_span(axes, MIN_ANGLE)


def strain_panels(model: Model) -> list[Panel]:
    """Return what draws twist and stretch of a run, of those that the robot has."""
    panels = {"t": plot_twist, "e": plot_stretch}
    return [panel for kind, panel in panels.items() if _sections_with(model, kind)]


def plot_twist(axes: Axes, run: Trajectory) -> None:
    """Draw by how much each section that twists is twisted from base to tip [deg] over time."""
    _plot_strain(axes, run, "t", 180.0 / np.pi)
    axes.set_ylabel("twist [deg]")
    keep_span(axes, MIN_ANGLE)


def plot_stretch(axes: Axes, run: Trajectory) -> None:
    """Draw by how much each section that stretches is longer than it was [mm] over time."""
    _plot_strain(axes, run, "e", 1e3)
    axes.set_ylabel("stretch [mm]")
    keep_span(axes, MIN_LENGTH * 1e3 * run.model.robot.length)


def _sections_with(model: Model, kind: str) -> list[int]:
    """Return the sections that twist, "t", or stretch, "e"."""
    return [i for i in range(model.num_sections) if f"{kind}{i + 1}" in model.coordinate_names]


def _plot_strain(axes: Axes, run: Trajectory, kind: str, unit: float) -> None:
    """Draw the first coefficient of a strain, its integral, in the colours of the sections."""
    model, found = run.model, _sections_with(run.model, kind)
    colors, names = line_colors(model.num_sections), _numbered("section", model.num_sections)
    for i in found:
        column = model.coordinate_names.index(f"{kind}{i + 1}")
        dashes = DASHES[i % len(DASHES)] if model.num_sections <= MAX_NAMED else "-"
        values = unit * run.q[:, column]
        axes.plot(run.t, values, color=colors[i], linestyle=dashes, label=names[i])
    if len(found) > 1:
        legend_above(axes, len(found))


def shown_phi(run: Trajectory) -> FloatArray:
    """Return the orientation angles (N, n) [deg] as they are drawn.

    They are those of the run, continuous; of several sections, not drawn (NaN) where a section is
    nearly straight, and without the whole turns that it makes there.
    """
    phi: FloatArray = np.rad2deg(run.phi)
    if run.model.num_sections > 1:
        theta = np.abs(run.theta)
        phi[theta < STRAIGHT * theta.max()] = np.nan
        for column in phi.T:
            shown = np.flatnonzero(np.isfinite(column))
            for piece in np.split(shown, np.flatnonzero(np.diff(shown) > 1) + 1):
                if piece.size:
                    column[piece] -= 360.0 * np.round(column[piece[0]] / 360.0)
    return phi


def plot_tension(axes: Axes, run: Trajectory) -> None:
    """Draw the cable tensions [N] over time."""
    model = run.model
    names = _numbered("cable", model.num_cables, MAX_CABLES)
    for j, (name, look) in enumerate(zip(names, cable_looks(model, len(run)), strict=True)):
        axes.plot(run.t, run.tension[:, j], label=name, **look)
    if model.num_cables > 1:
        legend_above(axes, model.num_cables)
    axes.set_ylabel("tension [N]")
    radius = max((cable.farthest for cable in model.robot.all_cables), default=1.0)
    top = max(MIN_TENSION * _stiffness(model) / radius, np.max(run.tension, initial=0.0))
    axes.set_ylim(-0.05 * top, 1.08 * top)  # a line along zero stays clear of the frame
    if not run.model.num_cables:
        axes.text(0.5, 0.5, "no cables", transform=axes.transAxes, ha="center", color=GREY)


def cable_colors(model: Model) -> list[Any]:
    """One colour for each cable; of several sections, that of the section where it ends."""
    if model.num_sections == 1:
        return [COLORS[j % len(COLORS)] for j in range(model.num_cables)]
    colors = line_colors(model.num_sections)
    return [colors[cable.end_section] for cable in model.robot.all_cables]


def cable_looks(model: Model, samples: int) -> list[dict[str, Any]]:
    """One kind of line for each cable, as arguments of `plot`; 36 that end together differ.

    Dashes tell the first few that end together apart, markers the others. `samples` are those of a
    line.
    """
    kinds = DASHES if model.num_cables <= ROOMY else SHORT_DASHES
    ends = [cable.end_section for cable in model.robot.all_cables]
    looks = []
    for j, (end, color) in enumerate(zip(ends, cable_colors(model), strict=True)):
        turn, kind = divmod(ends[:j].count(end), len(kinds))
        look = {"color": color, "linestyle": kinds[kind]}
        if turn:
            every = max(1, samples // NUM_MARKED)
            first = j * every // model.num_cables  # markers of coinciding lines stand apart
            look |= {"marker": MARKERS[turn % len(MARKERS)], "markersize": 4.0}
            look |= {"markevery": (first, every)}
        looks.append(look)
    return looks


def _plot_tip(axes: Axes, run: Trajectory) -> None:
    _plot_lines(axes, run.t, run.tip, ["x", "y", "z"])
    axes.set_ylabel("tip position [m]")
    keep_span(axes, MIN_LENGTH * run.model.robot.length)


def _stiffness(model: Model) -> float:
    """Return the bending stiffness of the stiffest section [N m/rad]."""
    return max(section.stiffness for section in model.robot.sections)


def _plot_energy(axes: Axes, run: Trajectory) -> None:
    kinetic, potential, *_ = line_colors(2)
    axes.plot(run.t, run.energy, color=BLACK, label="total")
    axes.plot(run.t, run.kinetic_energy, color=kinetic, label="kinetic")
    axes.plot(run.t, run.potential_energy, color=potential, label="potential", linestyle=DASHES[1])
    legend_above(axes, 3)
    axes.set_ylabel("energy [J]")
    keep_span(axes, MIN_ENERGY * _stiffness(run.model))


def _plot_energy_error(axes: Axes, run: Trajectory) -> None:
    axes.plot(run.t, run.energy_error, color=BLACK)
    axes.set_ylabel("relative energy error [1]")
    keep_span(axes, MIN_ERROR)


def _plot_lines(axes: Axes, t: FloatArray, values: FloatArray, names: Sequence[str]) -> None:
    """Draw the columns of values (N, k) over t, with a legend where there are several."""
    count = values.shape[1]
    for k, (name, color) in enumerate(zip(names, line_colors(count), strict=True)):
        dashes = DASHES[k % len(DASHES)] if count <= MAX_NAMED else "-"
        axes.plot(t, values[:, k], color=color, linestyle=dashes, label=name)
    if count > 1:
        legend_above(axes, count)


def _numbered(noun: str, count: int, room: int = MAX_NAMED) -> list[str]:
    """Names for a legend: noun 1, 2, 3, ..., not more than have room."""
    step = -(-count // room) or 1
    unnamed = "_"  # Matplotlib leaves it out of the legend
    names = [f"{k + 1}" if k % step == 0 else unnamed for k in range(count)]
    return [f"{noun} 1", *names[1:]] if names else []


def legend_above(axes: Axes, count: int = 4) -> None:
    """Put the legend of `count` lines above a panel, so that it lies on no data."""
    named = len(axes.get_legend_handles_labels()[0])
    rows = -(-named // MAX_NAMED)
    axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=max(1, -(-named // max(1, rows))),
        borderaxespad=0.1,
        columnspacing=1.2 if count <= ROOMY else 0.7,
        handlelength=1.8 if count <= ROOMY else 1.3,
        handletextpad=0.8 if count <= ROOMY else 0.4,
    )


def keep_span(axes: Axes, smallest: float) -> None:
    """Widen the y limits evenly where they are closer than `smallest`."""
    low, high = axes.get_ylim()
    missing = smallest - (high - low)
    if missing > 0.0:
        axes.set_ylim(low - missing / 2, high + missing / 2)
