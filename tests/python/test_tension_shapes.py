"""Tensions put together from shapes: their values and their jumps."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cdcr.scenarios.file.shapes import Shape, TensionShapes, ramp, sine, step
from tension_shapes import PULSE, RAMP, ROUNDING, SINE, STEP


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
    before = [np.nextafter(t, 0.0) for t in tension.break_points]  # as a run asks for
    assert tension(before[0]) == pytest.approx([2.0], abs=ROUNDING)
    assert tension(0.25) == pytest.approx([3.5], abs=ROUNDING)
    assert tension(before[1]) == pytest.approx([sine], abs=ROUNDING)
    assert tension(0.3) == pytest.approx([sine + 5.0], abs=ROUNDING)


def test_no_shapes_no_tension() -> None:
    np.testing.assert_array_equal(TensionShapes(3, [])([0.0, 1.0]), np.zeros((2, 3)))


def test_what_rounding_leaves_below_zero_is_zero() -> None:
    parts = [step(value=0.3), step(value=-0.1, at=1.0), step(value=-0.2, at=1.0)]
    assert 0.3 - 0.1 - 0.2 < 0.0
    tension = TensionShapes(1, [(0, part) for part in parts])
    assert tension(2.0)[0] == 0.0


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
