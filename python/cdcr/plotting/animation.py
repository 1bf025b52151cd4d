"""A run as a film: the robot in space beside its bending angles and tensions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, require_like, short
from cdcr.files.new_file import file_path, new_file
from cdcr.plotting import panels, space
from cdcr.plotting.geometry import states_at
from cdcr.plotting.robot3d import RobotArtists, show_robot
from cdcr.plotting.sizes import Size, checked_size, is_narrow, resize
from cdcr.plotting.style import BLACK, PRINTED, StyledFigure, style
from cdcr.plotting.video import MAX_GIF_FPS, film_path, write_film

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory

SIZE = (11.0, 5.6)  # of the picture [in]
DPI, SHARP = 100, 144  # of that size, and of others that are wide: a slide has 1080 lines
ROBOT_ROOM = np.array([5.6, 5.2])  # of the robot's part, left and under the clock [in]
MIN_FPS = 0.01  # each picture of a .gif may last 655 s
MOST_FRAMES = 100_000  # an hour of film, near enough
NUM_FITTED = 50  # shapes that must fit into the picture, besides all tips


def animate(
    run: Trajectory,
    path: str | PathLike[str],
    *,
    fps: float = 30.0,
    speed: float = 1.0,
    size: Size = None,
    overwrite: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> Path:
    """Write a film of a run, as `Trajectory.animate` does.

    Parameters
    ----------
    run : Trajectory
        The run.
    path, fps, speed, size, overwrite, progress
        As in `Trajectory.animate`.

    Returns
    -------
    Path
        The file written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> import cdcr.plotting
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> run = cdcr.simulate(model, [0, 0], [0, 0], t=np.linspace(0, 1, 11), tension=[5, 0, 0])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     print(cdcr.plotting.animate(run, Path(folder) / "pull.gif", fps=2).name)
    pull.gif
    """
    require_like("run", run, "Trajectory", "model", "tension", "tip")
    path = film_path(file_path(path))
    check = Check()
    for name, value in {"fps": fps, "speed": speed}.items():
        check.number(name, value, "a number > 0 and finite", above=0.0)
    check.done()
    if path.suffix.lower() == ".gif" and fps > MAX_GIF_FPS:
        raise ValueError(f"fps must be at most {MAX_GIF_FPS:g} in a .gif, got {short(fps)}")
    if fps < MIN_FPS:
        raise ValueError(f"fps must be at least {MIN_FPS:g}, got {fps!r}")
    checked_size(size)
    if progress is not None and not callable(progress):
        raise TypeError(
            f"progress must be a function of two numbers, got {type(progress).__name__}"
        )
    frame_times(run, speed / fps)
    with new_file(path, overwrite=overwrite) as partial:
        write_frames(run, partial, path.suffix, fps=fps, speed=speed, size=size, progress=progress)
    return path


def write_frames(
    run: Trajectory,
    path: Path,
    suffix: str,
    *,
    fps: float = 30.0,
    speed: float = 1.0,
    size: Size = None,
    progress: Callable[[int, int], object] | None = None,
) -> None:
    """Write a film to a file of any name, in the format of a suffix."""
    times = frame_times(run, speed / fps)

    def frames() -> Iterator[NDArray[np.uint8]]:
        for done, frame in enumerate(draw_frames(run, times, size), start=1):
            yield frame
            if progress is not None:
                progress(done, len(times))

    write_film(path, suffix, frames(), fps)


def frame_times(run: Trajectory, step: float) -> FloatArray:
    """Return the times of the frames: every `step` [s] from the start, as far as the run goes."""
    start, end = run.t[0], run.t[-1]
    frames = (end - start) / step if step > 0.0 else math.inf
    step = min(step, 2.0 * (end - start + 1.0))  # a step beyond the end may be infinite
    if frames > MOST_FRAMES:
        raise ValueError(
            f"a film has at most {MOST_FRAMES} pictures, of {end - start:g} s it would have "
            f"{frames:.3g}: take fewer a second (fps), or a higher speed"
        )
    count = math.floor(frames + 1e-6) + 1  # rounding must not lose the last frame
    times: FloatArray = np.minimum(start + step * np.arange(count), end)
    return times


def draw_frames(
    run: Trajectory, times: FloatArray, size: Size = None
) -> Iterator[NDArray[np.uint8]]:
    """Yield a picture (height, width, 4), of even numbers, for each time.

    What stands still is drawn once; each frame only draws what moves on a copy of it.
    """
    with style():
        film = Film(run, times, size)
    states = states_at(run, times)
    samples = np.searchsorted(run.t, times, side="right") - 1  # tensions hold until the next one
    for time, q, sample in zip(times, states, samples, strict=True):
        yield film.frame(time, q, run.tension[sample])


def _paper(sides: Any) -> tuple[tuple[float, float], float]:
    """Return width and height to draw on [in] and the dots [1/in], for a checked size.

    A film in a size that is less than usual, yet not narrow, is the usual one in finer dots, so
    that its words keep their room.
    """
    if sides is None:
        return SIZE, DPI
    if is_narrow(sides):
        return SIZE, PRINTED
    larger = max(1.0, *(usual / side for usual, side in zip(SIZE, sides, strict=True)))
    return (larger * sides[0], larger * sides[1]), SHARP / larger


class Film:
    """The picture with its moving parts."""

    def __init__(self, run: Trajectory, times: FloatArray, size: Size) -> None:
        paper, dpi = _paper(checked_size(size))
        self.figure = figure = StyledFigure(figsize=paper, dpi=dpi)
        self._canvas = cast(Any, figure.canvas)
        robot_axes = space.add_axes(figure)
        chosen = np.linspace(0, len(run) - 1, min(len(run), NUM_FITTED)).astype(int)
        show_robot(robot_axes, run.model, run.q[chosen], run.tip)
        space.fill(robot_axes, ROBOT_ROOM * np.array(paper) / SIZE)
        self._robot = RobotArtists(robot_axes, run.model, run.q[0])
        self._largest = np.max(run.tension, initial=0.0)

        plots = [panels.plot_theta] + ([panels.plot_tension] if run.model.num_cables else [])
        grid = figure.add_gridspec(len(plots), 1, left=0.575, right=0.975, bottom=0.1, top=0.93)
        charts = [figure.add_subplot(grid[k]) for k in range(len(plots))]
        for plot, axes in zip(plots, charts, strict=True):
            plot(axes, run)
            panels.show_time(axes, run, named=axes is charts[-1])
        figure.align_ylabels(charts)
        self._marks = [axes.axvline(run.t[0], color=BLACK, linewidth=1.0) for axes in charts]
        self._clock = figure.suptitle("", x=0.02, y=0.985, ha="left", va="top", fontsize=12)
        if is_narrow(checked_size(size)):
            resize(figure, size)
        step = np.ptp(times) / max(1, len(times) - 1) or 1.0
        self._decimals = max(2, math.ceil(-math.log10(step)))  # slow motion needs more

        robot = self._robot
        self._moving: list[Any] = [robot.disks, *robot.lines]
        self._moving += [*self._marks, self._clock]
        for artist in self._moving:
            artist.set_animated(True)
        self._canvas.draw()
        self._still = self._canvas.copy_from_bbox(figure.bbox)

    def frame(self, time: float, q: FloatArray, tension: FloatArray) -> NDArray[np.uint8]:
        """Return the picture (height, width, 4) of one moment."""
        self._robot.update(q)
        self._robot.show_tension(tension, self._largest)
        self._robot.disks.do_3d_projection()
        for mark in self._marks:
            mark.set_xdata([time, time])
        self._clock.set_text(f"t = {time:.{self._decimals}f} s")
        self._canvas.restore_region(self._still)
        for artist in sorted(self._moving, key=lambda artist: artist.get_zorder()):
            artist.draw(self._canvas.get_renderer())
        picture: NDArray[np.uint8] = np.array(self._canvas.buffer_rgba())
        height, width = (side // 2 * 2 for side in picture.shape[:2])  # films want even numbers
        return picture[:height, :width]
