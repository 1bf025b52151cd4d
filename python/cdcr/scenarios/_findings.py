"""What a run shows, in numbers for people."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cdcr._trajectory import Trajectory

if TYPE_CHECKING:
    from cdcr.scenarios._scenario import Scenario

FloatArray = NDArray[np.float64]

# A signal has swung when it has left this share of its span around its mean on both sides.
_SWING = 0.02


class Finding(NamedTuple):
    """One number of a summary, with its name for machines and for people."""

    key: str
    label: str
    value: float
    unit: str


def findings(scenario: Scenario, run: Trajectory) -> tuple[Finding, ...]:
    """Return the findings every run has, for each section and for the robot."""
    return (*_angle_findings(run), *_energy_findings(run))


def _angle_findings(run: Trajectory) -> Iterator[Finding]:
    theta, phi = np.rad2deg(run.theta), np.rad2deg(run.phi)
    rest = static_theta(run)
    several = run.model.num_sections > 1
    for i in range(run.model.num_sections):
        key, label = (f"section_{i + 1}_", f"section {i + 1}, ") if several else ("", "")
        if rest is not None:
            yield Finding(
                f"{key}theta_static_deg", f"{label}theta at static equilibrium", rest[i], "deg"
            )
        mean = time_mean(run.t, theta[:, i])
        yield Finding(f"{key}theta_mean_deg", f"{label}theta, mean", mean, "deg")
        yield Finding(f"{key}theta_min_deg", f"{label}theta, smallest", min(theta[:, i]), "deg")
        yield Finding(f"{key}theta_max_deg", f"{label}theta, largest", max(theta[:, i]), "deg")
        period = oscillation_period(run.t, run.theta[:, i])
        if period is not None:
            yield Finding(f"{key}period_s", f"{label}period of oscillation", period, "s")
        yield Finding(f"{key}phi_min_deg", f"{label}phi, smallest", min(phi[:, i]), "deg")
        yield Finding(f"{key}phi_max_deg", f"{label}phi, largest", max(phi[:, i]), "deg")


def _energy_findings(run: Trajectory) -> Iterator[Finding]:
    drift = energy_drift(run)
    if drift is not None:
        yield Finding("energy_drift", "relative energy drift", drift, "")


def static_theta(run: Trajectory) -> FloatArray | None:
    """Return the bending angles (n,) [deg] of rest under the tensions of the last sample.

    None where they change over the run, or where no point of rest is found.
    """
    if not _tension_is_constant(run):
        return None
    rest = run.model.equilibrium(run.tension[-1])
    if rest is None:
        return None
    return np.rad2deg(np.hypot(rest[0::2], rest[1::2]))


def energy_drift(run: Trajectory) -> float | None:
    """Return the largest change of the energy that should not change, over the largest kinetic one.

    Under constant tensions F a cable at angle gamma does the work F r e(gamma).(q - q0), so
    T + U - (B F).q stays what it was. None where tensions change or damping takes energy away.
    """
    damped = any(section.damping > 0.0 for section in run.model.robot.sections)
    if damped or not _tension_is_constant(run):
        return None
    force = run.model.actuation_matrix(run.q[0]) @ run.tension[0]
    kept = run.energy - run.q @ force
    scale = float(np.max(run.kinetic_energy)) or 1.0
    return float(np.max(np.abs(kept - kept[0]))) / scale


def _tension_is_constant(run: Trajectory) -> bool:
    return bool(np.all(run.tension == run.tension[0]))


def time_mean(t: FloatArray, y: FloatArray) -> float:
    """Return the mean of samples y over times t, by the trapezoidal rule."""
    return float(np.sum(np.diff(t) * (y[1:] + y[:-1]))) / (2.0 * float(t[-1] - t[0]))


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
    rises = [_crossing(t[i : j + 1], y[i : j + 1] - level) for i, j in zip(lows, highs, strict=True)]
    period = (rises[-1] - rises[0]) / (len(rises) - 1)
    return period if period > 6.0 * float(np.max(np.diff(t))) else None


def _crossing(t: FloatArray, y: FloatArray) -> float:
    """Return the time where y, which starts below and ends above 0, last becomes positive."""
    i = int(np.flatnonzero(y <= 0.0)[-1])
    return float(t[i] - y[i] * (t[i + 1] - t[i]) / (y[i + 1] - y[i]))
