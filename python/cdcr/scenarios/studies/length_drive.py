"""Cables wound to lengths: the shape commanded against the one reached."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr.model.coordinates import bending
from cdcr.model.model import Model
from cdcr.robot.robot import Robot
from cdcr.robots import three_sections
from cdcr.runs.command import TensionTable
from cdcr.runs.simulate import simulate
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.studies.energy import integral

FloatArray = NDArray[np.float64]

# Held out sideways: Z of the first section along x, its cable 1 on top.
SIDEWAYS = ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0))
STIFFNESS, STIFFER = 2e4, 2e5  # of cables and drives [N/m]
CABLE_DAMPING = 20.0  # of the drives [N s/m]
SHORTER = 1e-4  # how much shorter than in the wanted shape all cables are wound: pretension [m]
WANTED = np.ravel(bending(np.deg2rad([25.0, 45.0, 65.0]), np.deg2rad([30.0, -50.0, 10.0])))
GO, BACK, MOVE, END = 0.5, 4.5, 2.0, 9.0  # when it starts to go and to come back, how long [s]
ROWS = 0.01  # between rows of the table of lengths [s]
STEP = 2e-3  # between samples [s]
OPTIONS: dict[str, Any] = {"method": "bdf", "rtol": 1e-7, "atol": 1e-9}


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


def start(model: Model) -> tuple[float, ...]:
    """Return the bending vectors (2n,) of rest under the first lengths [rad]."""
    straight = model.cable_lengths(np.zeros(model.num_coordinates))
    return tuple(model.equilibrium(straight - SHORTER))


def errors(run: Trajectory) -> FloatArray:
    """Return how far each section is from its wanted bending vector (N, n) [rad]."""
    away = (run.q - wanted(run.t)).reshape(len(run), -1, 2)
    return np.asarray(np.linalg.norm(away, axis=2))


@lru_cache(maxsize=2)
def stiffer(t_end: float) -> Trajectory:
    """Return the run with stiffer cables under the same lengths."""
    model = Model(robot(STIFFER))
    rest, t = np.zeros(model.num_coordinates), np.linspace(0.0, t_end, 1 + round(t_end / STEP))
    return simulate(model, start(model), rest, t=t, tension=lengths(model, t_end), **OPTIONS)


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
