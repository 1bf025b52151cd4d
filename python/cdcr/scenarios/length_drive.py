"""Cables wound to lengths: the shape commanded against the one reached."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr._coordinates import bending
from cdcr._model import Model
from cdcr._robot import Robot
from cdcr._simulate import TensionTable
from cdcr._trajectory import Trajectory
from cdcr.robots import three_sections
from cdcr.scenarios._findings import Finding
from cdcr.scenarios._integral import integral
from cdcr.scenarios._scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

# Held out sideways: Z of the first section along x, its cable 1 on top.
SIDEWAYS = ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0))
STIFFNESS, STIFFER = 2e4, 2e5  # of cables and drives [N/m]
CABLE_DAMPING = 20.0  # of the drives [N s/m]
SHORTER = 1e-4  # how much shorter than in the wanted shape all cables are wound: pretension [m]
WANTED = np.ravel(bending(np.deg2rad([25.0, 45.0, 65.0]), np.deg2rad([30.0, -50.0, 10.0])))
GO, BACK, MOVE, END = 0.5, 4.5, 2.0, 9.0  # when it starts to go and to come back, how long [s]
ROWS = 0.01  # between rows of the table of lengths [s]


def robot(stiffness: float) -> Robot:
    """Return the robot of three sections, held sideways, its cables driven by length."""
    plain = three_sections(gravity=(0.0, 0.0, -9.81))
    driven = [
        replace(section, cable_stiffness=stiffness, cable_damping=CABLE_DAMPING)
        for section in plain.sections
    ]
    return replace(plain, sections=tuple(driven), base_orientation=SIDEWAYS)


def wanted(t: ArrayLike) -> FloatArray:
    """Return the wanted bending vectors (N, 6) at times (N,) [rad]: there and back smoothly."""
    times = np.atleast_1d(np.asarray(t, dtype=np.float64))
    share = _smooth((times - GO) / MOVE) - _smooth((times - BACK) / MOVE)
    return share[:, None] * WANTED


def _smooth(x: FloatArray) -> FloatArray:
    """Rise from 0 to 1 while x does, with rate and acceleration zero at both ends."""
    y = np.clip(x, 0.0, 1.0)
    return np.asarray(y**3 * (10.0 - 15.0 * y + 6.0 * y**2))


def lengths(model: Model, t_end: float) -> TensionTable:
    """Return the lengths that the wanted shapes give the cables, less the pretension."""
    t = np.linspace(0.0, t_end, max(2, round(t_end / ROWS) + 1))
    rows = model.cable_lengths(wanted(t)) - SHORTER
    return TensionTable(t, np.array(rows))


def errors(run: Trajectory) -> FloatArray:
    """Return how far each section is from its wanted bending vector (N, n) [rad]."""
    away = (run.q - wanted(run.t)).reshape(len(run), -1, 2)
    return np.asarray(np.linalg.norm(away, axis=2))


@lru_cache(maxsize=2)
def stiffer(t_end: float) -> Trajectory:
    """Return the run with stiffer cables under the same lengths."""
    return _from_rest(STIFFER).simulate(t_end=t_end)


def balance(run: Trajectory) -> tuple[float, float, float]:
    """Return the energy gained, what the drives gave and what damping took over the run [J].

    A drive that winds at a rate gives the force of its spring times that rate.
    """
    sections = run.model.robot.sections
    damping = np.repeat([section.damping for section in sections], 2)
    stiffness = np.array([cable.stiffness for cable in run.model.robot.all_cables])
    length = run.model.cable_lengths(run.q)
    assert run.command is not None
    spring = stiffness * np.maximum(length - run.command, 0.0)
    total = run.energy + run.cable_energy
    gained = float(total[-1] - total[0])
    given = -float(np.sum(integral(spring, run.command)))
    taken = float(integral(run.qd**2 @ damping, run.t))
    taken += float(np.sum(integral(run.tension - spring, length)))
    return gained, given, taken


def _tell(scenario: Scenario, run: Trajectory) -> tuple[Finding, ...]:
    end = float(run.t[-1])
    found = []
    for key, name, one in (("", "", run), ("stiffer_", "ten times stiffer: ", stiffer(end))):
        error = np.rad2deg(errors(one))
        held = int(np.searchsorted(one.t, min(BACK, end)))
        tips = np.linalg.norm(one.tip[held] - one.model.tips(wanted(one.t[held]))[0])
        events = sum(event.slack for event in one.slack_events)
        found += [
            Finding(f"{key}error_max_deg", f"{name}largest error", float(error.max()), "deg"),
            Finding(
                f"{key}error_held_deg",
                f"{name}largest error, shape held",
                float(error[held].max()),
                "deg",
            ),
            Finding(f"{key}tip_held_mm", f"{name}tip from wanted, held", 1e3 * float(tips), "mm"),
            Finding(f"{key}tension_max_N", f"{name}largest tension", float(one.tension.max()), "N"),
            Finding(f"{key}slack", f"{name}times that a cable turns slack", float(events), ""),
        ]
    gained, given, taken = balance(run)
    gap = abs(given - taken - gained) / max(abs(given), abs(taken), abs(gained))
    found += [
        Finding("given_J", "given by the drives", given, "J"),
        Finding("taken_J", "taken by damping", taken, "J"),
        Finding("balance", "gap in the energy balance, relative", gap, ""),
    ]
    return tuple(found)


def _draw(scenario: Scenario, run: Trajectory) -> Figure:
    from cdcr.scenarios._length_drive_figure import length_drive_figure

    return length_drive_figure(scenario.title, run)


def _from_rest(stiffness: float) -> Scenario:
    """Return the scenario with cables of some stiffness, from rest under the first lengths."""
    described = robot(stiffness)
    model = Model(described)
    start = model.equilibrium(model.cable_lengths(np.zeros(model.num_coordinates)) - SHORTER)
    return Scenario(
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
        robot=described,
        q0=tuple(start),
        qd0=(0.0,) * model.num_coordinates,
        tension=lengths,
        t_end=END,
        num_samples=4501,
        method="bdf",
        rtol=1e-7,
        atol=1e-9,
        tell=_tell,
        draw=_draw,
    )


SCENARIO = _from_rest(STIFFNESS)
