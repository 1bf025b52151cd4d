"""Runs read back from their files: everything a netCDF file holds, the numbers of a CSV file."""

import json
import re
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

ARRAYS = ("t", "q", "qd", "tension", "command")
STATS = ("steps", "rejected", "evaluations", "jacobians", "newton_failures")
CABLES = [cdcr.Cable(radius=0.02, angle=1.0, end_section=1, stiffness=5e3, damping=1.0)]


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    """Two sections, cables driven by tension and by length, slack events, stopped early."""
    plain = cdcr.robots.amouri2020(damping=0.02).sections
    model = cdcr.Model(cdcr.Robot(sections=plain * 2, cables=CABLES))
    command = [1.0, *[0.0] * 5, model.rest_command()[6]]
    t = np.linspace(0.0, 5.0, 51)
    return cdcr.simulate(
        model, [-0.4, -0.4] * 2, np.zeros(4), t=t, command=command, method="bdf", max_steps=1500
    )


def refuses(error: type[Exception], sentence: str) -> Any:
    return pytest.raises(error, match=f"^{re.escape(sentence)}")


def test_tensions_are_newtons_and_commands_what_was_asked(run: cdcr.Trajectory) -> None:
    np.testing.assert_array_equal(run.command[:, 6], run.model.rest_command()[6])
    np.testing.assert_array_equal(run.tension[:, :6], run.command[:, :6])
    spring = [
        run.model.cable_tensions(*state) for state in zip(run.q, run.qd, run.command, strict=True)
    ]
    np.testing.assert_array_equal(run.tension, spring)
    assert run.tension[:, 6].max() > 5.0


def test_a_netcdf_file_holds_everything(run: cdcr.Trajectory, tmp_path: Path) -> None:
    again = cdcr.Trajectory.load(run.save(tmp_path / "run.nc"))
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(again, name), getattr(run, name))
    assert (again.model.robot, again.model.formulation) == (run.model.robot, "exact")
    assert (again.status, again.message) == (cdcr.Status.step_limit, run.message)
    assert (again.method, again.slack_events) == ("bdf", run.slack_events)
    assert len(run.slack_events) > 0
    stored = json.loads(run.to_xarray().attrs["slack_events"])
    assert [cable - 1 for _, cable, _ in stored] == [event.cable for event in run.slack_events]
    for name in STATS:
        assert getattr(again.stats, name) == getattr(run.stats, name)


def test_a_csv_file_holds_the_numbers_and_says_what_it_lacks(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "xarray", None)
    path = run.save(tmp_path / "run.csv")
    again = cdcr.Trajectory.load(path, model=run.model)
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(again, name), getattr(run, name))
    assert again.message == "run.csv does not hold how the run ended, its method and its cost"
    with refuses(ValueError, f"{path} holds numbers and no robot: give the model that ran"):
        cdcr.Trajectory.load(path)
    one = cdcr.Model(cdcr.Robot(sections=run.model.robot.sections, cables=CABLES * 2))
    with refuses(ValueError, f"{path} has no column 'tension8 [N]', which a run of this model has"):
        cdcr.Trajectory.load(path, model=one)


def test_a_robot_without_cables_comes_back(tmp_path: Path) -> None:
    section = cdcr.Section(
        length=0.5, backbone_mass=0.1, backbone_diameter=5e-3, youngs_modulus=1e10
    )
    run = cdcr.simulate(cdcr.Model(cdcr.Robot(sections=[section])), [0.5, 0], [0, 0], t=[0.0, 1.0])
    for suffix in (".nc", ".csv"):
        path = run.save(tmp_path / f"run{suffix}")
        again = cdcr.Trajectory.load(path, model=run.model)
        np.testing.assert_array_equal(again.q, run.q)
        assert again.tension.shape == (2, 0)


def test_files_that_are_no_run_are_refused(run: cdcr.Trajectory, tmp_path: Path) -> None:
    for name in ("other.nc", "other.csv"):
        (tmp_path / name).write_text("t,a\n1,2,3\n")
        with refuses(ValueError, f"{tmp_path / name} is no run that cdcr has written: "):
            cdcr.Trajectory.load(tmp_path / name, model=run.model)
    with refuses(FileNotFoundError, f"there is no run {tmp_path / 'none.nc'}"):
        cdcr.Trajectory.load(tmp_path / "none.nc")
    with refuses(ValueError, "the file name must end in .nc or .csv, got 'run.txt'"):
        cdcr.Trajectory.load("run.txt")
    run.to_xarray().drop_vars("qd").to_netcdf(tmp_path / "half.nc", engine="h5netcdf")
    with refuses(ValueError, f"{tmp_path / 'half.nc'} is no run that cdcr has written: "):
        cdcr.Trajectory.load(tmp_path / "half.nc")


def test_files_of_another_unit_order_or_robot_are_refused(
    run: cdcr.Trajectory, tmp_path: Path
) -> None:
    path, whole = tmp_path / "other.nc", run.to_xarray()
    degrees = np.degrees(whole.q).assign_attrs(units="deg")
    drive = cdcr.Model(cdcr.Robot(sections=run.model.robot.sections))
    odd: list[tuple[Any, cdcr.Model | None, str]] = [
        (whole.assign(q=degrees), None, "q must be in rad, got deg"),
        (
            whole.assign_coords(time=(1e3 * whole.time).assign_attrs(units="ms")),
            None,
            "time must be in s, got ms",
        ),
        (whole.isel(component=[1, 0]), None, "component of q must be ['x', 'y'], got ['y', 'x']"),
        (whole.isel(time=slice(None, None, -1)), None, "its times do not increase"),
        (whole.isel(time=slice(0)), None, "it has no samples"),
        (whole.assign_attrs(robot="{"), None, "Expecting property name"),
        (whole.assign_attrs(slack_events="[[0.1, 9, true]]"), None, "its slack events tell of"),
        (whole, drive, "its cables are driven by length, those of the model by tension"),
    ]
    for dataset, model, told in odd:
        path.unlink(missing_ok=True)
        dataset.to_netcdf(path, engine="h5netcdf")
        with refuses(ValueError, f"{path} is no run ") as refusal:
            cdcr.Trajectory.load(path, model=model)
        assert told in str(refusal.value)
    path.unlink()
    whole.transpose(..., "time").to_netcdf(path, engine="h5netcdf")  # another order in the file
    np.testing.assert_array_equal(cdcr.Trajectory.load(path).q, run.q)


def test_a_damaged_netcdf_file_is_refused(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = run.save(tmp_path / "run.nc")

    def damaged(*_: object, **__: object) -> None:
        raise RuntimeError("Link iteration failed")  # as h5py says

    monkeypatch.setattr("xarray.open_dataset", damaged)
    with refuses(ValueError, f"{path} is no run that cdcr has written: Link iteration failed"):
        cdcr.Trajectory.load(path)


def test_csv_files_of_another_robot_or_out_of_order_are_refused(
    run: cdcr.Trajectory, tmp_path: Path
) -> None:
    path = run.save(tmp_path / "run.csv")
    header, *rows = path.read_text().splitlines()
    sections = run.model.robot.sections
    drive = cdcr.Model(
        cdcr.Robot(sections=sections, cables=[cdcr.Cable(radius=0.02, angle=1.0, end_section=1)])
    )
    short = cdcr.Model(cdcr.Robot(sections=sections[:1]))
    for model, lines, told in (
        (run.model, [header, *rows[::-1]], "its times do not increase"),
        (run.model, [header], "it has no samples"),
        (run.model, [f"{header},t [s]", *(f"{row},0" for row in rows)], "has 2 columns 't [s]'"),
        (drive, [header, *rows], "has a column 'command1 [N or m]', which no run of this model"),
        (short, [header, *rows], "has a column 'q2_x [rad]', which no run of this model has"),
    ):
        path.write_text("\n".join(lines))
        with refuses(ValueError, str(path)) as refusal:
            cdcr.Trajectory.load(path, model=model)
        assert told in str(refusal.value)
    with refuses(TypeError, "model must be a cdcr.Model, got Robot"):
        cdcr.Trajectory.load(path, model=run.model.robot)  # type: ignore[arg-type]
