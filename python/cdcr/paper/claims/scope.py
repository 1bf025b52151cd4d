"""Rows of the audit: what abstract, sections 5.5 and 6 say of the model as a whole."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.coordinates import bending
from cdcr.model.model import Model
from cdcr.paper._elements import bow, sinc
from cdcr.paper.claims.common import (
    EDGE,
    PRINTED_ANGLE,
    PULL,
    ROBOT,
    SECTION,
    Claim,
    excess,
    gap,
    model,
    numbers,
)
from cdcr.runs.simulate import simulate

_SECONDS, _STEP = 10.0, 1e-3  # of the runs that are timed


def times_real_time(m: Model) -> float:
    """Return how much faster than real time Runge-Kutta at 1 ms runs, best of five."""
    rest, t, best = np.zeros(m.num_coordinates), np.linspace(0.0, _SECONDS, 11), np.inf
    pull = np.zeros(m.num_cables)
    pull[0] = PULL
    for _ in range(5):
        start = time.perf_counter()
        simulate(m, rest, rest, t=t, tension=pull, method="rk4", step=_STEP, throw=True)
        best = min(best, time.perf_counter() - start)
    return float(_SECONDS / best)


def real_time() -> Claim:
    """Time step-tension over 10 s with steps of 1 ms, exact and Taylor, on this computer."""
    exact, taylor = times_real_time(model()), times_real_time(Model(ROBOT, "taylor"))
    return Claim(
        where="Abstract; 1; 5.5",
        claim="The simplified model is efficient for real time and for control.",
        computed=(
            "The paper states no computing time. Here and now, in steps of 1 ms, the Taylor "
            f"factors run {taylor:,.0f} and the exact ones {exact:,.0f} times faster than real "
            "time: the equations are cheap with either."
        ),
        verdict="cannot be checked",
        values=numbers(taylor=taylor, exact=exact),
    )


Shape = Callable[[float], float]  # a function of sigma = theta^2


def chain(q: FloatArray, A: Shape, S: Shape) -> FloatArray:
    """Return the end of a chain of equal sections of length one, q (2n,) base to tip.

    By (1) and (2) with A = (1 - cos theta)/theta^2 and S = sin(theta)/theta, the end of a section
    is (A u, A v, S) in its base and its turn I + S k + A k k, k the cross product with (-v, u, 0).
    """
    p, R = np.zeros(3), np.eye(3)
    for u, v in q.reshape(-1, 2):
        a, s = A(u * u + v * v), S(u * u + v * v)
        k = np.array([[0.0, 0.0, u], [0.0, 0.0, v], [-u, -v, 0.0]])
        p = p + R @ np.array([a * u, a * v, s])
        R = R @ (np.eye(3) + s * k + a * k @ k)
    return p


def more_sections() -> Claim:
    """Put polynomials for A and S of two sections; take the inertia of a mass at their end.

    The inertia is that of the straight robot by central differences, in q and in theta, phi.
    """

    def A(sigma: float) -> float:
        return float(bow(np.sqrt(sigma)))

    def S(sigma: float) -> float:
        return float(sinc(np.sqrt(sigma)))

    sigma, rng = np.linspace(0.0, EDGE**2, 200), np.random.default_rng(1)
    bent = rng.uniform(-EDGE / 2.0**0.5, EDGE / 2.0**0.5, (20, 4))
    degree, error = 0, np.inf
    while error > 1e-13:  # of the length: to rounding
        degree += 1
        a, s = (np.polynomial.Chebyshev.fit(sigma, [f(x) for x in sigma], degree) for f in (A, S))
        error = max(gap(chain(q, a, s), chain(q, A, S)) for q in bent)

    def least_inertia(place: Callable[[FloatArray], FloatArray]) -> float:
        steps = 1e-5 * np.eye(4)
        J = np.array([(place(step) - place(-step)) / 2e-5 for step in steps])
        return float(np.min(np.sum(J**2, axis=1)))

    in_q = least_inertia(lambda q: chain(q, A, S))
    in_angles = least_inertia(lambda angles: chain(bending(angles[0::2], angles[1::2]), A, S))
    return Claim(
        where="Abstract; 6",
        claim="More than 2 DOF lead to a more complex expression that cannot be simplified by "
        "similar means.",
        computed=(
            "More terms, yes. But in q = theta (cos phi, sin phi) they close in polynomials: with "
            f"two of degree {degree} in theta^2 the end of two sections (4 DOF) is where (1) and "
            f"(2) put it, to {error:.0e} of a section up to 3pi/5. And the straight chain is "
            f"regular: the least inertia of a unit mass there is {in_q:.2f} in q, {in_angles:.0f} "
            "in theta and phi."
        ),
        verdict="holds in part",
        values=numbers(degree=degree, fit_error=error, least_in_q=in_q, least_in_angles=in_angles),
    )


def comparison() -> Claim:
    """Collect what could be compared: the one static number and the one that is near a ratio."""
    degrees = float(np.degrees(SECTION.cable_radius * PULL / SECTION.stiffness))
    return Claim(
        where="Abstract; 5.5; 6",
        claim="Static and forward results are very similar in shape to [25], with friction or "
        "without; inverse ones to [15]. This validates the model.",
        computed=(
            "No number, curve or parameter of [15] or [25] is given, and robots and assumptions "
            "differ by the paper's own word. The one number that can be checked, Fig. 9, is "
            f"{PRINTED_ANGLE} deg where the equations give {degrees:.2f} deg "
            f"({excess(PRINTED_ANGLE, degrees):+.1f} %)."
        ),
        verdict="cannot be checked",
        values=numbers(printed_degrees=PRINTED_ANGLE, degrees=degrees),
    )


def simple_expressions() -> Claim:
    """Compare both natural frequencies about the rest under 5 N, Taylor factors against exact."""
    rest = model().equilibrium([PULL, 0.0, 0.0])

    def frequencies(m: Model) -> FloatArray:
        A, _ = m.linearize(rest, [0.0, 0.0], [PULL, 0.0, 0.0])
        return np.sort(np.abs(np.linalg.eigvals(A)))

    ratios = frequencies(Model(ROBOT, "taylor")) / frequencies(model())
    error = 100.0 * float(np.max(np.abs(ratios - 1.0)))
    return Claim(
        where="5.5; 6",
        claim="The expressions are simple, beside those of [27], and ease simulation and control.",
        computed=(
            "[27] is not quoted. Cut at theta^4 each factor has three coefficients, and about the "
            f"rest under 5 N the frequencies are off by up to {error:.4f} %. So at small "
            "angles the cut costs little; but it must be made on the mended factors (E1 to E6)."
        ),
        verdict="cannot be checked",
        values=numbers(frequency_error_percent=error),
    )
