"""What an environment shows: the robot, its target, the way of its tip."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import gymnasium
import numpy as np
from numpy.typing import NDArray

from cdcr.base.arrays import FloatArray
from cdcr.base.extras import require

if TYPE_CHECKING:
    from cdcr.gym._task import Task

SIZE, DPI = (4.8, 4.8), 100  # [in], [dots/in]
SHOWN = 60  # shapes that must fit into the picture
TRAIL = 100  # frames that the way of the tip lasts


class Picture:
    """A picture whose still parts are drawn once."""

    def __init__(self, task: Task, i: int = 0) -> None:
        """Draw what stands still about robot i."""
        require("matplotlib", "plot")
        from cdcr.plotting import space
        from cdcr.plotting.robot3d import RobotArtists, show_robot
        from cdcr.plotting.style import COLORS, GREY, StyledFigure, style

        self._i = i
        with style():
            figure = StyledFigure(figsize=SIZE, dpi=DPI)
            self._canvas = cast("Any", figure.canvas)
            axes = space.add_axes(figure)
            shown = task.shapes(SHOWN, np.random.default_rng(0))
            show_robot(axes, task.model, [*shown, np.zeros_like(shown[0])])
            space.fill(axes, np.array(SIZE))
            self._robot = RobotArtists(axes, task.model, task.q[i])
            (self._trail,) = axes.plot([], [], [], color=GREY, linewidth=0.9, zorder=2)
            (self._target,) = axes.plot(
                *([], [], []),
                color=COLORS[1],
                marker="o",
                linestyle="",
                zorder=9,
                label="target",
            )
            figure.legend(handles=[self._target], loc="upper right")
            robot = self._robot
            self._moving: list[Any] = [robot.disks, *robot.lines, self._trail, self._target]
            self._moving.sort(key=lambda artist: artist.get_zorder())
            for artist in self._moving:
                artist.set_animated(True)
            self._canvas.draw()
            self._still = self._canvas.copy_from_bbox(figure.bbox)
        self._way: list[FloatArray] = []
        self._episode = 0

    def frame(self, task: Task) -> NDArray[np.uint8]:
        """Return the picture (height, width, 3) of this moment."""
        tip, target = task.tip[self._i], task.target[self._i]
        if task.episode[self._i] != self._episode:
            self._way, self._episode = [], task.episode[self._i]
        self._way = [*self._way[1 - TRAIL :], tip.copy()]
        self._robot.update(task.q[self._i])
        self._robot.disks.do_3d_projection()
        self._trail.set_data_3d(*np.transpose(self._way))
        self._target.set_data_3d(*target[:, None])
        self._canvas.restore_region(self._still)
        for artist in self._moving:
            artist.draw(self._canvas.get_renderer())
        return np.array(self._canvas.buffer_rgba())[..., :3]


class Window:
    """A window of Matplotlib that shows picture after picture; where none opens, a warning."""

    def __init__(self, pause: float) -> None:
        """Open a window; each picture stays for some time [s]."""
        self._plt: Any = require("matplotlib.pyplot", "plot")
        self._pause = pause
        height, width = SIZE[1], SIZE[0]
        self._figure = self._plt.figure(figsize=(width, height))
        self._image: Any = None
        self._is_shown = self._figure.canvas.required_interactive_framework is not None
        if not self._is_shown:
            gymnasium.logger.warn(
                "render_mode 'human' shows nothing: it needs a screen and a Matplotlib that opens "
                "windows there; 'rgb_array' needs neither"
            )

    def show(self, frame: NDArray[np.uint8]) -> None:
        """Show a picture."""
        if not self._is_shown:
            return
        if self._image is None:
            self._image = self._figure.figimage(frame, resize=True)
        self._image.set_data(frame)
        self._figure.canvas.draw_idle()
        self._plt.pause(self._pause)

    def close(self) -> None:
        """Close the window."""
        self._plt.close(self._figure)
