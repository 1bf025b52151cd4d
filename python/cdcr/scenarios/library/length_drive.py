"""Cables wound to lengths: the shape commanded against the one reached."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric
from cdcr.scenarios.scenario import Scenario
from cdcr.scenarios.studies.length_drive import (
    BACK,
    END,
    OPTIONS,
    STEP,
    STIFFNESS,
    WANTED,
    balance,
    errors,
    lengths,
    robot,
    start,
    stiffer,
    wanted,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def _summarize(scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
    end = float(run.t[-1])
    found = []
    for key, name, one in (("", "", run), ("stiffer_", "ten times stiffer: ", stiffer(end))):
        error = np.rad2deg(errors(one))
        held = int(np.searchsorted(one.t, min(BACK, end)))
        tips = np.linalg.norm(one.tip[held] - one.model.tips(wanted(one.t[held]))[0])
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


def _plot(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios.figures.length_drive import length_drive_figure

    return length_drive_figure(scenario.title, run)


SCENARIO = Scenario(
    name="length-drive",
    title="A shape commanded by cable lengths, and the one reached under gravity",
    description=(
        "The robot of three sections is held out sideways and its nine cables are wound to "
        "the lengths they have in a wanted shape, 0.1 mm less for pretension. Cables and "
        "drives give by 20 N/mm, so weight and the stiffness of the backbone keep the robot "
        "away from that shape, the more where cables turn slack and no longer help. The same "
        "lengths on cables ten times stiffer come nearer."
    ),
    source="robot and lengths ours",
    robot=robot(STIFFNESS),
    q0=start,
    qd0=(0.0,) * WANTED.size,
    tension=lengths,
    t_end=END,
    num_samples=round(END / STEP) + 1,
    **OPTIONS,
    summarize=_summarize,
    plot=_plot,
)
