"""Tensions put together from shapes: their values, their jumps, and runs under them."""

import math
import warnings
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import cdcr
from cdcr.scenarios import Scenario
from cdcr.scenarios.file.reader import load_scenario
from cdcr.scenarios.file.shapes import Shape, TensionShapes, pulse, ramp, sine, step

# One evaluation of a sum of a few terms near 10 N.
ROUNDING = 1e-14
# Of two runs at the tightest tolerance whose steps differ [rad], [rad/s].
RUN = 1e-10
TIGHT: dict[str, Any] = {"method": "dopri5", "rtol": 1e-12, "atol": 1e-14}
HEAD = """\
robot = "amouri2020"
t_end = 2.0
integrator = { method = "dopri5", rtol = 1e-12, atol = 1e-14 }
"""

STEP = step(value=5.0, at=0.3)
RAMP = ramp(before=1.0, after=3.0, start=0.5, end=1.0)
PULSE = pulse(value=4.0, start=0.2, end=0.9, base=0.5)
SINE = sine(mean=2.0, amplitude=1.5, frequency=0.5, phase=math.pi / 2, start=0.25)


def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020())


def load(folder: Path, text: str) -> Scenario:
    path = folder / "pull.toml"
    path.write_text(HEAD + text, encoding="utf-8")
    return load_scenario(path)


def table(**keys: object) -> str:
    return "[[tension]]\n" + "".join(f"{key} = {value!r}\n" for key, value in keys.items())


@pytest.mark.parametrize(
    ("shape", "values"),
    [
        (STEP, {0.0: 0.0, 0.2999: 0.0, 0.3: 5.0, 9.0: 5.0}),
        (RAMP, {0.0: 1.0, 0.5: 1.0, 0.625: 1.5, 0.75: 2.0, 1.0: 3.0, 9.0: 3.0}),
        (PULSE, {0.0: 0.5, 0.2: 4.0, 0.8999: 4.0, 0.9: 0.5, 9.0: 0.5}),
        (SINE, {0.0: 2.0, 0.2499: 2.0, 0.25: 3.5, 0.75: 2.0, 1.25: 0.5, 2.25: 3.5}),
    ],
)
def test_values_at_jumps_are_those_after(shape: Shape, values: dict[float, float]) -> None:
    tension = TensionShapes(2, [(1, shape)])
    wanted = np.stack([np.zeros(len(values)), list(values.values())], axis=1)
    np.testing.assert_allclose(tension(list(values)), wanted, atol=ROUNDING)
    for t, row in zip(values, wanted, strict=True):
        np.testing.assert_allclose(tension(t), row, atol=ROUNDING)


def test_shapes_of_one_cable_add_up() -> None:
    t = np.linspace(0.0, 2.0, 201)
    shapes = (STEP, RAMP, PULSE, SINE)
    together = TensionShapes(1, [(0, shape) for shape in shapes])
    alone = sum(TensionShapes(1, [(0, shape)])(t) for shape in shapes)
    np.testing.assert_allclose(together(t), alone, atol=ROUNDING)
    assert together.break_points == (0.2, 0.25, 0.3, 0.5, 0.9, 1.0)


def test_both_sides_of_a_jump() -> None:
    tension = TensionShapes(1, [(0, STEP), (0, SINE)])
    assert tension.break_points == (0.25, 0.3)
    sine = 2.0 + 1.5 * math.cos(math.pi * 0.05)
    assert tension.within(0, 0.25) == pytest.approx([2.0], abs=ROUNDING)
    assert tension.within(1, 0.25) == pytest.approx([3.5], abs=ROUNDING)
    assert tension.within(1, 0.3) == pytest.approx([sine], abs=ROUNDING)
    assert tension.within(2, 0.3) == pytest.approx([sine + 5.0], abs=ROUNDING)


def test_no_shapes_no_tension() -> None:
    np.testing.assert_array_equal(TensionShapes(3, [])([0.0, 1.0]), np.zeros((2, 3)))


def test_what_rounding_leaves_below_zero_is_zero() -> None:
    parts = [step(value=0.3), step(value=-0.1, at=1.0), step(value=-0.2, at=1.0)]
    assert 0.3 - 0.1 - 0.2 < 0.0
    tension = TensionShapes(1, [(0, part) for part in parts])
    assert tension(2.0)[0] == 0.0


@settings(max_examples=60, deadline=None)
@given(
    data=st.lists(
        st.tuples(
            st.floats(-1.0, 5.0), st.floats(0.0, 3.0), st.floats(0.1, 2.0), st.floats(0.0, 3.0)
        ),
        min_size=1,
        max_size=4,
    )
)
def test_accepted_shapes_never_push(data: list[tuple[float, float, float, float]]) -> None:
    shapes: list[tuple[int, Shape]] = []
    for value, start, length, amplitude in data:
        shapes.append((0, ramp(after=value, start=start, end=start + length)))
        shapes.append((0, sine(mean=value, amplitude=amplitude, frequency=1.7, start=start)))
    t = np.linspace(0.0, 6.0, 1201)
    try:
        tension = TensionShapes(1, shapes)
    except ValueError:
        return
    plain = np.zeros(t.size)
    for value, start, length, amplitude in data:
        plain += value * np.clip((t - start) / length, 0.0, 1.0) + value
        plain += np.where(t >= start, amplitude * np.sin(3.4 * math.pi * (t - start)), 0.0)
    assert plain.min() > -1e-12
    np.testing.assert_allclose(tension(t)[:, 0], plain, atol=1e-12)


def restarted(edges: list[float], rows: list[list[float]], at: float) -> NDArray[np.float64]:
    """q and qd at `at` of runs under constant tensions, one for each stretch."""
    q, qd = np.zeros(2), np.zeros(2)
    for start, end, row in zip(edges[:-1], edges[1:], rows, strict=True):
        run = cdcr.simulate(model(), q, qd, t=[start, end], tension=row, **TIGHT)
        q, qd = run.q[-1], run.qd[-1]
    assert edges[-1] == at
    return np.concatenate([q, qd])


@pytest.mark.parametrize("method", ["bdf", "adams", "dopri5"])
def test_a_run_over_jumps_is_one_restarted_there(method: str) -> None:
    tension = TensionShapes(3, [(0, STEP), (2, pulse(value=3.0, start=0.1, end=0.7))])
    t = np.array([0.0, 0.05, 0.3, 0.31, 2.0])
    options = TIGHT | {"method": method}
    run = tension.run(model(), [0.0, 0.0], [0.0, 0.0], t, **options)
    np.testing.assert_array_equal(run.t, t)
    rows = [[0.0, 0.0, 0.0], [0.0, 0.0, 3.0], [5.0, 0.0, 3.0], [5.0, 0.0, 0.0]]
    exact = restarted([0.0, 0.1, 0.3, 0.7, 2.0], rows, 2.0)
    # CVODE's global error is far above its tolerance of one step.
    limit = RUN if method == "dopri5" else 1e-7
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


def test_lengths_put_together_from_shapes_are_commands_and_no_tensions() -> None:
    robot = cdcr.robots.amouri2020(damping=0.02)
    section = replace(robot.sections[0], cable_stiffness=5e3)
    model = cdcr.Model(replace(robot, sections=(section,)))
    shapes = [(j, step(value=length)) for j, length in enumerate(model.rest_command())]
    lengths = TensionShapes(3, [*shapes, (0, ramp(after=-0.01, start=0.1, end=0.2))])
    t = np.linspace(0.0, 0.4, 41)
    rest = np.zeros(2)
    run, table = lengths.run(model, rest, rest, t), cdcr.TensionTable(t, lengths(t))
    np.testing.assert_array_equal(run.command, lengths(t))
    whole = cdcr.simulate(model, rest, rest, t=t, command=table)
    np.testing.assert_allclose(run.tension, whole.tension, rtol=0, atol=1e-2)
    assert 10.0 < run.tension.max() < 50.0
    assert {event.cable for event in run.slack_events} == {
        event.cable for event in whole.slack_events
    }


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


def test_shapes_in_a_file(tmp_path: Path) -> None:
    text = table(cable=1, shape="step", value=5, at=0.3)
    text += table(cable=1, shape="ramp", to=2.0, end=1)
    text += table(cable=2, shape="pulse", value=3, start=0.2, end=0.9, base=1)
    text += table(cable=3, shape="sine", mean=2, amplitude=1, frequency=1.5, phase_deg=90)
    scenario = load(tmp_path, text)
    tension = TensionShapes(
        3,
        [
            (0, STEP),
            (0, ramp(after=2.0, end=1.0)),
            (1, pulse(value=3.0, start=0.2, end=0.9, base=1.0)),
            (2, sine(mean=2.0, amplitude=1.0, frequency=1.5, phase=math.pi / 2)),
        ],
    )
    run = scenario.simulate(num_samples=21)
    plain = tension.run(model(), [0.0, 0.0], [0.0, 0.0], run.t, **TIGHT)
    np.testing.assert_array_equal(run.q, plain.q)
    np.testing.assert_array_equal(run.tension, tension(run.t))
    shorter = scenario.simulate(t_end=1.0, method="rk4")
    assert (shorter.t[-1], shorter.method) == (1.0, "rk4")


STEP_KEYS = {"cable": 1, "shape": "step", "value": 5}
SINE_KEYS = {"cable": 2, "shape": "sine", "mean": 1, "amplitude": 0.5, "frequency": 2}
NO_PUSH = (
    "; what its shapes add up to must be >= 0 N at all times (a sine counts with its whole "
    "amplitude), since a cable cannot push"
)


@pytest.mark.parametrize(
    ("keys", "sentence"),
    [
        (
            STEP_KEYS | {"shape": "setp"},
            ': tension[0].shape must be one of "step", "ramp", "pulse", "sine", '
            "got 'setp' (string). Did you mean 'step'?",
        ),
        (
            {"cable": 1, "value": 5},
            ': tension[0].shape is missing; it must be one of "step", "ramp", "pulse", "sine"',
        ),
        (
            {"cable": 1, "shape": "step"},
            ": tension[0].value is missing; it must be a number [N]",
        ),
        (
            STEP_KEYS | {"att": 1},
            ": tension[0].att is not a known key. Did you mean 'at'? "
            "Known keys: cable, shape, value, at",
        ),
        (
            STEP_KEYS | {"cable": 4},
            ": tension[0].cable must be the number of a cable, 1 to 3, got 4",
        ),
        (
            STEP_KEYS | {"cable": 0},
            ": tension[0].cable must be the number of a cable, from 1, got 0 (integer)",
        ),
        (
            STEP_KEYS | {"value": math.inf},
            ": tension[0].value must be a number [N], got inf (float)",
        ),
        (
            STEP_KEYS | {"value": -2.0, "at": 1.5},
            ", [[tension]]: cable 1 would go down to -2 N from t = 1.5 s on" + NO_PUSH,
        ),
        (
            SINE_KEYS | {"amplitude": 3},
            ", [[tension]]: cable 2 would go down to -2 N from t = 0 s on" + NO_PUSH,
        ),
        (
            SINE_KEYS | {"amplitude": -1},
            ": tension[0].amplitude must be a number >= 0 [N], got -1 (integer)",
        ),
        (
            SINE_KEYS | {"phase": 0.5, "phase_deg": 30},
            ": tension[0] must have phase or phase_deg, not both",
        ),
        (
            {"cable": 1, "shape": "pulse", "value": -1, "start": 1, "end": 2, "base": 0.5},
            ", [[tension]]: cable 1 would go down to -1 N between t = 1 and 2 s" + NO_PUSH,
        ),
        (
            {"cable": 1, "shape": "ramp", "from": -1, "to": 2, "start": 1, "end": 2},
            ", [[tension]]: cable 1 would go down to -1 N before t = 1 s" + NO_PUSH,
        ),
        (
            {"cable": 1, "shape": "ramp", "to": 2, "start": 2, "end": 2},
            ": tension[0]: end must be later than start, 2 s, got 2 s",
        ),
        (
            {"cable": 1, "shape": "ramp", "to": 2, "form": 1, "end": 2},
            ": tension[0].form is not a known key. Did you mean 'from'? "
            "Known keys: cable, shape, from, to, start, end",
        ),
    ],
)
def test_what_is_wrong_with_a_shape(tmp_path: Path, keys: dict[str, object], sentence: str) -> None:
    text = table(**keys)
    with pytest.raises(ValueError, match="tension") as caught:
        load(tmp_path, text)
    assert str(caught.value) == f"{tmp_path / 'pull.toml'}{sentence}"


def test_one_shape_wants_two_brackets(tmp_path: Path) -> None:
    text = table(**STEP_KEYS).replace("[[tension]]", "[tension]")
    with pytest.raises(ValueError, match=r"a table with shape must be written \[\[tension\]\]"):
        load(tmp_path, text)
