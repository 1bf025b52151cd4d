"""Mode shapes of a robot, beside the shape it rests in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, require_like
from cdcr.plotting import space
from cdcr.plotting.geometry import PIECES
from cdcr.plotting.letters import shrink_letters
from cdcr.plotting.sizes import COLUMN, TEXT, Size, checked_size, is_narrow
from cdcr.plotting.style import ALARM, BLACK, GREY, StyledFigure, line_colors, style

if TYPE_CHECKING:
    from cdcr.model.model import Model
    from cdcr.model.modes import Modes

PANEL = np.array([2.9, 4.4])  # [in]
SWING = (1.0, 0.5)  # of the phases drawn to each side of rest, the full one last
VIEW = {"elev": 24.0, "azim": -52.0}  # [deg]: shows motion along x and along y
TITLE = 0.5  # room above each panel [in]
FOOT = 0.15  # and below all [in]
MAX_COLUMNS = 64  # two for each section: all beside each other
LEAST_WIDTH = 1.6  # of a panel where there is room for another below [in]


def plot_modes(
    modes: Modes, count: int = 4, *, deflection: float = 0.15, size: Size = None
) -> StyledFigure:
    """Draw the first mode shapes: the backbone at rest and swung to both sides.

    Parameters
    ----------
    modes : Modes
        Answer of `Model.modes`.
    count : int
        Modes to draw at most, the slowest first.
    deflection : float
        Farthest that a point of the backbone is moved, as a share of the robot's length; the true
        size of a free vibration is whatever started it.
    size : optional
        As in `Scenario.figure`.

    Returns
    -------
    Figure
        One panel for each mode, with its frequency [Hz] and damping ratio.

    Examples
    --------
    >>> import cdcr.plotting
    >>> model = cdcr.Model(cdcr.robots.three_sections())
    >>> modes = model.modes([0.0] * 6, [0.0] * 9)
    >>> len(cdcr.plotting.plot_modes(modes, count=2).axes)
    2
    """
    require_like("modes", modes, "Modes", "frequency", "model")
    check = Check()
    count = check.whole("count", count, "a whole number >= 1", low=1)
    share = check.number("deflection", deflection, "> 0 and <= 1", above=0.0)
    if share > 1.0:
        check.refuse("deflection", "> 0 and <= 1", deflection)
    check.done()
    if modes.frequency.ndim > 1:
        raise ValueError(
            "modes must be those of one shape to be drawn, got those of an array of shape "
            f"{modes.frequency.shape[:-1]}"
        )
    shown = min(count, len(modes.frequency))
    rest = _backbone(modes.model, modes.q)
    swings = [_swings(modes, k, share * modes.model.robot.length) for k in range(shown)]
    points = np.concatenate([rest, *(line for pair in swings for line in pair)])
    sides = checked_size(size)
    with style():
        columns = min(shown, _columns(sides))
        rows = -(-shown // columns)
        panel = _panel(sides, columns, rows)
        figure = StyledFigure(figsize=tuple(panel * [columns, rows] + [0.0, TITLE * rows + FOOT]))
        paper = figure.get_size_inches()
        letters = TEXT if is_narrow(sides) else 1.0
        for k, (color, pair) in enumerate(zip(line_colors(shown), swings, strict=True)):
            axes = space.add_axes(figure)
            axes.view_init(**VIEW)
            space.show_points(axes, points)
            space.fill(axes, panel, letters)
            row, column = divmod(k, columns)
            height = FOOT + (rows - 1 - row) * (panel[1] + TITLE)
            corner = np.array([column * panel[0], height]) / paper
            box = axes.get_position()
            axes.set_position((box.x0 + corner[0], box.y0 + corner[1], box.width, box.height))
            for j, line in enumerate(pair):
                axes.plot(*line.T, color=color, alpha=1.0 if j % len(SWING) == 0 else 0.45)
            axes.plot(*rest.T, color=BLACK, linewidth=2.4)
            unstable = modes.squared_frequency[k] <= 0.0
            middle = corner + np.array([panel[0], 2.0 * panel[1] + TITLE]) / 2.0 / paper
            figure.text(
                middle[0],
                middle[1],
                _label(modes, k),
                ha="center",
                va="center",
                color=ALARM if unstable else BLACK,
            )
        if not modes.stable:
            figure.text(0.01, 0.01, "not stable", color=ALARM)
        figure.text(0.99, 0.01, "black: at rest", color=GREY, ha="right")
        if is_narrow(sides):
            shrink_letters(figure, TEXT)
    return figure


def _columns(sides: Any) -> int:
    """Return how many panels have room beside each other."""
    if sides is None:
        return MAX_COLUMNS
    return 2 if isinstance(sides, str) else max(1, int(sides[0] / LEAST_WIDTH))


def _panel(sides: Any, columns: int, rows: int) -> FloatArray:
    """Return width and height of a panel, titles apart [in]."""
    if sides is None:
        return PANEL
    if isinstance(sides, str):
        width = COLUMN / columns
        return np.array([width, width * PANEL[1] / PANEL[0]])
    return np.array([sides[0] / columns, max((sides[1] - FOOT) / rows - TITLE, TITLE)])


def _label(modes: Modes, k: int) -> str:
    """Name mode k, with its frequency."""
    if modes.squared_frequency[k] <= 0.0:
        return f"mode {k + 1}: unstable"
    text = f"mode {k + 1}: {modes.frequency_hz[k]:.3g} Hz"
    ratio = modes.damping_ratio[k]
    return text if abs(ratio) < 1e-12 else f"{text}\ndamping ratio {ratio:.2g}"


def _backbone(model: Model, q: FloatArray) -> FloatArray:
    """Points (P, 3) of the backbone at q [m]."""
    points = [np.array(model.robot.base_position)]
    for i in range(model.num_sections):
        points += [model.pose(q, i, k / PIECES)[1] for k in range(1, PIECES + 1)]
    return np.array(points)


def _swings(modes: Modes, k: int, farthest: float) -> list[FloatArray]:
    """Backbones swung to both sides in mode k, the farthest point about `farthest` away [m]."""
    model, shape = modes.model, modes.shape[:, k]
    rest = _backbone(model, modes.q)
    small = 1e-6 / np.max(np.abs(shape))
    moved = _backbone(model, modes.q + small * shape) - rest
    size = small * farthest / np.max(np.linalg.norm(moved, axis=1))
    return [
        _backbone(model, modes.q + side * phase * size * shape)
        for side in (1.0, -1.0)
        for phase in SWING
    ]
