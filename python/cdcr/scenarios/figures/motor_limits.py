"""The picture of motors that are too slow: bending angle and tension of three loops."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.plotting.style import BLACK, COLORS, StyledFigure, style
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.figures.drawing import legend_below, new_figure, note, share_time
from cdcr.scenarios.studies.motor_limits import FASTEST, NAMES, STRONGEST, TARGET, runs

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

SIZE = (9.0, 6.2)  # [in]
HIGHEST = 12.0  # tension that is shown [N]


def plot(scenario: Scenario, run: Trajectory) -> StyledFigure:
    """Draw all three loops, one over the other."""
    with style():
        figure = new_figure(scenario.title, SIZE)
        angle, tension = figure.subplots(2, 1, sharex=True)
        for color, (name, one) in zip(COLORS, runs(float(run.t[-1])).items(), strict=False):
            # Two run alike until the limits are reached: the first is seen through the second.
            look: dict[str, Any] = {"color": color} | (
                {"linewidth": 4.0} if name == NAMES[0] else {}
            )
            angle.plot(one.t, np.rad2deg(one.theta[:, 0]), label=name, **look)
            tension.plot(one.t, one.tension[:, 0], **look)
        angle.axhline(TARGET, color=BLACK, linewidth=0.9, linestyle=":")
        angle.set_ylabel(r"bending angle $\theta$ [deg]")
        tension.axhline(STRONGEST, color=BLACK, linewidth=0.9, linestyle=":")
        tension.set_ylabel("tension of cable 1 [N]")
        tension.set_ylim(0.0, HIGHEST)
        note(angle, f"dotted: {TARGET:g} deg")
        note(tension, f"dotted: {STRONGEST:g} N, reached by {FASTEST:g} N/s at most")
        share_time(figure, [angle, tension], run)
        legend_below(figure, angle)
    return figure
