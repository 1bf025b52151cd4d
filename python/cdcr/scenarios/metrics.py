"""What a run shows, in numbers for people."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.statics import ConvergenceError, checked_equilibrium
from cdcr.model.wrench import Wrench
from cdcr.runs.trajectory import Trajectory

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

# A signal has swung when it has left this share of its span around its mean on both sides.
_SWING = 0.02
# Fields of a section that take energy away, beside friction of its cables.
_LOSSES = ("damping", "twist_damping", "stretch_damping", "material_damping")


class Metric(NamedTuple):
    """One number of a summary, with its name for machines and for people."""

    key: str
    label: str
    value: float
    unit: str


def run_metrics(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return the findings every run has, of each section and of the robot."""
    several = run.model.num_sections > 1
    found: list[Metric] = []
    for i in range(run.model.num_sections):
        for one in _section_metrics(run, i, scenario.wrenches):
            key, label = f"section_{i + 1}_{one.key}", f"section {i + 1}: {one.label}"
            found.append(one._replace(key=key, label=label) if several else one)
    drift = None if scenario.wrenches else energy_drift(run)  # wrenches feed and drain the robot
    if drift is not None:
        found.append(Metric("energy_drift", "relative energy drift", drift, ""))
    return tuple(found)


def _section_metrics(run: Trajectory, i: int, wrenches: Sequence[Wrench]) -> Iterator[Metric]:
    theta, phi = np.rad2deg(run.theta[:, i]), np.rad2deg(run.phi[:, i])
    rest = static_theta(run, wrenches)
    if rest is not None:
        yield Metric("theta_static_deg", "theta at static equilibrium", float(rest[i]), "deg")
    yield Metric("theta_mean_deg", "theta, mean", time_mean(run.t, theta), "deg")
    yield Metric("theta_min_deg", "theta, smallest", float(np.min(theta)), "deg")
    yield Metric("theta_max_deg", "theta, largest", float(np.max(theta)), "deg")
    period = oscillation_period(run.t, theta) if is_steady(run) else None
    if period is not None:
        yield Metric("period_s", "period of oscillation", period, "s")
    yield Metric("phi_min_deg", "phi, smallest", float(np.min(phi)), "deg")
    yield Metric("phi_max_deg", "phi, largest", float(np.max(phi)), "deg")


def static_theta(run: Trajectory, wrenches: Sequence[Wrench] = ()) -> FloatArray | None:
    """Return the bending angles (n,) [deg] of rest under the tensions and wrenches of the run.

    Negative where the run's phi points the other way. None where tensions or wrenches change over
    the run, or where no point of rest is found.
    """
    command = run.command
    constant = np.all(command == command[0]) and all(one.profile is None for one in wrenches)
    if not constant:
        return None
    try:
        found = run.model.equilibrium(command[0], wrenches=wrenches, throw=False)
        rest = checked_equilibrium(found)
    except ConvergenceError:
        return None
    (x, y), phi = run.model.bending_vectors(rest).T, run.phi[-1]
    signed: FloatArray = np.copysign(np.hypot(x, y), x * np.cos(phi) + y * np.sin(phi))
    return np.rad2deg(signed)


def swing_times(run: Trajectory, num: int) -> FloatArray:
    """Return up to `num` times [s] to show a run at: its first half swing, or else all of it.

    They are round numbers, of steps of 1, 2 or 5 in their last place, but for the run's ends.
    """
    end = float(run.t[-1])
    if is_steady(run):
        periods = [oscillation_period(run.t, theta) for theta in run.theta.T]
        halves = [run.t[0] + period / 2.0 for period in periods if period is not None]
        end = min(halves, default=end)
    return round_times(np.linspace(run.t[0], end, num), float(run.t[-1]))


def round_times(times: FloatArray, last: float) -> FloatArray:
    """Return rising times [s] as people say them, each once; none comes before the first."""
    if len(times) < 2 or times[-1] <= times[0]:
        return times[:1]
    unit = 10.0 ** math.floor(math.log10((times[-1] - times[0]) / (len(times) - 1) / 2.0))
    digits = max(0, -math.floor(math.log10(unit)))
    said = np.round(np.round(times / unit) * unit, digits)
    return np.unique(np.clip(said, times[0], last))


def energy_drift(run: Trajectory) -> float | None:
    """Return the largest change of the energy that should not change, over the largest kinetic one.

    Under constant tensions F a cable does the work F (l0 - l), so T + U + F.l stays what it was,
    or T + U - (B F).q where the actuation matrix B is constant. None where tensions change, or
    damping or friction take energy away.
    """
    sections = run.model.robot.sections
    lossy = any(getattr(section, name) for section in sections for name in _LOSSES)
    if lossy or run.model.has_friction or not is_steady(run):
        return None
    pull = run.tension[0]
    if run.model.has_constant_actuation:
        kept = run.energy - run.q @ (run.model.actuation_matrix() @ pull)
    else:
        kept = run.energy + run.model.cable_lengths(run.q) @ pull
    scale = float(np.max(run.kinetic_energy)) or 1.0
    return float(np.max(np.abs(kept - kept[0]))) / scale


def is_steady(run: Trajectory) -> bool:
    """Return whether the tensions are the same at all times."""
    return bool(np.all(run.tension == run.tension[0]))


def time_mean(t: FloatArray, y: FloatArray) -> float:
    """Return the mean of samples y over times t, by the trapezoidal rule."""
    return float(np.sum(np.diff(t) * (y[1:] + y[:-1]))) / (2.0 * float(t[-1] - t[0]))


def settling_time(t: FloatArray, away: FloatArray, band: float) -> float | None:
    """Return when `away` (N,) is last above a band, None where it is so at the end."""
    outside = np.flatnonzero(away > band)
    last = int(outside[-1]) if outside.size else 0
    return float(t[last]) if last + 1 < len(t) else None


def oscillation_period(t: FloatArray, y: FloatArray) -> float | None:
    """Return the mean time between rises of y (N,) through its mean, in the unit of t.

    None where y rises less than twice, or is sampled too coarsely to tell (less than six samples
    a period).
    """
    level = time_mean(t, y)
    band = _SWING * float(np.ptp(y))
    clear = np.flatnonzero(np.abs(y - level) > band)
    above = y[clear] > level
    lows, highs = clear[:-1][~above[:-1] & above[1:]], clear[1:][~above[:-1] & above[1:]]
    if len(lows) < 2:
        return None
    rises = [
        _crossing(t[i : j + 1], y[i : j + 1] - level) for i, j in zip(lows, highs, strict=True)
    ]
    period = (rises[-1] - rises[0]) / (len(rises) - 1)
    return period if period > 6.0 * float(np.max(np.diff(t))) else None


def _crossing(t: FloatArray, y: FloatArray) -> float:
    """Return the time where y, which starts below and ends above 0, last becomes positive."""
    i = int(np.flatnonzero(y <= 0.0)[-1])
    return float(t[i] - y[i] * (t[i + 1] - t[i]) / (y[i + 1] - y[i]))
