"""A real browser: Chromium as the system has it, without a way out of this machine."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any
from urllib.parse import urlsplit

WIDTH, HEIGHT = 960, 640  # of the window [px]
PATIENCE = 60_000  # for what a machine without a graphics card draws slowly [ms]
NAMES = ("chromium", "chromium-browser", "google-chrome")
# No sandbox: it refuses to run for root. Graphics by the processor, which is there everywhere.
OPTIONS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
# What viser's client makes Chromium complain of when something is dragged; it does no harm.
HARMLESS = ("Unable to preventDefault inside passive event listener invocation.",)
INSIDE = ("127.0.0.1", "")  # hosts of this machine; none in blob: and data:


def chromium() -> str | None:
    """Where the browser is, if anywhere."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Window:
    """A page of a browser that keeps a record of what went wrong, and of what was asked outside."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.errors: list[str] = []
        self.outside: list[str] = []
        self.received = 0  # messages of the server
        page.set_default_timeout(PATIENCE)
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("websocket", self._socket)
        page.route("**/*", self._route)

    def open(self, url: str) -> None:
        """Open an address, and put away viser's note about slow graphics."""
        self.page.goto(url)
        self.page.wait_for_selector("canvas")
        self.page.add_style_tag(content=".mantine-Notifications-root {display: none}")

    def field(self, label: str) -> Any:
        """The text field beside a label of the panel."""
        named = self.page.locator("label", has_text=label)
        return named.locator("xpath=following::input[@type='text'][1]")

    def _console(self, message: Any) -> None:
        if message.type == "error" and message.text not in HARMLESS:
            self.errors.append(message.text)

    def _socket(self, socket: Any) -> None:
        if urlsplit(socket.url).hostname not in INSIDE:
            self.outside.append(socket.url)
        socket.on("framereceived", lambda _: self._count())

    def _count(self) -> None:
        self.received += 1

    def _route(self, route: Any) -> None:
        if (urlsplit(route.request.url).hostname or "") in INSIDE:
            route.continue_()
        else:
            self.outside.append(route.request.url)
            route.abort()


@contextmanager
def window() -> Iterator[Window]:
    """Open a browser, and close it again."""
    playwright = import_module("playwright.sync_api")  # which type checkers need not have
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=chromium(), args=list(OPTIONS))
        try:
            yield Window(browser.new_page(viewport={"width": WIDTH, "height": HEIGHT}))
        finally:
            browser.close()
