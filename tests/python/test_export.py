"""Runs as data sets and files: nothing lost, nothing overwritten, nothing left half-written."""

import csv
import dataclasses
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import cdcr
from cdcr.files.new_file import new_file

UNITS = {
    "time": "s",
    "section": "1",
    "component": "1",
    "cable": "1",
    "axis": "1",
    "q": "rad",
    "qd": "rad/s",
    "theta": "rad",
    "phi": "rad",
    "tension": "N",
    "tip": "m",
    "kinetic_energy": "J",
    "potential_energy": "J",
    "energy": "J",
}


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    """Gravity, damping, changing tensions and a sideways push: no column is trivial."""
    robot = cdcr.robots.amouri2020(gravity=(1.0, -2.0, 9.0), payload=0.01, damping=1e-3)
    return cdcr.simulate(
        cdcr.Model(robot),
        [0.1, -0.2],
        [0.3, 1.0],
        t=np.linspace(0.0, 2.0, 41),
        tension=cdcr.TensionTable(
            [0.0, 1.0, 2.0], [[1.0, 0.0, 0.1], [3.0, 1.0, 0.1], [0.0, 0.0, 0.0]]
        ),
    )


@pytest.fixture
def cableless_run() -> cdcr.Trajectory:
    section = dataclasses.replace(cdcr.robots.amouri2020().sections[0], cable_angles=())
    model = cdcr.Model(cdcr.Robot(sections=[section]))
    return cdcr.simulate(model, [0.5, 0.1], [0.0, 0.0], t=np.linspace(0.0, 1.0, 11))


def test_dataset_holds_the_run(run: cdcr.Trajectory) -> None:
    data = run.to_xarray()
    assert dict(data.sizes) == {"time": 41, "section": 1, "component": 2, "cable": 3, "axis": 3}
    np.testing.assert_array_equal(data.time, run.t)
    np.testing.assert_array_equal(data.q.sel(section=1, component="y"), run.q[:, 1])
    np.testing.assert_array_equal(data.qd.sel(section=1, component="x"), run.qd[:, 0])
    np.testing.assert_array_equal(data.tension.sel(cable=2), run.tension[:, 1])
    np.testing.assert_array_equal(data.tip.sel(axis="z"), run.tip[:, 2])
    for name in ("theta", "phi"):
        np.testing.assert_array_equal(data[name].sel(section=1), getattr(run, name)[:, 0])
    for name in ("kinetic_energy", "potential_energy", "energy"):
        np.testing.assert_array_equal(data[name], getattr(run, name))
        assert data[name].dims == ("time",)


def test_everything_has_a_unit_and_a_name(run: cdcr.Trajectory) -> None:
    data = run.to_xarray()
    assert {name: variable.attrs["units"] for name, variable in data.variables.items()} == UNITS
    names = {variable.attrs["long_name"] for variable in data.variables.values()}
    assert len(names) == len(UNITS)  # each says something of its own
    assert "" not in names


def test_numbers_count_from_one_and_say_so(run: cdcr.Trajectory) -> None:
    data = run.to_xarray()
    assert data.cable.values.tolist() == [1, 2, 3]
    assert data.section.values.tolist() == [1]
    assert "1" in data.section.attrs["long_name"]
    assert "1" in data.cable.attrs["long_name"]


def test_dataset_says_where_it_comes_from(run: cdcr.Trajectory) -> None:
    attributes = dataclasses.replace(run, method="bdf").to_xarray().attrs
    assert attributes["cdcr_version"] == cdcr.__version__
    assert attributes["status"] == "ok"
    assert attributes["message"] == ""
    assert attributes["method"] == "bdf"
    assert attributes["formulation"] == "exact"
    for name in ("steps", "rejected", "evaluations", "jacobians", "newton_failures"):
        assert attributes[name] == getattr(run.stats, name)
    described = json.loads(attributes["robot"])
    sections = [cdcr.Section(**section) for section in described.pop("sections")]
    assert cdcr.Robot(sections=sections, **described) == run.model.robot


def test_netcdf_round_trip(run: cdcr.Trajectory, tmp_path: Path) -> None:
    path = run.save(tmp_path / "run.nc")
    assert path == tmp_path / "run.nc"
    with xr.open_dataset(path, engine="h5netcdf") as data:
        xr.testing.assert_identical(data.load(), run.to_xarray())


def test_csv_header(run: cdcr.Trajectory, tmp_path: Path) -> None:
    with run.save(tmp_path / "run.csv").open(encoding="utf-8") as file:
        header = file.readline()
    assert header == (
        "t [s],q1_x [rad],q1_y [rad],qd1_x [rad/s],qd1_y [rad/s],"
        "tension1 [N],tension2 [N],tension3 [N],theta1 [rad],phi1 [rad],"
        "tip_x [m],tip_y [m],tip_z [m],kinetic_energy [J],potential_energy [J],energy [J]\n"
    )


def test_csv_round_trip_is_exact(run: cdcr.Trajectory, tmp_path: Path) -> None:
    with run.save(str(tmp_path / "run.csv")).open(encoding="utf-8", newline="") as file:
        _, *rows = csv.reader(file)
    values = np.array(rows, dtype=float)
    energies = np.stack([run.kinetic_energy, run.potential_energy, run.energy], axis=1)
    parts = [run.t[:, None], run.q, run.qd, run.tension, run.theta, run.phi, run.tip, energies]
    np.testing.assert_array_equal(values, np.hstack(parts))


def test_csv_needs_the_base_install_only(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in ("xarray", "pandas", "h5netcdf", "matplotlib"):
        monkeypatch.setitem(sys.modules, module, None)
    assert run.save(tmp_path / "run.csv").stat().st_size > 0


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_a_robot_without_cables(
    cableless_run: cdcr.Trajectory, tmp_path: Path, suffix: str
) -> None:
    path = cableless_run.save(tmp_path / f"run{suffix}")
    if suffix == ".nc":
        with xr.open_dataset(path, engine="h5netcdf") as data:
            assert data.sizes["cable"] == 0
            np.testing.assert_array_equal(data.theta, cableless_run.theta)
    else:
        assert "tension" not in path.read_text(encoding="utf-8")


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_no_silent_overwrite(run: cdcr.Trajectory, tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"run{suffix}"
    path.write_text("precious", encoding="utf-8")
    with pytest.raises(FileExistsError, match=rf"run\{suffix} exists already.*overwrite=True"):
        run.save(path)
    assert path.read_text(encoding="utf-8") == "precious"
    run.save(path, overwrite=True)
    assert not path.read_bytes().startswith(b"precious")
    assert list(tmp_path.iterdir()) == [path]


def test_a_file_that_appears_meanwhile_is_kept(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    with pytest.raises(FileExistsError), new_file(path) as partial:  # noqa: PT012
        partial.write_text("ours", encoding="utf-8")
        path.write_text("theirs", encoding="utf-8")
    assert path.read_text(encoding="utf-8") == "theirs"
    assert list(tmp_path.iterdir()) == [path]


def _failing_rows(error: type[BaseException]) -> Callable[..., Any]:
    """Make a csv.writer that fails after the third row."""
    real = csv.writer

    class Writer:
        def __init__(self, file: Any, **options: Any) -> None:
            self.file, self.real = file, real(file, **options)

        def writerow(self, row: list[str]) -> None:
            self.real.writerow(row)

        def writerows(self, rows: Any) -> None:
            for count, row in enumerate(rows):
                if count == 3:
                    self.file.flush()
                    raise error
                self.real.writerow(row)

    return Writer


@pytest.mark.parametrize("error", [OSError, KeyboardInterrupt])
def test_failing_half_way_leaves_nothing(
    run: cdcr.Trajectory,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    error: type[BaseException],
) -> None:
    monkeypatch.setattr(csv, "writer", _failing_rows(error))
    with pytest.raises(error):
        run.save(tmp_path / "run.csv")
    assert list(tmp_path.iterdir()) == []


def test_failing_half_way_keeps_the_old_file(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def write_half(self: Any, store: Any) -> None:
        store.ds.attrs["half"] = 1
        raise KeyboardInterrupt

    old = run.save(tmp_path / "run.nc").read_bytes()
    monkeypatch.setattr(xr.Dataset, "dump_to_store", write_half)
    with pytest.raises(KeyboardInterrupt):
        run.save(tmp_path / "run.nc", overwrite=True)
    assert (tmp_path / "run.nc").read_bytes() == old
    assert [path.name for path in tmp_path.iterdir()] == ["run.nc"]


def test_refusals_name_the_item(run: cdcr.Trajectory, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"must end in \.nc, \.csv or \.mcap, got 'run\.txt'"):
        run.save(tmp_path / "run.txt")
    with pytest.raises(FileNotFoundError, match=r"the folder .*missing does not exist"):
        run.save(tmp_path / "missing" / "run.csv")
    (tmp_path / "folder.csv").mkdir()
    with pytest.raises(IsADirectoryError, match=r"folder\.csv is a folder"):
        run.save(tmp_path / "folder.csv", overwrite=True)


@pytest.mark.parametrize("module", ["xarray", "h5netcdf"])
def test_missing_extra_is_named(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, module: str
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=rf'{module} .*pip install "cdcr\[data\]"'):
        run.save(tmp_path / "run.nc")
    assert list(tmp_path.iterdir()) == []


def test_a_dataframe_is_the_csv_file(run: cdcr.Trajectory, tmp_path: Path) -> None:
    frame = run.to_dataframe()
    header = run.save(tmp_path / "run.csv").read_text().splitlines()[0].split(",")
    assert [frame.index.name, *frame.columns] == header
    np.testing.assert_array_equal(frame.index, run.t)
    np.testing.assert_array_equal(frame["q1_y [rad]"], run.q[:, 1])
    np.testing.assert_array_equal(frame["tension1 [N]"], run.tension[:, 0])
