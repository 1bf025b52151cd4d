"""Pictures and films of runs and robots. Needs the extra ``plot``.

Nothing here but `show_or_save` shows a window or uses pyplot, and nothing leaves Matplotlib's
settings changed.
"""
# ruff: noqa: E402 - the extra is asked for before its first import, so that one sentence says so

from cdcr.base.extras import require

require("matplotlib", "plot")

from cdcr.plotting.animation import animate
from cdcr.plotting.identified import plot_identified
from cdcr.plotting.modes import plot_modes
from cdcr.plotting.panels import plot_run
from cdcr.plotting.robot3d import plot_robot, plot_run_robot
from cdcr.plotting.scripts import show_or_save
from cdcr.plotting.sizes import resize
from cdcr.plotting.style import STYLE

__all__ = [
    "STYLE",
    "animate",
    "plot_identified",
    "plot_modes",
    "plot_robot",
    "plot_run",
    "plot_run_robot",
    "resize",
    "show_or_save",
]
