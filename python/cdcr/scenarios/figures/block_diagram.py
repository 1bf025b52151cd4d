"""The picture of the flow of data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch

from cdcr.plotting.style import BLACK, GREY, StyledFigure, style
from cdcr.scenarios.figures.drawing import new_figure

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

GIVEN, COMPUTED, CONTROL = "#E9EDF1", "#D6E6F2", "#F6E0CF"


class Block(NamedTuple):
    """What is given or computed: what it does, and its colour."""

    content: str
    color: str = COMPUTED


class Flow(NamedTuple):
    """What goes along a line of corners (x, y); the words stand at `at`."""

    words: str
    at: tuple[float, float]
    corners: tuple[tuple[float, float], ...]


class Plan(NamedTuple):
    """Where the blocks stand, by their middles, what flows between them, and how it is drawn."""

    size: tuple[float, float]  # [in]
    limits: tuple[float, float, float, float]  # of x and of y
    half: tuple[float, float]  # width and height of a block
    letters: float  # over those of a wide picture
    places: dict[str, tuple[float, float]]
    flows: tuple[Flow, ...]


BLOCKS = {
    "Robot": Block("sections, cables,\ngravity, payload", GIVEN),
    "Model": Block(r"$M(q)$, $h(q, \dot q)$, $B$" + "\nseries in $|q|^2$"),
    "simulate": Block(r"$M \ddot q + h = B F$" + "\nrk4, dopri5, CVODE"),
    "Trajectory": Block(r"$q$, $\dot q$; $\theta$, $\varphi$" + "\ntip, energy", GIVEN),
    "Reference": Block(r"$q$, $\dot q$, $\ddot q$ over time", GIVEN),
    "inverse_run": Block(r"$B F = M \ddot q + h$" + "\nleast tensions $F$"),
    "Pid": Block("each period:\nforce, then tensions", CONTROL),
}

WIDE = Plan(
    size=(11.0, 5.0),
    limits=(-1.2, 10.6, -2.5, 2.5),
    half=(0.98, 0.42),
    letters=1.0,
    places={
        "Robot": (0.0, 0.0),
        "Model": (3.0, 0.0),
        "simulate": (6.2, 0.0),
        "Trajectory": (9.4, 0.0),
        "Reference": (3.0, 1.9),
        "inverse_run": (6.2, 1.9),
        "Pid": (6.2, -1.9),
    },
    flows=(
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
    ),
)
# For a column: from above to below.
NARROW = Plan(
    size=(3.35, 4.4),
    limits=(-3.5, 3.5, -4.6, 4.6),
    half=(1.06, 0.52),
    letters=0.7,
    places={
        "Robot": (0.0, 3.6),
        "Model": (0.0, 1.8),
        "Reference": (-2.35, 1.8),
        "inverse_run": (-2.35, 0.0),
        "Pid": (2.35, 0.0),
        "simulate": (0.0, -1.8),
        "Trajectory": (0.0, -3.6),
    },
    flows=(
        Flow("validated", (0.62, 2.7), ((0.0, 3.08), (0.0, 2.32))),
        Flow("", (0.0, 0.0), ((0.0, 1.28), (0.0, -1.28))),
        Flow("motion", (0.5, -2.7), ((0.0, -2.32), (0.0, -3.08))),
        Flow("motion\nasked for", (-1.65, 0.9), ((-2.35, 1.28), (-2.35, 0.52))),
        Flow("", (0.0, 0.0), ((0.0, 0.0), (-1.29, 0.0))),
        Flow("", (0.0, 0.0), ((0.0, 0.0), (1.29, 0.0))),
        Flow(
            "tension table\n$F(t)$", (-2.2, -2.25), ((-2.35, -0.52), (-2.35, -1.8), (-1.06, -1.8))
        ),
        Flow(
            r"$q$, $\dot q$ each period",
            (2.15, -3.85),
            ((1.06, -3.6), (3.1, -3.6), (3.1, -0.52)),
        ),
        Flow("tensions $F$,\nheld", (2.0, -2.25), ((2.0, -0.52), (2.0, -1.8), (1.06, -1.8))),
        Flow("reference $q$", (2.35, 1.2), ((2.35, 1.0), (2.35, 0.52))),
    ),
)


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw the blocks and what flows between them."""
    with style():
        figure = new_figure(scenario.title, WIDE.size)
        _draw(figure, WIDE)

    def narrow(width: float) -> None:
        title = figure.get_suptitle()
        figure.clear()
        figure.set_size_inches(width, NARROW.size[1] * width / NARROW.size[0])
        figure.suptitle(title, x=0.02, ha="left", fontsize=13 * NARROW.letters)
        _draw(figure, NARROW)

    figure.narrow = narrow
    return figure


def _draw(figure: StyledFigure, plan: Plan) -> None:
    axes = figure.subplots()
    axes.set_axis_off()
    axes.set_aspect("equal")
    for name, place in plan.places.items():
        _draw_block(axes, name, place, plan)
    for flow in plan.flows:
        _draw_flow(axes, flow, plan.letters)
    axes.axis(plan.limits)


def _draw_block(axes: Axes, name: str, place: tuple[float, float], plan: Plan) -> None:
    (x, y), block, (wide, high), letters = place, BLOCKS[name], plan.half, plan.letters
    axes.add_patch(
        FancyBboxPatch(
            (x - wide, y - high),
            2 * wide,
            2 * high,
            boxstyle="round,pad=0,rounding_size=0.1",
            facecolor=block.color,
            edgecolor=GREY,
            linewidth=0.9,
        )
    )
    look: Any = {"ha": "center", "va": "center"}
    axes.text(x, y + 0.52 * high, name, weight="bold", fontsize=10.0 * letters, **look)
    axes.text(x, y - 0.3 * high, block.content, fontsize=8.5 * letters, **look)


def _draw_flow(axes: Axes, flow: Flow, letters: float) -> None:
    *_, before, end = flow.corners
    axes.plot(*zip(*flow.corners[:-1], strict=True), color=BLACK, linewidth=1.1 * letters)
    arrow: Any = {"arrowstyle": "-|>", "color": BLACK, "linewidth": 1.1 * letters}
    arrow |= {"shrinkA": 0, "shrinkB": 0, "mutation_scale": 10.0 * letters}
    axes.annotate("", end, before, arrowprops=arrow)
    if flow.words:
        look: Any = {"ha": "center", "va": "center", "style": "italic"}
        axes.text(*flow.at, flow.words, fontsize=8.5 * letters, **look)
