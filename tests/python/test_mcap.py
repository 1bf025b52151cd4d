"""Runs as MCAP logs, read back by the reader of the format."""

from __future__ import annotations

import json
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]
from typer.testing import CliRunner

import cdcr
from cdcr.cli.app import app
from cdcr.runs.mcap_log import quaternion

pytest.importorskip("mcap", reason="the extra mcap is not installed")
from mcap.reader import make_reader

ROUNDING = 1e-14
# What the JSON schemas of Foxglove ask of a message, in the version of August 2026:
# https://github.com/foxglove/foxglove-sdk/tree/main/schemas/jsonschema
REQUIRED = {
    "foxglove.PoseInFrame": {"timestamp", "frame_id", "pose"},
    "foxglove.FrameTransforms": {"transforms"},
    "foxglove.FrameTransform": {
        *("timestamp", "parent_frame_id", "child_frame_id", "translation", "rotation"),
    },
    "foxglove.SceneUpdate": {"deletions", "entities"},
    "foxglove.SceneEntity": {
        *("timestamp", "frame_id", "id", "lifetime", "frame_locked", "metadata"),
        *("arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"),
    },
    "foxglove.LinePrimitive": {
        *("type", "pose", "thickness", "scale_invariant", "points", "color", "colors", "indices"),
    },
    "foxglove.Pose": {"position", "orientation"},
    "foxglove.Vector3": {"x", "y", "z"},
    "foxglove.Point3": {"x", "y", "z"},
    "foxglove.Quaternion": {"x", "y", "z", "w"},
    "foxglove.Color": {"r", "g", "b", "a"},
}
TYPES = {"number": float, "integer": int, "string": str, "boolean": bool}

Log = tuple[dict[str, list[Any]], dict[str, Any], dict[str, str]]


def read(path: Path) -> Log:
    """Messages and schemas by topic, and what the log says of itself."""
    messages, schemas = defaultdict(list), {}
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        for schema, channel, message in reader.iter_messages():
            assert schema is not None
            assert (schema.encoding, channel.message_encoding) == ("jsonschema", "json")
            assert message.log_time == message.publish_time
            schemas[channel.topic] = json.loads(schema.data)
            assert schemas[channel.topic]["title"] == schema.name
            messages[channel.topic].append((message.log_time, json.loads(message.data)))
        (about,) = reader.iter_metadata()
    return messages, schemas, about.metadata


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    model = cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81)))
    tension = [4.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0]
    return cdcr.simulate(model, [0.1] * 6, [0.2] * 6, t=3.5 + np.arange(21) / 40, tension=tension)


@pytest.fixture(scope="module")
def log(run: cdcr.Trajectory, tmp_path_factory: pytest.TempPathFactory) -> Log:
    return read(run.save(tmp_path_factory.mktemp("log") / "run.mcap"))


def wrong(value: Any, schema: dict[str, Any], where: str) -> list[str]:
    """Where a message is not what its schema says."""
    if schema["type"] == "object":
        if set(value) != set(schema["properties"]):
            return [where]
        items = [(value[name], one, name) for name, one in schema["properties"].items()]
    elif schema["type"] == "array":
        items = [(one, schema["items"], str(i)) for i, one in enumerate(value)]
    else:
        return [] if type(value) is TYPES[schema["type"]] else [where]
    return [found for one in items for found in wrong(one[0], one[1], f"{where}.{one[2]}")]


def test_every_message_is_what_its_schema_says(run: cdcr.Trajectory, log: Log) -> None:
    messages, schemas, _ = log
    assert set(messages) == {"/state", "/tension", "/energy", "/tip_pose", "/tf", "/backbone"}
    times = [3_500_000_000 + 25_000_000 * k for k in range(21)]
    for topic, found in messages.items():
        assert [time for time, _ in found] == times
        for _, message in found:
            assert wrong(message, schemas[topic], topic) == []
    assert schemas["/state"]["properties"]["qd2_x"]["description"].endswith("[rad/s]")
    names = {topic: schema["title"] for topic, schema in schemas.items()}
    assert names["/tip_pose"] == "foxglove.PoseInFrame"
    assert names["/tf"] == "foxglove.FrameTransforms"
    assert names["/backbone"] == "foxglove.SceneUpdate"


def records(schema: dict[str, Any], value: Any) -> Iterator[tuple[str, set[str]]]:
    """Yield the title and the names of each record that a message holds."""
    if schema["type"] == "array":
        for one in value:
            yield from records(schema["items"], one)
    elif schema["type"] == "object":
        yield schema["title"], set(value)
        for name, one in schema["properties"].items():
            yield from records(one, value[name])


def test_messages_hold_all_that_foxglove_asks_for(log: Log) -> None:
    messages, schemas, _ = log
    found = {
        title: names
        for topic in ("/tip_pose", "/tf", "/backbone")
        for title, names in records(schemas[topic], messages[topic][0][1])
        if title.startswith("foxglove.")
    }
    assert found == REQUIRED


def test_what_is_wrong_is_found() -> None:
    schema = {"type": "object", "properties": {"a": {"type": "array", "items": {"type": "number"}}}}
    assert wrong({"a": [1.0, "2"]}, schema, "m") == ["m.a.1"]
    assert wrong({"b": []}, schema, "m") == ["m"]


def test_every_bit_of_every_number_is_kept(run: cdcr.Trajectory, log: Log) -> None:
    messages, _, about = log
    for topic, names, values in (
        ("/state", [f"q{i}_{axis}" for i in (1, 2, 3) for axis in "xy"], run.q),
        ("/state", [f"qd{i}_{axis}" for i in (1, 2, 3) for axis in "xy"], run.qd),
        ("/state", ["theta1", "theta2", "theta3"], run.theta),
        ("/tension", [f"tension{j}" for j in range(1, 10)], run.tension),
        ("/energy", ["energy"], run.energy[:, None]),
    ):
        found = [[message[name] for name in names] for _, message in messages[topic]]
        np.testing.assert_array_equal(found, values)
    assert (about["cdcr_version"], about["status"]) == (cdcr.__version__, "ok")
    assert json.loads(about["robot"])["gravity"] == [0.0, 0.0, -9.81]


def values(named: dict[str, float]) -> list[float]:
    return [named[name] for name in "xyzw" if name in named]


def test_poses_are_those_of_the_model(run: cdcr.Trajectory, log: Log) -> None:
    messages, _, _ = log
    for k, (time, message) in enumerate(messages["/tip_pose"]):
        R, p = run.model.tip(run.q[k])
        pose = message["pose"]
        np.testing.assert_allclose(values(pose["position"]), p, rtol=0.0, atol=ROUNDING)
        turned = Rotation.from_quat(values(pose["orientation"])).as_matrix()
        np.testing.assert_allclose(turned, R, rtol=0.0, atol=ROUNDING)
        stamp = message["timestamp"]
        assert stamp["sec"] * 1_000_000_000 + stamp["nsec"] == time
    for k, (_, message) in enumerate(messages["/tf"]):
        frames = message["transforms"]
        assert [one["child_frame_id"] for one in frames] == ["section1", "section2", "tip"]
        for i, one in enumerate(frames):
            R, p = run.model.pose(run.q[k], i, 1.0)
            np.testing.assert_allclose(values(one["translation"]), p, rtol=0.0, atol=ROUNDING)
            turned = Rotation.from_quat(values(one["rotation"])).as_matrix()
            np.testing.assert_allclose(turned, R, rtol=0.0, atol=ROUNDING)
    (entity,) = messages["/backbone"][7][1]["entities"]
    points = np.array([values(point) for point in entity["lines"][0]["points"]])
    np.testing.assert_allclose(points[[0, -1]], [[0.0] * 3, run.tip[7]], rtol=0.0, atol=ROUNDING)
    length = np.sum(np.linalg.norm(np.diff(points, axis=0), axis=1))
    np.testing.assert_allclose(length, run.model.robot.length, rtol=2e-3)  # chords


def test_lengths_that_were_asked_for_are_kept(tmp_path: Path) -> None:
    model = cdcr.Model(cdcr.scenarios.get("length-drive").robot)
    lengths = model.rest_command() - np.array([0.002] + [0.0] * 8)
    run = cdcr.simulate(model, [0.0] * 6, [0.0] * 6, t=[0.0, 0.1], command=lengths)
    messages, schemas, _ = read(run.save(tmp_path / "run.mcap"))
    assert messages["/tension"][1][1]["command1"] == lengths[0]
    assert messages["/tension"][1][1]["tension1"] == run.tension[1, 0] > 0.0
    assert "cable_energy" in schemas["/energy"]["properties"]


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1.0, np.pi - 1e-9, np.pi, 4.0])
@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0.6, 0.0, -0.8), (1, 1, 1)])
def test_quaternions_of_any_turn(angle: float, axis: tuple[float, ...]) -> None:
    R = Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis)).as_matrix()
    found = quaternion(R)
    assert found[3] >= 0.0
    np.testing.assert_allclose(np.linalg.norm(found), 1.0, rtol=ROUNDING)
    np.testing.assert_allclose(Rotation.from_quat(found).as_matrix(), R, rtol=0.0, atol=ROUNDING)


def test_refusals(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    run = cdcr.simulate(model, [0.0, 0.0], [0.0, 0.0], t=[-1.0, 0.0])
    with pytest.raises(ValueError, match=r"times of an MCAP log must be 0 to .* s, got -1 s"):
        run.save(tmp_path / "run.mcap")
    monkeypatch.setitem(sys.modules, "mcap.writer", None)
    with pytest.raises(ImportError, match=r'mcap .*pip install "cdcr\[mcap\]"'):
        run.save(tmp_path / "run.mcap")
    assert list(tmp_path.iterdir()) == []


def test_a_scenario_file_asks_for_a_log(tmp_path: Path) -> None:
    file = tmp_path / "pull.toml"
    file.write_text(
        "robot = 'amouri2020'\nt_end = 0.1\ntension = [1.0, 0.0, 0.0]\n"
        "[output]\nnum_samples = 3\nfiles = ['mcap']\n"
    )
    result = CliRunner().invoke(app, ["run", str(file), "--out", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    (path,) = (tmp_path / "out").iterdir()
    assert path.name == "pull.mcap"
    assert len(read(path)[0]["/state"]) == 3


def test_a_command_asks_for_a_log(tmp_path: Path) -> None:
    args = ["run", "step-tension", "--t-end", "0.02", "--out", str(tmp_path)]
    result = CliRunner().invoke(app, [*args, "--format", "mcap", "--format", "csv"])
    assert result.exit_code == 0, result.output
    assert {path.name for path in tmp_path.iterdir()} == {"step-tension.mcap", "step-tension.csv"}
    assert read(tmp_path / "step-tension.mcap")[2]["method"]
    result = CliRunner().invoke(app, [*args, "--format", "bag"])
    assert result.exit_code == 2
    assert "--format must be one of picture, csv, nc, mcap, got 'bag'" in result.output
    result = CliRunner().invoke(app, ["run", "block-diagram", "--format", "csv"])
    assert result.exit_code == 2
    assert "nothing runs in the scenario 'block-diagram', so it takes no --format" in result.output
