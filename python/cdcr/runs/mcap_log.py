"""Runs as MCAP logs, which Foxglove opens: channels of JSON messages, each with its schema."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.extras import require
from cdcr.runs.export import Quantity, attributes, column_names, quantities

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory

# Channels of plain numbers: the quantities that each holds.
_NUMBERS = {
    "state": ("q", "qd", "theta", "phi"),
    "tension": ("tension", "command"),
    "energy": ("kinetic_energy", "potential_energy", "energy", "cable_energy"),
}
BASE, TIP = "base", "tip"  # frames; section1, section2, ... are the ends of the others
PIECES = 16  # straight pieces of a section's backbone in the scene
NANO = 1_000_000_000
MAX_TIME = 2**63 / NANO  # [s]

Json = dict[str, Any]


class Channel(NamedTuple):
    """A topic, what its messages are, and one for each sample."""

    topic: str
    schema: Json
    messages: Iterable[Json]


def _record(title: str, **properties: Json) -> Json:
    return {"type": "object", "title": title, "properties": properties}


def _array(of: Json) -> Json:
    return {"type": "array", "items": of}


# Messages that Foxglove knows by name: https://docs.foxglove.dev/docs/sdk/schemas
_NUMBER, _INTEGER, _TEXT, _BOOL = (
    {"type": name} for name in ("number", "integer", "string", "boolean")
)
_TIME = _record("time", sec=_INTEGER, nsec=_INTEGER)
_DURATION = _record("duration", sec=_INTEGER, nsec=_INTEGER)
_VECTOR = _record("foxglove.Vector3", **dict.fromkeys("xyz", _NUMBER))
_POINT = _record("foxglove.Point3", **dict.fromkeys("xyz", _NUMBER))
_QUATERNION = _record("foxglove.Quaternion", **dict.fromkeys("xyzw", _NUMBER))
_COLOR = _record("foxglove.Color", **dict.fromkeys("rgba", _NUMBER))
_POSE = _record("foxglove.Pose", position=_VECTOR, orientation=_QUATERNION)
_POSE_IN_FRAME = _record("foxglove.PoseInFrame", timestamp=_TIME, frame_id=_TEXT, pose=_POSE)
_TRANSFORM = _record(
    "foxglove.FrameTransform",
    timestamp=_TIME,
    parent_frame_id=_TEXT,
    child_frame_id=_TEXT,
    translation=_VECTOR,
    rotation=_QUATERNION,
)
_TRANSFORMS = _record("foxglove.FrameTransforms", transforms=_array(_TRANSFORM))
_LINE = _record(
    "foxglove.LinePrimitive",
    type=_INTEGER,
    pose=_POSE,
    thickness=_NUMBER,
    scale_invariant=_BOOL,
    points=_array(_POINT),
    color=_COLOR,
    colors=_array(_COLOR),
    indices=_array(_INTEGER),
)
_PAIR = _record("foxglove.KeyValuePair", key=_TEXT, value=_TEXT)
# What else an entity may be drawn as: asked for by the schema, empty in our scenes.
_OTHERS = {
    "arrows": "ArrowPrimitive",
    "cubes": "CubePrimitive",
    "spheres": "SpherePrimitive",
    "cylinders": "CylinderPrimitive",
    "triangles": "TriangleListPrimitive",
    "texts": "TextPrimitive",
    "models": "ModelPrimitive",
}
_ENTITY = _record(
    "foxglove.SceneEntity",
    timestamp=_TIME,
    frame_id=_TEXT,
    id=_TEXT,
    lifetime=_DURATION,
    frame_locked=_BOOL,
    metadata=_array(_PAIR),
    lines=_array(_LINE),
    **{name: _array(_record(f"foxglove.{title}")) for name, title in _OTHERS.items()},
)
_DELETION = _record("foxglove.SceneEntityDeletion", timestamp=_TIME, type=_INTEGER, id=_TEXT)
_SCENE = _record("foxglove.SceneUpdate", deletions=_array(_DELETION), entities=_array(_ENTITY))
_NO_TURN = {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}


def write_mcap(run: Trajectory, path: Path) -> None:
    """Write a run as an MCAP log to a file of any name; see Trajectory.save."""
    writing: Any = require("mcap.writer", "mcap")
    times = _nanoseconds(run)
    with path.open("wb") as file:
        writer = writing.Writer(file)
        writer.start(library=f"cdcr {_core.__version__}")
        about = {name: str(value) for name, value in attributes(run).items()}
        writer.add_metadata("cdcr", about)
        messages = []
        for topic, schema, contents in _channels(run, [_stamp(time) for time in times]):
            text = json.dumps(schema).encode()
            registered = writer.register_schema(schema["title"], "jsonschema", text)
            channel = writer.register_channel(topic, "json", registered)
            messages.append((channel, iter(contents)))
        for number, time in enumerate(times):  # in the order of time, as readers like it
            for channel, contents in messages:
                data = json.dumps(next(contents)).encode()
                writer.add_message(channel, time, data, time, number)
        writer.finish()


def _nanoseconds(run: Trajectory) -> list[int]:
    for time in (run.t[0], run.t[-1]):
        if not 0.0 <= time < MAX_TIME:
            raise ValueError(f"times of an MCAP log must be 0 to {MAX_TIME:.3g} s, got {time:g} s")
    return [round(time * NANO) for time in run.t.tolist()]


def _stamp(time: int) -> Json:
    return {"sec": time // NANO, "nsec": time % NANO}


def _channels(run: Trajectory, stamps: list[Json]) -> Iterator[Channel]:
    for topic, names in _NUMBERS.items():
        own = [item for item in quantities(run) if item.name in names]
        yield _numbers(run, topic, [*own, *run.channels.get(topic, ())])
    for topic, items in run.channels.items():
        if topic not in _NUMBERS:
            yield _numbers(run, topic, list(items))
    model, last = run.model, run.model.num_sections - 1
    ends = [*(model.pose(run.q, i, 1.0) for i in range(last)), model.tip(run.q)]
    frames = [f"section{i + 1}" for i in range(last)] + [TIP]
    poses = [[_pose(*one) for one in zip(*end, strict=True)] for end in ends]
    yield Channel(
        "/tip_pose",
        _POSE_IN_FRAME,
        (
            {"timestamp": stamp, "frame_id": BASE, "pose": pose}
            for stamp, pose in zip(stamps, poses[last], strict=True)
        ),
    )
    yield Channel(
        "/tf",
        _TRANSFORMS,
        (
            {"transforms": [_transform(stamp, *one) for one in zip(frames, now, strict=True)]}
            for stamp, *now in zip(stamps, *poses, strict=True)
        ),
    )
    yield Channel("/backbone", _SCENE, _scenes(run, stamps))


def _numbers(run: Trajectory, topic: str, items: list[Quantity]) -> Channel:
    """Make a channel of numbers with the names that a CSV file has."""
    names: list[str] = []
    fields: Json = {}
    columns = []
    for item in items:
        new = column_names(run.model, item.name, item.dims)
        fields |= dict.fromkeys(new, _NUMBER | {"description": f"{item.long_name} [{item.units}]"})
        names += new
        columns.append(item.values.reshape(len(run), -1))
    schema = _record(f"cdcr.{topic.capitalize()}", **fields)
    rows = np.concatenate(columns, axis=1)
    return Channel(
        f"/{topic}", schema, (dict(zip(names, row.tolist(), strict=True)) for row in rows)
    )


def _scenes(run: Trajectory, stamps: list[Json]) -> Iterator[Json]:
    """Yield the backbone as a line, for the 3D panel."""
    robot = run.model.robot
    line = [np.tile(robot.base_position, (len(run), 1))]
    for i in range(len(robot.sections)):
        line += [run.model.pose(run.q, i, k / PIECES)[1] for k in range(1, PIECES + 1)]
    look = {
        "type": 0,  # a strip
        "pose": {"position": _named((0.0, 0.0, 0.0)), "orientation": _NO_TURN},
        "thickness": max(max(section.diameters) for section in robot.sections),
        "scale_invariant": False,
        "color": {"r": 0.13, "g": 0.13, "b": 0.13, "a": 1.0},
        "colors": [],
        "indices": [],
    }
    nothing: Json = {name: [] for name in ("metadata", *_OTHERS)}
    for stamp, points in zip(stamps, np.stack(line, axis=1).tolist(), strict=True):
        entity = {
            "timestamp": stamp,
            "frame_id": BASE,
            "id": "backbone",
            "lifetime": {"sec": 0, "nsec": 0},  # until the next
            "frame_locked": True,
            "lines": [look | {"points": [_named(point) for point in points]}],
        }
        yield {"deletions": [], "entities": [entity | nothing]}


def _transform(stamp: Json, frame: str, pose: Json) -> Json:
    names = {"timestamp": stamp, "parent_frame_id": BASE, "child_frame_id": frame}
    return names | {"translation": pose["position"], "rotation": pose["orientation"]}


def _pose(R: FloatArray, p: FloatArray) -> Json:
    return {"position": _named(p.tolist()), "orientation": _named(quaternion(R))}


def _named(values: Iterable[float]) -> Json:
    return dict(zip("xyzw", values, strict=False))


def quaternion(R: FloatArray) -> tuple[float, float, float, float]:
    """Return the unit quaternion x, y, z, w of a rotation matrix (3, 3), with w >= 0.

    From its largest component times all four, times 4, so that nothing small is divided by.
    """
    trace = float(np.trace(R))
    squares = [1.0 + 2.0 * float(R[i, i]) - trace for i in range(3)] + [1.0 + trace]
    odd = [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]]
    even = R + R.T
    largest = int(np.argmax(squares))
    row = [float(v) for v in (odd if largest == 3 else even[largest])] + [float(odd[largest % 3])]
    row[largest] = squares[largest]
    found = np.array(row) / np.linalg.norm(row)
    x, y, z, w = (found if found[3] >= 0.0 else -found).tolist()
    return x, y, z, w
