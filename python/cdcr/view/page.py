"""A recording as one page, which any browser plays without a network."""

from __future__ import annotations

import html
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.files.new_file import REPLACE, new_file
from cdcr.view.colors import legend
from cdcr.view.drawing import Drawing
from cdcr.view.live import CIRCLE, RAMP, circling
from cdcr.view.server import WIDTH, close_server, look_at, open_server
from cdcr.view.session import Session

FPS = 30.0
MOST_FRAMES = 900  # longer recordings have fewer pictures a second
# The field of view is that of the height, so that a narrow window leaves some of it blank.
_NARROW = (
    "<style>@media (max-aspect-ratio: {0}) "
    "{{#root {{height: calc(100vw / {0}) !important}}}}</style>"
)
_OVERLAY = (
    '<div id="cdcr-legend" style="position:fixed;left:1em;bottom:4em;width:17em;z-index:1;'
    'pointer-events:none;font-family:sans-serif;color:#222">'
    '<div style="padding:0 0.7em;font-weight:bold">'
    "{title}</div>{legend}</div>"
)


def write_page(session: Session, path: Path, title: str, *, overwrite: bool = False) -> Path:
    """Write the recording of a session as a page; see `page`."""
    if path.suffix != ".html":
        raise ValueError(f"the file name must end in .html, got {path.name!r}")
    with new_file(path, overwrite=overwrite, replace=REPLACE) as part:
        part.write_text(page(session, title), encoding="utf-8", newline="\n")
    return path


def page(session: Session, title: str) -> str:
    """Return the recording of a session, in HTML: the client of viser and all pictures in it.

    A run is recorded whole. A robot without one goes round in a circle once.
    """
    session.restart()
    server = open_server(0, title)
    try:
        look_at(server, session.model)
        drawing = Drawing(server.scene, session.model, session.moment(), session.scale)
        recorded = _record(server, session, drawing)
    finally:
        close_server(server)
        session.restart()
    words = html.escape(title)
    overlay = _OVERLAY.format(title=words, legend=legend(drawing.scale))
    named = f"<title>{words}</title>{_NARROW.format(WIDTH)}"
    head, _, tail = recorded.replace("<title>Viser</title>", named).rpartition("</body>")
    return f"{head}{overlay if drawing.cables is not None else ''}</body>{tail}"


def _record(server: Any, session: Session, drawing: Drawing) -> str:
    """Show one picture after the other to a recorder."""
    live = session.live
    span = CIRCLE + RAMP if live is not None else (session.span[1] - session.span[0])
    pictures = max(1, min(MOST_FRAMES, round(FPS * span / session.speed)))
    times: FloatArray = np.linspace(0.0, span, pictures + 1)
    drawing.update(session.model, session.moment(), session.trail())
    recorder = server.get_scene_serializer()
    ranges, start = session.ranges(), session.time
    for before, now in pairwise(times):
        if live is None:
            session.seek(start + now)
        else:
            live.command = circling(ranges, session.model, float(now))
            session.live_for(float(now - before))
        recorder.insert_sleep(float(now - before) / session.speed)
        drawing.update(session.model, session.moment(), session.trail())
    return str(recorder.as_html())
