"""Files of closed loops: what runs save, and logs that C++ writes while a loop runs."""

import copy
import json
import os
import pickle
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=0.02))
START = [0.05, 0.0], [0.0, 0.0]
PATH = cdcr.ReferencePath.spline([0.0, 0.1, 0.3], [[0.0, 0.0], [0.2, 0.1], [-0.1, 0.2]])


def a_loop() -> cdcr.Loop:
    controller = cdcr.ComputedTorque(MODEL, period=2e-3)
    controller.path = PATH
    sensors = [cdcr.Sensor(kind="coordinates", noise=1e-4), cdcr.Sensor(kind="lengths", noise=1e-5)]
    estimator = cdcr.ExtendedKalman(MODEL, sensors=sensors, force_at=(0, 1.0))
    loop = cdcr.Loop(MODEL, controller, sensors=sensors, estimator=estimator)
    loop.reset(*START)
    return loop


@pytest.fixture(scope="module")
def run() -> cdcr.LoopRun:
    return a_loop().run(0.1)


def columns(run: cdcr.LoopRun) -> dict[str, Any]:
    """What a file must hold beside the motion, by column, without the clock."""
    found = {f"asked{j + 1}": run.asked[:, j] for j in range(3)}
    for i, axis in enumerate("xy"):
        found[f"told_q1_{axis}"] = run.told_q[:, i]
        found[f"told_qd1_{axis}"] = run.told_qd[:, i]
        found[f"reference_q1_{axis}"] = run.reference[:, i]
        found[f"sensor1_{i + 1}"] = run.measurements[0][:, i]
    for j in range(3):
        found[f"sensor2_{j + 1}"] = run.measurements[1][:, j]
    for name, values in run.estimated.items():
        found[f"estimated_{name}"] = values
        found[f"deviation_{name}"] = run.deviations[name]
    return found | {"innovation": run.innovation, "measured": run.measured}


def csv_columns(path: Path) -> dict[str, Any]:
    header = path.read_text().split("\n", 1)[0].split(",")
    table = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    return {name.split(" [")[0]: values for name, values in zip(header, table.T, strict=True)}


def mcap_columns(path: Path) -> tuple[dict[str, Any], set[str]]:
    """Numbers by name, and the topics."""
    reader = pytest.importorskip("mcap.reader", reason="the extra mcap is not installed")
    found: dict[str, list[float]] = defaultdict(list)
    topics = set()
    with path.open("rb") as file:
        for schema, channel, message in reader.make_reader(file).iter_messages():
            assert (schema.encoding, channel.message_encoding) == ("jsonschema", "json")
            topics.add(channel.topic)
            content = json.loads(message.data)
            if json.loads(schema.data)["title"].startswith("cdcr."):
                assert set(json.loads(schema.data)["properties"]) == set(content)
                for name, value in content.items():
                    found[name].append(value)
            found[channel.topic + " time"].append(message.log_time)
    return {name: np.array(values) for name, values in found.items()}, topics


def test_the_reference_is_what_the_controller_followed(run: cdcr.LoopRun) -> None:
    for k in range(0, 100, 2):
        wanted = PATH.evaluate(run.trajectory.t[k])[0]
        np.testing.assert_array_equal(run.reference[k : k + 2], [wanted, wanted])


def test_csv_has_what_the_loop_tells(run: cdcr.LoopRun, tmp_path: Path) -> None:
    path = run.save(tmp_path / "run.csv")
    found = csv_columns(path)
    for name, values in columns(run).items():
        np.testing.assert_array_equal(found[name], values, err_msg=name)
    np.testing.assert_array_equal(found["duration"], run.durations)
    again = cdcr.Trajectory.load(path, model=MODEL)
    np.testing.assert_array_equal(again.q, run.trajectory.q)


def test_netcdf_has_what_the_loop_tells(run: cdcr.LoopRun, tmp_path: Path) -> None:
    xarray = pytest.importorskip("xarray", reason="the extra data is not installed")
    pytest.importorskip("h5netcdf", reason="the extra data is not installed")
    path = run.save(tmp_path / "run.nc")
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        np.testing.assert_array_equal(data.asked, run.asked)
        np.testing.assert_array_equal(data.told_q[:, 0], run.told_q)
        np.testing.assert_array_equal(
            data.reference_q.sel(component="y")[:, 0], run.reference[:, 1]
        )
        np.testing.assert_array_equal(data.estimated_force_x, run.estimated["force_x"])
        np.testing.assert_array_equal(data.duration, run.durations)
        assert data.reference_q.attrs["units"] == "rad"
    np.testing.assert_array_equal(cdcr.Trajectory.load(path).qd, run.trajectory.qd)


def test_mcap_has_reference_and_timing(run: cdcr.LoopRun, tmp_path: Path) -> None:
    found, topics = mcap_columns(run.save(tmp_path / "run.mcap"))
    assert {"/state", "/tension", "/estimate", "/reference", "/sensors", "/timing"} <= topics
    for name, values in (columns(run) | {"duration": run.durations}).items():
        np.testing.assert_array_equal(found[name], values, err_msg=name)


@pytest.mark.parametrize("ending", ["csv", "npy", "mcap"])
def test_a_log_tells_what_run_tells_bit_for_bit(
    run: cdcr.LoopRun, tmp_path: Path, ending: str
) -> None:
    path, loop = tmp_path / f"loop.{ending}", a_loop()
    with cdcr.LoopLog(loop, path) as log:
        loop.run(0.05)
        for _ in range(50):
            assert loop.step() == cdcr.Status.ok
    assert (log.path, log.dropped) == (path, 0)
    if ending == "npy":
        rows = np.load(path)
        found = {name: rows[name] for name in rows.dtype.names}
    elif ending == "csv":
        found = csv_columns(path)
        read = cdcr.Trajectory.load(path, model=MODEL)
        np.testing.assert_array_equal(read.qd, run.trajectory.qd[:-1])
    else:
        found, topics = mcap_columns(path)
        names = ("state", "tension", "tip", "sensors", "estimate", "reference", "timing")
        assert topics == {f"/{name}" for name in names}
        np.testing.assert_array_equal(found["/state time"], 1_000_000 * np.arange(100))
    for name, values in columns(run).items():
        np.testing.assert_array_equal(found[name], values[:-1], err_msg=name)
    np.testing.assert_array_equal(found["q1_x"], run.trajectory.q[:-1, 0])
    tip = run.trajectory.tip[:-1, 2]  # of many states at once, which may round otherwise
    np.testing.assert_allclose(found["tip_z"], tip, rtol=0.0, atol=1e-14)
    assert (found["status"] == 0.0).all()
    asked = slice(None, None, 2)  # steps in which the controller was
    assert (found["step_duration"][asked] > found["duration"][asked]).all()


def test_columns_of_rods_have_their_units(tmp_path: Path) -> None:
    section = cdcr.robots.amouri2020(damping=0.02).sections[0]
    rod = cdcr.Robot(
        sections=[cdcr.Section(**vars(section) | {"bending_order": 1, "stretch_order": 0})],
    )
    model = cdcr.Model(rod)
    controller = cdcr.ComputedTorque(model)
    loop = cdcr.Loop(model, controller, substeps=40)
    loop.reset(np.zeros(model.num_coordinates), np.zeros(model.num_coordinates))
    header = loop.run(0.002).save(tmp_path / "run.csv").read_text().split("\n", 1)[0].split(",")
    with cdcr.LoopLog(loop, tmp_path / "log.csv"):
        loop.run(0.002)
    logged = (tmp_path / "log.csv").read_text().split("\n", 1)[0].split(",")
    names = ["told_e1 [m]", "told_ed1 [m/s]", "reference_q1_x_1 [rad]", "told_qd1_x_1 [rad/s]"]
    for name in [*names, "e1 [m]", "ed1 [m/s]", "asked1 [N]"]:
        assert name in header
        assert name in logged


def test_a_ring_that_is_full_drops_and_counts(tmp_path: Path) -> None:
    loop = a_loop()
    with cdcr.LoopLog(loop, tmp_path / "loop.npy", capacity=1) as log:
        loop.run(0.2)
    assert len(np.load(tmp_path / "loop.npy")) + log.dropped == 200


def test_refusals(tmp_path: Path) -> None:
    loop, path = a_loop(), tmp_path / "loop.csv"
    with cdcr.LoopLog(loop, path):
        with pytest.raises(ValueError, match="the loop writes a log already: close that first"):
            cdcr.LoopLog(loop, tmp_path / "other.csv")
        assert not (tmp_path / "other.csv").exists()
    with pytest.raises(FileExistsError, match="overwrite=True"):
        cdcr.LoopLog(loop, path)
    cdcr.LoopLog(loop, path, overwrite=True).close()
    with pytest.raises(ValueError, match=r"must end in .csv, .npy or .mcap, got 'loop.nc'"):
        cdcr.LoopLog(loop, tmp_path / "loop.nc")
    with pytest.raises(ValueError, match="capacity must be a whole number 1 to 16777216, got 0"):
        cdcr.LoopLog(loop, tmp_path / "new.csv", capacity=0)
    with pytest.raises(FileNotFoundError, match="does not exist; make it first"):
        cdcr.LoopLog(loop, tmp_path / "no" / "loop.csv")
    assert [file.name for file in tmp_path.iterdir()] == ["loop.csv"]
    loop.step()


def test_a_file_has_one_log(tmp_path: Path) -> None:
    path = tmp_path / "loop.csv"
    with cdcr.LoopLog(a_loop(), path) as log:
        with pytest.raises(FileExistsError, match="another log is written to"):
            cdcr.LoopLog(a_loop(), path, overwrite=True)
        assert repr(log) == f"<LoopLog to {path}, open, 0 rows dropped>"
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match="LoopLog can be neither pickled nor copied"):
                copied(log)
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    with pytest.raises(ValueError, match="is a pipe or a device, not a file to write to"):
        cdcr.LoopLog(a_loop(), pipe, overwrite=True)


def test_scenarios_of_closed_loops_write_it_too(tmp_path: Path) -> None:
    run = cdcr.scenarios.get("estimator").simulate(t_end=0.02)
    found = csv_columns(run.save(tmp_path / "run.csv"))
    assert {"asked1", "told_q1_x", "duration", "innovation"} <= set(found)
    assert any(name.startswith("reference_") for name in found)
