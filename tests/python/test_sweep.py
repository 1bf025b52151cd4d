"""Sweeps give what single runs give, wherever they are computed."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("xarray")

from swept import end_x, pulled

FILE = """
robot = "three_sections"
t_end = 0.2
tension = [1.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0]
[integrator]
method = "dopri5"
[output]
num_samples = 21
"""
EXACT: dict[str, Any] = {"rtol": 0.0, "atol": 0.0}


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "three.toml"
    path.write_text(FILE)
    return path


def test_a_grid_is_the_runs_of_its_values(file: Path) -> None:
    payloads, moduli = [0.0, 0.01], [5e10, 6e10, 7e10]
    found = cdcr.sweep(
        file,
        {"payload": payloads, "sections.2.youngs_modulus": moduli},
        metrics=["final_tip_x", "peak_theta"],
        jobs=1,
    )
    assert dict(found.sizes) == {"payload": 2, "sections.2.youngs_modulus": 3}
    robot = cdcr.robots.three_sections()
    for i, payload in enumerate(payloads):
        for j, modulus in enumerate(moduli):
            sections = list(robot.sections)
            sections[1] = replace(sections[1], youngs_modulus=modulus)
            model = cdcr.Model(replace(robot, sections=tuple(sections), payload=payload))
            run = cdcr.simulate(
                model,
                np.zeros(6),
                np.zeros(6),
                t=np.linspace(0.0, 0.2, 21),
                tension=[1.0, 0, 0, 0.5, 0, 0, 0, 0, 0],
                method="dopri5",
            )
            assert found.final_tip_x[i, j] == run.tip[-1, 0]
            assert found.peak_theta[i, j] == np.abs(run.theta).max()
    assert found["sections.2.youngs_modulus"].attrs["units"] == "Pa"
    assert found.final_tip_x.attrs["units"] == "m"
    assert set(found.status.values.ravel()) == {"ok"}


@pytest.mark.parametrize("name", cdcr.robots.names())
def test_the_table_of_a_robot_is_the_robot(name: str) -> None:
    from cdcr.robot.file import robot_from_table, robot_table

    robot = cdcr.robots.get(name)
    section = replace(
        robot.sections[-1], cable_friction=0.1, num_disks=2, disk_positions=(0.5, 1.0)
    )
    cable = cdcr.Cable(radius=0.02, angle=1.0, end_section=0)
    robot = replace(robot, sections=(*robot.sections[:-1], section), cables=(cable,))
    assert robot_from_table(cdcr.Robot, robot_table(robot), "table") == robot


def changed(file: Path, **parameters: Any) -> Any:
    """The scenario of the only run of a sweep."""
    from cdcr.sweeps.jobs import file_source

    names = tuple(name.replace("__", ".") for name in parameters)
    return file_source(file, names).scenario(list(parameters.values()))


def test_paths_lead_to_what_the_file_says(file: Path) -> None:
    robot = changed(file, **{"sections.*.damping": 0.02, "gravity.z": -9.81}).robot
    assert [section.damping for section in robot.sections] == [0.02] * 3
    assert robot.gravity == (0.0, 0.0, -9.81)
    robot = changed(file, **{"robot.sections.3.num_disks": 4.0, "gravity.1": 1.0}).robot
    assert [section.num_disks for section in robot.sections][2] == 4
    assert robot.gravity == (1.0, 0.0, 0.0)
    assert changed(file, **{"tension.4": 2.0, "t_end": 3.0}).tension[3] == 2.0
    assert changed(file, **{"t_end": 3.0}).t_end == 3.0


def test_a_changed_robot_changes_what_is_made_for_it(file: Path) -> None:
    file.write_text(FILE + "[initial]\nequilibrium = true\n")
    heavy = changed(file, **{"gravity.x": 9.81, "payload": 0.02})
    model = cdcr.Model(replace(cdcr.robots.three_sections(), gravity=(9.81, 0, 0), payload=0.02))
    rest = model.equilibrium([1.0, 0, 0, 0.5, 0, 0, 0, 0, 0])
    np.testing.assert_array_equal(heavy.start(heavy.model), rest)
    loop = changed(Path(cdcr.scenarios.source_file("pid")), **{"controller.kp": 5.0})
    assert loop.controller.options["kp"] == 5.0


def test_files_that_a_scenario_names_travel_with_it(tmp_path: Path) -> None:
    from cdcr.scenarios.file.reader import load_scenario
    from cdcr.scenarios.file.whole import whole_table

    cdcr.robots.amouri2020().save(tmp_path / "robot.toml")
    (tmp_path / "pull.csv").write_text("t,cable 1,cable 2,cable 3\n0,0,0,0\n0.1,4,0,1\n")
    rows = "".join(f"{0.1 * k},{2.0 * k},{9.0 * k}\n" for k in range(12))
    (tmp_path / "path.csv").write_text("t,theta_deg 1,phi_deg 1\n" + rows)
    head = 'robot = "robot.toml"\nt_end = 0.2\n'
    inputs = ['[tension]\nfile = "pull.csv"\ninterpolation = "previous"\n']
    inputs.append('[trajectory]\nfile = "path.csv"\n')
    for k, given in enumerate(inputs):
        file = tmp_path / f"{k}.toml"
        file.write_text(head + given)
        here = load_scenario(file).simulate()
        table = whole_table(file)
        assert ".csv" not in str(table)
        there = changed(file, payload=0.0).simulate()
        np.testing.assert_array_equal(there.q, here.q)
        np.testing.assert_array_equal(there.tension, here.tension)


@pytest.fixture(params=["processes", "threads", "spawned"])
def elsewhere(request: pytest.FixtureRequest) -> Iterator[dict[str, Any]]:
    if request.param == "processes":
        yield {"jobs": 2}
        return
    pool: Executor = (
        ThreadPoolExecutor(2)
        if request.param == "threads"
        else ProcessPoolExecutor(1, mp_context=get_context("spawn"))
    )
    with pool:
        yield {"executor": pool}


def test_the_same_bits_wherever_they_are_computed(file: Path, elsewhere: dict[str, Any]) -> None:
    parameters = {"payload": [0.0, 0.01], "tension.1": [0.5, 1.0, 1.5]}
    options: dict[str, Any] = {"metrics": ["tip_path_length", "steps"]}
    here = cdcr.sweep(file, parameters, jobs=1, **options)
    there = cdcr.sweep(file, parameters, **options, **elsewhere)
    assert there.identical(here)


def test_functions_as_source_and_as_metric() -> None:
    told: list[tuple[int, int]] = []
    found = cdcr.sweep(
        pulled,
        {"pull": [1.0, 2.0], "damping": [0.01, 0.02]},
        metrics=["final_tip_x", end_x],
        progress=lambda done, total: told.append((done, total)),
    )
    np.testing.assert_array_equal(found.end_x, found.final_tip_x)
    assert found.end_x[1, 0] == pulled(2.0, 0.01).tip[-1, 0]
    assert found.end_x.attrs["long_name"] == "Where the tip is at the end, along X."
    assert told[0] == (0, 4)
    assert told[-1] == (4, 4)
    named = cdcr.sweep(pulled, {"pull": [1.0]}, metrics={"last": lambda run: run.t[-1]})
    assert named["last"].item() == 0.1


def test_findings_of_the_summary_are_metrics_too(file: Path) -> None:
    found = cdcr.sweep(file, {"payload": [0.0, 0.01]}, metrics="section_2_theta_max_deg", jobs=1)
    scenario = changed(file, payload=0.01)
    summary = {one.key: one.value for one in scenario.summary(scenario.simulate())}
    assert found.section_2_theta_max_deg[1] == summary["section_2_theta_max_deg"]
    assert found.section_2_theta_max_deg.attrs["units"] == "deg"


def test_a_run_that_fails_is_no_number_and_keeps_its_message() -> None:
    def run(pull: float) -> cdcr.Trajectory:
        if pull == 2.0:
            raise RuntimeError("no such pull")
        steps = 1 if pull == 3.0 else None
        model = cdcr.Model(cdcr.robots.amouri2020())
        return cdcr.simulate(
            model, [0, 0], [0, 0], t=[0.0, 1.0], tension=[pull, 0, 0], max_steps=steps
        )

    found = cdcr.sweep(run, {"pull": [1.0, 2.0, 3.0]}, metrics=["final_theta", "steps"])
    assert np.isfinite(found.final_theta.values).tolist() == [True, False, False]
    assert np.isfinite(found.steps.values).tolist() == [True, False, False]
    assert found.status.values.tolist() == ["ok", "refused", "step_limit"]
    first, second, third = found.message.values.tolist()
    assert (first, second) == ("", "no such pull")
    assert "max_steps" in third


def test_metrics_that_fail_leave_the_others_of_the_sweep() -> None:
    def picky(run: cdcr.Trajectory) -> float:
        if run.tension[0, 0] > 1.5:
            raise ValueError("too much")
        return 1.0

    found = cdcr.sweep(pulled, {"pull": [1.0, 2.0]}, metrics=picky)
    assert found.picky.values[0] == 1.0
    assert found.message.values.tolist() == ["", "its metrics failed: too much"]


def test_rows_of_ones_own() -> None:
    rows = np.array([[1.0, 0.01], [2.0, 0.02], [1.0, 0.03]])
    found = cdcr.sweep(pulled, ["pull", "damping"], samples=rows, metrics=end_x)
    assert dict(found.sizes) == {"run": 3}
    np.testing.assert_array_equal(found.damping, rows[:, 1])
    assert found.end_x[2] == pulled(1.0, 0.03).tip[-1, 0]
