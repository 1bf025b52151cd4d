"""Draws view.png, the live view as a browser shows it: PYTHONPATH=tests/python/shared python FILE.

Needs Chromium and Playwright, as `make view-test` does.
"""

import io
from pathlib import Path

import numpy as np
from PIL import Image

import cdcr
from browser import window

TENSION = [0.0, 7.0, 2.0, 0.0, 4.0, 0.0, 0.0, 3.0, 0.0]  # [N]
PULLED_TO = (-0.45, 0.0, 0.75)  # the tip [m]
WINDOW = {"width": 1200, "height": 760}  # [px]
SETTLED = 6000  # [ms]
LATE = 30  # pictures

robot = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), damping=0.02)
model = cdcr.Model(robot)
straight = cdcr.simulate(model, np.zeros(6), np.zeros(6), t=[0.0, 0.1])
start = cdcr.simulate(model, np.zeros(6), np.zeros(6), t=[0.0, 0.1], tension=TENSION)
with window() as opened, start.view(reference=straight, port=0, browser=False) as view:
    opened.page.set_viewport_size(WINDOW)
    opened.open(view.url)
    opened.page.wait_for_selector("#cdcr-status")
    view._tasks.put(lambda: view._session.pull_to(2, 1.0, PULLED_TO))
    opened.page.wait_for_timeout(SETTLED)
    for _ in range(LATE):  # each has the browser draw what it has got meanwhile
        opened.page.screenshot()
    picture = Image.open(io.BytesIO(opened.page.screenshot())).convert("RGB")
    picture.save(Path(__file__).with_name("view.png"), optimize=True)
