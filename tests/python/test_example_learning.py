"""The example that learns: what it learned works in a run, too."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

SCRIPT = Path(__file__).parents[2] / "examples" / "14_learn_to_reach.py"
STEPS = 1e-6  # of two integrators and of observations in single precision; distance [m]


def test_learn_to_reach(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("gymnasium", reason="the extra gym is not installed")
    mpl = pytest.importorskip("matplotlib", reason="the extra plot is not installed")
    mpl.use("Agg")
    picture = tmp_path / "picture.png"
    monkeypatch.setattr(sys, "argv", [str(SCRIPT), str(picture)])
    with mpl.rc_context():
        found = runpy.run_path(str(SCRIPT))
    assert len(capsys.readouterr().out.splitlines()) == 3
    assert picture.read_bytes().startswith(b"\x89PNG")
    policy, scale = found["policy"], found["scale"]
    env = cdcr.gym.RobotEnv()
    reach = env.model.robot.length

    class Learned(cdcr.Controller):
        def update(self, t: float, q: Any, qd: Any) -> Any:
            tip = env.model.tip(q)[1]
            seen = np.concatenate([q, qd, tip / reach, (env.target - tip) / reach])
            return env.command(policy @ np.append(seen * scale, 1.0))

    t = 0.02 * np.arange(found["STEPS"] + 1)
    for i in range(8):
        env.reset(seed=10_000 + i)
        run = cdcr.simulate(env.model, env.q, env.qd, t=t, controller=Learned(0.02))
        distances = np.linalg.norm(run.tip[1:] - env.target, axis=1)
        np.testing.assert_allclose(found["after"][:, i], distances, rtol=0, atol=STEPS)
    assert found["curve"][-1] > 0.4 * found["curve"][0]
    assert found["after"][-1].mean() < 0.3 * found["before"][-1].mean()
