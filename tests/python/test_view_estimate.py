"""Reference and estimate beside a robot: where they stand, and how far off they are said to be."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("matplotlib", reason="the view draws with the colours of pictures")
pytest.importorskip("viser", reason="the view is served by viser, extra view")

from rich.console import Console

from cdcr.cli.view import Shown, _find
from cdcr.runs.loop import LoopRun
from cdcr.view import Session
from cdcr.view.drawing import Drawing
from cdcr.view.panel import errors
from cdcr.view.placement import place
from cdcr.view.server import close_server, open_server

ROBOT = cdcr.robots.three_sections(damping=0.005)


@pytest.fixture(scope="module")
def run() -> LoopRun:
    model = cdcr.Model(ROBOT)
    lengths = cdcr.Sensor(kind="lengths", noise=1e-4)
    kalman = cdcr.ExtendedKalman(model, sensors=lengths, start=[0.05] * 6, deviation=0.05)
    controller = cdcr.ComputedTorque(model, kp=25.0, kd=10.0, min_tension=0.5)
    loop = cdcr.Loop(model, controller, sensors=lengths, estimator=kalman)
    loop.reset([0.1] * 6, [0.0] * 6)
    return loop.run(0.1, record_every=10)


def test_the_estimate_is_a_ghost_of_its_own_with_its_error_in_the_corner(run: LoopRun) -> None:
    straight = cdcr.simulate(run.trajectory.model, [0] * 6, [0] * 6, t=run.told.t)
    session = Session(ROBOT, run=run.trajectory, reference=straight, estimate=run.told)
    server = open_server(0, "estimate")
    try:
        drawing = Drawing(server.scene, session.model, session.moment(), session.scale)
        assert list(drawing.ghosts) == ["reference", "estimate"]
        for time, row in ((0.0, 0), (0.03, 3), (0.1, 10)):
            session.seek(time)
            moment = session.moment()
            drawing.update(session.model, moment, session.trail())
            there = place(session.model, run.told_q[row])
            backbone = drawing.ghosts["estimate"][0]
            np.testing.assert_allclose(
                backbone.batched_positions, there.backbone.position, atol=1e-6
            )
            of_reference, of_estimate = errors(session.model, moment)
            tips = run.trajectory.model.tips(np.array([run.told_q[row], run.trajectory.q[row]]))
            off = 1e3 * np.linalg.norm(tips[1] - tips[0])
            most = np.abs(run.told_q[row] - run.trajectory.q[row]).max()
            assert of_estimate == f"estimate: tip {off:.2f} mm off, a coordinate {most:.4f} at most"
            assert of_reference.startswith("reference: tip ")
    finally:
        close_server(server)
    bare = Session(ROBOT, run=run.trajectory)
    assert errors(bare.model, bare.moment()) == []


def test_what_is_no_motion_of_the_robot_is_refused(run: LoopRun) -> None:
    other: Any = cdcr.simulate(cdcr.Model(cdcr.robots.amouri2020()), [0, 0], [0, 0], t=[0.0, 1.0])
    with pytest.raises(ValueError, match=r"^estimate must be of a robot of 6 coordinates, got one"):
        Session(ROBOT, run=run.trajectory, estimate=other)
    with pytest.raises(
        TypeError, match=r"^estimate must be a cdcr\.Trajectory or a cdcr\.Reference"
    ):
        Session(ROBOT, run=run.trajectory, estimate=run.told_q)  # type: ignore[arg-type]


@pytest.fixture
def shown(tmp_path: Path) -> Shown:
    """A scenario whose filter begins where the robot is not."""
    file = tmp_path / "told.toml"
    file.write_text(
        'robot = "amouri2020"\nt_end = 0.02\n[output]\nnum_samples = 3\n'
        '[controller]\ntype = "computed-torque"\n[controller.reference]\nq = [0.2, 0.1]\n'
        '[loop]\n[[loop.sensors]]\nkind = "lengths"\nnoise = 1e-4\n'
        '[loop.estimator]\ntype = "extended-kalman"\nstart = [0.1, 0.0]\n'
    )
    return _find(str(file), Console(stderr=True), robot_alone=False)


def test_a_scenario_with_an_estimator_shows_it(shown: Shown) -> None:
    assert shown.run is not None
    assert shown.estimate is not None
    assert shown.reference is not None
    np.testing.assert_array_equal(shown.reference.q, [[0.2, 0.1]] * 3)
    assert shown.estimate.q.shape == shown.run.q.shape
    assert np.abs(shown.estimate.q[0] - shown.run.q[0]).max() > 1e-3


def test_live_the_loop_goes_on_with_its_estimate_until_a_person_steers(shown: Shown) -> None:
    session = Session(
        shown.robot,
        run=shown.run,
        reference=shown.reference,
        estimate=shown.estimate,
        loop=shown.loop,
    )
    session.go_live()
    live = session.live
    assert live is not None
    assert live.steered

    def off() -> float:
        moment = session.moment()
        assert moment.estimate is not None
        assert errors(session.model, moment)[1].startswith("estimate: tip ")
        return float(np.abs(moment.estimate - moment.q).max())

    session.live_for(0.002)
    assert off() > 1e-3
    session.live_for(1.5)
    assert 0.0 < off() < 5e-4  # of noise
    np.testing.assert_allclose(live.q, [0.2, 0.1], rtol=0, atol=5e-3)  # the controller goes on
    assert session.command.max() > 0.0

    session.pull_to(0, 1.0, tuple(live.model.tip(live.q)[1] + [0.0, 0.1, 0.0]))
    session.live_for(0.5)
    assert np.abs(live.q - [0.2, 0.1]).max() > 0.02
    assert off() > 5e-4  # the filter knows of no pull
    session.let_go()

    live.steer(0, 8.0)
    assert not live.steered
    assert session.command[0] == 8.0
    session.live_for(0.5)
    np.testing.assert_array_equal(live.tension, live.command)
    assert live.q[0] > 0.25  # cable 1 bends it towards x
    live.change(payload=0.02)
    session.live_for(0.1)
    assert live.command[0] == 8.0
    session.restart()
    assert session.live is not None
    assert session.live.steered
