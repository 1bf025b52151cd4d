"""Functions of time with their first two derivatives, from samples or callables.

Derivatives come from quintic splines (SciPy, extra ``track``). Splines through all points and
through every other one come in pairs: their difference tells the error of the coarser.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray, finite
from cdcr.base.extras import require

TimeFunction: TypeAlias = Callable[[float], ArrayLike]
# Takes times (M,), gives values, rates and accelerations (3, M, k).
Motion: TypeAlias = Callable[[FloatArray], FloatArray]

# What a quintic spline through every other sample needs.
_MIN_SAMPLES = 11
# A callable is sampled in up to this many equal steps, and in at least 1/64 of them.
_FINEST = 4096
_COARSEST_STRIDE = 64


class Pair(NamedTuple):
    """A motion, and the same from half of the samples."""

    fine: Motion
    coarse: Motion


# Motions. Classes and no closures, so that they can be pickled where what they are made of can.


@dataclass(frozen=True)
class Constant:
    """An angle that stays (3, M, 1)."""

    angle: float

    def __call__(self, times: FloatArray) -> FloatArray:
        """Return values, rates and accelerations at times (M,)."""
        still = np.array([self.angle, 0.0, 0.0])
        return np.repeat(still[:, np.newaxis, np.newaxis], times.size, axis=1)


@dataclass(frozen=True)
class Derivatives:
    """A function of time and its first two derivatives."""

    functions: tuple[Callable[[FloatArray], FloatArray], ...]

    def __call__(self, times: FloatArray) -> FloatArray:
        """Return values, rates and accelerations at times (M,)."""
        return np.stack([function(times) for function in self.functions])


@dataclass(frozen=True)
class Functions:
    """Functions of the user, by name, and a spline for the derivatives that are missing."""

    named: tuple[tuple[str, TimeFunction | None], ...]
    spline: Motion | None

    def __call__(self, times: FloatArray) -> FloatArray:
        """Return values, rates and accelerations at times (M,)."""
        given = [None if f is None else called(name, f, times) for name, f in self.named]
        return filled(given, None if self.spline is None else self.spline(times))


@dataclass(frozen=True)
class Angles:
    """Bending vectors of angles."""

    bending: Motion
    orientation: Motion

    def __call__(self, times: FloatArray) -> FloatArray:
        """Return values, rates and accelerations at times (M,)."""
        return bending_vectors(self.bending(times), self.orientation(times))


def of_samples(times: FloatArray, values: FloatArray) -> Pair:
    """Return splines through samples (N, k)."""
    if times.size < _MIN_SAMPLES:
        raise ValueError(
            f"derivatives by spline need at least {_MIN_SAMPLES} samples, got {times.size}: give "
            "more, or the derivatives"
        )
    # Both ends belong to either spline.
    half = np.unique(np.append(np.arange(0, times.size, 2), times.size - 1))
    return Pair(_spline(times, values), _spline(times[half], values[half]))


def of_function(times: FloatArray, name: str, function: TimeFunction) -> Pair:
    """Return splines through values of a function over the span of times, as fine as pays.

    A finer step makes the spline better and its second derivative rounder: the step that changes
    it least is taken.
    """
    knots = np.linspace(times[0], times[-1], _FINEST + 1)
    values = called(name, function, knots)
    best, least = None, np.inf
    stride = _COARSEST_STRIDE
    while stride >= 1:
        pair = of_samples(knots[::stride], values[::stride])
        error = change(pair.fine(knots), pair.coarse(knots))[1]
        if best is None or error < least:
            best, least = pair, error
        stride //= 2
    assert best is not None
    return best


def of_angle(times: FloatArray, name: str, angle: ArrayLike | TimeFunction) -> Pair:
    """Return motions (3, M, n) of an angle: a constant, samples (N,) or (N, n), or a function."""
    if callable(angle):
        return of_function(times, name, angle)
    samples = finite(angle, name)
    if samples.ndim == 0:
        rest = Constant(float(samples))
        return Pair(rest, rest)
    if samples.ndim == 1:
        samples = samples[:, np.newaxis]
    samples = checked_samples(name, samples, times.size, "n")
    return of_samples(times, _unwrapped(times, samples) if name == "phi" else samples)


def bending_vectors(theta: FloatArray, phi: FloatArray) -> FloatArray:
    """Return q = theta (cos phi, sin phi), qd, qdd (3, M, 2n) of angles (3, M, n)."""
    if theta.shape[2] != phi.shape[2] and 1 not in (theta.shape[2], phi.shape[2]):
        raise ValueError(
            f"theta and phi must be for as many sections, got {theta.shape[2]} and {phi.shape[2]}"
        )
    theta, phi = np.broadcast_arrays(theta, phi)
    (angle, rate, acceleration), (_, turn, turn_rate) = theta, phi
    along = [angle, rate, acceleration - angle * turn**2]
    across = [np.zeros_like(angle), angle * turn, 2.0 * rate * turn + angle * turn_rate]
    cosine, sine = np.cos(phi[0]), np.sin(phi[0])
    x = np.stack(along) * cosine - np.stack(across) * sine
    y = np.stack(along) * sine + np.stack(across) * cosine
    return np.stack([x, y], axis=-1).reshape(3, angle.shape[0], -1)


def quintic(times: FloatArray, q: FloatArray, qd: FloatArray, qdd: FloatArray) -> Motion:
    """Return the quintic between each two samples that has the values and derivatives of both."""
    interpolate = require("scipy.interpolate", "track")
    pieces = interpolate.BPoly.from_derivatives(times, np.stack([q, qd, qdd], axis=1))
    return Derivatives((pieces, pieces.derivative(1), pieces.derivative(2)))


def filled(given: Sequence[FloatArray | None], spline: FloatArray | None) -> FloatArray:
    """Return values, rates and accelerations, those not given being a spline's.

    The spline is through the rates where they are given, else through the values.
    """
    order = 0 if given[1] is None else 1
    rows: list[FloatArray] = []
    for i, row in enumerate(given):
        if row is None:
            assert spline is not None
            row = spline[i - order]
        rows.append(row)
    return np.stack(rows)


def change(fine: FloatArray, coarse: FloatArray) -> tuple[float, float]:
    """Return the largest differences of rates and of accelerations."""
    _, rates, accelerations = np.abs(fine - coarse)
    return float(np.max(rates)), float(np.max(accelerations))


def called(name: str, function: TimeFunction, times: FloatArray) -> FloatArray:
    """Return a function's values (M, k) at times; it returns a number or (k,)."""
    if not callable(function):
        raise ValueError(f"{name} must be a function of time, got {type(function).__name__}")
    rows: list[FloatArray] = []
    for t in times:
        row = np.atleast_1d(finite(function(float(t)), f"{name}({t:g})"))
        if row.ndim != 1 or (rows and row.shape != rows[0].shape):
            wanted = f"{rows[0].shape} as before" if rows else "(k,)"
            raise ValueError(f"{name}({t:g}) must have shape {wanted}, got {row.shape}")
        rows.append(row)
    return np.stack(rows)


def checked_times(t: ArrayLike) -> FloatArray:
    """Return increasing times as an array of its own, or refuse them."""
    times = np.array(finite(t, "t"))
    if times.ndim != 1 or times.size < 2:
        raise ValueError(f"t must have shape (N,) with N at least 2, got {times.shape}")
    backwards = np.flatnonzero(np.diff(times) <= 0.0)
    if backwards.size:
        i = int(backwards[0])
        raise ValueError(
            f"t must be strictly increasing, got t[{i}] = {times[i]:g} s and "
            f"t[{i + 1}] = {times[i + 1]:g} s"
        )
    return times


def checked_samples(name: str, values: ArrayLike, num_times: int, columns: int | str) -> FloatArray:
    """Return samples (num_times, columns) as an array of its own, or refuse them.

    Instead of a number, `columns` may be "n" or "d" for any.
    """
    samples = np.array(finite(values, name))
    fits = samples.ndim == 2 and samples.shape[0] == num_times and samples.shape[1] > 0
    if fits and isinstance(columns, int):
        fits = samples.shape[1] == columns
    if not fits:
        raise ValueError(f"{name} must have shape ({num_times}, {columns}), got {samples.shape}")
    return samples


def _spline(times: FloatArray, values: FloatArray) -> Motion:
    interpolate = require("scipy.interpolate", "track")
    spline = interpolate.make_interp_spline(times, values, k=5)
    return Derivatives((spline, spline.derivative(1), spline.derivative(2)))


def _unwrapped(times: FloatArray, phi: FloatArray) -> FloatArray:
    """Return orientation angles (N, n) without jumps of full turns."""
    smooth: FloatArray = np.unwrap(phi, axis=0)
    steps = np.abs(np.diff(smooth, axis=0)).max(axis=1)
    i = int(np.argmax(steps))
    if steps[i] > np.pi / 2.0:
        raise ValueError(
            f"phi must change by at most pi/2 between samples, got {steps[i]:.4g} rad from "
            f"t = {times[i]:g} to {times[i + 1]:g} s: sample more finely, or, where the robot "
            "swings through straight, let theta change its sign and not phi jump"
        )
    return smooth
