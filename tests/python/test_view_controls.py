"""What the controls of the view do, moved as a browser moves them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("matplotlib", reason="the view draws with the colours of pictures")
pytest.importorskip("viser", reason="the view is served by viser, extra view")

from cdcr.view import Session
from cdcr.view.drawing import Drawing
from cdcr.view.panel import Panel
from cdcr.view.server import close_server, open_server

ROBOT = cdcr.robots.three_sections(gravity=(0.0, 0.0, 9.81))


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    model = cdcr.Model(ROBOT)
    t = np.linspace(0.0, 0.3, 31)
    return cdcr.simulate(model, np.zeros(6), np.zeros(6), t=t, tension=[5.0, *[0.0] * 8])


class Desk:
    """A view whose tasks are done when they are given, and controls that a person moves."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.server = open_server(0, "desk")
        self.drawing = Drawing(self.server.scene, session.model, session.moment(), session.scale)
        self.panel = Panel(self.server.gui, session, self.drawing, lambda task: task())

    def move(self, control: Any, value: Any) -> None:
        """Move a control as a browser does."""
        control.value = value
        for act in control._impl.update_cb:
            act(SimpleNamespace(client=object(), target=control))

    def press(self, button: Any) -> None:
        for act in button._impl.update_cb:
            act(SimpleNamespace(client=object(), target=button))

    def look(self) -> None:
        self.drawing.update(self.session.model, self.session.moment(), self.session.trail())
        self.panel.update(self.session.moment(), 1.0, 50.0)


@pytest.fixture
def desk(run: cdcr.Trajectory) -> Iterator[Desk]:
    desk = Desk(Session(ROBOT, run=run, reference=run))
    yield desk
    close_server(desk.server)


def test_a_tool_is_drawn_and_moves() -> None:
    tool = ((1.0, 0.0, 0.0, 0.05), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    desk = Desk(Session(replace(ROBOT, tool=tool, base_position=(1.0, 0.0, 0.0))))
    try:
        desk.session.advance(0.1)
        desk.move(desk.panel.cables[0], 3.0)
        desk.session.advance(0.2)
        desk.look()
        model, q = desk.session.model, desk.session.moment().q
        expected = [[model.pose(q, 2, 1.0)[1], model.tip(q)[1]]]
        np.testing.assert_allclose(desk.drawing.tool.points, expected, rtol=0.0, atol=1e-6)
    finally:
        close_server(desk.server)


def test_a_slider_leaves_the_run_where_it_is(desk: Desk, run: cdcr.Trajectory) -> None:
    desk.session.seek(0.2)
    desk.look()
    np.testing.assert_allclose([slider.value for slider in desk.panel.cables], run.command[20])
    desk.move(desk.panel.cables[3], 2.0)
    live = desk.session.live
    assert live is not None
    np.testing.assert_allclose(live.command, [5, 0, 0, 2, 0, 0, 0, 0, 0])
    np.testing.assert_allclose(live.q, run.q[20], atol=1e-9)
    assert desk.session.playing
    desk.look()
    assert "simulated" in desk.panel._status.content
    desk.press(desk.panel._back)
    desk.look()
    assert desk.session.live is None
    assert "played" in desk.panel._status.content


def test_what_the_program_sets_does_nothing(desk: Desk) -> None:
    for slider in desk.panel.cables:
        for act in slider._impl.update_cb:
            act(SimpleNamespace(client=None, target=slider))
    assert desk.session.live is None


def test_loads(desk: Desk) -> None:
    desk.move(desk.panel._gravity[0], 2.0)
    desk.move(desk.panel._payload, 0.01)
    desk.move(desk.panel._damping, 0.5)
    live = desk.session.live
    assert live is not None
    assert live.robot.gravity == (2.0, 0.0, 9.81)
    assert live.robot.payload == 0.01
    assert live.added_damping == 0.5
    assert live.robot.sections[0].damping > ROBOT.sections[0].damping


def test_time(desk: Desk, run: cdcr.Trajectory) -> None:
    desk.move(desk.panel._scrub, 0.1)
    assert (desk.session.time, desk.session.playing) == (0.1, False)
    desk.look()
    assert desk.panel._play.label == "Play"
    desk.press(desk.panel._play)
    desk.look()
    assert (desk.session.playing, desk.panel._play.label) == (True, "Pause")
    assert (desk.panel._scrub.min, desk.panel._scrub.max) == (0.0, 0.3)


def test_the_mouse(run: cdcr.Trajectory) -> None:
    with run.view(port=0, browser=False) as view:
        disks = view._drawing.disks
        (grab,) = (entry.callback for entry in disks._impl.drag_cb)
        todo: list[Any] = []
        view._tasks = SimpleNamespace(put=todo.append)  # type: ignore[assignment]
        grab(SimpleNamespace(phase="start", instance_index=7, end_position=(0.1, 0.2, 0.3)))
        grab(SimpleNamespace(phase="end", instance_index=7, end_position=(0.1, 0.2, 0.3)))
        pull, let_go = todo
    session = view._session
    pull()
    assert session.live is not None
    assert session.live.pull is not None
    assert session.live.pull.section == 1  # six disks are on the first, five on the second
    assert session.live.pull.fraction == pytest.approx(0.4)
    assert session.live.pull.target == (0.1, 0.2, 0.3)
    let_go()
    assert session.live.pull is None


def test_the_scale_grows_with_the_tension() -> None:
    desk = Desk(Session(ROBOT))
    try:
        assert desk.drawing.scale == 5.0
        desk.move(desk.panel.cables[0], 12.0)
        desk.session.live_for(0.01)
        desk.look()
        assert desk.drawing.scale == 20.0
        assert "<span>20</span>" in desk.panel._legend.content
    finally:
        close_server(desk.server)


def test_a_number_typed_beyond_a_slider_goes_to_its_end(desk: Desk) -> None:
    for control, low, high in (
        (desk.panel.cables[0], 0.0, desk.session.ranges()[0][1]),
        (desk.panel._payload, 0.0, desk.panel._payload.max),
        (desk.panel._gravity[2], -10.0, 10.0),
        (desk.panel._damping, 0.0, 1.0),
    ):
        for typed, taken in ((-1e9, low), (1e9, high)):
            desk.move(control, typed)
            assert control.value == taken
    live = desk.session.live
    assert live is not None
    assert live.command[0] == desk.session.ranges()[0][1]
    assert (live.robot.payload, live.robot.gravity[2]) == (desk.panel._payload.max, 10.0)
    assert desk.session.advance(0.02) > 0.0


def test_what_is_refused_stands_in_the_corner() -> None:
    desk = Desk(Session(ROBOT))
    try:
        live = desk.session.live
        assert live is not None
        desk.session.attempt(lambda: live.change(payload=-1.0))
        desk.look()
        assert "payload must be &gt;= 0 kg" in desk.panel._status.content
        assert live.robot.payload == 0.0
        desk.session.attempt(lambda: desk.panel._command(0, 2.0))
        desk.session.advance(0.02)
        assert desk.session.refusal == ""
        live.command[0] = -3.0
        assert desk.session.advance(0.02) == 0.0
        assert live.command[0] == 2.0  # the last good one
        desk.look()
        assert "must be &gt;= 0 N" in desk.panel._status.content
        assert desk.session.advance(0.02) > 0.0
    finally:
        close_server(desk.server)
