"""The view: a server, a picture drawn again and again, and what a person does to the robot."""

from __future__ import annotations

import atexit
import html
import os
import queue
import sys
import threading
import time
import webbrowser
from collections import deque
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import require_truth
from cdcr.files.new_file import file_path
from cdcr.view.drawing import Drawing
from cdcr.view.panel import Panel, Task
from cdcr.view.server import HOST, close_server, look_at, name_page, open_server
from cdcr.view.session import Session

PICTURES = 50.0  # a second at most
TOLD = 0.25  # time between two updates of the panel [s]
MEASURED = 2.0  # over which rates are measured [s]
WAIT = 0.2  # how long a closing waits unheard [s]
FRAME_HEIGHT = 560  # of the page in a notebook [px]


class View:
    """A robot or a run in the browser. Needs the extra ``view``.

    What `Robot.view` and `Trajectory.view` return: served already, or in a notebook shown as the
    recorded page. It closes with the program, by `close`, or as a context.

    Parameters
    ----------
    session : Session
        What is shown.
    title : str
        What it is called.
    """

    def __init__(self, session: Session, title: str) -> None:
        self._session, self._title = session, title
        self._server: Any = None
        self._closing = threading.Event()
        self._tasks: queue.SimpleQueue[Task] = queue.SimpleQueue()
        self._failure: BaseException | None = None
        self._awaited = False

    def __repr__(self) -> str:
        where = self.url if self._server is not None else "not served"
        if self._failure is not None:
            where = f"stopped: {self._failure}"
        return f"<View of {self._title}, {where}>"

    def _repr_html_(self) -> str:
        from cdcr.view.page import page

        whole = html.escape(page(self._session, self._title), quote=True)
        return (
            f'<iframe srcdoc="{whole}" width="100%" height="{FRAME_HEIGHT}" '
            'style="border:1px solid #ddd"></iframe>'
        )

    def __enter__(self) -> View:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def url(self) -> str:
        """The address to open in a browser of this machine; empty where nothing is served."""
        return "" if self._server is None else f"http://{HOST}:{self._server.get_port()}"

    def serve(self, port: int, *, browser: bool = False) -> View:
        """Serve the view on this machine.

        Parameters
        ----------
        port : int
            Where; 0 for any free one.
        browser : bool, default False
            Whether to open it in the browser, where there is a screen.

        Returns
        -------
        View
            This one.

        Raises
        ------
        ImportError
            Without the extra ``view``.
        OSError
            Where the port is in use.
        """
        require_truth("browser", browser)
        self._server = open_server(port, self._title)
        name_page(self._server, self._title)
        look_at(self._server, self._session.model)
        session = self._session
        self._drawing = Drawing(self._server.scene, session.model, session.moment(), session.scale)
        self._panel = Panel(self._server.gui, self._session, self._drawing, self._tasks.put)
        self._make_pullable()
        self._thread = threading.Thread(
            target=self._run, args=(self._server,), name="cdcr view", daemon=True
        )
        self._thread.start()
        atexit.register(self.close)
        if browser and _has_screen():
            webbrowser.open(self.url)
        return self

    def wait(self) -> None:
        """Serve until Ctrl-C is pressed, or another thread closes the view.

        What stops the view by itself is raised here.
        """
        self._awaited = True
        try:
            while not self._closing.wait(WAIT):
                pass
        except KeyboardInterrupt:
            pass
        finally:
            self.close()
        if self._failure is not None:
            raise self._failure

    def close(self) -> None:
        """Stop serving, and free the port."""
        self._closing.set()
        server, self._server = self._server, None
        if server is not None:
            atexit.unregister(self.close)
            self._thread.join()
            close_server(server)

    def record(self, path: str | PathLike[str], *, overwrite: bool = False) -> Path:
        """Write one page that plays without a network; a robot without a run goes round once.

        Parameters
        ----------
        path : path-like
            The file, ending in ``.html``.
        overwrite : bool
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
        RuntimeError
            While the view is served.
        FileExistsError
            If the file exists and ``overwrite`` is false.
        """
        from cdcr.view.page import write_page

        if self._server is not None:
            raise RuntimeError("a view that is served cannot be recorded; close it first")
        return write_page(self._session, file_path(path), self._title, overwrite=overwrite)

    def _run(self, server: Any) -> None:
        try:
            self._draw_on(server)
        except BaseException as failure:
            self._failure = failure
            self._panel.tell_end(str(failure))
            if not self._awaited:
                print(f"cdcr: the view of {self._title} has stopped: {failure}", file=sys.stderr)
            self._closing.set()

    def _draw_on(self, server: Any) -> None:
        """Draw until closing: as often as it can, PICTURES a second at most."""
        session, meter = self._session, _Meter()
        last = due = time.perf_counter()
        told = -TOLD
        while not self._closing.wait(max(0.0, due - time.perf_counter())):
            now = time.perf_counter()
            due = max(due + 1.0 / PICTURES, now)
            watched = bool(server.get_clients())  # else time stands still
            busy = (session.playing and watched) or not self._tasks.empty()
            while not self._tasks.empty():
                session.attempt(self._tasks.get())
            meter.add(now - last, session.advance(now - last) if watched else 0.0, busy)
            last = now
            moment = session.moment()
            if busy or told < 0.0:
                with server.atomic():
                    self._drawing.update(session.model, moment, session.trail())
                    self._show_pull()
            if now - told >= TOLD:
                told = now
                self._panel.update(moment, *meter.rates())

    def _show_pull(self) -> None:
        live = self._session.live
        if live is None or live.pull is None:
            self._drawing.show_pull(None)
        else:
            start = live.pull.point(live.model, live.q)
            self._drawing.show_pull(start, np.array(live.pull.target))

    def _make_pullable(self) -> None:
        """Let the mouse pull the backbone, by itself or by a disk."""
        drawing = self._drawing
        owner = drawing.sizes.backbone_section
        counts = np.bincount(owner)
        firsts = np.concatenate([[0], np.cumsum(counts)])
        pieces = [(int(i), float((k - firsts[i] + 0.5) / counts[i])) for k, i in enumerate(owner)]
        for handle, places in (
            (drawing.backbone, pieces),
            (drawing.disks, drawing.sizes.disk_place),
        ):
            if handle is not None:
                handle.on_drag("left")(lambda event, places=places: self._pull(event, places))

    def _pull(self, event: Any, places: list[tuple[int, float]]) -> None:
        if event.phase == "end":
            self._tasks.put(self._session.let_go)
        elif event.instance_index is not None:
            section, fraction = places[event.instance_index]
            target = tuple(float(x) for x in event.end_position)
            self._tasks.put(lambda: self._session.pull_to(section, fraction, target))


class _Meter:
    """Time simulated over real time, and pictures a second, lately."""

    def __init__(self) -> None:
        self._rows: deque[tuple[float, float, bool]] = deque()
        self._span = 0.0

    def add(self, real: float, simulated: float, drawn: bool) -> None:
        """Count one round: how long it took, how much went on, whether a picture was drawn."""
        self._rows.append((real, simulated, drawn))
        self._span += real
        while self._span > MEASURED and len(self._rows) > 1:
            self._span -= self._rows.popleft()[0]

    def rates(self) -> tuple[float, float]:
        """Return both, over MEASURED seconds."""
        rows: FloatArray = np.array(self._rows, dtype=np.float64)
        real, simulated, drawn = rows.sum(axis=0)
        return (simulated / real, drawn / real) if real > 0.0 else (0.0, 0.0)


def _has_screen() -> bool:
    """Whether a browser would have a window, not the terminal that the program is in."""
    return sys.platform != "linux" or bool({"DISPLAY", "WAYLAND_DISPLAY"} & os.environ.keys())


def in_notebook() -> bool:
    """Whether a notebook runs this, which shows what a cell returns."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and getattr(shell, "kernel", None) is not None
