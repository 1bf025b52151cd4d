"""Scenario files with wrenches, and with robots of several sections."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import cdcr

pytest.importorskip("typer")
pytest.importorskip("matplotlib")
pytest.importorskip("h5netcdf")

from typer.testing import CliRunner

from cdcr.cli.app import app
from cdcr.scenarios.file.reader import load_scenario
from description import without_lines

BASE = 'robot = "three_sections"\nt_end = 0.4\noutput.num_samples = 41\n'
WRENCH = "[[wrenches]]\nsection = 2\n"
SETTLED = 1e-3  # of a run with strong damping, at its end [rad]


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "push.toml"
    path.write_text(text, encoding="utf-8")
    return path


def refusal(tmp_path: Path, text: str) -> list[str]:
    path = written(tmp_path, text)
    with pytest.raises(ValueError, match=r"^") as caught:
        load_scenario(path)
    lines = without_lines(caught.value, path)
    return [line.removeprefix(str(path)).lstrip(":, ") for line in lines]


def test_a_table_is_the_wrench_that_python_would_make(tmp_path: Path) -> None:
    table = """fraction = 0.5
force = [0.0, 0.3, 0]
moment = [0, 0.01, 0.0]
frame = "local"
times = [0.0, 0.1, 0.2]
factors = [0.0, 1.0, 0.5]
interpolation = "previous"
"""
    scenario = load_scenario(written(tmp_path, BASE + WRENCH + table))
    pushed = cdcr.Wrench(
        section=1,
        fraction=0.5,
        force=(0.0, 0.3, 0.0),
        moment=(0.0, 0.01, 0.0),
        frame="local",
        profile=([0.0, 0.1, 0.2], [0.0, 1.0, 0.5]),
        interpolation="previous",
    )
    run = scenario.simulate()
    still = np.zeros(6)
    expected = cdcr.simulate(scenario.model, still, still, t=run.t, wrenches=pushed)
    np.testing.assert_array_equal(run.q, expected.q)
    assert np.all(run.q[run.t <= 0.1] == 0.0)  # the first factor holds
    assert np.max(np.abs(run.q)) > 0.01


@pytest.mark.parametrize(
    "drive",
    [
        "",
        "tension = [0, 0, 0, 2, 0, 0, 0, 0, 0]\n",
        '[[tension]]\ncable = 1\nshape = "step"\nvalue = 2.0\nat = 0.1\n',
        f"[tension]\nt = [0, 1]\nrows = [{9 * [0.0]}, {9 * [1.0]}]\n",
        '[controller]\ntype = "pid"\nkp = 0.1\nkd = 0.01\n',
        '[trajectory]\nshape = "line"\ntheta_rate_deg = 10.0\nsimulate = true\n',
    ],
)
def test_wrenches_act_beside_whatever_moves_the_robot(tmp_path: Path, drive: str) -> None:
    force = WRENCH + "force = [0.2, 0.0, 0.0]\n"
    without = load_scenario(written(tmp_path, BASE + drive)).simulate()
    pushed = load_scenario(written(tmp_path, BASE + drive + force)).simulate()
    assert pushed.success
    assert np.max(np.abs(pushed.q - without.q)) > 1e-3


def test_a_pushed_robot_comes_to_the_rest_that_statics_tells(tmp_path: Path) -> None:
    robot = cdcr.robots.three_sections(damping=0.03)
    robot.save(tmp_path / "robot.toml")
    text = 'robot = "robot.toml"\nt_end = 20.0\noutput.num_samples = 201\n'
    force = "force = [0.05, 0.02, 0.0]\n"
    scenario = load_scenario(written(tmp_path, text + WRENCH + force))
    run = scenario.simulate()
    pushed = cdcr.Wrench(section=1, force=(0.05, 0.02, 0.0))
    rest = scenario.model.equilibrium(np.zeros(9), wrenches=pushed)
    assert np.max(np.abs(rest)) > 0.05
    np.testing.assert_allclose(run.q[-1], rest, atol=SETTLED)


def test_several_wrenches_add_up(tmp_path: Path) -> None:
    half = WRENCH + "force = [0.1, 0.0, 0.0]\n"
    whole = WRENCH + "force = [0.2, 0.0, 0.0]\n"
    two = load_scenario(written(tmp_path, BASE + half + half))
    one = load_scenario(written(tmp_path, BASE + whole))
    assert (len(two.wrenches), len(one.wrenches)) == (2, 1)
    np.testing.assert_allclose(two.simulate().q, one.simulate().q, atol=1e-10)


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        (
            "section = 4\nforce = [1, 0, 0]",
            "section must be the number of a section, 1 to 3, got 4",
        ),
        (
            "section = 0\nforce = [1, 0, 0]",
            "section must be the number of a section, from 1, got 0 (integer)",
        ),
        ("force = [1, 0, 0]", "section is missing; it must be the number of a section, from 1"),
        (
            "section = 1\nfraction = 1.5\nforce = [1, 0, 0]",
            "fraction must be a fraction of the section's length, 0 to 1, got 1.5 (float)",
        ),
        ("section = 1\nforce = [1, 0]", "force must be three numbers [N], got [1, 0] (array)"),
        (
            "section = 1\nmoment = [0, 0, nan]",
            "moment must be three numbers [N m], got nan (float) at wrenches[0].moment[2]",
        ),
        (
            'section = 1\nforce = [1, 0, 0]\nframe = "world"',
            'frame must be "base" or "local", got \'world\' (string)',
        ),
        ("section = 1", " must have force, moment or both"),
        (
            "section = 1\nforce = [1, 0, 0]\ntimes = [0, 1]",
            " must have both times and factors, or neither",
        ),
        (
            "section = 1\nforce = [1, 0, 0]\ntimes = [0, 1]\nfactors = [1]",
            "factors must have 2 numbers as times has, got 1",
        ),
        (
            'section = 1\nforce = [1, 0, 0]\ninterpolation = "previous"',
            "interpolation goes with times and factors, which are missing",
        ),
    ],
)
def test_what_is_wrong_is_told(tmp_path: Path, table: str, sentence: str) -> None:
    at = f"wrenches[0]{'' if sentence.startswith(' ') else '.'}"
    assert refusal(tmp_path, f"{BASE}[[wrenches]]\n{table}\n") == [f"{at}{sentence}"]


def test_an_unknown_key_and_times_out_of_order(tmp_path: Path) -> None:
    table = f"{BASE}{WRENCH}forces = [1, 0, 0]\n"
    (told,) = refusal(tmp_path, table)
    assert told.startswith("wrenches[0].forces is not a known key. Did you mean 'force'?")
    (told,) = refusal(
        tmp_path, f"{BASE}{WRENCH}force = [1, 0, 0]\ntimes = [1, 0]\nfactors = [1, 1]\n"
    )
    assert told.startswith("wrenches[0]: ")
    assert "strictly increasing" in told


def test_nothing_to_push_along_a_trajectory_that_is_not_simulated(tmp_path: Path) -> None:
    text = f'{BASE}[trajectory]\nshape = "line"\ntheta_rate_deg = 10.0\n{WRENCH}force = [1, 0, 0]\n'
    assert refusal(tmp_path, text) == [
        "wrenches need simulate = true in [trajectory]; without it nothing is simulated"
    ]


def test_the_command_line_runs_a_file_with_several_sections(tmp_path: Path) -> None:
    turned = ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0))
    robot = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81))
    replace(robot, base_orientation=turned).save(tmp_path / "arm.toml")
    text = BASE.replace("three_sections", "arm.toml")
    text += "[initial]\ntheta_deg = [30, 20, 10]\nphi_deg = [0, 90, 0]\n"
    path = written(tmp_path, text + WRENCH + "force = [0.0, 0.0, 0.5]\n")
    result = CliRunner().invoke(app, ["run", str(path), "--out", str(tmp_path / "out"), "--json"])
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert told["success"]
    assert {f"section_{k}_theta_max_deg" for k in (1, 2, 3)} <= set(told["findings"])
    assert [Path(name).suffix for name in told["files"]] == [".png", ".csv", ".nc"]


def test_cables_driven_by_length_stay_as_they_are_without_a_command(tmp_path: Path) -> None:
    (section,) = cdcr.robots.amouri2020(damping=1e-3).sections
    robot = cdcr.Robot(sections=[replace(section, cable_stiffness=1e4)])
    robot.save(tmp_path / "robot.toml")
    text = 'robot = "robot.toml"\nt_end = 0.1\noutput.num_samples = 11\n'
    scenario = load_scenario(written(tmp_path, text))
    np.testing.assert_array_equal(scenario.tension, [section.length] * 3)
    run = scenario.simulate()
    assert np.all(run.q == 0.0)
    assert np.all(run.tension == 0.0)
