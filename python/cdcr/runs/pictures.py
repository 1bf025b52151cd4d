"""What is drawn of a run: pictures, films, and the robot in the browser."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike
    from pathlib import Path
    from typing import Any

    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from cdcr.plotting.geometry import Motion
    from cdcr.plotting.sizes import Size
    from cdcr.runs.trajectory import Trajectory
    from cdcr.view import Session, View


class Pictures:
    """The part of `Trajectory` that draws."""

    @property
    def _run(self) -> Trajectory:
        return cast("Trajectory", self)

    def _repr_html_(self) -> str:
        import base64  # of notebooks alone
        import html

        words = f"<div>{html.escape(repr(self))}</div>"
        try:
            png = cast("Any", self.plot())._repr_png_()
        except ImportError:  # without the extra plot
            return words
        data = base64.b64encode(png).decode("ascii")
        return f'<img src="data:image/png;base64,{data}" width="880" alt="the run"/>{words}'

    def plot(self, *, size: Size = None) -> Figure:
        """Draw angles [deg], tensions, tip and energy over time. Needs the extra ``plot``.

        A free run (no damping, no tension) also shows ``energy_error``.

        Parameters
        ----------
        size : optional
            As in `Scenario.figure`.
        """
        from cdcr import plotting

        return plotting.resize(plotting.plot_run(self._run), size)

    def plot_robot(
        self, times: ArrayLike | None = None, *, num: int = 5, ax: Any = None, size: Size = None
    ) -> Any:
        """Draw the robot in space at several times, earlier ones fainter. Needs the extra ``plot``.

        Parameters
        ----------
        times : (M,) array_like, optional
            Times within the run [s]; by default `num` of them, evenly spaced.
        num : int
            How many shapes when `times` is not given, at most 100.
        ax : Axes3D, optional
            Axes to draw into; by default those of a new figure.
        size : optional
            Of the new figure, as in `Scenario.figure`.

        Returns
        -------
        Axes3D
            The axes; their figure is ``ax.figure``.
        """
        from cdcr import plotting

        return plotting.plot_run_robot(self._run, times, num=num, ax=ax, size=size)

    def animate(
        self,
        path: str | PathLike[str],
        *,
        fps: float = 30.0,
        speed: float = 1.0,
        size: Size = None,
        overwrite: bool = False,
        progress: Callable[[int, int], None] | None = None,
    ) -> Path:
        """Write a film of the robot beside its bending angles. Needs the extra ``plot``.

        Parameters
        ----------
        path : path-like
            ``.mp4`` (needs ffmpeg), ``.gif`` or ``.html``, a page that any browser plays; without
            a suffix, ``.mp4`` where ffmpeg is found and ``.gif`` elsewhere.
        fps : float
            Frames for each second of film.
        speed : float
            Seconds of the run for each second of film: 0.5 is slow motion.
        size : optional
            As in `Scenario.figure`; a slide has 1920 x 1080 pixels.
        overwrite : bool
            Whether an existing file may be replaced.
        progress : callable, optional
            Told (frames done, frames in all) after each frame.

        Returns
        -------
        Path
            The file written.
        """
        from cdcr import plotting

        return plotting.animate(
            self._run,
            path,
            fps=fps,
            speed=speed,
            size=size,
            overwrite=overwrite,
            progress=progress,
        )

    def view(
        self,
        *,
        reference: Motion | None = None,
        estimate: Motion | None = None,
        markers: Any = None,
        speed: float = 1.0,
        port: int = 8080,
        browser: bool = True,
    ) -> View:
        """Play the run in the browser, where one can go on with it live. Needs the extra ``view``.

        Sliders of the cables, gravity and payload, and the mouse, which pulls the backbone, leave
        the run at what is shown and simulate from there, without the wrenches of the run. A
        notebook shows the page that `record` writes.

        Parameters
        ----------
        reference : Trajectory or Reference, optional
            What is shown beside it, faintly, at the same times.
        estimate : Trajectory, Reference or LoopRun.told, optional
            What was taken for its state, shown beside it in a colour of its own, with how far it is
            off.
        markers : optional
            What was measured, shown as points at the same times: a `cdcr.identification.Motion`, a
            pair of times (N,) [s] and positions (N, 3) or (N, k, 3) [m] in the base frame, where
            NaN is a gap, or positions (k, 3) that stay.
        speed : float, default 1
            Time played over real time.
        port : int, default 8080
            Where it is served, to this machine alone; 0 for any free one.
        browser : bool, default True
            Whether to open it in the browser.

        Returns
        -------
        View
            Served until its ``close()``, at its ``url``; ``wait()`` waits for Ctrl-C.

        Raises
        ------
        ImportError
            Without the extra ``view``.
        OSError
            Where the port is in use.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> run = cdcr.simulate(model, [0.5, 0.0], [0.0, 0.0], t=[0.0, 0.5, 1.0])
        >>> with run.view(port=0, browser=False) as view:
        ...     print(view.url)
        http://127.0.0.1:...
        """
        from cdcr import view

        session = self._session(reference, estimate, markers, speed)
        return view.show(session, "run", port=port, browser=browser)

    def record(
        self,
        path: str | PathLike[str],
        *,
        reference: Motion | None = None,
        estimate: Motion | None = None,
        markers: Any = None,
        speed: float = 1.0,
        overwrite: bool = False,
    ) -> Path:
        """Write one page that plays the run in any browser. Needs the extra ``view``.

        It needs no network. Runs longer than 30 s have fewer pictures a second.

        Parameters
        ----------
        path : path-like
            The file, ending in ``.html``.
        reference, estimate, markers, speed
            As in `view`.
        overwrite : bool, default False
            Whether an existing file may be replaced.

        Returns
        -------
        Path
            The file written.

        Raises
        ------
        ImportError
            Without the extra ``view``.
        ValueError
            For another suffix.
        FileExistsError
            If the file exists and ``overwrite`` is false.

        Examples
        --------
        >>> import tempfile
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> run = cdcr.simulate(model, [0.5, 0.0], [0.0, 0.0], t=[0.0, 0.1])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     print(run.record(f"{folder}/pull.html").name)
        pull.html
        """
        from cdcr import view

        session = self._session(reference, estimate, markers, speed)
        return view.View(session, "run").record(path, overwrite=overwrite)

    def _session(
        self, reference: Motion | None, estimate: Motion | None, markers: Any, speed: float
    ) -> Session:
        from cdcr import view

        run = self._run
        return view.Session(
            run.model.robot,
            run.model.formulation,
            run=run,
            reference=reference,
            estimate=estimate,
            markers=markers,
            speed=speed,
        )
