"""The tables [[tension]] of scenario files: read, run and refused."""

import math
from pathlib import Path

import numpy as np
import pytest

from cdcr.scenarios import Scenario
from cdcr.scenarios.file.reader import load_scenario
from cdcr.scenarios.file.shapes import TensionShapes, pulse, ramp, sine
from description import without_lines
from tension_shapes import STEP, TIGHT, model

HEAD = """\
robot = "amouri2020"
t_end = 2.0
integrator = { method = "dopri5", rtol = 1e-12, atol = 1e-14 }
"""


def load(folder: Path, text: str) -> Scenario:
    path = folder / "pull.toml"
    path.write_text(HEAD + text, encoding="utf-8")
    return load_scenario(path)


def table(**keys: object) -> str:
    return "[[tension]]\n" + "".join(f"{key} = {value!r}\n" for key, value in keys.items())


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
COMMAND = "a number [N], or [m] for a cable driven by length"
NO_PUSH = (
    "; what its shapes add up to must be >= 0 at all times, as a tension or a length (a sine "
    "counts with its whole amplitude)"
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
            ": tension[0].value is missing; it must be " + COMMAND,
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
            ": tension[0].value must be " + COMMAND + ", got inf (float)",
        ),
        (
            STEP_KEYS | {"value": -2.0, "at": 1.5},
            ", [[tension]]: cable 1 would go down to -2 from t = 1.5 s on" + NO_PUSH,
        ),
        (
            SINE_KEYS | {"amplitude": 3},
            ", [[tension]]: cable 2 would go down to -2 from t = 0 s on" + NO_PUSH,
        ),
        (
            SINE_KEYS | {"amplitude": -1},
            ": tension[0].amplitude must be a number >= 0" + COMMAND[8:] + ", got -1 (integer)",
        ),
        (
            SINE_KEYS | {"phase": 0.5, "phase_deg": 30},
            ": tension[0] must have phase or phase_deg, not both",
        ),
        (
            {"cable": 1, "shape": "pulse", "value": -1, "start": 1, "end": 2, "base": 0.5},
            ", [[tension]]: cable 1 would go down to -1 between t = 1 and 2 s" + NO_PUSH,
        ),
        (
            {"cable": 1, "shape": "ramp", "from": -1, "to": 2, "start": 1, "end": 2},
            ", [[tension]]: cable 1 would go down to -1 before t = 1 s" + NO_PUSH,
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
    path = tmp_path / "pull.toml"
    assert without_lines(caught.value, path) == [f"{path}{sentence}"]


def test_one_shape_wants_two_brackets(tmp_path: Path) -> None:
    text = table(**STEP_KEYS).replace("[[tension]]", "[tension]")
    with pytest.raises(ValueError, match=r"a table with shape must be written \[\[tension\]\]"):
        load(tmp_path, text)


@pytest.mark.parametrize("step", [0.5, 0.1, 0.007])
def test_sampled_shapes_jump_where_they_do(step: float, tmp_path: Path) -> None:
    """A pulse far shorter than the step, a jump at a sample but for rounding, a ramp that ends."""
    text = table(cable=1, shape="pulse", value=5, start=0.3123, end=0.3343)
    text += table(cable=2, shape="step", value=2, at=0.1 + 0.2)
    text += table(cable=3, shape="ramp", to=2.0, start=0.77, end=1.23)
    exact = load(tmp_path, text).simulate(num_samples=11)
    sampled = text.replace("[[tension]]", "[[tension.shapes]]")
    run = load(tmp_path, f"[tension]\nstep = {step}\n{sampled}").simulate(num_samples=11)
    np.testing.assert_allclose(run.q, exact.q, rtol=0, atol=1e-10)
    np.testing.assert_allclose(run.tension, exact.tension, rtol=0, atol=1e-12)


def test_a_cable_driven_by_length_without_shapes_keeps_its_length(tmp_path: Path) -> None:
    text = """\
t_end = 0.1
[robot]
name = "amouri2020"
[robot.each_section]
cable_stiffness = 5e3
[[tension]]
cable = 2
shape = "step"
value = 0.8
"""
    path = tmp_path / "pull.toml"
    path.write_text(text, encoding="utf-8")
    run = load_scenario(path).simulate()
    np.testing.assert_allclose(run.command, np.tile([0.802, 0.8, 0.802], (len(run), 1)))
    assert 1.0 < run.tension.max() < 20.0  # 2 mm short, 5 N/mm
