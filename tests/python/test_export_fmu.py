"""FMUs of FMI 2 and 3: valid by fmpy, and as exact as the simulations of cdcr itself."""

import ctypes
import dataclasses
import re
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.export.fmu import LIBRARY

if not LIBRARY.is_file():
    pytest.skip("cdcr was built without its FMU", allow_module_level=True)
validation: Any = pytest.importorskip("fmpy.validation", reason="FMUs are tested by fmpy")

from fmu import Fmu, fmpy, upright  # noqa: E402 - where there is no fmpy

HEADERS = Path(__file__).parents[2] / "bindings" / "fmu" / "fmi"
BOTH = pytest.mark.parametrize("fmi", [2, 3])

SAME_RUN = 1e-9  # of dopri5 and of another method; 1e-11 found
SAME_RUBBING_RUN = 1e-7  # friction turns within a step, whose error is seen late; 4e-9 found
SAME_STEPS = 1e-13  # the same arithmetic but for the clock
ROUNDING = 1e-9  # of derivatives, relative to the largest; 1e-12 found
DIFFERENCES = 1e-6  # of central differences


def by_length() -> cdcr.Robot:
    """Two sections, one cable of which is driven by tension; friction, an odd base."""
    section = dataclasses.replace(cdcr.robots.amouri2020(damping=0.01).sections[0], length=0.3)
    wound = dataclasses.replace(section, cable_stiffness=2e3, cable_damping=1.0)
    turn = ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    free = cdcr.Cable(radius=0.015, angle=0.4, end_section=0, friction=0.1)
    return cdcr.Robot(
        sections=[section, wound],
        cables=[free],
        gravity=(0.0, 0.0, -3.0),
        base_orientation=turn,
        base_position=(0.1, -0.2, 0.3),
        tool=((0, 0, 1, 0.02), (1, 0, 0, 0), (0, 1, 0, 0.05), (0, 0, 0, 1)),
        payload=0.01,
        payload_position=(0.0, 0.01, 0.02),
        payload_inertia=np.diag([1e-5, 1e-5, 2e-5]),
    )


ROBOTS = [upright, by_length]


def some_commands(robot: cdcr.Robot) -> np.ndarray:
    straight = cdcr.Model(robot).cable_lengths(np.zeros(2 * len(robot.sections)))
    pulls = 0.5 + 0.5 * np.cos(np.arange(robot.num_cables))
    cables = robot.all_cables
    lengths = straight - 0.004 * np.cos(np.arange(robot.num_cables))
    return np.where([cable.length_driven for cable in cables], lengths, pulls)


def input_names(fmu: Fmu) -> list[str]:
    return [v.name for v in fmu.description.modelVariables if v.causality == "input"]


@BOTH
@pytest.mark.parametrize("robot", ROBOTS)
def test_valid(tmp_path: Path, fmi: int, robot: object) -> None:
    file = tmp_path / "robot.fmu"
    cdcr.export.write_fmu(robot(), file, fmi=fmi)  # type: ignore[operator]
    assert validation.validate_fmu(str(file)) == []


@BOTH
def test_runs_as_cdcr_does(tmp_path: Path, fmi: int) -> None:
    robot = upright()
    file = tmp_path / "arm.fmu"
    cdcr.export.write_fmu(robot, file, fmi=fmi)
    times = np.linspace(0.0, 1.0, 51)
    step_at = 0.4
    before, after = some_commands(robot), some_commands(robot)[::-1]
    names = [f"tension[{j + 1}]" for j in range(9)]
    table = np.zeros(4, dtype=[("time", float), *((name, float) for name in names)])
    table["time"] = [0.0, step_at, step_at, 1.0]
    for j, name in enumerate(names):
        table[name] = [before[j], before[j], after[j], after[j]]
    outputs = [f"q[{i + 1}]" for i in range(6)] + [f"qd[{i + 1}]" for i in range(6)]
    outputs += [f"tip.position[{k + 1}]" for k in range(3)]
    found = fmpy.simulate_fmu(
        str(file),
        stop_time=1.0,
        output_interval=0.02,
        input=table,
        output=outputs,
        start_values={"q_start[1]": 0.2, "qd_start[4]": -0.5},
        use_event_mode=False,
    )
    q0, qd0 = np.zeros(6), np.zeros(6)
    q0[0], qd0[3] = 0.2, -0.5
    tension = cdcr.TensionTable([0.0, step_at], [before, after], interpolation="previous")
    run = cdcr.simulate(cdcr.Model(robot), q0, qd0, t=times, tension=tension, rtol=1e-12)
    assert np.allclose(found["time"], times)
    theirs = np.array([found[name] for name in outputs]).T
    ours = np.hstack([run.q, run.qd, run.tip])
    assert np.abs(theirs - ours).max() < SAME_RUN


def test_cables_that_rub_and_are_driven_by_length(tmp_path: Path) -> None:
    section = dataclasses.replace(
        cdcr.robots.amouri2020(damping=0.01).sections[0],
        length=0.5,
        cable_stiffness=2e4,
        cable_damping=20.0,
        cable_friction=0.2,
    )
    robot = cdcr.Robot(
        sections=[section], cables=[cdcr.Cable(radius=0.015, angle=0.4, end_section=0)]
    )
    command, file = [0.498, 0.5, 0.5, 1.0], tmp_path / "arm.fmu"
    cdcr.export.write_fmu(robot, file)
    outputs = ["q[1]", "q[2]", "qd[1]", "qd[2]"]
    inputs = Fmu(robot, tmp_path)
    start = dict(zip(input_names(inputs), command, strict=True))
    found = fmpy.simulate_fmu(
        str(file),
        stop_time=1.0,
        output_interval=0.02,
        output=outputs,
        start_values={**start, "q_start[1]": 0.2, "q_start[2]": 0.1},
        use_event_mode=False,
    )
    run = cdcr.simulate(
        cdcr.Model(robot),
        [0.2, 0.1],
        [0.0, 0.0],
        t=np.linspace(0.0, 1.0, 51),
        tension=command,
        method="dopri5",
        rtol=1e-12,
        atol=1e-14,
    )
    theirs = np.array([found[name] for name in outputs]).T
    assert np.abs(theirs - np.hstack([run.q, run.qd])).max() < SAME_RUBBING_RUN


@BOTH
def test_runge_kutta_is_that_of_the_simulator(tmp_path: Path, fmi: int) -> None:
    robot = upright()
    fmu = Fmu(robot, tmp_path, fmi=fmi, step=1e-3)
    fmu.begin(startTime=2.0)
    simulator = cdcr.Simulator(cdcr.Model(robot), step=1e-3)
    simulator.reset(np.zeros(6), np.zeros(6))
    commands = some_commands(robot)
    fmu.set(dict(zip(input_names(fmu), commands, strict=True)))
    for k in range(20):
        fmu.slave.doStep(2.0 + 0.005 * k, 0.005)
        for _ in range(5):
            assert simulator.step(commands) == cdcr.Status.ok
    assert np.abs(fmu.get(fmu.names("q")) - simulator.q).max() < SAME_STEPS
    assert np.abs(fmu.get(fmu.names("qd")) - simulator.qd).max() < SAME_STEPS
    assert fmu.get(["time"])[0] == pytest.approx(2.1, abs=1e-12)


@BOTH
def test_every_variable_says_what_the_model_says(tmp_path: Path, fmi: int) -> None:
    robot = by_length()
    fmu = Fmu(robot, tmp_path, fmi=fmi)
    q, qd = np.array([0.5, -0.2, 0.3, 0.1]), np.array([1.0, 0.0, -2.0, 0.5])
    start = dict(zip([*fmu.names("q_start"), *fmu.names("qd_start")], [*q, *qd], strict=True))
    inputs = input_names(fmu)
    assert [name.partition("[")[0] for name in inputs] == ["tension"] * 3 + ["length"] * 3 + [
        "tension"
    ]
    commands = some_commands(robot)
    fmu.begin({**start, "gravity[1]": 1.0, "gravity[2]": 2.0, "gravity[3]": 3.0})
    fmu.set(dict(zip(inputs, commands, strict=True)))
    model = cdcr.Model(robot).with_gravity([1.0, 2.0, 3.0])
    R, p = model.tip(q)
    lengths = model.cable_lengths(q)
    expected = {
        "q": q,
        "qd": qd,
        "qdd": model.forward_dynamics(q, qd, commands),
        "tip.position": p,
        "tip.orientation": R.ravel(),
        "cable_length": lengths,
    }
    for kind, values in expected.items():
        assert fmu.get(fmu.names(kind)) == pytest.approx(values, rel=1e-13), kind
    tension = fmu.get(fmu.names("cable_tension"))
    rate = (model.cable_lengths(q + 1e-3 * qd) - model.cable_lengths(q - 1e-3 * qd)) / 2e-3
    for j, cable in enumerate(robot.all_cables):
        pull = cable.stiffness * (lengths[j] - commands[j]) + cable.damping * rate[j]
        assert tension[j] == pytest.approx(max(0.0, pull) if cable.stiffness else commands[j])
    assert 0 < np.count_nonzero(tension[3:6]) < 3  # taut and slack ones


@BOTH
@pytest.mark.parametrize("robot", ROBOTS)
def test_derivatives(tmp_path: Path, fmi: int, robot: object) -> None:
    described = robot()  # type: ignore[operator]
    model = cdcr.Model(described)
    d = model.num_coordinates
    fmu = Fmu(described, tmp_path, fmi=fmi)
    rng = np.random.default_rng(5)
    q, qd = rng.normal(scale=0.4, size=d), rng.normal(size=d)
    starts = [*fmu.names("q_start"), *fmu.names("qd_start")]
    inputs = input_names(fmu)
    values = dict(zip(starts + inputs, [*q, *qd, *some_commands(described)], strict=True))
    fmu.set(values)
    knowns = [*fmu.names("q"), *fmu.names("qd"), *inputs]
    rates = [*fmu.names("qd"), *fmu.names("qdd")]
    A, B = model.linearize(q, qd, some_commands(described))
    by_model = np.hstack([A, B])
    scale = np.abs(by_model).max()
    assert np.abs(fmu.jacobian(rates, knowns) - by_model).max() < ROUNDING * scale

    unknowns = [v.name for v in fmu.description.modelVariables if v.causality == "output"]
    exact = fmu.jacobian(unknowns, starts + inputs)
    h = 1e-6
    for k, name in enumerate(starts + inputs):
        fmu.set({name: values[name] + h})
        above = fmu.get(unknowns)
        fmu.set({name: values[name] - h})
        difference = (above - fmu.get(unknowns)) / (2.0 * h)
        fmu.set({name: values[name]})
        tolerance = DIFFERENCES * np.abs(exact).max()
        assert np.abs(difference - exact[:, k]).max() < tolerance, name

    fmu.begin()
    rate = fmu.slave.getOutputDerivatives if fmi == 3 else None
    if rate is not None:
        along = np.concatenate([qd, fmu.get(fmu.names("qdd")), np.zeros(len(inputs))])
        expected = fmu.jacobian(unknowns, knowns) @ along
        found = rate(fmu.references(unknowns), [1] * len(unknowns))
        assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)
        seed = rng.normal(size=len(unknowns))
        adjoint = fmu.slave.getAdjointDerivative(
            fmu.references(unknowns), fmu.references(knowns), seed.tolist(), len(knowns)
        )
        transposed = fmu.jacobian(unknowns, knowns).T @ seed
        assert adjoint == pytest.approx(transposed, rel=1e-12, abs=1e-12 * scale)


@BOTH
def test_a_saved_state_comes_back_bit_by_bit(tmp_path: Path, fmi: int) -> None:
    robot = upright()
    fmu = Fmu(robot, tmp_path, fmi=fmi)
    fmu.begin({"gravity[3]": -5.0})
    fmu.set(dict(zip(input_names(fmu), some_commands(robot), strict=True)))
    fmu.slave.doStep(0.0, 0.1)
    slave = fmu.slave
    if fmi == 3:
        state = slave.getFMUState()
        content = slave.serializeFMUState(state)
    else:
        state = slave.getFMUstate()
        content = slave.serializeFMUstate(state)
    fmu.slave.doStep(0.1, 0.2)
    names = list(fmu.reference)
    later = fmu.get(names)

    fmu.set({"tension[1]": 0.0})
    fmu.slave.doStep(0.3, 0.1)
    (slave.setFMUState if fmi == 3 else slave.setFMUstate)(state)
    fmu.slave.doStep(0.1, 0.2)
    assert np.array_equal(fmu.get(names), later)
    (slave.freeFMUState if fmi == 3 else slave.freeFMUstate)(state)

    other = Fmu(robot, tmp_path, fmi=fmi)
    if fmi == 3:
        other.slave.setFMUState(other.slave.deserializeFMUState(content))
    else:
        other.slave.setFMUstate(other.slave.deSerializeFMUstate(content))
    other.slave.doStep(0.1, 0.2)
    assert np.array_equal(other.get(names), later)

    damaged = content[:-8] + np.float64(np.nan).tobytes()
    if fmi == 3:
        damaged_state, take = slave.deserializeFMUState(damaged), other.slave.setFMUState
    else:
        damaged_state, take = slave.deSerializeFMUstate(damaged), other.slave.setFMUstate
    with pytest.raises(fmpy.fmi1.FMICallException):
        take(damaged_state)
    assert "the state is not one of this FMU" in other.messages[-1]
    assert np.array_equal(other.get(names), later)

    fmu.slave.reset()
    fresh = Fmu(robot, tmp_path, fmi=fmi)
    assert np.array_equal(fmu.get(names), fresh.get(names))


@pytest.mark.parametrize("fmi", [2, 3])
def test_every_function_of_the_standard_is_there(fmi: int) -> None:
    text = (HEADERS / f"fmi{fmi}Functions.h").read_text()
    names = set(re.findall(rf"FMI{fmi}_Export\s+fmi{fmi}\w+TYPE\s+(fmi{fmi}\w+);", text))
    assert len(names) == {2: 44, 3: 75}[fmi]
    library = ctypes.CDLL(str(LIBRARY))
    assert [name for name in names if not hasattr(library, name)] == []


def test_the_same_robot_gives_the_same_file(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        cdcr.export.write_fmu(upright(), tmp_path / name / "arm.fmu")
    first, second = ((tmp_path / name / "arm.fmu").read_bytes() for name in "ab")
    assert first == second
    with zipfile.ZipFile(tmp_path / "a" / "arm.fmu") as archive:
        licenses = [name for name in archive.namelist() if "/licenses/" in name]
    assert {"LICENSE", "Eigen.txt"} <= {Path(name).name for name in licenses}
