"""The numbers that a sweep keeps of each run: one list of names, units and meanings."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import NamedTuple, TypeAlias

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import format_value, is_iterable, nearest, short
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric, settling_time, time_mean
from cdcr.scenarios.scenario import Scenario

SETTLED = 0.02  # of the largest distance of the tip from its last place
CALM = 0.1  # of a run, at its end, in which the tip must be settled


Function: TypeAlias = Callable[[Trajectory], float]


class RunMetric(NamedTuple):
    """A number of a run: how it is computed, its unit and what it is.

    Parameters
    ----------
    function : callable
        From a `cdcr.Trajectory` to the number, NaN where the run has none.
    unit : str
        Its unit; "1" where it has none.
    about : str
        What it is.

    Examples
    --------
    >>> import cdcr.sweeps
    >>> cdcr.sweeps.METRICS["peak_tip_speed"].unit
    'm/s'
    """

    function: Function
    unit: str
    about: str


MetricNames: TypeAlias = str | Function | Sequence[str | Function] | Mapping[str, Function]


def _settling_time(run: Trajectory) -> float:
    t, away = run.t - run.t[0], np.linalg.norm(run.tip - run.tip[-1], axis=1)
    when = settling_time(t, away, SETTLED * float(away.max()))
    return math.nan if when is None or when > (1.0 - CALM) * t[-1] else when


def _overshoot(run: Trajectory) -> float:
    way = run.tip[-1] - run.tip[0]
    length = float(way @ way)
    if not length or math.isnan(_settling_time(run)):
        return math.nan
    return float(np.max((run.tip - run.tip[0]) @ way)) / length - 1.0


def _tip_speed(run: Trajectory) -> FloatArray:
    rows = run.model.tip_jacobian(run.q)[:, :3]
    return np.asarray(np.linalg.norm(np.einsum("tij,tj->ti", rows, run.qd), axis=1))


def _path_length(run: Trajectory) -> float:
    return float(np.sum(np.linalg.norm(np.diff(run.tip, axis=0), axis=1)))


def _mean_tension(run: Trajectory) -> float:
    return time_mean(run.t, run.tension.mean(axis=1))


def _least_tension(run: Trajectory) -> float:
    return float(run.tension.min(initial=math.inf))


def _steps(run: Trajectory) -> float:
    return run.stats.steps


def _peak_tip_speed(run: Trajectory) -> float:
    return float(_tip_speed(run).max())


def _final_tip_speed(run: Trajectory) -> float:
    return float(_tip_speed(run)[-1])


def _final_theta(run: Trajectory) -> float:
    return float(np.abs(run.theta[-1]).max())


def _peak(run: Trajectory, of: str) -> float:
    return float(np.abs(getattr(run, of)).max(initial=0.0))


def _final(run: Trajectory, of: str, axis: int | None = None) -> float:
    last = getattr(run, of)[-1]
    return float(last if axis is None else last[axis])


#: The metrics that a sweep knows by name.
METRICS: Mapping[str, RunMetric] = MappingProxyType(
    {
        "settling_time": RunMetric(
            _settling_time,
            "s",
            "until the tip stays within 2 % of its largest distance from where it ends; none where "
            "it is not calm for the last tenth of the run",
        ),
        "overshoot": RunMetric(
            _overshoot,
            "1",
            "how far the tip goes beyond its last place, over the way there; none where it is not "
            "settled",
        ),
        "tip_path_length": RunMetric(_path_length, "m", "length of the way of the tip"),
        "final_tip_x": RunMetric(partial(_final, of="tip", axis=0), "m", "tip at the end, along X"),
        "final_tip_y": RunMetric(partial(_final, of="tip", axis=1), "m", "tip at the end, along Y"),
        "final_tip_z": RunMetric(partial(_final, of="tip", axis=2), "m", "tip at the end, along Z"),
        "peak_tip_speed": RunMetric(_peak_tip_speed, "m/s", "largest speed of the tip"),
        "final_tip_speed": RunMetric(_final_tip_speed, "m/s", "speed of the tip at the end"),
        "peak_theta": RunMetric(
            partial(_peak, of="theta"), "rad", "largest bending angle of any section"
        ),
        "final_theta": RunMetric(
            _final_theta,
            "rad",
            "largest bending angle of any section at the end",
        ),
        "peak_tension": RunMetric(
            partial(_peak, of="tension"), "N", "largest tension of any cable"
        ),
        "least_tension": RunMetric(_least_tension, "N", "smallest tension of any cable"),
        "mean_tension": RunMetric(_mean_tension, "N", "tension, mean over cables and time"),
        "peak_kinetic_energy": RunMetric(
            partial(_peak, of="kinetic_energy"), "J", "largest kinetic energy"
        ),
        "final_kinetic_energy": RunMetric(
            partial(_final, of="kinetic_energy"), "J", "kinetic energy at the end"
        ),
        "final_potential_energy": RunMetric(
            partial(_final, of="potential_energy"), "J", "elastic energy plus weight at the end"
        ),
        "steps": RunMetric(_steps, "1", "steps of the integrator"),
    }
)


@dataclass(frozen=True)
class Asked:
    """A metric of a sweep: a function of the user's, one of METRICS, or else of the summary."""

    name: str
    unit: str = ""
    about: str = ""
    function: Function | None = None

    @property
    def in_summary(self) -> bool:
        """Whether it is a finding of the scenario's own summary."""
        return self.function is None and self.name not in METRICS


def find_metrics(asked: MetricNames, findings: Callable[[], Sequence[Metric]]) -> tuple[Asked, ...]:
    """Return the metrics of a sweep, or refuse them with those there are.

    `findings` gives the summary of a run of the scenario as it is; it is asked for only where a
    name is none of `METRICS`.
    """
    pairs = list(_pairs(asked))
    if not pairs:
        raise ValueError(f"a sweep must have a metric, got none. Known: {', '.join(METRICS)}")
    names = [name for name, _ in pairs]
    twice = next((name for i, name in enumerate(names) if name in names[:i]), None)
    if twice is not None:
        raise ValueError(f"metric {twice!r} must be given once, got it twice")
    unknown = any(function is None and name not in METRICS for name, function in pairs)
    summary = findings() if unknown else ()
    return tuple(
        _named(name, summary)
        if function is None
        else Asked(name, about=first_line(function), function=function)
        for name, function in pairs
    )


def _pairs(asked: MetricNames) -> Iterator[tuple[str, Function | None]]:
    """Yield names and, of metrics of the user's own, functions."""
    if isinstance(asked, Mapping):
        for name, function in asked.items():
            if not callable(function):
                must = "a function of a run"
                raise ValueError(f"metric {name!r} must be {must}, got {short(function)}")
            yield _name(name), function
    elif isinstance(asked, str) or callable(asked):
        yield _pair(asked)
    elif is_iterable(asked):
        yield from map(_pair, asked)
    else:
        raise ValueError(f"metrics must be names or functions of a run, got {format_value(asked)}")


def _pair(one: str | Function) -> tuple[str, Function | None]:
    if not callable(one):
        return _name(one), None
    name = getattr(one, "__name__", "")
    if not name.isidentifier():
        raise ValueError(
            'a function without a name must be given one, as {"name": function}, got '
            f"{short(one)}"
        )
    return name, one


def _name(name: object) -> str:
    if not isinstance(name, str) or not name.isprintable() or not name or "/" in name:
        raise ValueError(f"a metric must be a name or a function of a run, got {short(name)}")
    return name


def first_line(function: Function) -> str:
    """Return what a function says of itself."""
    return (getattr(function, "__doc__", None) or "").strip().partition("\n")[0]


def _named(name: str, summary: Sequence[Metric]) -> Asked:
    if name in METRICS:
        return Asked(name, METRICS[name].unit, METRICS[name].about)
    for finding in summary:
        if finding.key == name:
            return Asked(name, finding.unit or "1", finding.label)
    keys = [finding.key for finding in summary]
    guess = nearest(name, [*METRICS, *keys])
    rest = f"; of this scenario also {', '.join(keys)}" if keys else ""
    raise ValueError(f"there is no metric {name!r}.{guess} Known: {', '.join(METRICS)}{rest}")


def values_of(asked: Sequence[Asked], scenario: Scenario | None, run: Trajectory) -> list[float]:
    """Return the metrics of a run; NaN for a finding that this one does not have."""
    findings: dict[str, float] = {}
    if scenario is not None and any(one.in_summary for one in asked):
        findings = {one.key: one.value for one in scenario.summary(run)}
    return [_value(one, run, findings) for one in asked]


def _value(one: Asked, run: Trajectory, findings: Mapping[str, float]) -> float:
    if one.in_summary:
        return float(findings.get(one.name, math.nan))
    value = (one.function or METRICS[one.name].function)(run)
    number = np.asarray(value)
    if number.ndim or number.dtype.kind not in "biuf":
        raise TypeError(f"metric {one.name!r} must return a number, got {format_value(value)}")
    return float(number)
