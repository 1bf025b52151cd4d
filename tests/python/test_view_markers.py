"""Measured markers in the view: where they are when, what is drawn, what is refused."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("matplotlib", reason="the view draws with the colours of pictures")

from cdcr.view import Session
from cdcr.view.drawing import Drawing
from cdcr.view.markers import Markers

ROBOT = cdcr.robots.three_sections(damping=0.02)
TIMES = [0.0, 1.0, 3.0]
TWO: Any = np.array([[[0.0, 0, 1], [5, 5, 5]], [[1, 0, 1], [6, 5, 5]], [[2, 2, 1], [6, 7, 5]]])


def test_markers_move_on_a_line_between_samples() -> None:
    markers = Markers((TIMES, TWO))
    np.testing.assert_array_equal(markers.at(1.0), TWO[1])
    np.testing.assert_allclose(markers.at(2.0), [[1.5, 1.0, 1.0], [6.0, 6.0, 5.0]], rtol=1e-15)
    np.testing.assert_array_equal(markers.at(3.0), TWO[2])
    for outside in (-0.1, 3.1):
        assert markers.at(outside).shape == (0, 3)


def test_what_is_not_seen_is_not_shown() -> None:
    hidden = TWO.copy()
    hidden[1, 0] = np.nan
    markers = Markers((TIMES, hidden))
    assert [len(markers.at(t)) for t in (0.0, 0.5, 1.0, 2.0, 3.0)] == [2, 1, 1, 1, 2]


def test_forms_of_markers() -> None:
    np.testing.assert_array_equal(Markers(TWO[0]).at(123.0), TWO[0])
    np.testing.assert_array_equal(Markers((TIMES, TWO[:, 0])).at(3.0), TWO[2, :1])
    motion = cdcr.identification.Motion(
        TIMES, np.zeros(9), tip=TWO[:, 0], markers={(0, 0.5): TWO[:, 1]}
    )
    np.testing.assert_array_equal(Markers(motion).at(3.0), TWO[2])


class Scene:
    """Keeps what is drawn into it, by name."""

    def __init__(self) -> None:
        self.drawn: dict[str, Any] = {}

    def __getattr__(self, kind: str) -> Any:
        def add(name: str, points: Any = None, *_: Any, **__: Any) -> Any:
            self.drawn[name] = SimpleNamespace(points=points)
            return self.drawn[name]

        return add


def test_a_run_has_its_markers_beside_it() -> None:
    model = cdcr.Model(ROBOT)
    run = cdcr.simulate(model, [0.1] * 6, [0.0] * 6, t=[0.0, 0.5, 1.0])
    seen = (run.t[:2], run.tip[:2])
    session, scene = Session(ROBOT, run=run, markers=seen), Scene()
    drawing = Drawing(scene, session.model, session.moment(), session.scale)
    np.testing.assert_allclose(scene.drawn["/markers"].points, run.tip[:1], rtol=1e-6)
    for time, expected in ((0.5, run.tip[1:2]), (0.9, np.empty((0, 3)))):
        session.seek(time)
        drawing.update(session.model, session.moment(), session.trail())
        np.testing.assert_allclose(scene.drawn["/markers"].points, expected, rtol=1e-6)
    session.go_live()  # they stay where the run is gone on with
    assert session.moment().markers is not None
    bare = Scene()
    Drawing(bare, session.model, Session(ROBOT).moment(), session.scale)
    assert "/markers" not in bare.drawn


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ("tip", r"^markers must be positions \(k, 3\) that stay, a pair of times .*, got 'tip'"),
        ([1.0, 2.0, 3.0], r"^markers must be positions \(k, 3\)"),
        ((TIMES, TWO[:2]), r"^markers must be positions \(k, 3\)"),
        (([0.0, 1.0, 1.0], TWO), "^times of markers must increase"),
    ],
)
def test_refused(given: Any, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        Session(ROBOT, markers=given)
    bare = cdcr.identification.Motion([0.0, 1.0], np.zeros(9), tension=np.ones((2, 9)))
    with pytest.raises(ValueError, match=r"^markers must be measured, and motion has none, nor a"):
        Markers(bare)
