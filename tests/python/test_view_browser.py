"""The view in a real browser: `make view-test`. Skipped where there is none, or no Playwright."""

from __future__ import annotations

import io
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from browser import HEIGHT, PATIENCE, WIDTH, Window, chromium, window
from cdcr.base.arrays import FloatArray

pytest.importorskip("matplotlib", reason="the view draws with the colours of pictures")
pytest.importorskip("viser", reason="the view is served by viser, extra view")
pytest.importorskip("playwright", reason="a browser is led by Playwright, group browser")
if chromium() is None:
    pytest.skip("there is no Chromium: apt-get install chromium", allow_module_level=True)

from PIL import Image

from cdcr.plotting.geometry import robot_shape
from cdcr.view import Session, View

PANEL = 340  # at the right, over the robot's picture [px]
WHITE = 250
ROBOT = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), damping=0.02)
OPEN = 0.94  # share of the backbone that must be seen where it is expected
CLOSED = 0.35  # and that may be seen where it was, across the grid and the way between


@pytest.fixture(scope="module")
def shared() -> Iterator[Window]:
    with window() as opened:
        yield opened


@pytest.fixture
def browser(shared: Window) -> Iterator[Window]:
    shared.errors.clear()
    shared.outside.clear()
    yield shared
    assert shared.errors == []
    assert shared.outside == []


def picture(browser: Window) -> FloatArray:
    """What is seen (HEIGHT, WIDTH), 0 to 255: the darkest of the three colours."""
    image = Image.open(io.BytesIO(browser.page.screenshot())).convert("RGB")
    return np.asarray(np.asarray(image, dtype=np.float64).min(axis=2))


def pixels(view: View, points: FloatArray) -> FloatArray:
    """Where points (K, 3) in space are seen (K, 2), by a pinhole camera."""
    (client,) = view._server.get_clients().values()
    camera = client.camera
    w, u = camera.wxyz[0], -np.asarray(camera.wxyz[1:])  # into the frame of the camera
    v = points - camera.position
    x, y, depth = (v + 2.0 * w * np.cross(u, v) + 2.0 * np.cross(u, np.cross(u, v))).T
    scale = HEIGHT / 2.0 / np.tan(camera.fov / 2.0) / depth
    return np.stack([WIDTH / 2.0 + scale * x, HEIGHT / 2.0 + scale * y], axis=1)


def share_seen(browser: Window, view: View, q: FloatArray) -> float:
    """Which share of the backbone at q (2n,) is drawn where it should be, within two pixels."""
    seen = picture(browser) < WHITE
    column, row = np.rint(pixels(view, robot_shape(view._session.model, q).backbone)).T.astype(int)
    inside = (column > 2) & (column < WIDTH - PANEL) & (row > 2) & (row < HEIGHT - 3)
    assert np.mean(inside) > 0.5
    hits = [
        seen[r - 2 : r + 3, c - 2 : c + 3].any()
        for r, c in zip(row[inside], column[inside], strict=True)
    ]
    return float(np.mean(hits))


def until(true: Callable[[], bool], browser: Window) -> None:
    """Let the browser go on until something is true; fail when it takes too long."""
    end = time.monotonic() + PATIENCE / 1000.0
    while not true():
        assert time.monotonic() < end, "it did not come to that"
        browser.page.wait_for_timeout(100)


def opened(view: View, browser: Window) -> View:
    """The view after the browser has shown it."""
    browser.open(view.url)
    browser.page.wait_for_selector("#cdcr-status")
    until(lambda: len(view._server.get_clients()) == 1, browser)
    return view


def live(view: View) -> Any:
    assert view._session.live is not None
    return view._session.live


def test_a_slider_moves_the_robot(browser: Window) -> None:
    with opened(ROBOT.view(port=0, browser=False), browser) as view:
        before = live(view).q
        until(lambda: share_seen(browser, view, before) >= OPEN, browser)
        field = browser.field("tension 1 [N]")
        field.fill("6")
        field.press("Enter")
        rest = cdcr.Model(ROBOT).equilibrium([6.0, *[0.0] * 8])
        until(lambda: bool(np.allclose(live(view).q, rest, atol=1e-2)), browser)
        browser.page.get_by_role("button", name="Pause").click()
        until(lambda: not view._session.playing, browser)
        shown = view._session.moment().q
        until(lambda: share_seen(browser, view, shown) >= OPEN, browser)
        assert share_seen(browser, view, before) < CLOSED
        until(lambda: "paused" in browser.page.inner_text("#cdcr-status"), browser)
        browser.page.get_by_role("button", name="Play").click()
        until(lambda: "× real time" in browser.page.inner_text("#cdcr-status"), browser)


def test_a_narrow_window_shows_the_whole_robot(browser: Window) -> None:
    try:
        browser.page.set_viewport_size({"width": 400, "height": 800})
        with opened(ROBOT.view(port=0, browser=False), browser) as view:
            assert browser.page.title() == "robot"
            until(lambda: bool(np.mean(picture(browser)[:500] < WHITE) > 0.01), browser)
            (client,) = view._server.get_clients().values()
            until(lambda: client.camera.aspect < 1.0, browser)
            columns, rows = pixels(view, robot_shape(live(view).model, live(view).q).backbone).T
            # As in a window of 960 pixels, the middle of this one is at 200.
            assert np.all(np.abs(columns - WIDTH / 2.0) < 200.0 * HEIGHT / 800.0)
            assert np.all((rows > 0.0) & (rows < 0.41 * HEIGHT))  # above the panel
    finally:
        browser.page.set_viewport_size({"width": WIDTH, "height": HEIGHT})


def test_gravity_and_payload(browser: Window) -> None:
    with opened(cdcr.robots.amouri2020().view(port=0, browser=False), browser) as view:
        for label, value in (("gravity x [m/s²]", "3"), ("payload [kg]", "0.02")):
            field = browser.field(label)
            field.fill(value)
            field.press("Enter")
        until(lambda: live(view).robot.payload == 0.02, browser)
        assert live(view).robot.gravity == (3.0, 0.0, 0.0)


def test_the_mouse_pulls_the_backbone(browser: Window) -> None:
    with opened(ROBOT.view(port=0, browser=False), browser) as view:
        _, tip = live(view).model.tip(live(view).q)
        until(lambda: share_seen(browser, view, live(view).q) >= OPEN, browser)
        ((x, y),) = pixels(view, tip[None])
        mouse = browser.page.mouse
        mouse.move(x, y + 3)
        mouse.down()
        mouse.move(x + 90, y + 30, steps=10)
        until(lambda: live(view).pull is not None, browser)
        pull = live(view).pull
        assert (pull.section, pull.fraction) == (2, pytest.approx(1.0, abs=0.06))
        until(lambda: bool(live(view).model.tip(live(view).q)[1] @ [1.0, 0, 0] > 0.02), browser)
        until(lambda: view._drawing.arrow.visible, browser)
        until(lambda: "pulled with" in browser.page.inner_text("#cdcr-status"), browser)
        mouse.up()
        until(lambda: live(view).pull is None, browser)
        until(lambda: not view._drawing.arrow.visible, browser)


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    t = np.linspace(0.0, 2.0, 101)
    tension = (np.array([0.0, 1.0]), np.array([[0.0] * 9, [8.0, *[0.0] * 8]]))
    return cdcr.simulate(cdcr.Model(ROBOT), np.zeros(6), np.zeros(6), t=t, tension=tension)


def test_a_run_is_played_scrubbed_and_gone_on_with(browser: Window, run: cdcr.Trajectory) -> None:
    with opened(run.view(reference=run, port=0, browser=False), browser) as view:
        until(lambda: not view._session.playing, browser)  # at its end
        field = browser.field("time [s]")
        field.fill("0.5")
        field.press("Enter")
        until(lambda: abs(view._session.time - 0.5) < 0.01, browser)
        shown = view._session.moment().q
        until(lambda: share_seen(browser, view, shown) >= OPEN, browser)
        field = browser.field("tension 2 [N]")
        field.fill("5")
        field.press("Enter")
        until(lambda: view._session.live is not None, browser)
        browser.page.get_by_role("button", name="Back to the run").click()
        until(lambda: view._session.live is None, browser)


def test_the_recorded_page_plays_from_a_file(
    browser: Window, run: cdcr.Trajectory, tmp_path: Path
) -> None:
    file = View(Session(ROBOT, run=run), "a run").record(tmp_path / "page.html")
    browser.open(file.as_uri())
    assert browser.page.title() == "a run"
    assert "cable tension [N]" in browser.page.inner_text("#cdcr-legend")
    browser.page.keyboard.press("Space")  # pauses
    first = picture(browser)
    assert np.mean(first[:, : WIDTH - PANEL] < WHITE) > 0.005  # something is drawn
    browser.page.keyboard.press("Space")
    until(lambda: bool(np.mean(np.abs(picture(browser) - first) > 20.0) > 0.002), browser)


def script_time(meter: Any) -> float:
    """How long scripts of the page have run [s]."""
    metrics = meter.send("Performance.getMetrics")["metrics"]
    return float(next(one["value"] for one in metrics if one["name"] == "ScriptDuration"))


def test_frame_rate_with_three_sections(
    browser: Window, capsys: pytest.CaptureFixture[str]
) -> None:
    with opened(ROBOT.view(port=0, browser=False), browser) as view:
        live(view).command = np.array([6.0, *[0.0] * 8])
        browser.page.wait_for_timeout(3000)
        drawn = "new Promise(done => {let k = 0; const from = performance.now(); const f = () => {"
        drawn += "k++; const t = performance.now() - from; t > 3000 ? done(1000 * k / t) : "
        drawn += "requestAnimationFrame(f)}; requestAnimationFrame(f)})"
        meter = browser.page.context.new_cdp_session(browser.page)
        meter.send("Performance.enable")
        before, script, start = browser.received, script_time(meter), time.monotonic()
        shown = browser.page.evaluate(drawn)
        took = time.monotonic() - start
        arrived = (browser.received - before) / took
        script = (script_time(meter) - script) / took
        status = browser.page.inner_text("#cdcr-status").replace("\n", ", ")
    with capsys.disabled():
        print(f"\nthree sections: {status}; in the browser {arrived:.0f} messages/s,")
        print(f"{shown:.0f} pictures/s drawn by the processor, scripts busy {100 * script:.0f} %")
    assert arrived > 0.0
