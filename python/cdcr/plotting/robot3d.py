"""The robot in space: base plate, backbone, disks and cables."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgba
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import-untyped]
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import Check, require_like
from cdcr.plotting import panels, space
from cdcr.plotting.geometry import base_plate, robot_shape, states_at
from cdcr.plotting.legend import ShapeSample, legend_of
from cdcr.plotting.sizes import Size, checked_size, is_narrow, resize
from cdcr.plotting.style import BLACK, DISK, GREY, StyledFigure, line_colors, style

if TYPE_CHECKING:
    from cdcr.model.model import Model
    from cdcr.runs.trajectory import Trajectory

SLACK_WIDTH, TAUT_WIDTH = 0.8, 2.2  # of the line of a cable [pt]
FINER = 0.6  # share of these, of the cables of several sections
MOST = 100  # shapes in a picture, beyond which nobody tells them apart
FAINTEST = 0.25  # opacity of the earliest of several shapes
PICTURE = np.array([7.0, 6.5])  # largest picture of a robot, legend apart [in]


class RobotArtists:
    """The drawing of one robot. `update` moves it without drawing anew."""

    def __init__(
        self, axes: Any, model: Model, q: FloatArray, *, alpha: float = 1.0, layer: float = 3.0
    ) -> None:
        """Draw the robot at q (d,) into Axes3D, above what lies in lower layers."""
        self._model = model
        shape = robot_shape(model, q)
        self.disks = Poly3DCollection(
            shape.disks,
            facecolor=to_rgba(DISK, 0.6 * alpha),
            edgecolor=to_rgba(GREY, alpha),
            linewidth=0.7,
            zorder=layer,
        )
        axes.add_collection3d(self.disks)
        self.marks = [
            axes.plot(*line.T, color=BLACK, linewidth=1.6, alpha=alpha, zorder=layer + 0.05)[0]
            for line in shape.marks
        ]
        self._width = 1.0 if model.num_sections == 1 else FINER
        self.backbones = [
            axes.plot(*line.T, color=color, linewidth=2.4, alpha=alpha, zorder=layer + 0.2)[0]
            for line, color in zip(shape.sections, section_colors(model), strict=True)
        ]
        # Matplotlib sorts by depth only what does not interlace. Here the base settles the order.
        outward = [cable[0] - shape.backbone[0] for cable in shape.cables]
        front = [arm @ space.towards_viewer(axes) > 0.0 for arm in outward]
        self.cables = [
            axes.plot(
                *cable.T,
                color=color,
                linewidth=1.2 * self._width,
                alpha=alpha,
                zorder=layer + (0.3 if is_front else 0.1),
            )[0]
            for cable, color, is_front in zip(
                shape.cables, panels.cable_colors(model), front, strict=True
            )
        ]

        self.tool = [
            axes.plot(*line.T, color=GREY, linewidth=1.8, alpha=alpha, zorder=layer + 0.2)[0]
            for line in shape.tool
        ]

    @property
    def lines(self) -> list[Any]:
        """Backbone of each section, then cables, the tool, and the marks of disks."""
        return [*self.backbones, *self.cables, *self.tool, *self.marks]

    def update(self, q: FloatArray) -> None:
        """Move everything to q (d,)."""
        shape = robot_shape(self._model, q)
        self.disks.set_verts(shape.disks)
        moved = (*shape.sections, *shape.cables, *shape.tool, *shape.marks)
        for line, points in zip(self.lines, moved, strict=True):
            line.set_data_3d(*points.T)

    def show_tension(self, tension: FloatArray, largest: float) -> None:
        """Draw the cables the thicker, the more tension (num_cables,) they carry."""
        for line, value in zip(self.cables, tension, strict=True):
            share = value / largest if largest > 0.0 else 0.0
            width = SLACK_WIDTH + (TAUT_WIDTH - SLACK_WIDTH) * share
            line.set_linewidth(width * self._width)

    def name_cables(self, suffixes: list[str] | None = None) -> None:
        """Name the cables for the legend; where there are several sections, name these."""
        if len(self.backbones) > 1 and not suffixes:
            for i, line in enumerate(self.backbones):
                line.set_label(f"section {i + 1}")
            return
        for j, line in enumerate(self.cables):
            line.set_label(f"cable {j + 1}" + (suffixes[j] if suffixes else ""))


def section_colors(model: Model) -> list[Any]:
    """One colour for the backbone of each section; black where there is one."""
    return [BLACK] if model.num_sections == 1 else line_colors(model.num_sections)


def plot_robot(
    model: Model,
    q: ArrayLike,
    ax: Any = None,
    *,
    tension: ArrayLike | None = None,
    alpha: float = 1.0,
    size: Size = None,
) -> Any:
    """Draw a robot in space, to scale.

    Parameters
    ----------
    model : Model
        The robot.
    q : array_like, shape (d,)
        Coordinates: bending vectors and twists [rad], stretches [m].
    ax : Axes3D, optional
        Axes to draw into; by default those of a new figure.
    tension : array_like, shape (num_cables,), optional
        Tensions [N]: told in the legend, and taut cables are drawn thicker.
    alpha : float
        Opacity, 0 to 1.
    size : optional
        Of the new figure, as in `Scenario.figure`.

    Returns
    -------
    Axes3D
        The axes; their figure is ``ax.figure``.

    Examples
    --------
    >>> import cdcr.plotting
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> cdcr.plotting.plot_robot(model, [0.5, 0.0]).get_zlabel()
    'z [m]'
    """
    require_like("model", model, "Model", "robot", "num_coordinates")
    state = _checked("q", q, model.num_coordinates)
    check = Check()
    opacity = check.number("alpha", alpha, "a number 0 to 1")
    if not 0.0 <= opacity <= 1.0 and not check.sentences:
        check.refuse("alpha", "a number 0 to 1", alpha)
    check.done()
    with style():
        axes = _axes(ax, size)
        show_robot(axes, model, [state])
        robot = RobotArtists(axes, model, state, alpha=opacity)
        if tension is None:
            robot.name_cables()
        else:
            values = _checked("tension", tension, model.num_cables)
            robot.show_tension(values, np.max(values, initial=0.0))
            robot.name_cables([f": {value:.3g} N" for value in values])
        if ax is None:
            _finish(axes, size)
    return axes


def plot_run_robot(
    run: Trajectory,
    times: ArrayLike | None = None,
    *,
    num: int = 5,
    ax: Any = None,
    size: Size = None,
) -> Any:
    """Draw the robot at several times of a run, as `Trajectory.plot_robot` does.

    Parameters
    ----------
    run : Trajectory
        The run.
    times, num, ax, size
        As in `Trajectory.plot_robot`.

    Returns
    -------
    Axes3D

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr.plotting
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> run = cdcr.simulate(model, [0, 0], [0, 0], t=np.linspace(0, 1, 11), tension=[5, 0, 0])
    >>> cdcr.plotting.plot_run_robot(run, [0.0, 1.0]).get_zlabel()
    'z [m]'
    """
    require_like("run", run, "Trajectory", "model", "tension", "tip")
    if times is None:
        check = Check()
        count = check.whole("num", num, f"a whole number 1 to {MOST}", low=1, high=MOST)
        check.done()
        times = np.linspace(run.t[0], run.t[-1], count)
    chosen = np.atleast_1d(finite(times, "times"))
    if chosen.ndim != 1 or not 1 <= chosen.size <= MOST:
        raise ValueError(f"times must have shape (M,) with M 1 to {MOST}, got {chosen.shape}")
    states = states_at(run, chosen)
    fading = np.linspace(FAINTEST, 1.0, len(chosen)) if len(chosen) > 1 else [1.0]
    with style():
        axes = _axes(ax, size)
        show_robot(axes, run.model, states, run.tip)
        axes.plot(*run.tip.T, color=GREY, linewidth=0.9, linestyle=":", label="path of the tip")
        for k, (time, q, alpha) in enumerate(zip(chosen, states, fading, strict=True)):
            name, colors = f"{time:.3g} s", section_colors(run.model)
            if len(colors) > 1:
                axes.add_line(ShapeSample(colors, alpha, name))
            robot = RobotArtists(axes, run.model, q, alpha=alpha, layer=3.0 + k)
            if len(colors) == 1:
                robot.backbones[0].set_label(name)
        robot.name_cables()
        if ax is None:
            _finish(axes, size)
    return axes


def show_robot(axes: Any, model: Model, states: Iterable[FloatArray], *more: FloatArray) -> None:
    """Show a base plate, and make Axes3D wide enough for all states (M, d) and more points."""
    plate = base_plate(model)
    shapes = [robot_shape(model, q).points for q in states]
    space.show_points(axes, np.concatenate([plate, *shapes, *more]))
    base = Poly3DCollection([plate], facecolor=GREY, edgecolor=BLACK, linewidth=0.8, zorder=1)
    axes.add_collection3d(base)


def _axes(ax: Any, size: Size) -> Any:
    """Return the axes to draw into, in a new figure where there are none."""
    checked_size(size)
    if ax is None:
        return space.add_axes(StyledFigure(figsize=PICTURE))
    if size is not None:
        raise ValueError("size is that of a new figure; give either ax or size, not both")
    if getattr(ax, "name", "") != "3d":
        kind = type(ax).__name__
        raise ValueError(f"ax must be an Axes3D, as projection='3d' makes one, got {kind}")
    space.label(ax)
    return ax


def _finish(axes: Any, size: Size) -> None:
    """Give a new picture its size, and its legend at the right, or below in a narrow one."""
    figure, legend_width = axes.figure, 0.0
    if axes.get_legend_handles_labels()[0]:
        legend = legend_of(figure, axes, loc="center right", borderaxespad=0.5, handlelength=1.4)
        legend_width = legend.get_window_extent().width / figure.dpi
    sides = checked_size(size)
    if is_narrow(sides):
        resize(figure, size)
    elif isinstance(sides, tuple):
        figure.set_size_inches(*sides)
        space.fill(axes, np.array([sides[0] - legend_width, sides[1]]))
    else:
        scale, room = space.fit(axes, PICTURE)
        figure.set_size_inches(room[0] + legend_width, room[1])
        space.place(axes, scale, room)


def _checked(name: str, value: ArrayLike, size: int) -> FloatArray:
    array = finite(value, name)
    if array.shape != (size,):
        raise ValueError(f"{name} must have shape ({size},), got {array.shape}")
    return array
