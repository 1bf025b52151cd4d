"""Events of a run: the user's functions, and cables that turn slack or taut."""

import itertools
import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr

METHODS = ("auto", "bdf", "adams", "dopri5", "dop853", "rk4")
ZEROS = [0.0, 0.0]


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020())


def event(function: Callable[..., Any], **attributes: Any) -> Callable[..., Any]:
    for name, value in attributes.items():
        setattr(function, name, value)
    return function


@pytest.mark.parametrize("method", METHODS)
def test_a_small_swing_passes_straight_at_the_times_of_its_frequency(
    model: cdcr.Model, method: Any
) -> None:
    # Bent by 1e-5 rad it is harmonic to 1e-10 of its period.
    frequency = model.modes(ZEROS, np.zeros(3)).frequency[0]
    run = cdcr.simulate(
        model,
        [1e-5, 0.0],
        ZEROS,
        t=[0.0, 3.0],
        method=method,
        rtol=1e-12,
        atol=1e-18,
        step=1e-4,
        events=lambda t, q, qd: q[0],
    )
    times = np.array([found.time for found in run.events])
    expected = (np.arange(len(times)) + 0.5) * math.pi / frequency
    assert len(times) == 9
    np.testing.assert_allclose(times, expected, rtol=0.0, atol=1e-8)
    assert all(abs(found.q[0]) < 1e-17 for found in run.events)
    assert run.success
    assert run.status is cdcr.Status.ok


def test_direction_and_terminal_are_those_of_solve_ivp(model: cdcr.Model) -> None:
    swing: dict[str, Any] = {"q0": [0.3, 0.0], "qd0": ZEROS, "t": np.linspace(0.0, 5.0, 51)}

    def down(t: float, y: Any) -> Any:
        assert y.shape == (4,)
        return y[0]

    event(down, direction=-1)
    up = event(lambda t, q, qd: q[0], direction=2.0, terminal=2)
    run = cdcr.simulate(model, **swing, events=[down, up])
    assert [found.event for found in run.events] == [0, 1, 0, 1]
    assert run.status is cdcr.Status.event
    assert run.success
    last = run.events[-1].time
    assert run.message.startswith(f"Stopped at t = {last:.6g} s (event).")
    assert run.t[-1] <= last < run.t[-1] + 0.1
    once = cdcr.simulate(model, **swing, events=event(lambda t: t - 0.5, terminal=True), throw=True)
    assert once.events[0].time == 0.5
    assert once.t[-1] == 0.5
    both = cdcr.simulate(model, **swing, events=lambda t, q, qd: q[0])
    assert [found.time for found in both.events[:4]] == [found.time for found in run.events]


@pytest.mark.parametrize("method", METHODS)
def test_two_crossings_within_a_step_are_found(model: cdcr.Model, method: Any) -> None:
    # At rest, a step of bdf is seconds long.
    run = cdcr.simulate(
        model, ZEROS, ZEROS, t=[0.0, 100.0], method=method, events=lambda t: (t - 50.0) ** 2 - 1e-4
    )
    np.testing.assert_allclose([found.time for found in run.events], [49.99, 50.01], atol=1e-12)


@pytest.mark.parametrize(
    ("events", "error", "sentence"),
    [
        (3, ValueError, "events must be a function or a sequence of functions, got 3 (int)"),
        ([3], TypeError, "events[0] must be a function, got int"),
        (lambda a, b, c, d: 0, ValueError, "events[0] must take (t, q, qd), (t, y)"),
        (event(lambda t: t, terminal=-1), ValueError, "terminal of events[0] must be True, False"),
        (event(lambda t: t, direction="up"), ValueError, "direction of events[0] must be a number"),
        (event(lambda t: t, direction=True), ValueError, "direction of events[0] must be a number"),
        (lambda t, q, qd: q[0] > 0.1, TypeError, "events[0] must return a number that goes"),
        (lambda t: math.nan, ValueError, "the value of an event must be finite, got nan"),
        (lambda t: [1.0, 2.0], ValueError, "the value of an event must have shape (), got (2,)"),
    ],
)
def test_what_is_no_event_is_refused(
    model: cdcr.Model, events: Any, error: type[Exception], sentence: str
) -> None:
    with pytest.raises(error) as found:
        cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 1.0], events=events)
    assert str(found.value).startswith(sentence)


def test_numbers_of_numpy_are_attributes_too(model: cdcr.Model) -> None:
    found = event(lambda t: t - 0.25, terminal=np.True_, direction=np.int64(1))
    assert cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 1.0], events=found).events[0].time == 0.25
    assert cdcr.simulate(model, ZEROS, ZEROS, t=[0.0, 1.0], events=None).events == ()


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("k", np.geomspace(100.0, 2e4, 12))
def test_slack_events_alternate_where_cables_turn_together(method: Any, k: float) -> None:
    robot = cdcr.robots.amouri2020(damping=0.005)
    robot = replace(robot, sections=(replace(robot.sections[0], cable_stiffness=k),))
    model = cdcr.Model(robot)
    command = model.rest_command()
    for start in (0.3, 0.1):
        run = cdcr.simulate(
            model, [start, 0.0], ZEROS, t=np.linspace(0.0, 0.6, 601), tension=command, method=method
        )
        longer = model.cable_lengths(run.q) - command
        for cable in range(3):
            found = [turn for turn in run.slack_events if turn.cable == cable]
            assert found
            flags = [longer[0, cable] < 0.0, *(turn.slack for turn in found)]
            assert all(a != b for a, b in itertools.pairwise(flags))
            assert np.all(np.diff([turn.time for turn in found]) > 1e-9)
            # Between events, every sample hangs slack or pulls as the event before it says.
            index = np.searchsorted([turn.time for turn in found], run.t)
            np.testing.assert_array_equal(longer[1:, cable] < 0.0, np.array(flags)[index][1:])
