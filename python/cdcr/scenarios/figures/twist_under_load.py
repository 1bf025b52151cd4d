"""The picture of a bent robot under a sideways load: an arc beside a rod, and tips over load."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.plotting import space
from cdcr.plotting.robot3d import RobotArtists, show_robot
from cdcr.plotting.style import BLACK, COLORS, GREY, StyledFigure, style
from cdcr.scenarios.figures.drawing import legend_over, name_point, note
from cdcr.scenarios.figures.workspace import add_panels, new_figure
from cdcr.scenarios.studies import twist_under_load as study

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (12.4, 6.8)  # of the picture [in]
ROOM = np.array([6.0, 6.1])  # of the robots in space, left [in]
VIEW = {"elev": 30.0, "azim": -28.0}  # shows what is out of the plane [deg]
LOOKS = ((COLORS[0], "o"), (COLORS[2], "s"), (COLORS[1], "^"))  # of the kinds of section


def plot(scenario: Scenario, run: None) -> StyledFigure:
    """Draw arc and rod under the largest load, and what the tips do over the load."""
    with style():
        figure = new_figure(scenario.title, SIZE)
        answers = study.answers(scenario)
        _draw_robots(figure, answers)
        moved, turned = add_panels(figure, [1.0, 1.0], left=0.57, hspace=0.3)
        for (kind, answer), (color, mark) in zip(answers.items(), LOOKS, strict=True):
            for axes, values in ((moved, 1e3 * answer.moved), (turned, np.rad2deg(answer.turned))):
                axes.plot(study.LOADS, values, color=color, marker=mark, markersize=5, label=kind)
        twist = np.rad2deg(study.twist(answers["rod"]))
        turned.plot(study.LOADS, twist, color=BLACK, linestyle="--")
        name_point(
            turned, "twist of the rod", (study.LOADS[-1], twist[-1]), (0, -24), ha="right", va="top"
        )
        moved.set_ylabel("tip moved sideways [mm]")
        turned.set_ylabel("tip turned [deg]")
        turned.set_xlabel("sideways force on the tip [N]")
        moved.tick_params(labelbottom=False)
        moved.legend(loc="upper left")
        note(moved, f"bent by {study.TENSION[0]:g} N on cable 1")
        figure.align_ylabels([moved, turned])
    return figure


def _draw_robots(figure: StyledFigure, answers: dict[str, study.Answer]) -> None:
    axes, (arc, _, rod) = space.add_axes(figure), answers.values()
    axes.view_init(**VIEW)
    show_robot(axes, rod.model, rod.q[[0, -1]], arc.model.tips(arc.q))
    RobotArtists(axes, rod.model, rod.q[0], alpha=0.25)
    axes.plot([], [], color=GREY, alpha=0.5, linewidth=2.4, label="without the force")
    load = f"{study.LOADS[-1]:g} N"
    drawn = (("one arc", arc, LOOKS[0][0]), ("rod", rod, LOOKS[2][0]))
    for layer, (kind, answer, color) in enumerate(drawn, start=4):
        robot = RobotArtists(axes, answer.model, answer.q[-1], layer=float(layer))
        robot.backbones[0].set(color=color, label=f"{kind}, {load}")
        for line in (*robot.cables, *robot.marks):
            line.set(color=color, linewidth=0.9)
        axes.plot(*answer.model.tips(answer.q).T, color=color, linewidth=1.0, linestyle=":")
    space.fill(axes, ROOM)
    legend_over(figure, axes, ROOM, 0.93, ncols=3)
