"""A few seconds of computing, compared with numbers that are known: whether cdcr works here.

``self_test.json`` holds three robots in a state each, two of arcs and one of rods. Accelerations,
energy and tip are from sums over elements differentiated at 40 digits, those of the rods from power
series at 55: numbers in which the library took no part.
"""

from __future__ import annotations

import io
import json
import math
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

import cdcr
from cdcr.base.arrays import FloatArray
from cdcr.runs.simulate import available

EXACT = 1e-9  # of what is exact to rounding, which processors and libraries differ in
INTEGRATED = 1e-6  # of a run at the default tolerances [rad]
# q after 1 s of RUN, by Dormand-Prince at rtol 1e-13 [rad]; Runge-Kutta 4 agrees to 1e-14.
END = (0.25052694138, -0.022074227465)
RUN: dict[str, Any] = {"t": [0.0, 1.0], "tension": [5.0, 0.0, 0.0]}
STEPS = 2000  # of the simulator that is timed


@dataclass(frozen=True)
class Outcome:
    """What a check gave: how far it was off, or why it failed."""

    name: str
    tolerance: float
    residual: float | None = None
    failure: str = ""

    @property
    def ok(self) -> bool:
        """Whether all is well."""
        return self.residual is not None and self.residual <= self.tolerance


def self_test(*, pictures: bool, netcdf: bool) -> Iterator[Outcome]:
    """Yield the outcome of each check; of pictures and netCDF files where these can be made."""
    for case in json.loads(Path(__file__).with_suffix(".json").read_text(encoding="utf-8")):
        size = len(case["sections"])
        words = (
            "one section" if size == 1 else f"{size} {'rods' if 'cables' in case else 'sections'}"
        )
        yield _outcome(f"dynamics of {words}", EXACT, partial(_dynamics, case))
    yield _outcome("rest under tension", EXACT, _rest)
    yield _outcome("natural frequency", EXACT, _frequency)
    yield _outcome("tensions for a force", EXACT, _tensions)
    yield _outcome("inverse kinematics", EXACT, _inverse)
    for method in ("rk4", "auto", "dopri5", "dop853", "bdf", "adams"):
        if available(method):
            yield _outcome(f"integration by {method}", INTEGRATED, partial(_integration, method))
    yield _outcome("run and robot written and read", 0.0, partial(_files, netcdf=netcdf))
    if pictures:
        yield _outcome("a picture", 0.0, _picture)


def step_time() -> float:
    """Return how long a step of 1 ms of the simulator takes from Python [s], the quickest of 5."""
    simulator = cdcr.Simulator(_model())
    simulator.reset([0.0, 0.0], [0.0, 0.0])
    tension, took = np.array([5.0, 0.0, 0.0]), []
    for _ in range(5):
        start = time.perf_counter()
        for _ in range(STEPS):
            simulator.step(tension)
        took.append((time.perf_counter() - start) / STEPS)
    return min(took)


def _outcome(name: str, tolerance: float, check: Callable[[], float]) -> Outcome:
    try:
        off = float(check())
        if math.isfinite(off):
            return Outcome(name, tolerance, off)
        return Outcome(name, tolerance, failure="gives what is not finite")
    except Exception as error:  # whatever goes wrong is what is looked for
        return Outcome(name, tolerance, failure=f"{type(error).__name__}: {error}")


def _model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020(damping=0.01))


def _off(found: Any, wanted: Any) -> float:
    """Return the largest difference, over the largest wanted."""
    difference: FloatArray = np.abs(np.asarray(found) - np.asarray(wanted))
    return float(difference.max() / np.abs(wanted).max())


def _dynamics(case: dict[str, Any]) -> float:
    model, q, qd = cdcr.Model(_robot(case)), case["q"], case["qd"]
    tension = case["tension"] if "tension" in case else np.concatenate(case["tensions"])
    qdd = model.forward_dynamics(q, qd, tension)
    return max(
        _off(qdd, case["qdd"]),
        _off(model.kinetic_energy(q, qd), case["kinetic_energy"]),
        _off(model.tip(q)[1], case["tip_position"]),
    )


def _robot(case: dict[str, Any]) -> cdcr.Robot:
    """Return the robot of a case; of rods orders below 0 are locked, and sections count from 1."""
    loads = {"gravity": case["gravity"], "payload": case["payload"]}
    if "cables" not in case:
        return cdcr.Robot(sections=[cdcr.Section(**one) for one in case["sections"]], **loads)
    given: list[dict[str, Any]] = [
        {key: None if value == -1 else value for key, value in one.items()}
        for one in case["sections"]
    ]
    sections = [cdcr.Section(**one, nodes=32) for one in given]
    cables = [cdcr.Cable(**one | {"end_section": one["end_section"] - 1}) for one in case["cables"]]
    return cdcr.Robot(sections=sections, cables=cables, **loads)


def _rest() -> float:
    """Without gravity K theta = r F, exactly."""
    model = _model()
    (section,) = model.robot.sections
    wanted = section.cable_radius * 5.0 / section.stiffness
    return _off(model.equilibrium([5.0, 0.0, 0.0]), [wanted, 0.0])


def _frequency() -> float:
    """Of the straight robot, the square root of stiffness over inertia."""
    model = _model()
    inertia = model.mass_matrix([0.0, 0.0])[0, 0]
    wanted = np.sqrt(model.robot.sections[0].stiffness / inertia)
    return _off(model.modes([0.0, 0.0], [0.0, 0.0, 0.0]).frequency, [wanted, wanted])


def _tensions() -> float:
    model, force = cdcr.Model(cdcr.robots.three_sections()), [0.1, -0.05, 0.02, 0.03, 0.01, -0.01]
    return _off(model.actuation_matrix() @ model.allocate(force), force)


def _inverse() -> float:
    model = cdcr.Model(cdcr.robots.three_sections())
    goal = model.tip([0.3, 0.2, -0.4, 0.1, 0.2, 0.5])[1]
    return _off(model.tip(model.inverse_kinematics(goal).q)[1], goal)


def _integration(method: Any) -> float:
    run = cdcr.simulate(_model(), [0.3, 0.1], [0.0, 0.5], method=method, throw=True, **RUN)
    return float(np.abs(run.q[-1] - END).max())


def _files(*, netcdf: bool) -> float:
    """Numbers of files come back exactly."""
    model = _model()
    run = cdcr.simulate(model, [0.3, 0.1], [0.0, 0.5], method="rk4", **RUN)
    with tempfile.TemporaryDirectory() as folder:
        model.robot.save(Path(folder) / "robot.toml")
        if cdcr.Robot.load(Path(folder) / "robot.toml") != model.robot:
            return 1.0
        off = 0.0
        for suffix in (".csv", *([".nc"] if netcdf else [])):
            path = Path(folder) / f"run{suffix}"
            run.save(path)
            off = max(off, float(np.abs(cdcr.Trajectory.load(path, model=model).q - run.q).max()))
    return off


def _picture() -> float:
    run = cdcr.simulate(_model(), [0.3, 0.1], [0.0, 0.5], method="rk4", **RUN)
    file = io.BytesIO()
    run.plot().savefig(file, format="png")
    return 0.0 if file.getvalue().startswith(b"\x89PNG") else 1.0
