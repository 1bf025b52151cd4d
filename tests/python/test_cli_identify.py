"""`cdcr identify`: files in, estimates out, files that appear whole, and its refusals."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import cdcr
from cdcr.files.toml import read_toml

pytest.importorskip("typer")

from command import cdcr_, everything_in, refused
from measured import ROBOT, pulls, tips

TASK = """\
robot = "arm.toml"
folds = 4

[parameters]
"sections[*].youngs_modulus" = {low = 40e9, high = 90e9}
"sections[2].disk_mass" = {}

[[poses]]
file = "pulls.csv"
noise = 1e-3
[poses.columns]
"cable 1 [N]" = "f1"
"cable 2 [N]" = "f2"
"cable 3 [N]" = "f3"
"cable 4 [N]" = "f4"
"cable 5 [N]" = "f5"
"cable 6 [N]" = "f6"
"tip x [mm]" = "x"
"tip y [mm]" = "y"
"tip z [mm]" = "z"

[[motions]]
file = "swing.csv"
start = [2.0, 0, 0, 0, 0, 0]
method = "dopri5"
noise = {tip = 1e-3}

[[frequencies]]
frequency = [FIRST]
mode = [1]
command = [0, 0, 0, 0, 0, 0]
noise = 0.05
"""


def laboratory(folder: Path) -> Path:
    """Write a robot, measurements of one with other values, and what is sought; return that."""
    ROBOT.save(folder / "arm.toml")
    first, second = (replace(one, youngs_modulus=66e9) for one in ROBOT.sections)
    true = replace(ROBOT, sections=(first, replace(second, disk_mass=0.003)))
    commands = pulls(12)
    table = np.hstack([commands, 1e3 * tips(true, commands, 1e-3, 4), np.zeros((12, 1))])
    header = "f1,f2,f3,f4,f5,f6,x,y,z,temperature"
    np.savetxt(folder / "pulls.csv", table, delimiter=",", header=header, comments="")
    model = cdcr.Model(true)
    q0 = model.equilibrium([2.0, 0, 0, 0, 0, 0])
    t = np.linspace(0.0, 0.5, 51)
    cdcr.simulate(model, q0, np.zeros(4), t=t, method="dopri5").save(folder / "swing.csv")
    hz = model.modes(np.zeros(4), np.zeros(6)).frequency_hz[0]
    file = folder / "task.toml"
    file.write_text(TASK.replace("FIRST", repr(float(hz))))
    return file


def test_what_is_printed_and_written(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    task, out = laboratory(tmp_path), tmp_path / "out"
    result = cdcr_("identify", task, "--out", out)
    assert result.exit_code == 0, result.output
    words = result.stdout
    assert "all sections: youngs_modulus" in words
    assert "section 2: disk_mass" in words  # sections count from 1 in files and tables
    assert "pulls.csv: tip: RMS" in words
    assert everything_in(out) == ["identified.png", "identified.toml", "robot.toml"]
    table = read_toml(out / "identified.toml", "result")
    modulus, mass = table["parameters"]
    assert abs(modulus["value"] - 66e9) < 4.5 * modulus["standard_error"] < 5e9
    assert abs(mass["value"] - 0.003) < 4.5 * mass["standard_error"] < 2e-3
    assert table["provenance"]["cdcr"] == cdcr.__version__
    assert [one["name"] for one in table["data"]] == ["pulls.csv", "swing.csv", "frequencies"]
    assert len(table["data"][0]["sha256"]) == 64
    robot = cdcr.Robot.load(out / "robot.toml")
    assert robot.sections[0].youngs_modulus == modulus["value"]
    assert robot.sections[1].disk_mass == mass["value"]
    assert robot.sections[0].disk_mass == ROBOT.sections[0].disk_mass
    assert len(table["robot"]["sections"]) == 2
    assert "--overwrite" in refused_with_output("identify", task, "--out", out)


def refused_with_output(*args: object) -> str:
    result = cdcr_(*args)
    assert result.exit_code == 2, result.output
    return result.stderr


def test_json(tmp_path: Path) -> None:
    result = cdcr_("identify", laboratory(tmp_path), "--json")
    assert result.exit_code == 0, result.output
    table = json.loads(result.stdout)
    assert table["estimates"][0]["path"] == "sections[*].youngs_modulus"
    assert table["not_told"] == []
    assert set(table["held_out"]) == {"pulls.csv: tip", "swing.csv: tip", "frequencies: frequency"}


WAY = """\
robot = "arm.toml"
parameters = {"sections[*].cable_entry_friction" = {start = 0.1}}

[[poses]]
file = "way.csv"
noise = 1e-3
history = true
"""


def test_poses_with_a_history_tell_friction(tmp_path: Path) -> None:
    """Cables pulled and let go again, on a robot that does not come back the same way."""
    ROBOT.save(tmp_path / "arm.toml")
    rubs = tuple(replace(one, cable_entry_friction=0.3) for one in ROBOT.sections)
    pull = np.concatenate([np.linspace(0.0, 3.0, 8), np.linspace(3.0, 0.0, 8)])
    commands = np.zeros((32, 6))
    commands[:16, 0], commands[16:, 4] = pull, pull
    run = cdcr.quasi_static(cdcr.Model(replace(ROBOT, sections=rubs)), commands)
    tip = run.tip + np.random.default_rng(5).normal(0.0, 1e-3, run.tip.shape)
    names = [*(f"cable {j} [N]" for j in range(1, 7)), *(f"tip {axis} [m]" for axis in "xyz")]
    table = np.hstack([commands, tip])
    np.savetxt(tmp_path / "way.csv", table, delimiter=",", header=",".join(names), comments="")
    file = tmp_path / "way.toml"
    file.write_text(WAY)
    found = json.loads(cdcr_("identify", file, "--json").stdout)
    (friction,) = found["estimates"]
    assert abs(friction["value"] - 0.3) < 4.5 * friction["standard_error"] < 0.1
    assert found["misfit"] < 2.0
    file.write_text(WAY.replace("history = true", "history = 1"))
    wanted = "line 7: poses[0].history must be true or false, got 1 (integer)"
    assert wanted in refused(cdcr_("identify", file))


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ('robot = "arm.toml"', 'robot = "leg.toml"', ", robot: there is no robot file"),
        ("folds = 4", "folds = 1", ", line 2: folds must be a whole number > 1, got 1 (integer)"),
        ("folds = 4", "fold = 4", ", line 2: fold is not a known key. Did you mean 'folds'?"),
        (
            "sections[2]",
            "sections[3]",
            "task.toml: parameter 'sections[3].disk_mass': [3] must be one of 1 to 2, * or :",
        ),
        (
            "noise = 1e-3\n",
            "noise = 1e-3\nmarkers = [[1.5, 0.5]]\n",
            "poses[0]: markers must be an array of pairs, a section from 1 to 2 and a fraction fr",
        ),
        (
            "noise = 1e-3\n",
            "noise = 1e-3\nmarkers = [[1]]\n",
            "poses[0]: markers must be an array of pairs, a section from 1 to 2 and a fraction fr",
        ),
        ("mode = [1]", "mode = [9]", "mode[0] asks for vibration 9, and the robot has 4"),
        ('file = "pulls.csv"', 'file = "pull.csv"', "poses[0]: there is no file of measurements"),
        ('"tip x [mm]" = "x"', '"tip x [mm]" = "u"', "pulls.csv, line 1: there is no column 'u'"),
        ("mode = [1]", "mode = [0]", "mode must be an array of whole numbers > 0"),
        ("start = [2.0, 0, 0,", "start = [2.0, 0,", "start must be None, 6 commands"),
    ],
)
def test_refusals(tmp_path: Path, old: str, new: str, sentence: str) -> None:
    task = laboratory(tmp_path)
    text = task.read_text()
    assert old in text
    task.write_text(text.replace(old, new))
    assert sentence in refused(cdcr_("identify", task))
