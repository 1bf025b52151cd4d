"""Between bending vectors and angles, both ways, one section or many."""

import re

import numpy as np
import pytest

import cdcr
from cdcr.model.signals import state_names
from cdcr.runs.export import columns_of

# One multiplication and one sine or hypotenuse.
ROUNDING = 4e-16


def test_one_vector_gives_two_floats() -> None:
    theta, phi = cdcr.polar([0.3, 0.4])
    assert isinstance(theta, float)
    assert isinstance(phi, float)
    assert theta == 0.5
    assert phi == np.arctan2(0.4, 0.3)
    np.testing.assert_allclose(cdcr.bending(theta, phi), [0.3, 0.4], rtol=ROUNDING)


def test_round_trip_of_a_batch_of_sections() -> None:
    random = np.random.default_rng(1)
    theta = random.uniform(0.0, 9.0, (5, 4, 3))
    phi = random.uniform(-np.pi, np.pi, (5, 4, 3))
    q = cdcr.bending(theta, phi)
    assert q.shape == (5, 4, 6)
    found_theta, found_phi = cdcr.polar(q)
    np.testing.assert_allclose(found_theta, theta, rtol=2 * ROUNDING)
    np.testing.assert_allclose(found_phi, phi, rtol=0.0, atol=2 * ROUNDING * np.pi)


def test_coordinates_are_named_as_in_files_and_systems() -> None:
    model = cdcr.Model(cdcr.robots.three_sections())
    names = model.coordinate_names
    assert names == ("q1_x", "q1_y", "q2_x", "q2_y", "q3_x", "q3_y")
    rates = tuple(f"qd{name[1:]}" for name in names)
    assert columns_of(model, "q") == [f"{name} [rad]" for name in names]
    assert columns_of(model, "qd") == [f"{name} [rad/s]" for name in rates]
    assert tuple(state_names(model)) == names + rates


def test_the_slice_of_a_section_holds_what_bends_it_alone() -> None:
    model = cdcr.Model(cdcr.robots.three_sections())
    for i in range(3):
        q = np.zeros(6)
        q[model.section_slice(i)] = 0.3, -0.2
        theta, _ = cdcr.polar(q)
        assert np.flatnonzero(theta).tolist() == [i]
        assert len(model.coordinate_names[model.section_slice(i)]) == 2
    for wrong in (-1, 3):
        with pytest.raises(ValueError, match=f"^section must be 0 to 2, got {wrong}$"):
            model.section_slice(wrong)


def test_the_last_axis_counts_sections() -> None:
    q = cdcr.bending([1.0, 2.0], [0.0, np.pi / 2])
    np.testing.assert_allclose(q, [1.0, 0.0, 0.0, 2.0], atol=2 * ROUNDING)
    theta, phi = cdcr.polar([1.0, 0.0, 0.0, 2.0])
    np.testing.assert_array_equal(theta, [1.0, 2.0])
    np.testing.assert_array_equal(phi, [0.0, np.pi / 2])
    assert cdcr.polar([[1.0, 0.0]])[0].shape == (1, 1)  # type: ignore[union-attr]


def test_theta_and_phi_broadcast() -> None:
    q = cdcr.bending(np.array([[0.1], [0.2]]), 0.0)
    np.testing.assert_array_equal(q, [[0.1, 0.0], [0.2, 0.0]])


def test_a_negative_theta_bends_the_other_way() -> None:
    np.testing.assert_array_equal(cdcr.bending(-0.5, 0.0), [-0.5, 0.0])
    assert cdcr.polar(cdcr.bending(-0.5, 0.0)) == (0.5, np.pi)


@pytest.mark.parametrize("x", [0.0, -0.0])
@pytest.mark.parametrize("y", [0.0, -0.0])
def test_straight_has_angle_zero_whatever_the_signs(x: float, y: float) -> None:
    theta, phi = cdcr.polar([x, y])
    assert (theta, phi) == (0.0, 0.0)
    assert not np.signbit(np.array([theta, phi])).any()
    assert not np.signbit(cdcr.polar([[x, y, x, y]])[1]).any()


def test_phi_is_pi_and_not_minus_pi_across_x() -> None:
    assert cdcr.polar([-1.0, 0.0]) == (1.0, np.pi)
    assert cdcr.polar([-1.0, -0.0]) == (1.0, np.pi)


def test_continuous_undoes_full_turns() -> None:
    turns = np.linspace(0.0, 6 * np.pi, 100)
    q = cdcr.bending(np.full((100, 1), 0.7), turns[:, np.newaxis])
    theta, phi = cdcr.polar(q, continuous=True)
    np.testing.assert_allclose(phi[:, 0], turns, rtol=0.0, atol=1e-14)  # type: ignore[index]
    np.testing.assert_allclose(theta, 0.7, rtol=2 * ROUNDING)


def test_continuous_lets_theta_change_sign_through_straight() -> None:
    swing = np.cos(np.linspace(0.0, 10.0, 200))
    # The second section turns while the first one swings.
    both = cdcr.bending(
        np.stack([swing, np.ones(200)], axis=1),
        np.stack([np.full(200, 1.0), np.linspace(0.0, 10.0, 200)], axis=1),
    )
    theta, phi = cdcr.polar(both, continuous=True)
    np.testing.assert_allclose(theta[:, 0], swing, atol=1e-15)  # type: ignore[index]
    np.testing.assert_allclose(phi[:, 0], 1.0, atol=1e-13)  # type: ignore[index]
    np.testing.assert_allclose(phi[:, 1], np.linspace(0.0, 10.0, 200), atol=1e-14)  # type: ignore[index]
    np.testing.assert_allclose(cdcr.bending(theta, phi), both, atol=1e-14)


def test_answers_are_fresh_float64() -> None:
    q = np.array([[0.3, 0.4]], dtype=np.float32)
    theta, phi = cdcr.polar(q)
    assert isinstance(theta, np.ndarray)
    assert isinstance(phi, np.ndarray)
    assert theta.dtype == phi.dtype == np.float64
    angles = np.array([0.5])
    bent = cdcr.bending(angles, angles)
    bent[:] = 0.0
    assert angles[0] == 0.5


@pytest.mark.parametrize(
    ("q", "sentence"),
    [
        (0.5, "q must have shape (2,) or (..., 2n), got ()"),
        ([], "q must have shape (2,) or (..., 2n), got (0,)"),
        ([1.0, 2.0, 3.0], "q must have shape (2,) or (..., 2n), got (3,)"),
        (np.zeros((2, 0)), "q must have shape (2,) or (..., 2n), got (2, 0)"),
        ([np.nan, 0.0], "q[0] must be finite, got nan"),
        ([0.0, np.inf], "q[1] must be finite, got inf"),
        ("bent", "q must be numbers, got str"),
        ([[0.0, 1.0], [0.0]], "q must be numbers, got list"),
        (None, "q must be numbers, got NoneType"),
    ],
)
def test_polar_refuses(q: object, sentence: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        cdcr.polar(q)  # type: ignore[arg-type]


def test_continuous_needs_rows() -> None:
    for q in ([0.1, 0.2], np.zeros((2, 2, 2))):
        shape = re.escape(str(np.shape(q)))
        with pytest.raises(
            ValueError, match=rf"^q must have shape \(N, 2n\) to be continuous, got {shape}$"
        ):
            cdcr.polar(q, continuous=True)


@pytest.mark.parametrize(
    ("theta", "phi", "sentence"),
    [
        (np.nan, 0.0, "theta must be finite, got nan"),
        (0.0, -np.inf, "phi must be finite, got -inf"),
        ("a", 0.0, "theta must be numbers, got str"),
        (0.0, {}, "phi must be numbers, got dict"),
        (
            [0.1, 0.2],
            [0.1, 0.2, 0.3],
            "theta and phi must have fitting shapes, got (2,) and (3,)",
        ),
    ],
)
def test_bending_refuses(theta: object, phi: object, sentence: str) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}$"):
        cdcr.bending(theta, phi)  # type: ignore[arg-type]
