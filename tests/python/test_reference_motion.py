"""cdcr.Reference: motions from samples, functions and angles, and their derivatives."""

from __future__ import annotations

import math
import sys
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr
from cdcr.motion.reference import Reference

FloatArray = NDArray[np.float64]

# Sums of a few products of numbers near one.
ROUNDING = 1e-14
# Second derivatives of splines through lines: rounding over the step squared.
SPLINED_LINE = 1e-11

CIRCLE_TIMES: FloatArray = 0.2 * np.arange(51.0)  # [s]
PLANE_TIMES: FloatArray = 0.2 * np.arange(13.0)


def circle() -> Reference:
    return Reference.from_angles(CIRCLE_TIMES, math.pi / 12.0, lambda t: math.pi / 5.0 * t)


def plane() -> Reference:
    return Reference.from_angles(PLANE_TIMES, lambda t: math.pi / 4.0 * t, math.pi / 6.0)


def circle_by_hand(t: FloatArray) -> FloatArray:
    """Return q, qd, qdd (3, N, 2) of the circle."""
    theta, rate = math.pi / 12.0, math.pi / 5.0
    along = np.stack([np.cos(rate * t), np.sin(rate * t)], axis=-1)
    across = np.stack([-along[:, 1], along[:, 0]], axis=-1)
    return np.stack([theta * along, theta * rate * across, -theta * rate**2 * along])


def motion_of(reference: Reference) -> FloatArray:
    return np.stack([reference.q, reference.qd, reference.qdd])


def test_angles_give_the_circle() -> None:
    reference = circle()
    expected = circle_by_hand(CIRCLE_TIMES)
    np.testing.assert_allclose(motion_of(reference), expected, rtol=0.0, atol=SPLINED_LINE)
    assert max(reference.derivative_error) < SPLINED_LINE
    np.testing.assert_allclose(reference.theta[:, 0], math.pi / 12.0, rtol=ROUNDING)
    np.testing.assert_allclose(reference.phi[:, 0], math.pi / 5.0 * CIRCLE_TIMES, atol=ROUNDING)


def test_angles_are_regular_through_straight() -> None:
    """At t = 0 theta is zero, and still qd = thetad (cos phi, sin phi)."""
    reference = plane()
    direction = np.array([math.cos(math.pi / 6.0), math.sin(math.pi / 6.0)])
    assert not np.any(reference.q[0])
    expected = np.tile(math.pi / 4.0 * direction, (13, 1))
    np.testing.assert_allclose(reference.qd, expected, rtol=0.0, atol=SPLINED_LINE)
    np.testing.assert_allclose(reference.qdd, 0.0, atol=SPLINED_LINE)
    through = Reference.from_angles(PLANE_TIMES - 1.2, PLANE_TIMES - 1.2, math.pi / 6.0)
    np.testing.assert_allclose(through.qd, np.tile(direction, (13, 1)), atol=SPLINED_LINE)


def test_full_turns_in_samples_of_phi_do_no_harm() -> None:
    phi = np.angle(np.exp(1j * math.pi / 5.0 * CIRCLE_TIMES))
    assert np.max(np.abs(np.diff(phi))) > 6.0
    reference = Reference.from_angles(CIRCLE_TIMES, np.full(51, math.pi / 12.0), phi)
    expected = circle_by_hand(CIRCLE_TIMES)
    np.testing.assert_allclose(motion_of(reference), expected, rtol=0.0, atol=SPLINED_LINE)


@pytest.mark.parametrize("given", [1, 2])
def test_derivatives_by_spline_are_as_good_as_they_say(given: int) -> None:
    """The estimate is above the error and at most a hundred times above."""
    exact = circle_by_hand(CIRCLE_TIMES)
    reference = Reference.from_samples(CIRCLE_TIMES, *exact[:given])
    errors = np.max(np.abs(motion_of(reference) - exact), axis=(1, 2))
    for order in range(3):
        if order < given:
            assert errors[order] == 0.0
        else:
            assert errors[order] <= reference.derivative_error[order - 1] <= 100 * errors[order]
    assert reference.derivative_error[1] < 1e-3


def test_given_derivatives_have_no_error() -> None:
    exact = circle_by_hand(CIRCLE_TIMES)
    reference = Reference.from_samples(CIRCLE_TIMES, *exact)
    np.testing.assert_array_equal(motion_of(reference), exact)
    assert reference.derivative_error == (0.0, 0.0)


def test_functions_with_and_without_derivatives() -> None:
    def part(order: int) -> Any:
        return lambda t: circle_by_hand(np.array([t]))[order, 0]

    exact = circle_by_hand(CIRCLE_TIMES)
    full = Reference.from_functions(CIRCLE_TIMES, part(0), part(1), part(2))
    np.testing.assert_allclose(motion_of(full), exact, rtol=0.0, atol=ROUNDING)
    assert full.derivative_error == (0.0, 0.0)
    for functions, bounds in (((part(0), part(1)), (0.0, 1e-11)), ((part(0),), (1e-11, 1e-9))):
        reference = Reference.from_functions(CIRCLE_TIMES, *functions)
        assert all(e <= b for e, b in zip(reference.derivative_error, bounds, strict=True))
        error = np.max(np.abs(motion_of(reference) - exact), axis=(1, 2))
        assert error[0] < ROUNDING
        assert error[2] <= reference.derivative_error[1]


@pytest.mark.parametrize("made", ["angles", "samples", "all samples"])
def test_a_reference_is_known_between_its_samples(made: str) -> None:
    exact = circle_by_hand(CIRCLE_TIMES)
    reference, atol = {
        "angles": (circle(), SPLINED_LINE),
        "samples": (Reference.from_samples(CIRCLE_TIMES, exact[0]), 2e-4),
        "all samples": (Reference.from_samples(CIRCLE_TIMES, *exact), 1e-6),
    }[made]
    times = np.linspace(0.0, 10.0, 333)
    other = reference.at(times)
    np.testing.assert_allclose(motion_of(other), circle_by_hand(times), rtol=0.0, atol=atol)
    np.testing.assert_allclose(motion_of(other.at(CIRCLE_TIMES)), motion_of(reference), atol=1e-12)
    np.testing.assert_array_equal(reference.evaluate(times[7]), motion_of(other)[:, 7])


def test_several_sections() -> None:
    theta = np.stack([np.sin(CIRCLE_TIMES), 0.3 + 0.0 * CIRCLE_TIMES], axis=1)
    reference = Reference.from_angles(CIRCLE_TIMES, theta, lambda t: [0.2 * t, 0.5])
    assert reference.q.shape == (51, 4)
    np.testing.assert_allclose(
        reference.q,
        cdcr.bending(theta, np.stack([0.2 * CIRCLE_TIMES, np.full(51, 0.5)], axis=1)),
        atol=ROUNDING,
    )
    assert repr(reference) == "<Reference: 51 samples, t = 0 to 10 s, 4 coordinates>"


def test_arrays_are_read_only_copies() -> None:
    exact = circle_by_hand(CIRCLE_TIMES)
    reference = Reference.from_samples(CIRCLE_TIMES, *exact)
    exact[:] = 7.0
    assert np.max(np.abs(reference.q)) < 1.0
    for array in (reference.t, reference.q, reference.qd, reference.qdd):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0


T, Q = CIRCLE_TIMES, circle_by_hand(CIRCLE_TIMES)[0]


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Reference.from_samples([0.0], Q), r"t must have shape \(N,\) .* got \(1,\)"),
        (lambda: Reference.from_samples([0, 2, 1], Q[:3]), r"t\[1\] = 2 s and t\[2\] = 1 s"),
        (lambda: Reference.from_samples(T, Q[:-1]), r"q must have shape \(51, d\), got \(50, 2\)"),
        (lambda: Reference.from_samples(T, Q, Q[:, 0]), r"qd must have shape \(51, 2\), got \(51,"),
        (lambda: Reference.from_samples(T, Q * np.nan), r"q\[0, 0\] must be finite, got nan"),
        (lambda: Reference.from_samples(T[:10], Q[:10]), "at least 11 samples, got 10: give more"),
        (lambda: Reference.from_functions(T, Q), "q must be a function of time, got ndarray"),
        (
            lambda: Reference.from_functions(T, lambda t: Q[: 1 + (t > 5)].ravel()),
            r"q\(5.00244\) must have shape \(2,\) as before, got \(4,\)",
        ),
        (
            lambda: Reference.from_angles(T, lambda t: 1.0 / (t - 5.0) if t != 5.0 else np.inf, 0),
            r"theta\(5\) must be finite, got inf",
        ),
        (lambda: Reference.from_angles(T, 1.0, "east"), "phi must be numbers, got str"),
        (lambda: Reference.from_angles(T, T[:5], 0.0), r"theta must have shape \(51, .* \(5, 1\)"),
        (
            lambda: Reference.from_angles(T, np.abs(T - 5.1), np.where(T < 5.1, 0.0, np.pi)),
            "phi must change by at most pi/2 .* from t = 5 to 5.2 s: .* let theta change its sign",
        ),
        (
            lambda: Reference.from_angles(T, np.ones((51, 2)), np.ones((51, 3))),
            "theta and phi must be for as many sections, got 2 and 3",
        ),
        (lambda: circle().evaluate(10.3), "t must lie within the reference, 0 to 10 s, got 10.3 s"),
        (lambda: circle().at([-1.0, 1.0]), "t must lie within the reference, .* got -1 s"),
        (lambda: circle().evaluate([[1.0]]), r"t must be a number or have shape \(M,\)"),
    ],
)
def test_bad_references_are_refused(make: Any, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        make()


def test_without_scipy_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy.interpolate", None)
    assert len(Reference.from_samples(T, Q, Q, Q)) == 51  # needs none
    with pytest.raises(ImportError, match=r'scipy is needed .* pip install "cdcr\[track\]"'):
        Reference.from_samples(T, Q)
