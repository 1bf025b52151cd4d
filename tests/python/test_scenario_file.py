"""Scenario files: what people may write, and the sentence for everything they may not."""

import dataclasses
import math
import re
from pathlib import Path

import numpy as np
import pytest

import cdcr
from cdcr import _core
from cdcr.runs.simulate import DEFAULT_METHOD
from cdcr.scenarios import Scenario
from cdcr.scenarios.file.reader import load_scenario
from cdcr.scenarios.file.schema import IntegratorTable, ScenarioTable
from cdcr.scenarios.file.start import read_start
from description import without_lines

FILE = """\
robot = "amouri2020"
t_end = 0.5
tension = [5, 0, 0]
"""
SECTION = "length = 0.8\nbackbone_mass = 0.03\nbackbone_diameter = 0.005\nyoungs_modulus = 9.5e9\n"


def load(folder: Path, text: str) -> Scenario:
    path = folder / "pull.toml"
    path.write_text(text, encoding="utf-8")
    return load_scenario(path)


def load_scenario_files(folder: Path, output: str) -> tuple[str, ...]:
    load(folder, FILE + output)
    return load_scenario(folder / "pull.toml").files


def refusal(folder: Path, text: str, where: str = "pull.toml") -> list[str]:
    """The sentences, without the place each must begin with."""
    with pytest.raises(ValueError, match=r"pull\.toml") as caught:
        load(folder, text)
    lines = without_lines(caught.value, folder / "pull.toml")
    start = f"{folder / where}: "
    assert all(line.startswith(start) for line in lines), lines
    return [line.removeprefix(start) for line in lines]


def without(key: str) -> str:
    return re.sub(rf"^{key} = .*\n", "", FILE, flags=re.MULTILINE)


def test_the_smallest_file(tmp_path: Path) -> None:
    scenario = load(tmp_path, 'robot = "amouri2020"\nt_end = 2\n')
    assert scenario.name == scenario.title == "pull"
    assert scenario.source == str(tmp_path / "pull.toml")
    assert scenario.robot == cdcr.robots.amouri2020()
    assert (scenario.q0, scenario.qd0) == ((0.0, 0.0), (0.0, 0.0))
    assert scenario.tension == (0.0, 0.0, 0.0)
    assert (scenario.t_end, scenario.num_samples, scenario.method) == (2.0, 1001, DEFAULT_METHOD)
    assert (scenario.rtol, scenario.atol, scenario.step, scenario.max_step) == (None,) * 4


def test_everything_a_file_may_say_is_kept(tmp_path: Path) -> None:
    text = """\
title = "A pull"
description = "Cable 2 pulls."
source = "imagined"
robot = "amouri2020"
formulation = "exact"
t_end = 0.5
tension = [0, 1.5, 0]
[output]
num_samples = 11
[integrator]
method = "dopri5"
rtol = 1e-6
atol = 1e-8
step = 0.01
max_step = 0.1
max_steps = 5000
[initial]
q = [0.1, -0.2]
qd = [1, 2]
"""
    scenario = load(tmp_path, text)
    kept = {item.name: getattr(scenario, item.name) for item in dataclasses.fields(scenario)}
    assert kept["title"] == "A pull"
    assert kept["description"] == "Cable 2 pulls."
    assert kept["source"] == "imagined"
    assert kept["formulation"] == "exact"
    assert (kept["t_end"], kept["num_samples"], kept["method"]) == (0.5, 11, "dopri5")
    assert [kept[name] for name in ("rtol", "atol", "step", "max_step")] == [1e-6, 1e-8, 0.01, 0.1]
    assert kept["max_steps"] == 5000
    assert kept["tension"] == (0.0, 1.5, 0.0)
    assert (kept["q0"], kept["qd0"]) == ((0.1, -0.2), (1.0, 2.0))


def test_a_file_runs_as_the_same_call_in_python(tmp_path: Path) -> None:
    scenario = load(tmp_path, FILE + "integrator.method = 'dopri5'\noutput.num_samples = 6\n")
    plain = cdcr.simulate(
        cdcr.Model(cdcr.robots.amouri2020()),
        [0.0, 0.0],
        [0.0, 0.0],
        t=np.linspace(0.0, 0.5, 6),
        tension=[5.0, 0.0, 0.0],
        method="dopri5",
    )
    np.testing.assert_array_equal(scenario.simulate().q, plain.q)


def test_robot_from_a_file_beside_the_scenario(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020(damping=1e-3)
    (tmp_path / "robots").mkdir()
    robot.save(tmp_path / "robots" / "soft.toml")
    scenario = load(tmp_path, FILE.replace("amouri2020", "robots/soft.toml"))
    assert scenario.robot == robot


def test_robot_in_the_file(tmp_path: Path) -> None:
    text = f"t_end = 1\n[robot]\npayload = 0.1\n[[robot.sections]]\n{SECTION}"
    scenario = load(tmp_path, text)
    assert scenario.robot == cdcr.Robot(
        sections=[
            cdcr.Section(
                length=0.8, backbone_mass=0.03, backbone_diameter=0.005, youngs_modulus=9.5e9
            )
        ],
        payload=0.1,
    )
    assert scenario.tension == ()


@pytest.mark.parametrize(
    ("initial", "q0"),
    [
        ("theta = [0.5]", (0.5, 0.0)),
        ("theta_deg = [90]", (math.pi / 2, 0.0)),
        ("theta = [2.0]\nphi = [0.5]", (2.0 * math.cos(0.5), 2.0 * math.sin(0.5))),
        ("theta_deg = [45]\nphi_deg = [90]", (0.0, math.pi / 4)),
        ("theta = [-0.5]\nphi_deg = [0]", (-0.5, 0.0)),
        ("phi = [1.0]", (0.0, 0.0)),
        ("q = [0.3, 0.4]", (0.3, 0.4)),
    ],
)
def test_initial_state(tmp_path: Path, initial: str, q0: tuple[float, float]) -> None:
    scenario = load(tmp_path, f"{FILE}[initial]\n{initial}\n")
    assert scenario.q0 == pytest.approx(q0, abs=1e-15)
    assert scenario.qd0 == (0.0, 0.0)


def test_methods_are_those_of_the_core() -> None:
    description = IntegratorTable.model_fields["method"].description or ""
    assert set(re.findall(r'"(\w+)"', description)) == set(_core.Method.__members__)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (
            FILE + "t_ned = 1\n",
            "t_ned is not a known key. Did you mean 't_end'? "
            f"Known keys: {', '.join(ScenarioTable.model_fields)}",
        ),
        (without("t_end"), "t_end is missing; it must be a number > 0 [s]"),
        (
            without("robot"),
            "robot is missing; it must be the name of a robot, "
            "the name of a robot file (.toml), a table with sections "
            "or a table with the name of a robot and what is different",
        ),
        (
            without("robot") + "robot = 3\n",
            "robot must be the name of a robot, the name of a robot file (.toml), a table with "
            "sections or a table with the name of a robot and what is different, got 3 (integer)",
        ),
        (
            FILE.replace("0.5", "0"),
            "t_end must be a number > 0 [s], got 0 (integer)",
        ),
        (
            FILE.replace("0.5", "inf"),
            "t_end must be a number > 0 [s], got inf (float)",
        ),
        (
            FILE + "output.num_samples = 1\n",
            "output.num_samples must be a whole number 2 to 10000000, got 1 (integer)",
        ),
        (
            FILE + "integrator.method = 'euler'\n",
            'integrator.method must be "auto", "bdf", "adams", "dopri5", "dop853", "rk4" or '
            '"rosenbrock", '
            "got 'euler' (string)",
        ),
        (
            FILE + "integrator.rtol = -1\n",
            "integrator.rtol must be a number > 0 [1], got -1 (integer)",
        ),
        (FILE + "rtol = 1e-6\n", "rtol must stand in [integrator]"),
        (
            FILE.replace("[5, 0, 0]", "5"),
            "tension must be an array with a number >= 0 [N] for each cable, "
            "or tables [[tension]] with cable and shape, or a table with t and rows, "
            "hold, shapes or file, got 5 (integer)",
        ),
        (
            FILE.replace("[5, 0, 0]", "[5, -1, 0]"),
            "tension must be an array with a number >= 0 [N] for each cable, "
            "or tables [[tension]] with cable and shape, or a table with t and rows, "
            "hold, shapes or file, got -1 (integer) at tension[1]",
        ),
        (
            FILE.replace("[5, 0, 0]", "[5]"),
            "tension must have 3 numbers, one for each cable, got [5] (array)",
        ),
        (
            FILE + "[initial]\ntheta = 1\n",
            "initial.theta must be an array with a number [rad] for each section, got 1 (integer)",
        ),
        (
            FILE + "[initial]\ntheta = [1, 2]\n",
            "initial.theta must have 1 number for a robot with 1 section, got [1, 2] (array)",
        ),
        (
            FILE + "[initial]\nqd = [1]\n",
            "initial.qd must have 2 numbers for a robot with 1 section, got [1] (array)",
        ),
        (
            FILE + "[initial]\ntheta_dge = [1]\n",
            "initial.theta_dge is not a known key. Did you mean 'theta_deg'? "
            "Known keys: q, theta, theta_deg, phi, phi_deg, qd, equilibrium, payload",
        ),
        (
            FILE + "[controller]\ntype = 'pid'\nkp = 1\n",
            "there must be only one of tension, trajectory and controller, "
            "got tension and controller",
        ),
        (
            FILE + "[output]\nfiles = ['png']\n",
            'output.files must be an array with one or more of "picture", "csv", "nc", "mcap", '
            "got 'png' (string) at output.files[0]",
        ),
        (
            FILE + "[output]\nfile = ['csv']\n",
            "output.file is not a known key. Did you mean 'files'? Known keys: num_samples, files",
        ),
        (
            FILE + "num_samples = 5\n[output]\nnum_samples = 6\n",
            "num_samples must stand in [output]",
        ),
        (
            FILE + "[initial]\ntheta = [1]\ntheta_deg = [1]\n",
            "initial must have theta or theta_deg, not both",
        ),
        (
            FILE + "[initial]\nphi = [1]\nphi_deg = [1]\n",
            "initial must have phi or phi_deg, not both",
        ),
        (
            FILE + "[initial]\nq = [1, 2]\nphi_deg = [1]\n",
            "initial must have q or phi_deg, not both",
        ),
    ],
)
def test_what_is_wrong_in_a_file(tmp_path: Path, text: str, sentence: str) -> None:
    assert refusal(tmp_path, text) == [sentence]


@pytest.mark.parametrize(
    ("text", "where", "sentence"),
    [
        (
            FILE.replace("amouri2020", "amouri"),
            "pull.toml, robot",
            "there is no robot 'amouri'. Did you mean 'amouri2020'? Known: "
            + ", ".join(cdcr.robots.names()),
        ),
        (
            f"t_end = 1\n[[robot.sections]]\n{SECTION.replace('0.8', '-0.8')}",
            "pull.toml, [robot]",
            "section 1: length must be > 0 m and finite, got -0.8",
        ),
    ],
)
def test_what_is_wrong_in_a_part_of_a_file(
    tmp_path: Path, text: str, where: str, sentence: str
) -> None:
    assert refusal(tmp_path, text, where) == [sentence]


@pytest.mark.parametrize("formulation", ["exact", "taylor", "printed", "printed-taylor"])
def test_formulations(tmp_path: Path, formulation: str) -> None:
    scenario = load(tmp_path, FILE + f'formulation = "{formulation}"\n')
    assert scenario.model.formulation == formulation


def test_what_is_written_by_default_and_when_told(tmp_path: Path) -> None:
    assert load_scenario_files(tmp_path, "") == (".png", ".csv", ".nc")
    output = '[output]\nnum_samples = 7\nfiles = ["nc", "picture"]\n'
    assert load_scenario_files(tmp_path, output) == (".png", ".nc")
    assert load(tmp_path, FILE + output).num_samples == 7


def test_a_formulation_must_be_known(tmp_path: Path) -> None:
    (sentence,) = refusal(tmp_path, FILE + "formulation = 'wrong'\n")
    assert sentence.startswith("formulation must be one of ")
    assert "'exact'" in sentence
    assert sentence.endswith("got 'wrong'")


@pytest.mark.parametrize(
    ("text", "what", "name"),
    [
        (FILE.replace("amouri2020", "no.toml"), "robot: there is no robot file", "no.toml"),
        (
            without("tension") + "[tension]\nfile = 'no.csv'\n",
            "tension.file: there is no tension file",
            "no.csv",
        ),
    ],
)
def test_missing_files_are_named(tmp_path: Path, text: str, what: str, name: str) -> None:
    sentence = rf"pull\.toml, line \d, {what} {re.escape(str(tmp_path / name))}$"
    with pytest.raises(FileNotFoundError, match=sentence):
        load(tmp_path, text)


def test_a_missing_scenario_file(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"^there is no scenario file .*pull\.toml$"):
        load_scenario(tmp_path / "pull.toml")


def test_two_sections_want_two_angles(tmp_path: Path) -> None:
    table = {"theta_deg": [90.0, 180.0], "phi_deg": [0.0, 90.0]}
    model = cdcr.Model(cdcr.robots.amouri2020().subdivide(2))
    q0, qd0 = read_start(table, model, None, tmp_path)
    assert q0 == pytest.approx((math.pi / 2, 0.0, 0.0, math.pi), abs=1e-15)
    assert qd0 == (0.0,) * 4
