"""What a run refuses, each with its own sentence."""

import re
from typing import Any

import numpy as np
import pytest

import cdcr

NAN, INF = np.nan, np.inf
ZEROS = [0.0, 0.0]


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020())


def run(model: cdcr.Model, **arguments: Any) -> cdcr.Trajectory:
    given = {"q0": ZEROS, "qd0": ZEROS, "t": [0.0, 0.1, 0.2]} | arguments
    return cdcr.simulate(model, given.pop("q0"), given.pop("qd0"), **given)


def refuses(sentence: str) -> Any:
    return pytest.raises(ValueError, match=f"^{re.escape(sentence)}$")


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ({"q0": [0.0]}, "q0 must have shape (2,), got (1,)"),
        ({"q0": [0.0, NAN]}, "q0[1] (section 1) must be finite, got nan"),
        (
            {"q0": [0.0, 10.0]},
            "q0 must bend each section by at most 3 pi rad, got 10 rad in section 1",
        ),
        ({"qd0": [[0.0, 0.0]]}, "qd0 must have shape (2,), got (1, 2)"),
        ({"qd0": [INF, 0.0]}, "qd0[0] (section 1) must be finite, got inf"),
        ({"qd0": None}, "qd0 must be numbers of shape (2,), got NoneType"),
        ({"t": 1.0}, "t must have shape (any,), got ()"),
        ({"t": []}, "t must hold at least one time, got none"),
        ({"t": [0.0, NAN]}, "t[1] must be finite, got nan"),
        (
            {"t": [0.0, 0.5, 0.5]},
            "t must be finite and strictly increasing, got 0.5 s at index 2 after 0.5 s",
        ),
        ({"t": "soon"}, "t must be numbers of shape (any,), got str"),
        (
            {"method": "euler"},
            "method must be one of 'rk4', 'dopri5', 'bdf', 'adams', 'dop853', "
            "'auto', 'rosenbrock', got 'euler'",
        ),
        ({"rtol": 0.0}, "rtol must be at least 1e-14 and below 1, got 0"),
        ({"rtol": 1.0}, "rtol must be at least 1e-14 and below 1, got 1"),
        ({"rtol": NAN}, "rtol must be at least 1e-14 and below 1, got nan"),
        ({"atol": 0.0}, "atol must be > 0 and finite, got 0"),
        ({"atol": INF}, "atol must be > 0 and finite, got inf"),
        ({"step": -1e-3}, "step must be > 0 s and finite, got -0.001"),
        ({"max_step": -1.0}, "max_step must be >= 0 s and finite (0: no limit), got -1"),
        ({"max_steps": 0}, "max_steps must be at least 1, got 0"),
    ],
)
def test_states_times_and_options(
    model: cdcr.Model, arguments: dict[str, Any], sentence: str
) -> None:
    with refuses(sentence):
        run(model, **arguments)


ROWS = np.ones((2, 3))


@pytest.mark.parametrize(
    ("tension", "sentence"),
    [
        ([1.0, 2.0], "tension must have shape (3,), got (2,)"),
        (5.0, "tension must have shape (3,), got ()"),
        ([1.0, NAN, 0.0], "tension[1] (cable 2) must be finite, got nan"),
        ([1.0, 0.0, -2.0], "tension[2] (cable 3) must be >= 0 N (a cable cannot push), got -2"),
        ("much", "tension must be numbers of shape (3,), got str"),
        (ROWS, "tension must have shape (3,), got (2, 3)"),
        (
            ([0.0, 1.0], ROWS[:, :2]),
            "the table's tension must have shape (2, 3), got (2, 2)",
        ),
        (
            ([0.0, 1.0, 2.0], ROWS),
            "the table's tension must have shape (3, num_cables), got (2, 3)",
        ),
        (
            ([[0.0, 1.0]], ROWS),
            "the table's t must have shape (any,), got (1, 2)",
        ),
        (([0.0, INF], ROWS), "the table's t[1] must be finite, got inf"),
        (
            ([1.0, 0.5], ROWS),
            "the times of a tension table must be finite and strictly increasing, got 0.5 s at "
            "index 1 after 1 s",
        ),
        (
            ([0.0, 1.0], [[0.0, 0.0, 0.0], [0.0, -1.0, 0.0]]),
            "tension[1, 1] (cable 2) must be finite and >= 0 N (a cable cannot push), "
            "or >= 0 m where driven "
            "by length, got -1",
        ),
        (
            ([0.0, 1.0], [[0.0, NAN, 0.0], [0.0, 0.0, 0.0]]),
            "the table's tension[0, 1] must be finite, got nan",
        ),
        (
            ([], np.zeros((0, 3))),
            "a tension table needs one row of values for each time, got 0 times and 0 rows",
        ),
        (
            ([0.0, 0.0, 0.0], [[0.0, 0.0, 0.0]] * 3),
            "the times of a tension table must be finite and strictly increasing, got 0 s at "
            "index 2 after 0 s",
        ),
        (
            lambda t: [1.0, 2.0],
            "the value of the tension function must have shape (3,), got (2,)",
        ),
        (
            lambda t: None,
            "the value of the tension function must be numbers of shape (3,), got NoneType",
        ),
        (
            lambda t: "much",
            "the value of the tension function must be numbers of shape (3,), got str",
        ),
        (
            lambda t: [0.0, 0.0, INF],
            "the value of the tension function[2] (cable 3) must be finite, got inf",
        ),
        (
            lambda t, q, qd: [1.0, -2.0, 0.5],
            "the tension function must give finite values >= 0 N (a cable cannot push), got "
            "[  1  -2 0.5] at t = 0 s",
        ),
        (
            lambda t, q: [1.0, 0.0, 0.0],
            "a tension function must take (t) or (t, q, qd), got one that needs 2 arguments",
        ),
        (
            lambda: [1.0, 0.0, 0.0],
            "a tension function must take (t) or (t, q, qd), got one that needs 0 arguments",
        ),
    ],
)
def test_tensions(model: cdcr.Model, tension: Any, sentence: str) -> None:
    with refuses(sentence):
        run(model, tension=tension)


@pytest.mark.parametrize("method", ["bdf", "adams", "dopri5", "dop853", "rk4"])
def test_a_function_that_goes_wrong_on_the_way(model: cdcr.Model, method: str) -> None:
    def tension(t: float) -> list[float]:
        return [1.0 if t < 0.1 else -1.0, 0.0, 0.0]

    with pytest.raises(ValueError, match=r"a cable cannot push\), got \[-1  0  0\] at t = 0\.1"):
        run(model, tension=tension, method=method)


def test_interpolation() -> None:
    with refuses("interpolation must be 'linear' or 'previous', got 'cubic'"):
        cdcr.TensionTable([0.0, 1.0], ROWS, "cubic")  # type: ignore[arg-type]


def test_break_points(model: cdcr.Model) -> None:
    with refuses("break_points go with a tension function; a table has its own"):
        run(model, tension=[1.0, 0.0, 0.0], break_points=[0.1])
    with refuses(
        "break_points must be finite and strictly increasing, got 0.1 s at index 1 after 0.2 s"
    ):
        run(model, tension=lambda t: [1.0, 0.0, 0.0], break_points=[0.2, 0.1])


def test_tension_and_controller(model: cdcr.Model) -> None:
    pid = cdcr.Pid(model, kp=1.0)
    with refuses("give either tension or controller, not both"):
        run(model, tension=[1.0, 0.0, 0.0], controller=pid)
    with refuses("give either tension or controller, not both"):
        run(model, controller=pid, break_points=[0.1])
    with refuses("give either command or controller, not both"):
        run(model, command=[1.0, 0.0, 0.0], controller=pid)
    with refuses("give either tension or command, two names for one thing, not both"):
        run(model, tension=[1.0, 0.0, 0.0], command=[1.0, 0.0, 0.0])


def test_messages_call_the_commands_what_the_caller_does(model: cdcr.Model) -> None:
    sentence = r"^command\[1\] \(cable 2\) must be >= 0 N \(a cable cannot push\), got -1$"
    with pytest.raises(ValueError, match=sentence):
        run(model, command=[0.0, -1.0, 0.0])
    simulator = cdcr.Simulator(model)
    simulator.reset([0.0, 0.0], [0.0, 0.0])
    with pytest.raises(ValueError, match=sentence):
        simulator.step(command=[0.0, -1.0, 0.0])


def test_a_table_is_refused_where_it_is_made() -> None:
    with refuses("the table's tension must have shape (2, num_cables), got (1, 3)"):
        cdcr.TensionTable([0.0, 1.0], [[1.0, 2.0, 3.0]])
    with pytest.raises(ValueError, match=r"tension\[0, 1\] \(cable 2\) must be finite and >= 0 N"):
        cdcr.TensionTable([0.0], [[0.0, -1.0, 0.0]])


def test_a_step_that_is_too_large_is_named(model: cdcr.Model) -> None:
    """Far beyond the limit of `stable_step` the first step throws the robot out of its range."""
    pull, t = [5.0, 0.0, 0.0], [0.0, 5.0]
    thrown = run(model, t=t, tension=pull, method="rk4", step=5.0)
    limit = cdcr.stable_step(model, ZEROS)
    assert not thrown.success
    assert thrown.message.endswith(
        f" Or the step of 5 s is too large: here rk4 is stable up to {limit:.3g} s."
    )
    too_much = run(model, t=t, tension=[900.0, 0.0, 0.0], method="rk4", step=1e-3)
    assert too_much.status is cdcr.Status.bending_limit
    assert "too large" not in too_much.message
