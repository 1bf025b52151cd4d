"""Arguments of identification that are of another kind, or of another robot: a sentence each."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.identification import Frequencies, Motion, Poses, informative_commands
from cdcr.identification.paths import quantities_of
from cdcr.identification.setup import plain_setup
from measured import BY_LENGTH, ROBOT, pulls, tips

COMMANDS = pulls(4)
TIPS = tips(ROBOT, COMMANDS)
POSES = Poses(COMMANDS, tip=TIPS)
T = np.linspace(0.0, 0.3, 4)
MODULUS = "sections[*].youngs_modulus"


def refused(sentence: str) -> Any:
    return pytest.raises((ValueError, TypeError), match=f"^{re.escape(sentence)}")


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        ("", "there is no parameter ''."),
        ("base\ntilt", "there is no parameter 'base\\ntilt'. Did you mean 'base tilt'?"),
        ("time_shift", "there is no parameter 'time_shift'. Did you mean 'time shift'?"),
        ("base_tilt[0]", "there is no parameter 'base_tilt[0]'. Did you mean 'base tilt'?"),
        ("places[0]", "there is no parameter 'places[0]'."),
        ("tool[0]", "parameter 'tool[0]': tool is no number that can be sought; 'tip offset' can"),
        ("base_orientation", "parameter 'base_orientation': base_orientation is no number that"),
        ("payload_inertia[0]", "parameter 'payload_inertia[0]': payload_inertia is no number"),
    ],
)
def test_words_of_a_laboratory_are_no_paths(path: str, sentence: str) -> None:
    with refused(sentence):
        cdcr.identify(POSES, ROBOT, {path: None})


def test_a_path_of_a_file_without_quotes() -> None:
    with refused(
        "parameter 'cables': there is no key 'friction'; a path stands in quotes: "
        '"cables.friction"'
    ):
        cdcr.identify(POSES, ROBOT, {"cables": {"friction": {}}})


def test_numbers_in_pairs() -> None:
    helix = cdcr.Cable(radius=0.01, angle=[(0.0, 3.0), (3.0, 4.0)], end_section=1)
    cone = cdcr.Cable(radius=[(0.01, 0.008)] * 2, angle=[(1.0, 3.0), (3.0, 4.0)], end_section=1)
    robot = replace(ROBOT, cables=(helix, cone))
    plain = plain_setup(robot)

    def names(path: str) -> list[str]:
        return [one.name for one in quantities_of(path, robot, plain)]

    (last,) = quantities_of("cables[0].angle[1][1]", robot, plain)
    assert (last.start, last.slots) == (4.0, (("cables", 0, "angle", 1, 1),))
    assert names("cables[1].radius[*][0]") == ["cable 2 of cables: radius 1"]
    assert len(names("cables[:].angle[:][:]")) == 8
    for path, sentence in (
        ("cables[0].angle", "angle has several numbers, pick one: [0][0]"),
        ("cables[0].angle[0]", "angle has several numbers, pick one: [0]"),
        ("cables[0].radius[0]", "radius is no number that can be sought"),
        ("cables[*].radius", "cables have differing numbers of radius"),
        (
            "cables.radius",
            "radius of cable 2 of cables has several numbers, pick one: cables[1].ra",
        ),
    ):
        with refused(f"parameter {path!r}: {sentence}"):
            names(path)


@pytest.mark.parametrize("data", [5, None, Poses])
def test_what_is_no_measurement(data: Any) -> None:
    with refused("data must be Poses, a Motion or Frequencies, or a sequence of these, got "):
        cdcr.identify(data, ROBOT, {MODULUS: None})
    found = cdcr.identify(POSES, ROBOT, {MODULUS: None})
    for ask in (found.predict, found.errors):
        with refused("data must be Poses, a Motion or Frequencies, got "):
            ask(data)


@pytest.mark.parametrize("seed", [-1, None, "x", 1.5, True])
def test_seeds(seed: Any) -> None:
    with refused("seed must be a whole number >= 0, got "):
        cdcr.identify(POSES, ROBOT, {MODULUS: None}, starts=2, seed=seed)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"pulled": "yes"}, "pulled must be True or False, got 'yes' (str)"),
        ({"markers": {("a", 0.5): TIPS}}, "section of a marker's place must be a whole number, go"),
        ({"markers": {(0.5, 0.5): TIPS}}, "section of a marker's place must be a whole number, go"),
        ({"markers": {(True, 0.5): TIPS}}, "section of a marker's place must be a whole number, "),
        ({"markers": {(0, "x"): TIPS}}, "fraction of a marker's place must be a number, got 'x'"),
    ],
)
@pytest.mark.parametrize("kind", [Poses, Motion])
def test_options_of_other_kinds(kind: Any, given: Any, sentence: str) -> None:
    arguments = (COMMANDS,) if kind is Poses else (T, COMMANDS)
    with refused(sentence):
        kind(*arguments, **given)


def test_options_of_poses_and_of_motions() -> None:
    with refused("history must be True or False, got 'no' (str)"):
        Poses(COMMANDS, tip=TIPS, history="no")  # type: ignore[arg-type]
    with refused("rtol must be at least 1e-14 and below 1, got 2"):
        Motion(T, COMMANDS, tip=TIPS, rtol=2.0)
    with refused("step must be > 0 s and finite, got -1"):
        Motion(T, COMMANDS, tip=TIPS, method="rk4", step=-1.0)
    for time in (0.0, np.nan, "x", None):
        with refused("time must be a number of seconds > 0, got "):
            Motion(T, COMMANDS, tip=TIPS).until(time)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("start", "sentence"),
    [
        (np.full(6, -1.0), "motion, start, cable 1 must be >= 0 (a cable cannot push), got -1"),
        (np.full(6, np.nan), "motion, start, cable 1 must be a finite number, got nan"),
        (["a"] * 6, "motion: start must be None, 6 commands, or a pair"),
        ((np.zeros(4), np.full(4, np.inf)), "motion, start, qd0[0] must be a finite number, got i"),
        ((["a"] * 4, np.zeros(4)), "motion: start must be None, 6 commands, or a pair"),
    ],
)
def test_starts_that_no_robot_has(start: Any, sentence: str) -> None:
    with refused(sentence):
        cdcr.identify(Motion(T, np.zeros(6), tip=TIPS, start=start), ROBOT, {MODULUS: None})


def test_a_start_in_millimetres_is_asked_about() -> None:
    lengths = cdcr.Model(BY_LENGTH).rest_command()
    swing = Motion(T, lengths, tip=TIPS, start=1e3 * lengths)
    with refused("motion, start, cable 1 is told 100 m, where the straight robot takes 0.1 m: is"):
        cdcr.identify(swing, BY_LENGTH, {MODULUS: None})


def test_commands_and_loads_of_frequencies() -> None:
    with refused("frequencies, cable 2 must be >= 0 (a cable cannot push), got -1"):
        cdcr.identify(Frequencies([1.0], command=[0, -1, 0, 0, 0, 0]), ROBOT, {MODULUS: None})
    far = cdcr.Wrench(section=7, force=(0.0, 0.0, 1.0))
    for data in (
        Frequencies([1.0], command=np.zeros(6), wrenches=far),
        Poses(COMMANDS, tip=TIPS, wrenches=far),
        Motion(T, COMMANDS, tip=TIPS, wrenches=far),
    ):
        with refused("wrenches[0].section must be 0 to 1, got 7"):
            cdcr.identify(data, ROBOT, {MODULUS: None})


@pytest.mark.parametrize(
    ("candidates", "sentence"),
    [
        (5, "candidates must have shape (any, any), got ()"),
        (None, "candidates must "),
        ("x", "candidates must be an array of numbers, got 'x' (str)"),
        (COMMANDS[:0], "candidates must have at least one command, got none"),
        (np.full((2, 6), np.nan), "candidates, row 1, cable 1 must be a finite number, got nan"),
    ],
)
def test_candidates_of_a_design(candidates: Any, sentence: str) -> None:
    with refused(sentence):
        informative_commands(ROBOT, {MODULUS: None}, candidates, noise=1e-3)


def test_one_row_cannot_be_cross_validated() -> None:
    one = Poses(COMMANDS[:1], tip=TIPS[:1])
    with refused("cross-validation needs at least two rows of measurements, got 1"):
        cdcr.identify(one, ROBOT, {MODULUS: None}).cross_validate(2)


def test_parts_left_out_of_poses_with_a_history_are_left_out_of_every_channel() -> None:
    base = cdcr.Model(ROBOT).base_wrench
    q = cdcr.quasi_static(cdcr.Model(ROBOT), COMMANDS).q
    wrench = base(q, 0 * q, 0 * q)
    poses = Poses(
        COMMANDS, tip=TIPS, base_force=wrench[:, :3], base_moment=wrench[:, 3:], history=True
    )
    part = poses._rows(np.array([True, False, False, True]))
    for channel in part.channels:
        assert np.isfinite(channel.values).all(axis=1).tolist() == [True, False, False, True]


def test_data_of_one_name_are_one_in_cross_validation() -> None:
    noise = np.random.default_rng(3).normal(0.0, 1e-3, TIPS.shape)
    near, far = Poses(COMMANDS, tip=TIPS + noise), Poses(COMMANDS, tip=TIPS + 5.0 * noise)
    found = cdcr.identify([near, far], ROBOT, {MODULUS: None})
    both = np.sqrt(np.mean([one.rms**2 for one in found.residuals]))
    assert found.cross_validate(4).used == {"poses: tip": pytest.approx(both)}


def test_columns_of_files(tmp_path: Path) -> None:
    header = [*(f"cable {j + 1} [N]" for j in range(6)), *(f"tip {axis} [m]" for axis in "xyz")]
    file = tmp_path / "pulls.csv"

    def written(row: int, column: int, cell: str) -> Path:
        rows = [list(map(repr, one)) for one in np.hstack([COMMANDS, TIPS]).tolist()]
        rows[row][column] = cell
        file.write_text("\n".join(",".join(one) for one in [header, *rows]) + "\n")
        return file

    told = f"{file}, line 3: cable 2 [N] must be a number, got nothing"
    with pytest.raises(ValueError, match=f"^{re.escape(told)}$"):  # no gap may be in a command
        Poses.load(written(1, 1, ""), ROBOT, gaps="skip")
    assert np.isnan(np.asarray(Poses.load(written(1, 6, ""), ROBOT, gaps="skip").tip)[1, 0])
    written(0, 0, "0.0")
    with refused(f"{file}, line 1: column 'cable 1 [N]' is a command, and so is what 'command'"):
        Poses.load(file, ROBOT, command=np.zeros(6))
    with refused(
        f"{file}, line 1: there must be a column 'marker 1 x [m]', and the columns are "
        f"{', '.join(header)}"
    ):
        Poses.load(file, ROBOT, markers=[(0, 0.5)])
    file.write_text("# measured today\n" + file.read_text())
    with refused(f"{file}, line 2: must have 1 column, got 9"):
        Poses.load(file, ROBOT)


def test_files_of_runs_of_rods(tmp_path: Path) -> None:
    section = cdcr.Section(
        length=0.3, backbone_mass=0.01, backbone_diameter=2e-3, youngs_modulus=60e9,
        shear_modulus=23e9, cable_radius=0.01, cable_angles=[0.0, 2.1, 4.2], damping=1e-3,
        twist_damping=1e-4, stretch_damping=0.1, bending_order=1, twist_order=1, stretch_order=0,
    )  # fmt: skip
    robot = cdcr.Robot(sections=[section, section])
    rest = np.zeros(cdcr.Model(robot).num_coordinates)
    run = cdcr.simulate(
        cdcr.Model(robot), rest, rest, t=np.linspace(0.0, 0.1, 5), tension=[2.0, 0, 0, 0, 0, 0]
    )
    file = run.save(tmp_path / "run.csv")
    assert [one.name for one in Motion.load(file, robot).channels] == ["tip"]
    header, *rows = (line.split(",") for line in file.read_text().splitlines())
    keep = [k for k, name in enumerate(header) if not name.startswith("tip")]

    def written(scale: float) -> Path:
        lines = [[header[k] for k in keep]]
        for row in rows:
            lines.append([
                repr(scale * float(row[k])) if header[k] == "q2_x [rad]" else row[k] for k in keep
            ])  # fmt: skip
        file.write_text("\n".join(map(",".join, lines)))
        return file

    (channel,) = Motion.load(written(1.0), robot).channels
    np.testing.assert_array_equal(channel.values, run.q)
    far = Motion.load(written(1e6), robot)
    with pytest.raises(ValueError, match=r"run.csv, line \d: q2_x \[rad\] = .* is it in deg"):
        cdcr.identify(far, robot, {"sections[*].damping": None})
