"""Rows of the audit: sections 5.1 and 5.2, the free and the forward dynamic responses."""

from __future__ import annotations

import math

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.coordinates import polar
from cdcr.model.model import Model
from cdcr.paper.claims.common import (
    PRINTED_ANGLE,
    PULL,
    SAME,
    SECTION,
    Claim,
    excess,
    holds_if,
    model,
    numbers,
    tiny,
)
from cdcr.robots import amouri2020
from cdcr.runs.simulate import simulate
from cdcr.runs.trajectory import Trajectory

_SETTLED = 37.68  # when Fig. 8 settles, by the text [s]
_SAMPLE = 0.06  # its sample step [s]
_BAND = 0.02  # of what counts as settled
_START = math.pi / 4.0


def frequency() -> tuple[float, float]:
    """Return natural frequency [rad/s] and inertia [kg m^2] of the straight robot."""
    rest = [0.0, 0.0]
    A, _ = model().linearize(rest, rest, [0.0, 0.0, 0.0])
    return math.sqrt(-A[2, 0]), float(model().mass_matrix(rest)[0, 0])


def swing(m: Model, times: FloatArray, theta: float, pull: float = 0.0) -> Trajectory:
    """Release the robot at rest and integrate with tight tolerances."""
    return simulate(
        m,
        [theta, 0.0],
        [0.0, 0.0],
        t=times,
        tension=[pull, 0.0, 0.0],
        method="dopri5",
        rtol=1e-10,
        atol=1e-12,
        throw=True,
    )


def last_outside(times: FloatArray, values: FloatArray, centre: float, band: float) -> float:
    """Return the time from which on values stay within a band about a centre."""
    outside = np.flatnonzero(np.abs(values - centre) > band)
    return float(times[min(outside[-1] + 1, len(times) - 1)]) if len(outside) else 0.0


def free_oscillation() -> Claim:
    """Swing freely from pi/4: without damping, then with what brings 2 % at the printed time."""
    omega, M = frequency()
    times = np.linspace(0.0, 50.0, 10001)
    free = swing(model(), times, _START)
    drift = 100.0 * float(np.max(np.abs(free.energy / free.energy[0] - 1.0)))
    decay = math.log(1.0 / _BAND) / _SETTLED
    damped = Model(amouri2020(damping=2.0 * decay * M))
    theta = swing(damped, times, _START).theta[:, 0]
    settled = last_outside(times, theta, 0.0, _BAND * _START)
    return Claim(
        where="5.1, Fig. 8",
        claim="From theta = pi/4 without tension the oscillation settles after 37.68 s.",
        computed=(
            f"Nothing in (20) dissipates: it swings for ever at {omega:.3f} rad/s (small motion), "
            f"period {2 * math.pi / omega:.3f} s; in {times[-1]:.0f} s the energy changes by "
            f"{drift:.0e} %. Undisclosed or numerical damping: a viscous {2 * decay * M:.2e} "
            f"N m s/rad (zeta = {decay / omega:.4f}) would leave 2 % after {settled:.1f} s."
        ),
        verdict="does not hold",
        values=numbers(
            frequency=omega,
            period=2.0 * math.pi / omega,
            energy_drift_percent=drift,
            damping=2.0 * decay * M,
            damping_ratio=decay / omega,
            settled_with_damping=settled,
        ),
    )


def sample_step() -> Claim:
    """Integrate Fig. 8 with classical Runge-Kutta at the printed step; take what energy is left."""
    omega, _ = frequency()
    times = np.linspace(0.0, _SETTLED, round(_SETTLED / _SAMPLE) + 1)
    run = simulate(
        model(), [_START, 0.0], [0.0, 0.0], t=times, method="rk4", step=_SAMPLE, throw=True
    )
    left = 100.0 * math.sqrt(float(run.energy[-1] / run.energy[0]))
    samples = 2.0 * math.pi / omega / _SAMPLE
    return Claim(
        where="5.1, Fig. 8",
        claim="The sample step is 0.06 s.",
        computed=(
            f"That is {samples:.1f} samples a period, enough to draw with. As the step of "
            f"classical Runge-Kutta it leaves {left:.0f} % of the amplitude after {_SETTLED} s, so "
            "it alone does not explain the figure. Solver and tolerance are not stated."
        ),
        verdict="cannot be checked",
        values=numbers(samples_per_period=samples, amplitude_left_percent=left),
    )


def step_tension() -> Claim:
    """Find the equilibrium under 5 N, and the modulus that would give the printed angle."""
    theta, _ = polar(model().equilibrium([PULL, 0.0, 0.0]))
    degrees = math.degrees(theta)
    modulus = SECTION.youngs_modulus * degrees / PRINTED_ANGLE / 1e9
    return Claim(
        where="5.2, Fig. 9",
        claim="5 N on cable 1 bring theta to a new stable value of 15.53 deg.",
        computed=(
            f"F r l/(E I_b) = {degrees:.3f} deg: the print is off by "
            f"{excess(PRINTED_ANGLE, degrees):.1f} %. E = {modulus:.3f} GPa would give it."
        ),
        verdict=holds_if(abs(PRINTED_ANGLE - degrees) < 0.005),  # half of the last digit
        values=numbers(
            degrees=degrees, excess_percent=excess(PRINTED_ANGLE, degrees), modulus_gpa=modulus
        ),
    )


def step_oscillation() -> Claim:
    """Pull the straight robot at rest with 5 N; look at the swing of theta, first and last."""
    times = np.linspace(0.0, 40.0, 8001)
    theta = np.degrees(swing(model(), times, 0.0, PULL).theta[:, 0])
    first, last = np.ptp(theta[:1000]), np.ptp(theta[-1000:])
    return Claim(
        where="5.2, Fig. 9",
        claim="The robot presents some oscillations around the new stable value.",
        computed=(
            f"It swings between {np.min(theta):.1f} and {np.max(theta):.1f} deg, as widely in the "
            f"last 5 of {times[-1]:.0f} s ({last:.2f} deg) as in the first ({first:.2f} deg): it "
            "oscillates about the value, but without damping it never comes to it."
        ),
        verdict="holds in part",
        values=numbers(
            lowest=np.min(theta), highest=np.max(theta), first_swing=first, last_swing=last
        ),
    )


def step_orientation() -> Claim:
    """Take the largest sideways bending component of the same run."""
    run = swing(model(), np.linspace(0.0, 10.0, 1001), 0.0, PULL)
    sideways = float(np.max(np.abs(run.q[:, 1])))
    return Claim(
        where="5.2, Fig. 9",
        claim="The orientation angle phi remains zero.",
        computed=f"Yes, by symmetry: theta sin(phi) stays within {tiny(sideways)} rad.",
        verdict=holds_if(sideways < SAME),
        values=numbers(sideways=sideways),
    )


def two_tensions() -> Claim:
    """Find the rest under equal tensions on cables 1 and 2, as an example of what could be."""
    q = model().equilibrium([PULL, PULL, 0.0])
    theta, phi = (math.degrees(angle) for angle in polar(q))
    _, p = model().tip(q)
    return Claim(
        where="5.2, Fig. 10",
        claim="Tensions on cables 1 and 2 bring the tip to coordinates taken after stabilisation.",
        computed=(
            "The text does not give the tensions, and without damping nothing stabilises. For "
            f"example {PULL:.0f} N on each hold theta = {theta:.2f} deg, phi = {phi:.1f} deg, the "
            f"tip at ({p[0]:.3f}, {p[1]:.3f}, {p[2]:.3f}) m."
        ),
        verdict="cannot be checked",
        values=numbers(theta_degrees=theta, phi_degrees=phi, x=p[0], y=p[1], z=p[2]),
    )
