"""Predictive control on its limit, beside what the motion needs without one."""

from __future__ import annotations

import numpy as np
import pytest

import cdcr
from example_script import Example


def test_predictive_control(example: Example) -> None:
    pytest.importorskip("piqp", reason="needs PIQP, extra mpc")
    found = example(33)
    model, circle, start = found["model"], found["circle"], found["start"]
    free = cdcr.TaskSpace(model, posture=start, damping=1e-3)
    free.path = circle
    run = cdcr.simulate(model, start, np.zeros(6), t=found["t"], controller=free, method="rk4")
    assert np.linalg.norm(run.tip - found["wanted"], axis=1).max() < 1e-4  # the motion exists,
    assert run.tension.max() > 1.5 * found["most"]  # and needs more
    assert found["runs"]["predictive"].tension.max() <= found["most"]
    assert found["errors"]["predictive"].max() < 8.0  # [mm]
    assert found["errors"]["task space"].max() > 50.0
