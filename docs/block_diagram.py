"""Draw docs/block-diagram.svg, how data flow through the library: what each room gives the next.

Run ``python docs/block_diagram.py`` with matplotlib installed.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

INK, CORE, SUNDIALS = "#222222", "#dbe7f3", "#f3e3d3"
WIDTH, HEIGHT = 1.7, 0.72


class Block(NamedTuple):
    """A room of the library: what it is called, what it holds, where it stands."""

    name: str
    content: str
    x: float
    y: float
    color: str = CORE


class Flow(NamedTuple):
    """What one block gives another; `offset` moves the words off the middle of the arrow."""

    source: str
    target: str
    what: str
    offset: tuple[float, float]
    bend: float = 0.0


BLOCKS = (
    Block("robot", "sections, cables,\ngravity, payload", 0.0, 0.0),
    Block("model", "polynomials a, b, G\nactuation matrix B", 2.6, 0.0),
    Block("dynamics", "M qdd + h = B F\nequilibrium, A and B", 5.2, 0.0),
    Block("stepper", "rk4, dopri5", 7.8, 0.75),
    Block("cvode", "bdf, adams", 7.8, -0.75, SUNDIALS),
    Block("simulator", "simulate: a run\nSimulator: a period", 10.4, 0.0),
    Block("control", "PID, allocation", 7.8, -2.2),
)
FLOWS = (
    Flow("robot", "model", "validated", (0.0, 0.14)),
    Flow("model", "dynamics", "tables", (0.0, 0.14)),
    Flow("dynamics", "stepper", "qdd", (-0.15, 0.16)),
    Flow("dynamics", "cvode", "qdd, df/dy", (-0.38, -0.14)),
    Flow("stepper", "simulator", "q, qd", (0.22, 0.16)),
    Flow("cvode", "simulator", "q, qd", (0.24, -0.14)),
    Flow("simulator", "control", "q, qd each period", (1.35, -0.25), bend=-0.25),
    Flow("control", "dynamics", "tensions F", (-0.8, -0.4), bend=-0.25),
)


def draw_block(ax: Axes, block: Block) -> None:
    corner = (block.x - WIDTH / 2, block.y - HEIGHT / 2)
    style = "round,pad=0.05,rounding_size=0.1"
    ax.add_patch(
        FancyBboxPatch(corner, WIDTH, HEIGHT, boxstyle=style, facecolor=block.color, edgecolor=INK)
    )
    ax.text(block.x, block.y + 0.2, block.name, ha="center", va="center", weight="bold")
    ax.text(block.x, block.y - 0.13, block.content, ha="center", va="center", fontsize=7.5)


def ends(source: Block, target: Block) -> tuple[tuple[float, float], tuple[float, float]]:
    """Where an arrow leaves and enters: sides, or the lower edge on the way back."""
    half = WIDTH / 2 + 0.07
    if target.x > source.x:
        return (source.x + half, source.y), (target.x - half, target.y)
    if source.y > target.y:
        return (source.x, source.y - HEIGHT / 2 - 0.07), (target.x + half, target.y)
    return (source.x - half, source.y), (target.x, target.y - HEIGHT / 2 - 0.07)


def draw_flow(ax: Axes, flow: Flow, source: Block, target: Block) -> None:
    start, end = ends(source, target)
    style = {"arrowstyle": "-|>", "color": INK, "connectionstyle": f"arc3,rad={flow.bend}"}
    ax.annotate("", end, start, arrowprops=style)
    x, y = (start[0] + end[0]) / 2 + flow.offset[0], (start[1] + end[1]) / 2 + flow.offset[1]
    ax.text(x, y, flow.what, ha="center", va="center", fontsize=7.5, style="italic", color=INK)


def draw() -> Figure:
    figure = Figure(figsize=(10.4, 3.6), layout="constrained")
    ax = figure.subplots()
    ax.set_aspect("equal")
    ax.set_axis_off()
    by_name = {block.name: block for block in BLOCKS}
    for block in BLOCKS:
        draw_block(ax, block)
    for flow in FLOWS:
        draw_flow(ax, flow, by_name[flow.source], by_name[flow.target])
    ax.text(0.0, -1.9, "blue: target cdcr::cdcr, Eigen only", fontsize=8, ha="left")
    ax.text(0.0, -2.2, "sand: target cdcr::cvode, with SUNDIALS", fontsize=8, ha="left")
    ax.set(xlim=(-1.1, 11.5), ylim=(-2.75, 1.35))
    return figure


if __name__ == "__main__":
    # The same bytes at every run.
    mpl.rcParams["svg.hashsalt"] = "cdcr"
    target = Path(__file__).with_name("block-diagram.svg")
    draw().savefig(target, metadata={"Date": None})
    print(f"wrote {target}")
