"""The picture of the flow of data."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch

from cdcr.plotting.style import BLACK, GREY, StyledFigure, style
from cdcr.scenarios.figures.drawing import new_figure

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (11.0, 5.0)  # [in]
HALF_WIDTH, HALF_HEIGHT = 0.98, 0.42
GIVEN, COMPUTED, CONTROL = "#E9EDF1", "#D6E6F2", "#F6E0CF"


class Block(NamedTuple):
    """What is given or computed: its name, what it does, where it stands."""

    name: str
    content: str
    x: float
    y: float
    color: str = COMPUTED


class Flow(NamedTuple):
    """What goes along a line of corners (x, y); the words stand at `at`."""

    words: str
    at: tuple[float, float]
    corners: tuple[tuple[float, float], ...]


ROBOT = Block("Robot", "sections, cables,\ngravity, payload", 0.0, 0.0, GIVEN)
MODEL = Block("Model", r"$M(q)$, $h(q, \dot q)$, $B$" + "\nseries in $|q|^2$", 3.0, 0.0)
FORWARD = Block("simulate", r"$M \ddot q + h = B F$" + "\nrk4, dopri5, CVODE", 6.2, 0.0)
RUN = Block("Trajectory", r"$q$, $\dot q$; $\theta$, $\varphi$" + "\ntip, energy", 9.4, 0.0, GIVEN)
REFERENCE = Block("Reference", r"$q$, $\dot q$, $\ddot q$ over time", 3.0, 1.9, GIVEN)
INVERSE = Block("inverse_run", r"$B F = M \ddot q + h$" + "\nleast tensions $F$", 6.2, 1.9)
PID = Block("Pid", "each period:\nforce, then tensions", 6.2, -1.9, CONTROL)
BLOCKS = (ROBOT, MODEL, FORWARD, RUN, REFERENCE, INVERSE, PID)

FLOWS = (
    Flow("validated", (1.5, 0.14), ((0.98, 0.0), (2.02, 0.0))),
    Flow("", (0.0, 0.0), ((3.98, 0.0), (5.22, 0.0))),
    Flow("motion", (9.4 - 1.6, 0.14), ((7.18, 0.0), (8.42, 0.0))),
    Flow("motion asked for", (4.6, 2.04), ((3.98, 1.9), (5.22, 1.9))),
    Flow("", (0.0, 0.0), ((4.45, 0.0), (4.45, 1.55), (5.22, 1.55))),
    Flow("", (0.0, 0.0), ((4.45, 0.0), (4.45, -1.65), (5.22, -1.65))),
    Flow("tension table $F(t)$", (7.12, 0.95), ((6.2, 1.48), (6.2, 0.42))),
    Flow(r"$q$, $\dot q$ each period", (8.4, -1.76), ((9.4, -0.42), (9.4, -1.9), (7.18, -1.9))),
    Flow("tensions $F$, held", (7.07, -0.95), ((6.2, -1.48), (6.2, -0.42))),
    Flow("reference $q$", (4.0, -2.23), ((3.0, -2.08), (5.22, -2.08))),
)


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw the blocks and what flows between them."""
    with style():
        figure = new_figure(scenario.title, SIZE)
        axes = figure.subplots()
        axes.set_axis_off()
        axes.set_aspect("equal")
        for block in BLOCKS:
            _draw_block(axes, block)
        for flow in FLOWS:
            _draw_flow(axes, flow)
        axes.set(xlim=(-1.2, 10.6), ylim=(-2.5, 2.5))
    return figure


def _draw_block(axes: Axes, block: Block) -> None:
    corner = (block.x - HALF_WIDTH, block.y - HALF_HEIGHT)
    axes.add_patch(
        FancyBboxPatch(
            corner,
            2 * HALF_WIDTH,
            2 * HALF_HEIGHT,
            boxstyle="round,pad=0,rounding_size=0.1",
            facecolor=block.color,
            edgecolor=GREY,
            linewidth=0.9,
        )
    )
    axes.text(block.x, block.y + 0.22, block.name, ha="center", va="center", weight="bold")
    axes.text(block.x, block.y - 0.13, block.content, ha="center", va="center", fontsize=8.5)


def _draw_flow(axes: Axes, flow: Flow) -> None:
    *_, before, end = flow.corners
    axes.plot(*zip(*flow.corners[:-1], strict=True), color=BLACK, linewidth=1.1)
    arrow = {"arrowstyle": "-|>", "color": BLACK, "linewidth": 1.1, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, before, arrowprops=arrow)
    if flow.words:
        axes.text(*flow.at, flow.words, ha="center", va="center", fontsize=8.5, style="italic")
