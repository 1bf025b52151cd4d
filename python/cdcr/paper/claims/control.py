"""Rows of the audit: sections 5.3 and 5.4, inverse dynamics and the PID controller."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.paper.claims.common import (
    EDGE,
    PRINTED_ANGLE,
    SECTION,
    Claim,
    holds_if,
    model,
    numbers,
)
from cdcr.paper.claims.response import last_outside
from cdcr.runs.pid import Pid
from cdcr.runs.simulate import simulate

_TURN = math.pi / 5.0  # rate of phi in Fig. 12 [rad/s]
_CIRCLE = math.pi / 12.0  # its bending angle [rad]
_STEP = 0.2  # its sampling step [s]
_BEND = math.pi / 4.0  # rate of theta in Fig. 13 [rad/s]
_GAINS = (2.8, 0.004, 0.38)  # kp, ki, kd of section 5.4
_SECONDS = 20.0  # a run of the controller


def tensions(q: FloatArray, qd: FloatArray, qdd: FloatArray) -> FloatArray:
    """Return the least non-negative tensions that move the robot so, one row per time [N]."""
    motion = zip(q, qd, qdd, strict=True)
    return np.array([model().allocate(model().inverse_dynamics(*row)) for row in motion])


def numerical_derivatives() -> Claim:
    """Differentiate the circle of Fig. 12 twice, by central differences at its step."""
    after = 2.0 * (1.0 - math.cos(_TURN * _STEP)) / _STEP**2
    error = 100.0 * (1.0 - after / _TURN**2)
    return Claim(
        where="5.3, Fig. 11",
        claim="The inverse model in Simulink takes numerical derivatives of the path.",
        computed=(
            f"By which formula is not stated. Central differences at the step of {_STEP} s get the "
            f"acceleration of the circle of Fig. 12 wrong by {error:.2f} %: harmless there."
        ),
        verdict="cannot be checked",
        values=numbers(acceleration_error_percent=error),
    )


def circle_tracking() -> Claim:
    """Inverse dynamics at the samples; least non-negative tensions on three cables."""
    t = np.linspace(0.0, 10.0, round(10.0 / _STEP) + 1)
    out = np.stack([np.cos(_TURN * t), np.sin(_TURN * t)], axis=-1)
    side = np.stack([-out[:, 1], out[:, 0]], axis=-1)
    force = tensions(_CIRCLE * out, _CIRCLE * _TURN * side, -_CIRCLE * _TURN**2 * out)
    peaks, start = np.max(force, axis=0), force[0, 0]
    turns = _TURN * t[-1] / (2.0 * math.pi)
    return Claim(
        where="5.3, Fig. 12",
        claim="Tensions for theta = pi/12, phi = (pi/5) t, t from 0 to 10 s in steps of 0.2 s.",
        computed=(
            f"phi makes {turns:.0f} full turn, so all three cables act. Least tensions peak at "
            f"{peaks[0]:.3f}, {peaks[1]:.3f} and {peaks[2]:.3f} N, cable 1 starts at {start:.3f} "
            "N. Feasible, once (19) is used with the pair of cables of the sector."
        ),
        verdict=holds_if(np.min(force) >= 0.0 and np.all(peaks > 0.0)),
        values=numbers(
            turns=turns, peak_1=peaks[0], peak_2=peaks[1], peak_3=peaks[2], start_1=start
        ),
    )


def plane_tracking() -> Claim:
    """Inverse dynamics of theta = pi t/4, phi = pi/6 where theta reaches 3pi/5."""
    time = EDGE / _BEND
    out = np.array([[math.cos(math.pi / 6.0), math.sin(math.pi / 6.0)]])
    first, second, third = tensions(EDGE * out, _BEND * out, 0.0 * out)[0]
    degrees = math.degrees(_BEND * 10.0)
    return Claim(
        where="5.3, Fig. 13",
        claim="Tensions for theta = (pi/4) t, phi = pi/6.",
        computed=(
            f"theta leaves the range of 3pi/5 at t = {time:.1f} s, with {first:.1f} N on cable 1, "
            f"{second:.1f} N on cable 2 and {third:.0f} N on cable 3 there. With t to 10 s as in "
            f"Fig. 12 theta would be {degrees:.0f} deg."
        ),
        verdict="holds in part",
        values=numbers(
            time=time, tension_1=first, tension_2=second, tension_3=third, degrees_at_10=degrees
        ),
    )


class Loop(NamedTuple):
    """What a run under the controller came to."""

    final: float  # [deg]
    peak: float  # [deg]
    lowest: float  # tension [N]
    settled: float  # within 2 % of the printed angle [s]


def loop(scale: float, *, feed_forward: bool) -> Loop:
    """Run the printed gains, times a factor that makes them N m/rad, on cable 1 without limits."""
    kp, ki, kd = (gain * scale for gain in _GAINS)
    pid = Pid(
        model(),
        kp=kp,
        ki=ki,
        kd=kd,
        period=1e-3,
        feed_forward=feed_forward,
        min_tension=-math.inf,
        cables=[0],
    )
    pid.reference = np.array([math.radians(PRINTED_ANGLE), 0.0])
    t = np.linspace(0.0, _SECONDS, 20001)
    rest = [0.0, 0.0]
    run = simulate(model(), rest, rest, t=t, controller=pid, method="rk4", step=1e-3, throw=True)
    theta = np.degrees(run.theta[:, 0])
    settled = last_outside(t, theta, PRINTED_ANGLE, 0.02 * PRINTED_ANGLE)
    return Loop(float(theta[-1]), float(np.max(theta)), float(np.min(run.tension[:, 0])), settled)


def scales() -> dict[str, float]:
    """Return what turns the gains into N m/rad: error in rad or deg, output a tension; a moment."""
    r = SECTION.cable_radius
    return {"radian": r, "degree": math.degrees(r), "moment": 1.0}


def pid_gains() -> Claim:
    """Run the three readings of the gains from rest towards 15.53 deg, nothing fed forward."""
    radian, degree, moment = (loop(scale, feed_forward=False) for scale in scales().values())
    return Claim(
        where="5.4, Fig. 14",
        claim="Kp = 2.8, KI = 0.004, KD = 0.38 on the result of Fig. 9 are an acceptable "
        "compromise.",
        computed=(
            f"Units are not given. After {_SECONDS:.0f} s towards {PRINTED_ANGLE} deg: error in "
            f"rad, output a tension: {radian.final:.2f} deg; error in degrees: {degree.final:.2f} "
            f"deg, asking for {degree.lowest:.2f} N, a cable that pushes; output a moment: "
            f"{moment.final:.2f} deg. None arrives."
        ),
        verdict="cannot be checked",
        values=numbers(
            radian_final=radian.final,
            degree_final=degree.final,
            degree_lowest_tension=degree.lowest,
            degree_peak=degree.peak,
            moment_final=moment.final,
        ),
    )


def pid_damping() -> Claim:
    """Run the radian and the degree reading with the static tension fed forward."""
    table = scales()
    radian, degree = (loop(table[name], feed_forward=True) for name in ("radian", "degree"))
    return Claim(
        where="5.4, Fig. 14",
        claim="The PID controller reduces the oscillations of Fig. 9 significantly.",
        computed=(
            f"With the static tension fed forward, yes: {degree.final:.2f} deg, within 2 % after "
            f"{degree.settled:.2f} s, in the degree reading; after {radian.settled:.2f} s with a "
            f"peak of {radian.peak:.1f} deg in the radian reading. So it needs stated units, a "
            f"feed-forward term and a tension limit (the degree reading asks for "
            f"{degree.lowest:.1f} N)."
        ),
        verdict="holds in part",
        values=numbers(
            degree_final=degree.final,
            degree_settled=degree.settled,
            degree_lowest_tension=degree.lowest,
            radian_final=radian.final,
            radian_settled=radian.settled,
            radian_peak=radian.peak,
        ),
    )
