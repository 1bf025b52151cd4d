"""What a robot has to do with the browser."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path

    from cdcr.robot.robot import Robot
    from cdcr.view import View


class Shown:
    """A robot that is simulated in the browser, live or recorded."""

    def view(self, *, markers: Any = None, port: int = 8080, browser: bool = True) -> View:
        """Simulate the robot in the browser, live. Needs the extra ``view``.

        It begins at rest. Sliders change cables, gravity and payload; the mouse pulls the backbone.
        A robot without damping gets a tenth of the critical one, which a slider changes too. A
        notebook shows the page that `record` writes.

        Parameters
        ----------
        markers : optional
            What was measured, shown as points: positions (k, 3) [m] in the base frame, or as in
            `Trajectory.view`, over the time that is simulated.
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
        >>> with cdcr.robots.amouri2020().view(port=0, browser=False) as view:
        ...     print(view.url)
        http://127.0.0.1:...
        """
        from cdcr import view

        session = view.Session(cast("Robot", self), markers=markers)
        return view.show(session, "robot", port=port, browser=browser)

    def record(self, path: str | PathLike[str], *, overwrite: bool = False) -> Path:
        """Write a page on which the robot goes round in a circle once. Needs the extra ``view``.

        Parameters
        ----------
        path : str or path
            The page, ending in ``.html``.
        overwrite : bool, default False
            Whether a file of that name may be replaced.

        Returns
        -------
        Path
            Of the page.

        Raises
        ------
        FileExistsError
            Where there is such a file and `overwrite` is False.
        ValueError
            For another ending.
        ImportError
            Without the extra ``view``.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> import cdcr
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     page = cdcr.robots.amouri2020().record(Path(folder) / "robot.html")
        ...     page.name
        'robot.html'
        """
        from cdcr import view

        return view.View(view.Session(cast("Robot", self)), "robot").record(
            path, overwrite=overwrite
        )
