"""Estimates by three filters beside the truth."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.runs.loop import LoopRun
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, run_metrics

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

NAMES = ("extended filter", "unscented filter", "lengths alone")
LATE = 0.5  # share of the run after which errors of the start have gone


def _loops(closed: Any) -> dict[str, Any]:
    """Return the scenario's loop, and the same with other filters."""
    unscented = replace(closed, estimator=replace(closed.estimator, kind="unscented-kalman"))
    alone = replace(closed, options=closed.options | {"sensors": closed.options["sensors"][:1]})
    return dict(zip(NAMES, (closed, unscented, alone), strict=True))


@lru_cache(maxsize=1)
def runs(scenario: Scenario, t_end: float) -> dict[str, LoopRun]:
    """Return the loops with each filter, by name."""
    model, loops = scenario.model, _loops(scenario.input_source)
    start, t = (scenario.start(model), scenario.qd0), scenario.times(t_end)
    return {name: one.run_loop(model, *start, t) for name, one in loops.items()}


def error(run: LoopRun) -> FloatArray:
    """Return the largest error of a coordinate at each sample [deg]."""
    off = np.abs(run.told_q[:-1] - run.trajectory.q[:-1]).max(axis=1)
    return np.asarray(np.rad2deg(off))


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return what every run shows, errors, and how honest the filter is."""
    found = runs(scenario, float(run.t[-1]))
    late = found[NAMES[0]].trajectory.t[:-1] >= LATE * run.t[-1]
    metrics = [*run_metrics(scenario, run)]
    for key, name in zip(("extended", "unscented", "lengths"), NAMES, strict=True):
        root = float(np.sqrt(np.mean(error(found[name])[late] ** 2)))
        metrics.append(Metric(f"error_{key}_deg", f"{name}: error, second half", root, "deg"))
    first = found[NAMES[0]]
    ratio = float(first.innovation[1:].sum() / first.measured[1:].sum())
    return (*metrics, Metric("innovation", "innovation over what is expected", ratio, "1"))
