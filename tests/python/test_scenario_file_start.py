"""Known robots with changes, starts at rest, shapes held, and motions by cable lengths in files."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.scenarios.file.reader import load_scenario
from description import without_lines

ROUNDING = 1e-11  # solves of 6 x 6 systems whose inertias span three powers of ten
SMOOTH = 1e-8  # tolerances of the runs, amplified
ROBOT = """\
t_end = 1
[robot]
name = "three_sections"
gravity = [0, 0, -9.81]
[robot.each_section]
damping = 0.01
"""
DRIVEN = ROBOT + "cable_stiffness = 2e4\n"


def load(folder: Path, text: str) -> cdcr.scenarios.Scenario:
    path = folder / "my.toml"
    path.write_text(text, encoding="utf-8")
    return load_scenario(path)


def refusal(folder: Path, text: str) -> str:
    with pytest.raises(ValueError, match=r"my\.toml") as caught:
        load(folder, text)
    path = folder / "my.toml"
    return "\n".join(without_lines(caught.value, path)).removeprefix(str(path))


# [robot] with a name


def test_a_known_robot_with_changes(tmp_path: Path) -> None:
    robot = load(tmp_path, ROBOT).robot
    assert robot == cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), damping=0.01)
    angles = load(tmp_path, ROBOT + "cable_angles_deg = [0, 90]\n").robot.sections[2].cable_angles
    assert angles == (0.0, np.deg2rad(90.0))


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (ROBOT.replace("three", "thee"), ": there is no robot 'thee_sections'. Did you mean "),
        (
            ROBOT.replace("gravity", "gravty"),
            ": gravty is not a known key. Did you mean 'gravity'?",
        ),
        (ROBOT.replace("damping", "damp"), ": each_section.damp is not a known key. Did you "),
        (ROBOT.replace("0.01", "'a'"), ": each_section.damping must be a number >= 0 "),
        (ROBOT.replace("0.01", "-1"), ", each_section: damping must be >= 0 "),
        (
            ROBOT + "cable_angles = [0]\ncable_angles_deg = [0]\n",
            ": each_section must have cable_angles or cable_angles_deg, not both",
        ),
        (ROBOT + "[[robot.cables]]\nradius = 0.1\n", ": cables is not a known key"),
    ],
)
def test_what_is_wrong_in_the_changes(tmp_path: Path, text: str, sentence: str) -> None:
    assert refusal(tmp_path, text).startswith(f", [robot]{sentence}")


# [initial] with equilibrium


@pytest.mark.parametrize(
    "tension",
    [
        "tension = [1, 0, 0, 0, 2, 0, 0, 0, 0]\n",
        "tension = { t = [-1, 1], rows = [[0, 0, 0, 0, 0, 0, 0, 0, 0], "
        "[2, 0, 0, 0, 4, 0, 0, 0, 0]] }\n",
        "tension = { t = [-1, 1], interpolation = 'previous', rows = "
        "[[1, 0, 0, 0, 2, 0, 0, 0, 0], [9, 0, 0, 0, 9, 0, 0, 0, 0]] }\n",
        "tension = [{ cable = 1, shape = 'step', value = 1 }, "
        "{ cable = 5, shape = 'step', value = 2 }]\n",
        "tension = { step = 0.5, shapes = [{ cable = 1, shape = 'step', value = 1 }, "
        "{ cable = 5, shape = 'step', value = 2 }] }\n",
    ],
)
def test_a_start_at_rest_under_the_first_tensions(tmp_path: Path, tension: str) -> None:
    text = tension + ROBOT + "[initial]\nequilibrium = true\n"
    scenario = load(tmp_path, text)
    q0 = scenario.start(scenario.model)
    expected = scenario.model.equilibrium([1, 0, 0, 0, 2, 0, 0, 0, 0])
    np.testing.assert_allclose(q0, expected, atol=ROUNDING)


def test_a_payload_falls_off_at_the_start(tmp_path: Path) -> None:
    scenario = load(tmp_path, ROBOT + "[initial]\nequilibrium = true\npayload = 0.1\n")
    heavy = cdcr.Model(replace(scenario.robot, payload=0.1))
    q0 = scenario.start(scenario.model)
    np.testing.assert_allclose(q0, heavy.equilibrium(np.zeros(9)), atol=ROUNDING)
    np.testing.assert_array_equal(scenario.simulate(t_end=0.1).q[0], q0)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("payload = 0.1\n", "initial.payload needs equilibrium = true: it is held until then"),
        (
            "equilibrium = true\n[controller]\ntype = 'pid'\nkp = 1\n",
            "initial.equilibrium needs tensions or a trajectory, not a controller",
        ),
    ],
)
def test_what_is_wrong_with_a_start(tmp_path: Path, text: str, sentence: str) -> None:
    assert refusal(tmp_path, f"{ROBOT}[initial]\n{text}") == f": {sentence}"


# [tension.hold]


def test_shapes_are_held(tmp_path: Path) -> None:
    hold = "[tension]\nt = [0, 1]\n[tension.hold]\ntheta_deg = [[0, 0, 0], [30, 0, 20]]\n"
    scenario = load(tmp_path, f"{ROBOT}{hold}phi_deg = [[0, 0, 0], [0, 0, 90]]\npayload = 0.01\n")
    tension: Any = scenario.tension
    table = tension(scenario.model, 1.0)
    heavy = cdcr.Model(replace(scenario.robot, payload=0.01))
    shape = np.ravel(cdcr.bending(np.deg2rad([30.0, 0.0, 20.0]), np.deg2rad([0.0, 0.0, 90.0])))
    moving = heavy.forward_dynamics(shape, np.zeros(6), table.tension[1])
    np.testing.assert_allclose(moving, 0.0, atol=SMOOTH)
    assert np.all(table.tension >= 0.0)


def test_a_shape_is_held_by_cables_driven_by_length(tmp_path: Path) -> None:
    hold = "[tension.hold]\nq = [0.3, 0, 0.1, 0.2, 0, 0]\n[initial]\nequilibrium = true\n"
    scenario = load(tmp_path, DRIVEN + hold)
    q0 = scenario.start(scenario.model)
    np.testing.assert_allclose(q0, [0.3, 0.0, 0.1, 0.2, 0.0, 0.0], atol=SMOOTH)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (
            "[tension.hold]\nq = [[0, 0, 0, 0, 0, 0]]\n",
            ".q must have 6 numbers for a robot with 3 sections, got [[",
        ),
        ("[tension]\nt=[0]\nhold.q = [0]\n", ".q must have a row for each time, 1, got "),
        ("[tension.hold]\ntheta = [0, 0]\n", ".theta must have 3 numbers for a robot with "),
        ("[tension]\nt=[0, 1]\nhold.phi = [[0, 0, 0]]\n", ".phi must have a row for each time, 2"),
        ("[tension.hold]\nq = [0, 0]\ntheta = [1]\n", " must have q or theta, not both"),
        ("[tension]\nhold.payload = -1\n", ".payload must be a number >= 0 [kg], got -1"),
    ],
)
def test_what_is_wrong_in_a_hold(tmp_path: Path, text: str, sentence: str) -> None:
    assert refusal(tmp_path, ROBOT + text).startswith(f": tension.hold{sentence}")


def test_what_cannot_be_held_is_refused(tmp_path: Path) -> None:
    pulled = ROBOT + "cable_angles = [0.0]\n[tension.hold]\ntheta = [0.3, 0, 0]\nphi = [2, 0, 0]\n"
    assert refusal(tmp_path, pulled).startswith(", tension.hold: force ")


# [tension.shapes], sampled


def test_sampled_shapes_are_rows_of_a_table(tmp_path: Path) -> None:
    wave = "cable = 2\nshape = 'sine'\nmean = 2\namplitude = 1\nfrequency = 0.5\n"
    exact = load(tmp_path, f"{ROBOT}[[tension]]\n{wave}").input_source
    sampled: Any = load(tmp_path, f"{ROBOT}[tension]\nstep = 0.3\n[[tension.shapes]]\n{wave}")
    table = sampled.tension(sampled.model, 1.0)
    assert table.t.tolist() == pytest.approx([0.0, 1 / 3, 2 / 3, 1.0])
    np.testing.assert_array_equal(table.tension, exact(table.t))  # type: ignore[operator,misc]
    assert refusal(tmp_path, f"{ROBOT}[[tension.shapes]]\n{wave}") == (
        ": tension.step is missing; it must be a number > 0 [s]"
    )
    wrong = f"{ROBOT}[tension]\nstep = 1\n[[tension.shapes]]\n{wave.replace('2', '12', 1)}"
    assert refusal(tmp_path, wrong) == (
        ": tension.shapes[0].cable must be the number of a cable, 1 to 9, got 12"
    )


# [trajectory] by lengths

MOVE = "[trajectory]\nshape = 'move'\ntheta_deg = [20, 0, 0]\nduration = 0.3\n"


@pytest.mark.parametrize("step", ["", "step = 0.01\n"])
def test_a_motion_by_lengths(tmp_path: Path, step: str) -> None:
    text = f"{DRIVEN}{MOVE}back = 0.5\nsimulate = true\nshorter = 1e-4\n{step}"
    scenario = load(tmp_path, text + "[initial]\nequilibrium = true\n")
    model, motion = scenario.model, scenario.input_source
    run = scenario.simulate(num_samples=101)
    asked = motion.motion(run.t)[0]  # type: ignore[union-attr]
    np.testing.assert_allclose(run.command, model.cable_lengths(asked) - 1e-4, atol=1e-6)
    assert np.all(asked[[0, -1]] == 0.0)  # there and back
    np.testing.assert_allclose(asked[40, 0], np.deg2rad(20.0), atol=ROUNDING)
    np.testing.assert_array_equal(run.q[0], scenario.start(model))
    keys = {metric.key for metric in scenario.summary(run)}
    assert "tip_error_m" in keys
    assert "tension_1_max_N" not in keys


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (DRIVEN + MOVE, " of a robot driven by length needs simulate = true"),
        (
            f"{DRIVEN}{MOVE}simulate = true\nmin_tension = 1\n",
            ".min_tension needs cables driven by tension; this robot's are driven by length",
        ),
        (
            f"{ROBOT}{MOVE}shorter = 1e-4\n",
            ".shorter needs a robot whose cables are all driven by length",
        ),
        (
            f"{ROBOT}{MOVE}back = 0.2\n",
            ".back must be 0.3 s, the end of the move, or more, got 0.2",
        ),
    ],
)
def test_what_is_wrong_with_a_motion_by_lengths(tmp_path: Path, text: str, sentence: str) -> None:
    assert refusal(tmp_path, text) == f": trajectory{sentence}"
