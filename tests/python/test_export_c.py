"""Exported C: compiled, its answers are those of the library, in both precisions."""

import dataclasses
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr
from c_library import CLibrary

pytestmark = pytest.mark.skipif(shutil.which("cc") is None, reason="there is no compiler of C")

# Relative to the largest number compared: residuals seen are below a tenth. Derivatives of eight
# sections that are bent far lose most.
TOLERANCE = {"double": 1e-12, "float": 2e-4}
OF_DERIVATIVES = {"double": 1e-11, "float": 2e-4}
SWEEP = 12  # states of each robot


def turned(robot: cdcr.Robot) -> cdcr.Robot:
    """The robot with everything else that a description may have: it hangs, and carries a tool."""
    return dataclasses.replace(
        robot,
        gravity=(1.0, 2.0, -9.0),
        payload=0.1,
        payload_position=(0.01, 0.02, 0.03),
        payload_inertia=((1e-4, 0, 0), (0, 2e-4, 0), (0, 0, 3e-4)),
        base_orientation=((0, 0, 1), (1, 0, 0), (0, 1, 0)),
        base_position=(1.0, 2.0, 3.0),
        tool=((1, 0, 0, 0.01), (0, 0, -1, 0.02), (0, 1, 0, 0.03), (0, 0, 0, 1)),
    )


def driven_by_length() -> cdcr.Robot:
    robot = cdcr.robots.three_sections()
    sections = [
        dataclasses.replace(section, cable_stiffness=2e3, cable_damping=5.0)
        for section in robot.sections[1:]
    ]
    return dataclasses.replace(robot, sections=(robot.sections[0], *sections))


def rubbing() -> cdcr.Robot:
    """Cables that rub in the holes, and two of the robot's own that do so at the entry too."""
    robot = turned(cdcr.robots.three_sections())
    sections = [dataclasses.replace(one, cable_friction=0.3) for one in robot.sections]
    entry: Any = {"entry_friction": 0.05, "sheath_friction": 0.2, "viscosity": 2.0}
    cable = cdcr.Cable(end_section=1, radius=0.01, angle=0.5, friction=0.1)
    rubs = dataclasses.replace(cable, **entry)
    drive: Any = {"stiffness": 2e3, "damping": 5.0, "pretension": 3.0}
    driven = dataclasses.replace(rubs, end_section=2, angle=2.5, friction=0.0, **drive)
    return dataclasses.replace(
        robot, sections=tuple(sections), cables=(*robot.cables, rubs, driven), sliding_speed=0.02
    )


ROBOTS = {
    "one section": cdcr.robots.amouri2020(),
    "one section with a payload": cdcr.robots.amouri2020(gravity=(1, 2, -9.81), payload=0.1),
    "three sections": cdcr.robots.three_sections(),
    "three sections, turned": turned(cdcr.robots.three_sections()),
    "driven by length": driven_by_length(),
    "with friction": rubbing(),
    "eight sections": cdcr.robots.three_sections().subdivide([3, 3, 2]),
}


def states(model: cdcr.Model) -> list[list[NDArray[np.float64]]]:
    rng = np.random.default_rng(7)
    d, straight = model.num_coordinates, model.cable_lengths(np.zeros(model.num_coordinates))
    driven = np.array([cable.length_driven for cable in model.robot.all_cables])
    found: list[list[NDArray[np.float64]]] = []
    for size in [1e-9, 0.1, 1.0] * (SWEEP // 3):
        pull = rng.uniform(0.0, 5.0, model.num_cables)
        command = np.where(driven, straight * rng.uniform(0.98, 1.0, model.num_cables), pull)
        found.append([size * rng.normal(size=d), 2.0 * rng.normal(size=d), command])
    return found


def error(got: NDArray[np.float64], wanted: NDArray[np.float64]) -> float:
    return float(np.abs(got - wanted).max() / np.abs(wanted).max())


@pytest.mark.parametrize("real", ["double", "float"])
@pytest.mark.parametrize("name", ROBOTS)
def test_answers_are_those_of_the_library(tmp_path: Path, name: str, real: str) -> None:
    model = cdcr.Model(ROBOTS[name])
    d, c = model.num_coordinates, model.num_cables
    library = CLibrary(ROBOTS[name], tmp_path, real)
    worst: dict[str, float] = {}

    def compare(what: str, got: NDArray[np.float64], wanted: NDArray[np.float64]) -> None:
        worst[what] = max(worst.get(what, 0.0), error(got.astype(float), wanted))

    for state in states(model):
        q, qd, command = map(library.numbers, state)
        at_q, at_qd, pull = (values.astype(float) for values in (q, qd, command))
        qdd, position, rotation = (library.numbers(np.zeros(n)) for n in (d, 3, 9))
        assert library.call("forward_dynamics", q, qd, command, qdd) == 0
        compare("accelerations", qdd, model.forward_dynamics(at_q, at_qd, pull))

        on_q, on_qd, on_command = (library.numbers(np.zeros((n, d))) for n in (d, d, c))
        assert library.call("derivatives", q, qd, command, on_q, on_qd, on_command) == 0
        by_q, by_qd, by_command = model.derivatives(at_q, at_qd, pull)[:3]
        compare("derivatives by q", on_q.T, by_q)
        compare("derivatives by qd", on_qd.T, by_qd)
        compare("derivatives by command", on_command.T, by_command)

        assert library.call("tip", q, position, rotation) == 0
        wanted_rotation, wanted_position = model.tip(at_q)
        compare("tip", position, wanted_position)
        compare("tip", rotation.reshape(3, 3), wanted_rotation)
        lengths = library.numbers([0.0] * c)
        library.call("cable_lengths", q, lengths)
        compare("lengths", lengths, model.cable_lengths(at_q))
    print(f"\n{name}, {real}:", {what: f"{value:.1e}" for what, value in worst.items()})
    for what, value in worst.items():
        assert value < (OF_DERIVATIVES if "derivatives" in what else TOLERANCE)[real], what


@pytest.mark.parametrize("real", ["double", "float"])
def test_steps_are_those_of_the_simulator(tmp_path: Path, real: str) -> None:
    robot = turned(cdcr.robots.three_sections())
    model = cdcr.Model(robot)
    library = CLibrary(robot, tmp_path, real)
    simulator = cdcr.Simulator(model, step=1e-3)
    command = np.linspace(0.0, 2.0, model.num_cables)
    simulator.reset(np.zeros(6), np.zeros(6))
    q, qd = library.numbers(np.zeros(6)), library.numbers(np.zeros(6))
    for _ in range(100):
        simulator.step(command)
        assert library.call("step", q, qd, library.numbers(command), 1e-3) == 0
    assert np.abs(simulator.q).max() > 0.01
    assert error(q.astype(float), simulator.q) < TOLERANCE[real]
    assert error(qd.astype(float), simulator.qd) < TOLERANCE[real]


def test_what_is_beyond_the_model_is_told_and_nothing_written(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020()
    library = CLibrary(robot, tmp_path, "double")
    zero, three, out = np.zeros(2), np.zeros(3), np.full(9, 7.0)
    for bad in (np.array([10.0, 0.0]), np.array([np.nan, 0.0]), np.array([np.inf, 0.0])):
        assert library.call("forward_dynamics", bad, zero, three, out) == 1
        assert library.call("tip", bad, out, out) == 1
        q, qd = bad.copy(), np.ones(2)
        assert library.call("step", q, qd, three, 1e-3) == 1
        assert np.array_equal(q, bad, equal_nan=True)
        assert np.array_equal(qd, np.ones(2))
    assert library.call("forward_dynamics", zero, np.array([np.nan, 0.0]), three, out) == 1
    fast = np.array([9.4, 0.0]), np.array([1e3, 0.0])
    assert library.call("step", *fast, three, 1e-3) == 1
    assert np.all(out == 7.0)


def test_it_needs_no_library(tmp_path: Path) -> None:
    """No heap and no mathematics: what compilers call by themselves to copy, and nothing else."""
    cdcr.export.write_c(cdcr.robots.three_sections(), tmp_path, name="arm")
    for real in ("double", "float"):
        flags = ["-std=c99", "-O1", "-Wdouble-promotion", "-Werror", f"-DARM_REAL={real}", "-c"]
        flags.append("-fno-stack-protector")  # which Ubuntu's compiler puts in by itself
        subprocess.run(["cc", *flags, "arm.c"], check=True, cwd=tmp_path)
        told = subprocess.run(
            ["nm", "arm.o"], check=True, cwd=tmp_path, capture_output=True, text=True
        ).stdout
        assert set(re.findall(r" U _?(\w+)", told)) <= {"memcpy", "memmove", "memset"}
        assert not re.findall(r" [BbDdC] (\w+)", told)  # nothing that a call could change
        assert re.findall(r" T (\w+)", told) == [
            "arm_cable_lengths",
            "arm_forward_dynamics",
            "arm_step",
            "arm_tip",
        ]


def test_tables_end_where_they_are_told(tmp_path: Path) -> None:
    robot = cdcr.robots.amouri2020()
    cdcr.export.write_c(robot, tmp_path, name="whole")
    cdcr.export.write_c(robot, tmp_path, name="arm", max_bending=1.5)
    sizes = [(tmp_path / f"{name}.c").stat().st_size for name in ("arm", "whole")]
    assert 3 * sizes[0] < sizes[1]
    assert "#define ARM_MAX_BENDING 1.5 " in (tmp_path / "arm.h").read_text()


def test_refusals(tmp_path: Path) -> None:
    arm = cdcr.robots.amouri2020()
    section = arm.sections[0]
    for robot, sentence in [
        (
            dataclasses.replace(arm, sections=(dataclasses.replace(section, bending_order=1),)),
            "curvature",
        ),
        (
            dataclasses.replace(
                arm,
                sections=(dataclasses.replace(section, cable_friction=0.1),),
                presliding_stiffness=1e4,
            ),
            "friction without memory, presliding_stiffness = 0; got 10000 N/m",
        ),
        (
            dataclasses.replace(arm, sections=(dataclasses.replace(section, cable_friction=5.0),)),
            "friction times angle up to 40; cable 1 may have 47",
        ),
        (
            dataclasses.replace(
                arm,
                cables=(
                    cdcr.Cable(radius=0.01, angle=0.0, end_section=0, stiffness=1e3, backlash=1e-4),
                ),
            ),
            "without backlash, which has memory; cable 4 has 0.0001 m",
        ),
        (
            dataclasses.replace(
                arm, cables=(cdcr.Cable(radius=[(0.01, 0.02)], angle=0.0, end_section=0),)
            ),
            "straight cables",
        ),
        (cdcr.robots.rao2021(), "dynamics"),
    ]:
        with pytest.raises(ValueError, match=sentence):
            cdcr.export.write_c(robot, tmp_path)
    with pytest.raises(ValueError, match="name must be an identifier of C, got 'my-arm'"):
        cdcr.export.write_c(arm, tmp_path, name="my-arm")
    with pytest.raises(ValueError, match="max_bending must be at most 3 pi rad, got 10"):
        cdcr.export.write_c(arm, tmp_path, max_bending=10.0)
    with pytest.raises(ValueError, match="max_bending must be a number > 0 rad"):
        cdcr.export.write_c(arm, tmp_path, max_bending=0.0)
    cdcr.export.write_c(arm, tmp_path, name="arm")
    with pytest.raises(FileExistsError):
        cdcr.export.write_c(arm, tmp_path, name="arm")
