"""What identification refuses, in a sentence that names file, row and column, or the path."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray
from cdcr.identification import Frequencies, Motion, Parameter, Poses, informative_commands
from measured import BY_LENGTH, ROBOT, pulls, tips

COMMANDS = pulls(4)
TIPS = tips(ROBOT, COMMANDS)
POSES = Poses(COMMANDS, tip=TIPS)
T = np.linspace(0.0, 0.3, 4)
MODULUS = "sections[*].youngs_modulus"


def changed(array: FloatArray, row: int, column: int, value: float) -> FloatArray:
    other: FloatArray = array.copy()
    other[row, column] = value
    return other


def refused(sentence: str) -> Any:
    return pytest.raises((ValueError, TypeError), match=f"^{re.escape(sentence)}")


NO_NUMBERS: dict[str, Any] = {
    "masked": np.ma.masked_array([1.0, 2.0, 3.0], mask=[True, False, False]),
    "durations": np.array([1, 2, 3], "m8[ms]"),
    "dates": np.array([1, 2, 3], "M8[s]"),
    "complex": np.array([1.0, 2.0, 3.0j]),
    "text": ["1", "2", "3"],
    "objects": np.array([1.0, 2.0, "3"], object),
    "truth": [True, False, True],
    "none": [None, 1.0, 2.0],
    "ragged": [[1.0], 2.0, 3.0],
}


@pytest.mark.parametrize("name", NO_NUMBERS)
def test_what_is_no_plain_number(name: str) -> None:
    bad, row = NO_NUMBERS[name], np.ones((1, 3))
    with refused("tip must be an array of numbers, got "):
        Poses(row, tip=[bad])
    with refused("command must be an array of numbers, got "):
        Poses([bad], tip=row)
    with refused("t must be an array of numbers, got "):
        Motion(bad, np.ones(3), q=np.ones((3, 2)))
    with refused("command must be an array of numbers, got "):
        Motion(T[:3], bad, q=np.ones((3, 2)))
    with refused("frequency must be an array of numbers, got "):
        Frequencies(bad, command=np.ones(3))
    with refused("candidates must be an array of numbers, got "):
        informative_commands(ROBOT, {MODULUS: None}, [bad], noise=0.1)
    if name != "truth":  # which counts as 0 and 1 where numbers are given, not measured
        motion = Motion(T, np.zeros(6), tip=TIPS, start=bad)
        with refused("motion: start must be None, 6 commands, or a pair (q0, qd0) of 4 numbers"):
            cdcr.identify(motion, ROBOT, {MODULUS: None})


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        ("sections[*].youngs_modulos", "there is no parameter 'sections[*].youngs_modulos'. Di"),
        ("base titl", "there is no parameter 'base titl'. Did you mean 'base tilt'?"),
        ("base tilt z", "parameter 'base tilt z': there is no axis z of base tilt"),
        ("sections[2].length", "parameter 'sections[2].length': [2] must be one of 0 to 1, * or :"),
        ("sections[0].num_disks", "parameter 'sections[0].num_disks': num_disks is no number that"),
        ("sections[0].cable_angles", "parameter 'sections[0].cable_angles': cable_angles has sev"),
        ("cables[0].radius", "parameter 'cables[0].radius': [0] must be one of none"),
        ("gravity", "parameter 'gravity': gravity has several numbers, pick one: gravity[0]"),
        ("marker offset", "parameter 'marker offset': the data have no markers"),
        (3, "a parameter must be named by a path, got 3"),
    ],
)  # fmt: skip
def test_paths_of_no_number(path: Any, sentence: str) -> None:
    with refused(sentence):
        cdcr.identify(POSES, ROBOT, {path: None})


def test_one_number_for_what_has_several() -> None:
    from dataclasses import replace

    robot = replace(ROBOT, sections=(replace(ROBOT.sections[0], length=0.2), ROBOT.sections[1]))
    with refused(
        "parameter 'sections[*].length' is one number for what has several: 0.1, 0.2; seek "
        "'sections[:].length', one each, or 'scale sections[*].length', a common factor"
    ):
        cdcr.identify(POSES, robot, {"sections[*].length": None})


@pytest.mark.parametrize(
    ("told", "sentence"),
    [
        ({"hiigh": 1.0}, f"parameter {MODULUS!r}: there is no key 'hiigh'. Did you mean 'high'?"),
        ("much", f"parameter {MODULUS!r}: start must be a finite number, got 'much' (str)"),
        ({"low": 70e9}, f"parameter {MODULUS!r}: start must be from 7e+10 to inf, got 6e+10"),
        ({"low": 2.0, "high": 1.0}, f"parameter {MODULUS!r}: low must be below high, got 2 and 1"),
        ({"prior": (1.0, 0.0)}, f"parameter {MODULUS!r}: prior must be a mean and a standard"),
    ],
)
def test_what_stands_beside_a_path(told: Any, sentence: str) -> None:
    with refused(sentence):
        cdcr.identify(POSES, ROBOT, {MODULUS: told})


def test_the_same_number_twice() -> None:
    with refused(f"parameters {MODULUS!r} and 'sections[0].youngs_modulus' seek the same number"):
        cdcr.identify(POSES, ROBOT, {MODULUS: None, "sections[0].youngs_modulus": None})


def test_fewer_data_than_parameters() -> None:
    one = Poses(COMMANDS[:1], tip=TIPS[:1])
    sought = dict.fromkeys([MODULUS, "base tilt", "base position"])
    with refused(
        "3 numbers measured cannot tell 6 parameters; measure more than in poses, or seek fewer"
    ):
        cdcr.identify(one, ROBOT, sought)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        (
            {"tip": changed(TIPS, 2, 1, np.nan)},
            "poses, row 3, tip y must be a finite number, got n",
        ),
        (
            {"tip": changed(TIPS, 2, 1, np.inf), "gaps": "skip"},
            "poses, row 3, tip y must be a fini",
        ),
        ({"tip": TIPS[:3]}, "tip must have shape (4, 3), got (3, 3)"),
        (
            {},
            "nothing was measured: give one of tip, tension, length, q, base_force, base_m",
        ),
        (
            {"tip": TIPS, "noise": 0.0},
            "noise of tip must be a number > 0 and finite, got 0.0 (floa",
        ),
        (
            {"tip": TIPS, "noise": {"top": 1.0}},
            "noise: there is no channel 'top'; measured are tip",
        ),
        ({"tip": TIPS, "gaps": "fill"}, "gaps must be 'refuse' or 'skip', got 'fill'"),
        ({"tip": TIPS + 1j}, "tip must be an array of numbers, got "),
        ({"markers": TIPS}, "markers must be a table from (section, fraction) to positions"),
    ],
)
def test_arrays_that_are_no_measurements(given: Any, sentence: str) -> None:
    with refused(sentence):
        Poses(COMMANDS, **given)


@pytest.mark.parametrize(
    ("poses", "robot", "sentence"),
    [
        (Poses(COMMANDS, tip=changed(TIPS, 1, 2, 480.0)), ROBOT,
         "poses, row 2, tip z = 480 m is 479.9"),
        (Poses(COMMANDS[:, :3], tip=TIPS), ROBOT, "poses: command must have shape (4, 6)"),
        (Poses(-COMMANDS, tip=TIPS), ROBOT, "poses, row 1, cable 2 must be >= 0"),
        (Poses(COMMANDS, tip=TIPS), BY_LENGTH, "poses, row 1, cable 1 is told 0 m"),
        (Poses(np.full((4, 6), 5.0), tip=TIPS, pulled=True), BY_LENGTH,
         "poses, row 1, cable 1 is pulled by 5 m, where the straight robot takes 0.1 m: is"),
        (Poses(COMMANDS[:1], tip=1e3 * TIPS[:1]), ROBOT, "poses, row 1, tip "),
        (Poses(COMMANDS, length=np.full((4, 6), 200.0)), ROBOT,
         "poses, row 1, length 1 = 200 m, where the straight robot takes 0.1 m: is it in mm?"),
        (Poses(COMMANDS, tension=1e3 * COMMANDS), ROBOT, "poses, row 1, tension "),
        (Poses(COMMANDS, q=np.full((4, 4), 40.0)), ROBOT,
         "poses, row 1, q 1 = 40 rad, and no section bends beyond 3 pi rad: is it in deg?"),
        (Poses(COMMANDS, markers={(2, 0.5): TIPS}), ROBOT, "a marker's place must be a sect"),
        (Poses(COMMANDS, q=TIPS), ROBOT, "q must have shape (4, 4), got (4, 3)"),
    ],
)  # fmt: skip
def test_measurements_of_another_robot_or_in_another_unit(
    poses: Poses, robot: cdcr.Robot, sentence: str
) -> None:
    with refused(sentence):
        cdcr.identify(poses, robot, {MODULUS: None})


def test_times_of_a_motion() -> None:
    with refused("motion, row 3, t must be later than the time before, got 0.1 s after 0.1 s"):
        Motion([0.0, 0.1, 0.1, 0.2], np.zeros(6), tip=TIPS)
    with refused("motion, row 4, t = 3e+06 s: the motion lasts 3e+06 s, where at most 10000 s"):
        Motion([0.0, 1e6, 2e6, 3e6], np.zeros(6), tip=TIPS)
    with refused("motion: a motion must have at least two times, got 1"):
        Motion([0.0], np.zeros(6), tip=TIPS[:1])
    with refused("motion: start must be None, 6 commands, or a pair (q0, qd0) of 4 numbers each"):
        cdcr.identify(Motion(T, np.zeros(6), tip=TIPS, start=[0.0]), ROBOT, {MODULUS: None})


def test_frequencies() -> None:
    with refused("nothing was measured: give frequency or damping_ratio"):
        Frequencies()
    with refused("frequencies, row 2, frequency must be > 0, got 0"):
        Frequencies([1.0, 0.0], command=np.zeros(6))
    with refused("frequencies, row 1, damping_ratio must be >= 0, got -0.1"):
        Frequencies(damping_ratio=[-0.1], command=np.zeros(6))
    with refused("mode must have 1 number, one each, got 2"):
        Frequencies([1.0], mode=[0, 1], command=np.zeros(6))
    with refused("frequencies: mode[0] asks for vibration 10, and the robot has 4"):
        cdcr.identify(Frequencies([1.0], mode=[9], command=np.zeros(6)), ROBOT, {MODULUS: None})


def test_a_start_without_an_answer_names_the_pose() -> None:
    strong = Poses(COMMANDS * [[1.0], [1.0], [1e4], [1.0]], tip=TIPS)
    with refused("the model has no answer at the start: poses, row 3, equilibrium: "):
        cdcr.identify(strong, ROBOT, {MODULUS: None})


def test_arguments_of_other_kinds() -> None:
    with refused("data[0] must be Poses, a Motion or Frequencies, got list"):
        cdcr.identify([[1.0]], ROBOT, {MODULUS: None})  # type: ignore[list-item]
    with refused("data must hold at least one measurement, got none"):
        cdcr.identify([], ROBOT, {MODULUS: None})
    with refused("parameters must name at least one number to seek, got none"):
        cdcr.identify(POSES, ROBOT, {})
    with refused("parameters must be a table of paths, got ["):
        cdcr.identify(POSES, ROBOT, [MODULUS])  # type: ignore[arg-type]
    with refused("loss must be one of linear, soft_l1, huber, cauchy, got 'l1'"):
        cdcr.identify(POSES, ROBOT, {MODULUS: None}, loss="l1")
    with refused("starts must be a whole number >= 1, got 0 (int)"):
        cdcr.identify(POSES, ROBOT, {MODULUS: None}, starts=0)
    found = cdcr.identify(POSES, ROBOT, {MODULUS: None})
    with refused("folds must be a whole number from 2 to 4, got 9 (int)"):
        found.cross_validate(9)
    with pytest.raises(KeyError, match="was not sought; these were"):
        found["payload"]
    with refused("noise must be a number > 0 and finite, got -1 (int)"):
        informative_commands(ROBOT, {MODULUS: None}, COMMANDS, noise=-1)
    with refused("low must be a finite number, got nan (float)"):
        Parameter(low=np.nan)


HEADER = ",".join(
    [*(f"cable {j + 1} [N]" for j in range(6)), "tip x [mm]", "tip y [mm]", "tip z [mm]"]
)


def written(path: Path, *, header: str = HEADER, line: int = 0, cell: str = "") -> Path:
    rows = np.hstack([COMMANDS, 1e3 * TIPS]).tolist()
    lines = [header, *(",".join(map(repr, row)) for row in rows)]
    if line:
        cells = lines[line].split(",")
        cells[-1] = cell
        lines[line] = ",".join(cells)
    path.write_text("\n".join(lines) + "\n")
    return path


def test_files_of_measurements(tmp_path: Path) -> None:
    good = written(tmp_path / "pulls.csv")
    assert len(Poses.load(good, ROBOT)) == 4
    file = tmp_path / "bad.csv"
    for line, cell, sentence in (
        (2, "", f"{file}, line 3: tip z [mm] must be a number, got nothing; gaps = 'skip' leaves"),
        (4, "x", f"{file}, line 5: tip z [mm] must be a number, got 'x'"),
        (3, "1e6", f"{file}, line 4: tip z [mm] = 1000 m is 999"),
    ):
        written(file, line=line, cell=cell)
        with refused(sentence):
            cdcr.identify(Poses.load(file, ROBOT), ROBOT, {MODULUS: None})
    for old, new, sentence in (
        ("tip x [mm]", "top x [mm]", "there must be a column 'tip x [m]', and the columns are"),
        ("tip x [mm]", "tip x", "column 'tip x' must have its unit, as in 'tip x [m]'"),
        ("tip x [mm]", "tip x [inch]", "the unit of column 'tip x [inch]' must be one of m, mm, c"),
        ("tip x [mm]", "tip x [N]", "column 'tip x [N]' must be in m, got N"),
        ("tip x [mm]", "tip y [mm]", "column 'tip y [mm]' is there twice"),
        (",", ";", "columns must be separated by commas, not semicolons"),
        ("cable 2 [N]", "rope 2 [N]", "there must be a column 'cable 2 [N]', and the columns are"),
    ):
        written(file, header=HEADER.replace(old, new))
        with refused(f"{file}, line 1: {sentence}"):
            Poses.load(file, ROBOT)
    written(file, header=HEADER + ",warmth [m]")
    with refused(f"{file}, line 2: must have 10 columns, got 9"):
        Poses.load(file, ROBOT)
    file.write_text("root:*:20228:0\ndaemon:*:20228:0\n")  # of somebody who may not read it
    with refused(f"{file}, line 1: the columns must have units, as in 'tip x [m]', and none has"):
        Poses.load(file, ROBOT)
    lines = good.read_text().splitlines()
    file.write_text("\n".join([f"{lines[0]},tipp x [m]", *(f"{row},0" for row in lines[1:])]))
    with refused(f"{file}, line 1: there is no channel 'tipp x [m]'. Did you mean 'tip x'?"):
        Poses.load(file, ROBOT)
    file.write_text(file.read_text().replace("tipp x", "marker 1 x"))
    with refused(f"{file}, line 1: column 'marker 1 x [m]' is of a marker whose place 'markers'"):
        Poses.load(file, ROBOT)
    with refused(f"{good}, line 1: there is no column 'x' for 'tip x [m]'."):
        Poses.load(good, ROBOT, columns={"tip x [m]": "x"})
    with pytest.raises(FileNotFoundError, match="there is no file of measurements"):
        Poses.load(tmp_path / "none.csv", ROBOT)
    with refused(f"{good}, line 1: there must be a column 't [s]'"):
        Motion.load(good, ROBOT)


def test_commands_are_in_the_unit_of_the_drive(tmp_path: Path) -> None:
    """A pull of 5 mm is no tension of 5 mN, nor is a tension a length."""
    file = tmp_path / "poses.csv"
    for robot, column, unit, wanted in (
        (ROBOT, "cable", "mm", "N"),
        (ROBOT, "pull", "mm", "N"),
        (ROBOT, "command", "m", "N"),
        (BY_LENGTH, "cable", "mN", "m"),
        (BY_LENGTH, "command", "N", "m"),
    ):
        names = [f"{column} {j + 1} [{unit}]" for j in range(robot.num_cables)]
        names += [f"tip {axis} [m]" for axis in "xyz"]
        file.write_text("\n".join([",".join(names), ",".join(["0.1"] * len(names))]))
        with refused(f"{file}, line 1: column '{names[0]}' must be in {wanted}, got "):
            Poses.load(file, robot)
    with refused("columns must be a mapping such as {'tip x [mm]': 'X'}, got 5 (int)"):
        Poses.load(file, ROBOT, columns=5)
