"""The [trajectory] table of scenario files: samples, a CSV file, or a shape.

[trajectory]
shape = "circle"                # or "line", "swing", "move"
theta_deg = 15.0                # of all sections, or an array with one for each
turns_per_second = 0.1
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray, check_step
from cdcr.base.check import count, nearest
from cdcr.files.number_csv import RUN_TIME, Layout, read_numbers
from cdcr.files.refusals import named_by
from cdcr.files.toml import format_toml, refuse, schema_errors
from cdcr.model.coordinates import bending
from cdcr.model.model import Model
from cdcr.motion.placed import placed
from cdcr.motion.reference import Reference
from cdcr.motion.splines import Motion, bending_vectors
from cdcr.runs.export import all_bend_evenly, columns_of
from cdcr.scenarios.file.tracking import TrackedMotion, driven_by_length
from cdcr.scenarios.file.values import (
    error_prefix,
    numbers_of,
    of_sections,
    refuse_function,
    rival_errors,
)

AT = "trajectory"
_LIMITS = ("min_tension", "max_tension", "infeasible")
_COMMON = (*_LIMITS, "simulate", "step", "shorter")


def read_trajectory(table: dict[str, Any], model: Model, t_end: float, file: Path) -> TrackedMotion:
    """Return the motion of a [trajectory] table, or refuse it with file, key and value."""
    num_sections = model.num_sections
    from cdcr.scenarios.file.shape_schema import TrajectoryFile, TrajectorySamples

    given = [key for key in ("shape", "t", "file") if key in table]
    if len(given) != 1:
        got = f", got {' and '.join(given)}" if given else ""
        refuse(str(file), [f"{AT} must have one of shape, t or file{got}"])
    options: dict[str, Any] = {key: table[key] for key in _COMMON if key in table}
    low, high = options.get("min_tension", 0.0), options.get("max_tension", math.inf)
    if given == ["shape"]:
        motion, error = placed(_shape(table, num_sections, file), model), (0.0, 0.0)
    else:
        schema = TrajectoryFile if given == ["file"] else TrajectorySamples
        refuse(str(file), [*schema_errors(schema, table, AT), *rival_errors(table, AT)])
        reference = _samples(table, model, file)
        motion, error = reference.evaluate, reference.derivative_error
        if reference.t[0] > 0.0 or reference.t[-1] < t_end:
            reach = f"{reference.t[0]:g} to {reference.t[-1]:g} s"
            sentence = f"{AT} must reach over the run, 0 to {t_end:g} s, got {reach}"
            refuse(str(file), [sentence])
    refuse(str(file), _drive_errors(table, model))
    if low > high:
        sentence = f"{AT}.max_tension must be at least min_tension, {low:g} N, got {high:g}"
        refuse(str(file), [sentence])
    where = f"{file}, [{AT}]"
    if table.get("simulate", False):
        with error_prefix(where):
            if "step" in table:
                check_step(t_end, table["step"])
            else:
                refuse_function(model, "give step, which samples the commands")
    return TrackedMotion(motion=motion, derivative_error=error, where=where, **options)


def _drive_errors(table: Mapping[str, Any], model: Model) -> list[str]:
    """Return a sentence for each key that does not go with how the cables are driven."""
    if not driven_by_length(model):
        wrong = ["shorter"] if "shorter" in table else []
        return [f"{AT}.{key} needs a robot whose cables are all driven by length" for key in wrong]
    found = [
        f"{AT}.{key} needs cables driven by tension; this robot's are driven by length"
        for key in _LIMITS
        if key in table
    ]
    if not table.get("simulate", False):
        found.append(f"{AT} of a robot driven by length needs simulate = true")
    return found


def _shape(table: dict[str, Any], num_sections: int, file: Path) -> Motion:
    from cdcr.scenarios.file.shape_schema import TRAJECTORY_SHAPES

    refuse(str(file), shape_errors(TRAJECTORY_SHAPES, table, AT))
    with error_prefix(str(file)):
        return _MOTIONS[table["shape"]](_Angles(table, num_sections))


def shape_errors(shapes: Mapping[str, Any], table: Mapping[str, Any], at: str) -> list[str]:
    """Return a sentence for an unknown shape, or one for each key that its table does not allow."""
    return kind_errors(shapes, table, at, "shape")


def kind_errors(kinds: Mapping[str, Any], table: Mapping[str, Any], at: str, key: str) -> list[str]:
    """Return the same where the kind of the table stands in another key than its shape."""
    kind = table.get(key)
    if not isinstance(kind, str) or kind not in kinds:
        known = ", ".join(f'"{name}"' for name in kinds)
        if key not in table:
            return [f"{at}.{key} is missing; it must be one of {known}"]
        guess = nearest(kind, kinds) if isinstance(kind, str) else ""
        return [f"{at}.{key} must be one of {known}, got {format_toml(kind)}.{guess}".rstrip(".")]
    return schema_errors(kinds[kind], table, at)


class _Angles:
    """Reads values for all sections from a table."""

    def __init__(self, table: Mapping[str, Any], num_sections: int) -> None:
        self.table, self.num_sections = table, num_sections

    def __call__(self, key: str, default: float | None = None) -> FloatArray:
        return of_sections(self.table, key, self.num_sections, AT, default)


def _with_rates(value: FloatArray, rate: FloatArray, acceleration: FloatArray) -> FloatArray:
    return np.stack(np.broadcast_arrays(value, rate, acceleration))


def _even(t: FloatArray, start: FloatArray, rate: FloatArray) -> FloatArray:
    """Return angles (3, M, n) that grow at constant rates (n,)."""
    return _with_rates(start + np.outer(t, rate), rate, np.zeros(1))


def _circle(angles: _Angles) -> Motion:
    theta, phi = angles("theta"), angles("phi", 0.0)
    rate = 2.0 * math.pi * angles("turns_per_second")
    return lambda t: bending_vectors(_even(t, theta, 0.0 * rate), _even(t, phi, rate))


def _line(angles: _Angles) -> Motion:
    theta, phi, rate = angles("theta", 0.0), angles("phi", 0.0), angles("theta_rate")
    return lambda t: bending_vectors(_even(t, theta, rate), _even(t, phi, 0.0 * rate))


def _swing(angles: _Angles) -> Motion:
    amplitude, phi = angles("amplitude"), angles("phi", 0.0)
    speed = 2.0 * math.pi * angles.table["frequency"]

    def motion(t: FloatArray) -> FloatArray:
        sine, cosine = (
            np.outer(np.sin(speed * t), amplitude),
            np.outer(np.cos(speed * t), amplitude),
        )
        theta = _with_rates(sine, speed * cosine, -(speed**2) * sine)
        return bending_vectors(theta, _even(t, phi, 0.0 * phi))

    return motion


def _move(angles: _Angles) -> Motion:
    goal = bending(angles("theta"), angles("phi", 0.0))
    start, duration = angles.table.get("start", 0.0), angles.table["duration"]
    back = angles.table.get("back")
    if back is not None and back < start + duration:
        end = start + duration
        raise ValueError(f"{AT}.back must be {end:g} s, the end of the move, or more, got {back:g}")

    def motion(t: FloatArray) -> FloatArray:
        share = _rise(t - start, duration)
        if back is not None:
            share = share - _rise(t - back, duration)
        return np.stack([np.outer(one, goal) for one in share])

    return motion


def _rise(t: FloatArray, duration: float) -> FloatArray:
    """Return the quintic from 0 to 1 that starts and ends without speed or acceleration (3, M)."""
    s = np.clip(t / duration, 0.0, 1.0)
    return np.stack(
        [
            s**3 * (10.0 - 15.0 * s + 6.0 * s**2),
            30.0 * s**2 * (1.0 - s) ** 2 / duration,
            60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / duration**2,
        ]
    )


_MOTIONS = {"circle": _circle, "line": _line, "swing": _swing, "move": _move}


def _samples(table: dict[str, Any], model: Model, file: Path) -> Reference:
    if "file" in table:
        path = file.parent / table["file"]
        with named_by(f"{file}, {AT}.file"):
            t, given = read_csv(path, model)
            with error_prefix(str(path)):
                return _reference(t, given, model)
    given = {key: np.array(_rows(table, key, model, file)) for key in _SAMPLED & set(table)}
    for key, rows in given.items():
        if len(rows) != len(table["t"]):
            requirement = f"as many rows as t, {len(table['t'])}, got {len(rows)}"
            refuse(str(file), [f"{AT}.{key} must have {requirement}"])
    if "q" not in given and not {"theta", "theta_deg"} & set(given):
        refuse(str(file), [f"{AT} must have q, theta or theta_deg beside t"])
    with error_prefix(f"{file}, [{AT}]"):
        return _reference(table["t"], given, model)


_SAMPLED = {"q", "theta", "theta_deg", "phi", "phi_deg"}


def _rows(table: dict[str, Any], key: str, model: Model, file: Path) -> list[list[float]]:
    """Return the rows of a key; for one section they may be numbers."""
    length, _ = numbers_of(key, model)
    rows = [row if isinstance(row, list) else [row] for row in table[key]]
    for i, row in enumerate(rows):
        if len(row) != length:
            must = f"must have {count(length, 'number')} for this robot"
            refuse(str(file), [f"{AT}.{key}[{i}] {must}, got {format_toml(table[key][i])}"])
    return rows


def _reference(t: list[float], given: Mapping[str, FloatArray], model: Model) -> Reference:
    if "q" in given:
        return Reference.from_samples(t, given["q"])
    angles = {}
    for key in ("theta", "phi"):
        in_degrees = np.deg2rad(given.get(f"{key}_deg", np.zeros(1)))
        angles[key] = given.get(key, in_degrees)
    if angles["phi"].size == 1:
        angles["phi"] = np.zeros(())
    return Reference.from_angles(t, angles["theta"], angles["phi"]).on(model)


def read_csv(path: Path, model: Model) -> tuple[list[float], dict[str, FloatArray]]:
    """Return the times of a file of samples, and its rows by the keys of a [trajectory]."""
    sections = range(1, model.num_sections + 1)
    layouts = []
    for theta, phi, unit in (("theta_deg", "phi_deg", "deg"), ("theta", "phi", "rad")):
        columns = tuple(f"{key} {i}" for i in sections for key in (theta, phi))
        layouts.append(Layout(columns, f"a number [{unit}]"))
    if all_bend_evenly(model):
        columns = tuple(f"q {i} {axis}" for i in sections for axis in "xy")
        layouts.append(Layout(columns, "a number [rad]"))
    layouts.append(Layout(tuple(columns_of(model, "q")), "a number [rad]", time=RUN_TIME))
    layout, t, rows = read_numbers(path, "trajectory file", layouts)
    values = np.array(rows)
    if layout in layouts[2:]:
        return t, {"q": values}
    suffix = "_deg" if layout is layouts[0] else ""
    return t, {f"theta{suffix}": values[:, 0::2], f"phi{suffix}": values[:, 1::2]}
