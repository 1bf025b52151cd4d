"""Runs under tensions put together from shapes: exact on both sides of every jump."""

import math
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr
from cdcr.scenarios.file.reader import load_scenario
from cdcr.scenarios.file.shapes import TensionShapes, pulse, ramp, sine, step
from tension_shapes import RAMP, ROUNDING, SINE, STEP, TIGHT, model

# Of two runs at the tightest tolerance whose steps differ [rad], [rad/s].
RUN = 1e-10

LENGTHS = (
    """\
t_end = 0.4
[robot]
name = "amouri2020"
[robot.each_section]
cable_stiffness = 5e3
damping = 0.02
[output]
num_samples = 41
"""
    + "".join(
        f"""\
[[tension]]
cable = {cable}
shape = "step"
value = 0.802
"""
        for cable in (1, 2, 3)
    )
    + """\
[[tension]]
cable = 1
shape = "ramp"
to = -0.01
start = 0.1
end = 0.2
[[tension]]
cable = 2
shape = "step"
value = -0.004
at = 0.15
[[tension]]
cable = 3
shape = "sine"
mean = 0.0
amplitude = 0.002
frequency = 5.0
"""
)


def restarted(edges: list[float], rows: list[list[float]], at: float) -> NDArray[np.float64]:
    """q and qd at `at` of runs under constant tensions, one for each stretch."""
    q, qd = np.zeros(2), np.zeros(2)
    for start, end, row in zip(edges[:-1], edges[1:], rows, strict=True):
        run = cdcr.simulate(model(), q, qd, t=[start, end], tension=row, **TIGHT)
        q, qd = run.q[-1], run.qd[-1]
    assert edges[-1] == at
    return np.concatenate([q, qd])


@pytest.mark.parametrize("method", ["bdf", "adams", "dopri5", "dop853"])
def test_a_run_over_jumps_is_one_restarted_there(method: str) -> None:
    tension = TensionShapes(3, [(0, STEP), (2, pulse(value=3.0, start=0.1, end=0.7))])
    t = np.array([0.0, 0.05, 0.3, 0.31, 2.0])
    options = TIGHT | {"method": method}
    run = tension.run(model(), [0.0, 0.0], [0.0, 0.0], t, **options)
    np.testing.assert_array_equal(run.t, t)
    rows = [[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [5.0, 0.0, 3.0], [5.0, 0.0, 0.0]]
    exact = restarted([0.0, 0.1, 0.3, 0.7, 2.0], rows, 2.0)
    # CVODE's global error is far above its tolerance of one step.
    limit = RUN if method in ("dopri5", "dop853") else 1e-7
    np.testing.assert_allclose(np.concatenate([run.q[-1], run.qd[-1]]), exact, atol=limit)
    np.testing.assert_array_equal(run.tension[2], [5.0, 0.0, 3.0])
    assert run.method == method


def test_a_jump_beside_a_sine_is_a_restart() -> None:
    def wave(t: float) -> float:
        return 2.0 + 1.5 * math.sin(3.0 * math.pi * t)

    shapes = TensionShapes(3, [(0, STEP), (1, sine(mean=2.0, amplitude=1.5, frequency=1.5))])
    q, qd = np.zeros(2), np.zeros(2)
    for t, pull in (([0.0, 0.3], 0.0), ([0.3, 2.0], 5.0)):

        def function(t: float, pull: float = pull) -> list[float]:
            return [pull, wave(t), 0.0]

        run = cdcr.simulate(model(), q, qd, t=t, tension=function, **TIGHT)
        q, qd = run.q[-1], run.qd[-1]
    whole = shapes.run(model(), [0.0, 0.0], [0.0, 0.0], [0.0, 2.0], **TIGHT)
    np.testing.assert_allclose(whole.q[-1], q, atol=RUN)
    np.testing.assert_allclose(whole.qd[-1], qd, atol=RUN)


def test_fixed_steps_keep_their_order_over_jumps() -> None:
    """RK4 evaluates at both ends of a step: a wrong side of one jump would cost its order."""
    tension = TensionShapes(3, [(0, STEP), (1, SINE), (2, RAMP)])
    t, rest = [0.0, 2.0], [0.0, 0.0]
    exact = tension.run(model(), rest, rest, t, **TIGHT).q[-1]
    errors = [
        np.abs(tension.run(model(), rest, rest, t, method="rk4", step=h).q[-1] - exact).max()
        for h in (0.01, 0.005)
    ]
    # Each stretch between break points is a whole number of steps.
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.15)


def test_ramps_run_as_a_table() -> None:
    shapes = TensionShapes(3, [(0, ramp(after=5.0, start=0.4, end=1.2)), (1, ramp(after=1, end=2))])
    table = cdcr.TensionTable(
        [0.0, 0.4, 1.2, 2.0],
        [[0.0, 0.0, 0.0], [0.0, 0.2, 0.0], [5.0, 0.6, 0.0], [5.0, 1.0, 0.0]],
    )
    t, rest = np.linspace(0.0, 2.0, 9), [0.0, 0.0]
    run = shapes.run(model(), rest, rest, t, **TIGHT)
    plain = cdcr.simulate(model(), rest, rest, t=t, tension=table, **TIGHT)
    np.testing.assert_allclose(run.q, plain.q, atol=RUN)
    np.testing.assert_allclose(run.tension, plain.tension, atol=ROUNDING)


def test_a_smooth_sine_runs_as_a_function() -> None:
    shapes = TensionShapes(3, [(1, sine(mean=2.0, amplitude=1.0, frequency=2.0))])
    t, rest = np.linspace(0.0, 2.0, 9), [0.0, 0.0]

    def function(t: float) -> list[float]:
        return [0.0, 2.0 + math.sin(4.0 * math.pi * t), 0.0]

    run = shapes.run(model(), rest, rest, t, **TIGHT)
    plain = cdcr.simulate(model(), rest, rest, t=t, tension=function, **TIGHT)
    np.testing.assert_allclose(run.q, plain.q, atol=RUN)


def test_costs_and_failures_of_the_stretches_add_up() -> None:
    tension = TensionShapes(3, [(0, step(value=1.0, at=0.5)), (0, step(value=500.0, at=1.0))])
    t, rest = np.linspace(0.0, 2.0, 41), [0.0, 0.0]
    run = tension.run(model(), rest, rest, t, **TIGHT)
    assert run.status.name == "bending_limit"
    assert run.t[-1] >= 1.0
    np.testing.assert_array_equal(run.t, t[: len(run)])
    part = tension.run(model(), rest, rest, t[:21], **TIGHT)
    assert part.success
    assert part.tension[-1, 0] == 501.0  # after the jump, as in any run
    assert 0 < part.stats.steps < run.stats.steps
    short = tension.run(model(), rest, rest, t, max_steps=part.stats.steps - 5, **TIGHT)
    assert short.status.name == "step_limit"
    assert short.stats.steps < part.stats.steps


@pytest.mark.parametrize("method", ["bdf", "adams", "dopri5", "dop853", "rk4"])
def test_lengths_put_together_from_shapes_run_as_a_function(method: Any, tmp_path: Path) -> None:
    """A scenario file's shapes: tensions in N, and each turn of a cable to slack or taut."""
    file = tmp_path / "lengths.toml"
    file.write_text(LENGTHS, encoding="utf-8")
    scenario = load_scenario(file)
    shapes: Any = scenario.input_source
    run = scenario.simulate(method=method)
    plain = cdcr.simulate(
        scenario.model,
        np.zeros(2),
        np.zeros(2),
        t=scenario.times(),
        tension=shapes,
        break_points=shapes.break_points,
        method=method,
    )
    for name in ("t", "q", "qd", "tension", "command"):
        np.testing.assert_array_equal(getattr(run, name), getattr(plain, name))
    assert run.slack_events == plain.slack_events
    np.testing.assert_array_equal(run.command, shapes(run.t))
    assert 1.0 < run.tension.max() < 100.0
    if method in ("bdf", "adams"):
        assert run.slack_events


def test_a_taylor_model_warns_once() -> None:
    taylor = cdcr.Model(cdcr.robots.amouri2020(), formulation="taylor")
    tension = TensionShapes(
        3, [(0, step(value=v, at=a)) for v, a in ((20, 0.0), (5, 0.4), (1, 0.5))]
    )
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        run = tension.run(taylor, [1.8, 0.0], [0.0, 0.0], np.linspace(0.0, 0.6, 7))
    assert run.theta.max() > cdcr.taylor_range
    assert len(caught) == 1
