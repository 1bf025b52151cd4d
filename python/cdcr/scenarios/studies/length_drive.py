"""Cables wound to lengths: the shape commanded against the one reached."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, cast

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.studies.energy import integral

if TYPE_CHECKING:
    from cdcr.scenarios.file.tracking import TrackedMotion
    from cdcr.scenarios.scenario import Scenario

GO, BACK = 0.5, 4.5  # when it starts to go and to come back, as in the file [s]
TIMES = 10.0  # as stiff are the cables it is compared with


def wanted(scenario: Scenario, t: ArrayLike) -> FloatArray:
    """Return the wanted bending vectors (N, 6) at times (N,) [rad]: there and back smoothly."""
    return np.asarray(cast("TrackedMotion", scenario.input_source).motion(np.atleast_1d(t))[0])


def errors(scenario: Scenario, run: Trajectory) -> FloatArray:
    """Return how far each section is from its wanted bending vector (N, n) [rad]."""
    away = (run.q - wanted(scenario, run.t)).reshape(len(run), -1, 2)
    return np.asarray(np.linalg.norm(away, axis=2))


@lru_cache(maxsize=2)
def stiffer(scenario: Scenario, t_end: float) -> Trajectory:
    """Return the run with cables TIMES as stiff under the same lengths."""
    sections = tuple(
        replace(one, cable_stiffness=TIMES * one.cable_stiffness) for one in scenario.robot.sections
    )
    return replace(scenario, robot=replace(scenario.robot, sections=sections)).simulate(t_end=t_end)


def balance(run: Trajectory) -> tuple[float, float, float]:
    """Return the energy gained, what the drives gave and what damping took over the run [J].

    A drive that winds at a rate gives the force of its spring times that rate.
    """
    sections = run.model.robot.sections
    damping = np.repeat([section.damping for section in sections], 2)
    stiffness = np.array([cable.stiffness for cable in run.model.robot.all_cables])
    length = run.model.cable_lengths(run.q)
    spring = stiffness * np.maximum(length - run.command, 0.0)
    total = run.energy + run.cable_energy
    gained = float(total[-1] - total[0])
    given = -float(np.sum(integral(spring, run.command)))
    taken = float(integral(run.qd**2 @ damping, run.t))
    taken += float(np.sum(integral(run.tension - spring, length)))
    return gained, given, taken


def summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    """Return how far both robots stay from what is wanted, and the energy balance of the run."""
    end = float(run.t[-1])
    found = []
    for key, name, one in (
        ("", "", run),
        ("stiffer_", "ten times stiffer: ", stiffer(scenario, end)),
    ):
        error = np.rad2deg(errors(scenario, one))
        held = int(np.searchsorted(one.t, min(BACK, end)))
        tips = np.linalg.norm(one.tip[held] - one.model.tips(wanted(scenario, one.t[held]))[0])
        events = sum(event.slack for event in one.slack_events)
        found += [
            Metric(f"{key}error_max_deg", f"{name}largest error", float(error.max()), "deg"),
            Metric(
                f"{key}error_held_deg",
                f"{name}largest error, shape held",
                float(error[held].max()),
                "deg",
            ),
            Metric(f"{key}tip_held_mm", f"{name}tip from wanted, held", 1e3 * float(tips), "mm"),
            Metric(f"{key}tension_max_N", f"{name}largest tension", float(one.tension.max()), "N"),
            Metric(f"{key}slack", f"{name}times that a cable turns slack", float(events), ""),
        ]
    gained, given, taken = balance(run)
    gap = abs(given - taken - gained) / max(abs(given), abs(taken), abs(gained))
    found += [
        Metric("given_J", "given by the drives", given, "J"),
        Metric("taken_J", "taken by damping", taken, "J"),
        Metric("balance", "gap in the energy balance, relative", gap, ""),
    ]
    return tuple(found)
