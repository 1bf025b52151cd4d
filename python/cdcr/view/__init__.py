"""Robots and runs in the browser, live, and as a page that plays by itself. Needs extra ``view``.

The server is that of viser, on this machine alone; what a picture is made of comes from
``plotting``. Other modules than these are imported when something is shown.
"""
# ruff: noqa: E402 - the extra is asked for before its first import, so that one sentence says so

from cdcr.base.extras import require

require("matplotlib", "view")

from cdcr.base.check import require_truth
from cdcr.view.server import PORT
from cdcr.view.session import Session
from cdcr.view.viewer import View, in_notebook

__all__ = ["PORT", "Session", "View", "show"]


def show(session: Session, title: str, *, port: int = PORT, browser: bool = True) -> View:
    """Return a view that is served, or in a notebook one that shows itself as a page.

    Parameters
    ----------
    session : Session
        What is shown.
    title : str
        What it is called.
    port : int, default 8080
        Where it is served on this machine; 0 for any free one.
    browser : bool, default True
        Whether to open it in the browser.

    Returns
    -------
    View
    """
    require_truth("browser", browser)
    view = View(session, title)
    return view if in_notebook() else view.serve(port, browser=browser)
