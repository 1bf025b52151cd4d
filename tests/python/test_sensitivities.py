"""Derivatives of runs: 96 digits, a closed form, differences of tight runs, refusals."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

CASE: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "data" / "run_sensitivities.json").read_text(encoding="utf-8")
)
TIGHT: dict[str, Any] = {"method": "dop853", "rtol": 1e-13, "atol": 1e-14}
# Largest error over the largest value, of methods at the tolerances below.
METHODS = {"dop853": 1e-9, "dopri5": 1e-9, "bdf": 1e-8, "adams": 1e-8}
DIFFERENCE = 1e-8  # of runs, of fourth order: what their own errors leave

needs_cvode = pytest.mark.skipif(
    not cdcr.runs.simulate.available("bdf"), reason="built without CVODE"
)
methods = pytest.mark.parametrize(
    "method",
    [pytest.param(one, marks=needs_cvode if one in ("bdf", "adams") else ()) for one in METHODS],
)


def difference(function: Callable[[float], Any], size: float) -> Any:
    """Return the derivative at zero: central, of fourth order."""
    near, far = function(size) - function(-size), function(2 * size) - function(-2 * size)
    return (8 * near - far) / (12 * size)


@methods
def test_96_digits(method: Any) -> None:
    """A disk on a massless arc, tests/data/run_sensitivities.py."""
    robot = cdcr.Robot(sections=[cdcr.Section(**CASE["section"])], gravity=CASE["gravity"])
    names = list(CASE["slopes"])
    run = cdcr.simulate(
        cdcr.Model(robot), CASE["q0"], CASE["qd0"], t=[0.0, CASE["t"]], tension=CASE["tension"],
        method=method, rtol=1e-12, atol=1e-13, sensitivities=names,
    )  # fmt: skip
    state = np.array([float(one) for one in CASE["state"]])
    assert np.concatenate([run.q[-1], run.qd[-1]]) == pytest.approx(
        state, abs=METHODS[method] * abs(state).max()
    )
    for name in names:
        wanted = np.array([[float(one) for one in column] for column in CASE["slopes"][name]]).T
        found = np.vstack([run.sensitivities[name][-1], run.rate_sensitivities[name][-1]])
        assert found == pytest.approx(wanted, abs=METHODS[method] * abs(wanted).max()), name


def test_small_swings_in_closed_form() -> None:
    """A straight robot barely moved: a damped oscillator of stiffness K and mass a."""
    robot = cdcr.robots.amouri2020(damping=2e-4)
    model = cdcr.Model(robot)
    still = [0.0, 0.0]
    mass, stiffness = model.mass_matrix(still)[0, 0], model.elastic_stiffness[0, 0]
    decay = 2e-4 / (2 * mass)
    omega = np.sqrt(stiffness / mass - decay**2)
    t = np.linspace(0.0, 1.0, 51)
    run = cdcr.simulate(model, still, still, t=t, **TIGHT, sensitivities=["q0", "qd0", "tension"])
    fade = np.exp(-decay * t)
    by_q0 = fade * (np.cos(omega * t) + decay / omega * np.sin(omega * t))
    by_qd0 = fade * np.sin(omega * t) / omega
    lever = model.actuation_matrix()[:, 1] / stiffness
    assert run.sensitivities["q0"][:, 0, 0] == pytest.approx(by_q0, abs=1e-11)
    assert run.sensitivities["qd0"][:, 1, 1] == pytest.approx(by_qd0, abs=1e-11)
    assert run.sensitivities["tension"][:, :, 1] == pytest.approx(
        np.outer(1.0 - by_q0, lever), abs=1e-11
    )


ARM = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81))
ARM = replace(ARM, sections=tuple(replace(one, damping=3e-3) for one in ARM.sections))


@methods
def test_differences_under_a_table(method: Any) -> None:
    """Commands that ramp and jump, a wrench that comes and goes; the run is the one without."""
    model = cdcr.Model(ARM)
    rows = np.random.default_rng(3).uniform(0.5, 3.0, (5, 9))
    push = cdcr.Wrench(section=2, force=(0.1, 0.0, 0.05), profile=([0.0, 0.3, 0.6], [0, 1, 0]))
    t = np.linspace(1.0, 1.8, 17)
    q0 = np.full(6, 0.2)

    def go(
        by: float = 0.0, length: float = 0.0, robot: cdcr.Robot = ARM, **options: Any
    ) -> cdcr.Trajectory:
        first = replace(robot.sections[0], length=robot.sections[0].length + length)
        changed = cdcr.Model(replace(robot, sections=(first, *robot.sections[1:])))
        table = cdcr.TensionTable([1.0, 1.2, 1.5, 1.6, 1.8], rows + by * np.eye(9)[4], "previous")
        return cdcr.simulate(changed, q0, np.zeros(6), t=t, tension=table, wrenches=push, **options)

    options = {"method": method, "rtol": 1e-11, "atol": 1e-12}
    names = ["tension", "sections.1.length"]
    run = go(**options, sensitivities=names)
    assert np.array_equal(run.q, go(**options).q)
    assert model.num_coordinates == run.sensitivities["tension"].shape[1]
    by_pull = difference(lambda h: go(by=h, **TIGHT).q, 0.02)
    found = run.sensitivities["tension"][:, :, 4]
    assert found == pytest.approx(by_pull, abs=DIFFERENCE * abs(by_pull).max())
    by_length = difference(lambda h: go(length=h, **TIGHT).qd, 1e-4)
    found = run.rate_sensitivities["sections.1.length"][:, :, 0]
    assert found == pytest.approx(by_length, abs=DIFFERENCE * abs(by_length).max())


def test_springs_that_turn_slack() -> None:
    """Cables driven by length, released: they hang slack on the way and pull again."""
    section = replace(
        cdcr.robots.amouri2020(damping=1e-3).sections[0], cable_stiffness=3e3, cable_damping=2.0
    )
    robot = cdcr.Robot(sections=[section], gravity=(0.0, 0.0, 9.81))

    def go(by: float = 0.0, **options: Any) -> cdcr.Trajectory:
        changed = cdcr.Model(replace(robot, sections=(replace(section, cable_stiffness=3e3 + by),)))
        command = changed.rest_command() + np.array([-4e-3, 1e-3, 1e-3])
        return cdcr.simulate(
            changed, [-0.3, 0.1], [0.0, 0.0], t=np.linspace(0, 0.5, 21), command=command, **TIGHT,
            **options,
        )  # fmt: skip

    run = go(sensitivities="sections.1.cable_stiffness")
    assert run.slack_events
    wanted = difference(lambda h: go(by=h).q, 0.1)
    found = run.sensitivities["sections.1.cable_stiffness"][:, :, 0]
    assert found == pytest.approx(wanted, abs=1e-6 * abs(wanted).max())


def test_rk4_is_of_its_order() -> None:
    """Half the step, a sixteenth of the error."""
    model = cdcr.Model(ARM)
    q0, qd0 = np.full(6, 0.2), np.zeros(6)
    options: dict[str, Any] = {"t": [0.0, 0.3], "tension": np.ones(9), "sensitivities": ["q0"]}
    truth = cdcr.simulate(model, q0, qd0, **options, **TIGHT).sensitivities["q0"][-1]
    errors = [
        abs(
            cdcr.simulate(model, q0, qd0, **options, method="rk4", step=step).sensitivities["q0"][
                -1
            ]
            - truth
        ).max()
        for step in (1e-3, 5e-4)
    ]
    assert 12 < errors[0] / errors[1] < 20


def test_xarray_has_them() -> None:
    """A variable each, of the parameters without a dimension."""
    pytest.importorskip("xarray")
    model = cdcr.Model(ARM)
    run = cdcr.simulate(
        model, np.full(6, 0.2), np.zeros(6), t=[0.0, 0.1], sensitivities=["q0", "payload"]
    )
    data = run.to_xarray()
    assert data["dq_dpayload"].dims == ("time", "of_coordinate")
    assert data["dqd_dq0"].dims == ("time", "of_coordinate", "by_coordinate")
    assert np.array_equal(data["dqd_dq0"], run.rate_sensitivities["q0"])
    assert list(data["of_coordinate"].values) == list(model.coordinate_names)


def test_netcdf_keeps_them(tmp_path: Path) -> None:
    """All names, also of numbers of the robot, bit for bit."""
    pytest.importorskip("h5netcdf")
    names = ["q0", "tension", "sections.*.length", "gravity.z"]
    run = cdcr.simulate(
        cdcr.Model(ARM), np.full(6, 0.2), np.zeros(6), t=[0.0, 0.1], sensitivities=names
    )
    again = cdcr.Trajectory.load(run.save(tmp_path / "run.nc"))
    for kept in ("sensitivities", "rate_sensitivities"):
        wanted, found = getattr(run, kept), getattr(again, kept)
        assert set(found) == set(names)
        for name in names:
            assert np.array_equal(found[name], wanted[name])


@pytest.mark.parametrize(
    ("asked", "options", "sentence"),
    [
        (["q0", "q0"], {}, "must be named once each, got 'q0' twice"),
        (["tension", "command"], {}, "'tension', which is 'command', twice"),
        (["sections.4.length"], {}, "there is no parameter 'sections.4.length'"),
        (["q1"], {}, "a number from 1 or all: q0, qd0, tension, command, sections"),
        (["q0"], {"tension": lambda t: np.zeros(9)}, "constant or a table"),
        (["q0"], {"controller": "pid"}, "derivatives of a controller are not known"),
    ],
)
def test_refusals(asked: Any, options: dict[str, Any], sentence: str) -> None:
    """Names given twice, numbers that are none, feedback."""
    model = cdcr.Model(ARM)
    if "controller" in options:
        options = {"controller": cdcr.Pid(model, kp=1.0, period=0.01)}
    with pytest.raises(ValueError, match=sentence):
        cdcr.simulate(model, np.zeros(6), np.zeros(6), t=[0.0, 0.1], sensitivities=asked, **options)


@pytest.mark.parametrize("asked", [None, 3])
def test_what_is_no_name(asked: Any) -> None:
    """Nothing and numbers are none."""
    model = cdcr.Model(ARM)
    with pytest.raises(TypeError, match=r"sensitivities must be names, such as 'q0'.*, got"):
        cdcr.simulate(model, np.zeros(6), np.zeros(6), t=[0.0, 0.1], sensitivities=asked)
