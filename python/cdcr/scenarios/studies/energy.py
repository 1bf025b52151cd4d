"""Where the energy of a run goes: into damping, and into the cables or out of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.runs.simulate import simulate
from cdcr.runs.trajectory import Trajectory

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

# A release wakes motions that damping ends within milliseconds: sampled finely up to here [s].
JUMP, JUMP_STEP, STEP = 0.05, 5e-5, 1e-3


def dissipated(run: Trajectory) -> FloatArray:
    """Return the energy that damping has taken since the start (N,) [J].

    The integral of c |qd|^2 over all sections. Between samples the power is the cubic that has its
    values and rates at both ends, which the equations of motion give.
    """
    damping = np.repeat([section.damping for section in run.model.robot.sections], 2)
    qdd = run.model.forward_dynamics(run.q, run.qd, run.tension)
    power, rate = run.qd**2 @ damping, 2.0 * (run.qd * qdd) @ damping
    h = np.diff(run.t)
    steps = h / 2.0 * (power[1:] + power[:-1]) + h**2 / 12.0 * (rate[:-1] - rate[1:])
    return np.concatenate([[0.0], np.cumsum(steps)])


def cable_work(run: Trajectory) -> FloatArray:
    """Return the work that the cables have done on the robot since the start (N,) [J].

    For cables without friction under tensions that are linear between samples. The work of the
    generalised force Q = B F is [Q.q] less the integral of Qdot.q, in which Qdot is constant
    between samples: so a kink in the tensions costs no accuracy.
    """
    force = run.tension @ run.model.actuation_matrix().T
    h = np.diff(run.t)[:, None]
    mean = (run.q[1:] + run.q[:-1]) / 2.0 + h / 12.0 * (run.qd[:-1] - run.qd[1:])
    change = np.sum(force[1:] * run.q[1:] - force[:-1] * run.q[:-1], axis=1)
    steps = change - np.sum(np.diff(force, axis=0) * mean, axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def energy_gap(run: Trajectory) -> float:
    """Return the largest error of the energy balance, over the energy that has changed hands.

    The energy gained must be the work of the cables less what damping took.
    """
    work, loss = cable_work(run), dissipated(run)
    gap = run.energy - run.energy[0] - work + loss
    scale = max(float(np.ptp(run.energy)), float(np.ptp(work)), float(loss[-1]))
    return float(np.max(np.abs(gap))) / (scale or 1.0)


def fine_run(scenario: Scenario, run: Trajectory) -> Trajectory:
    """Return a run under constant tensions again, sampled for its energy balance."""
    start, end = run.t[0], run.t[-1]
    jump = np.arange(start, start + JUMP - JUMP_STEP / 2.0, JUMP_STEP)
    t = np.concatenate([jump, np.arange(start + JUMP, end, STEP)])
    return simulate(
        run.model,
        run.q[0],
        run.qd[0],
        t=np.append(t[t < end - JUMP_STEP / 2.0], end),
        command=run.command[0],
        method=scenario.method,
        rtol=scenario.rtol,
        atol=scenario.atol,
    )


def integral(y: FloatArray, x: FloatArray) -> Any:
    """Return the integral of samples y (N, ...) over x (N, ...) by the trapezoidal rule."""
    return 0.5 * np.sum((y[1:] + y[:-1]) * np.diff(x, axis=0), axis=0)
