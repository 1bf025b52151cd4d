"""Natural frequencies and mode shapes against SciPy, and their picture."""

import math
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from scipy.linalg import eigh  # type: ignore[import-untyped]

import cdcr
from cdcr.plotting import plot_modes

# Symmetric eigenvalue problems of condition 1e4, solved by two libraries.
EIGEN = 1e-9


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81)))


@pytest.fixture(scope="module")
def found(model: cdcr.Model) -> cdcr.Modes:
    tension = np.array([3.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0])
    return model.modes(model.equilibrium(tension), tension)


def test_they_are_those_of_stiffness_and_mass(model: cdcr.Model, found: cdcr.Modes) -> None:
    M = model.mass_matrix(found.q)
    K = model.static_stiffness(found.q, np.zeros(9))
    squares, _ = eigh(K, M)
    np.testing.assert_allclose(found.squared_frequency, squares, rtol=EIGEN)
    np.testing.assert_allclose(found.frequency, np.sqrt(squares), rtol=EIGEN)
    np.testing.assert_allclose(found.frequency_hz, np.sqrt(squares) / (2 * math.pi), rtol=EIGEN)
    np.testing.assert_allclose(found.shape.T @ M @ found.shape, np.eye(6), rtol=0.0, atol=EIGEN)
    np.testing.assert_allclose(
        found.shape.T @ K @ found.shape, np.diag(squares), rtol=0.0, atol=EIGEN * squares[-1]
    )
    assert found.stable


def test_light_damping_is_that_of_the_eigenvalues() -> None:
    model = cdcr.Model(cdcr.robots.three_sections(damping=1e-6))
    found = model.modes(np.zeros(6), np.zeros(9))
    pairs = found.eigenvalues[found.eigenvalues.imag > 0.0]
    ratios = -pairs.real / np.abs(pairs)
    # Coupling of modes by damping is of second order; modes come in equal pairs here.
    np.testing.assert_allclose(np.sort(found.damping_ratio), np.sort(ratios), rtol=1e-4)
    np.testing.assert_allclose(found.frequency, np.abs(pairs), rtol=1e-6)


def test_a_table_1_robot_has_one_frequency_in_closed_form() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    found = model.modes([0.0, 0.0], [0.0, 0.0, 0.0])
    stiffness = model.robot.sections[0].stiffness
    expected = math.sqrt(stiffness / model.mass_matrix([0.0, 0.0])[0, 0])
    np.testing.assert_allclose(found.frequency, expected, rtol=1e-12)
    assert repr(found) == "<Modes at 1.448, 1.448 Hz, stable>"


def test_a_buckled_column_falls_away() -> None:
    robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, -9.81), payload=0.5)
    found = cdcr.Model(robot).modes([0.0, 0.0], [0.0, 0.0, 0.0])
    assert not found.stable
    assert found.squared_frequency[0] < 0.0
    np.testing.assert_array_equal(found.frequency, [0.0, 0.0])
    assert np.all(np.isfinite(found.shape))
    assert plot_modes(found).texts[0].get_text() == "mode 1: unstable"


def test_refusals(model: cdcr.Model, found: cdcr.Modes) -> None:
    with pytest.raises(ValueError, match=r"^q must have shape \(\.\.\., 6\), got \(2,\)$"):
        model.modes([0.0, 0.0], np.zeros(9))
    with pytest.raises(ValueError, match=r"has no (inertia|dynamics)"):
        cdcr.Model(cdcr.robots.rao2021()).modes(np.zeros(4), np.zeros(6))
    with pytest.raises(ValueError, match=r"^count must be a whole number >= 1, got 0 \(int\)$"):
        plot_modes(found, 0)
    with pytest.raises(ValueError, match=r"^deflection must be > 0 and <= 1, got 2 \(int\)$"):
        plot_modes(found, deflection=2)
    many = model.modes(np.zeros((2, 6)), np.zeros(9))
    assert repr(many) == "<Modes at shapes of leading dimensions (2,)>"
    with pytest.raises(ValueError, match=r"got those of an array of shape \(2,\)$"):
        plot_modes(many)


def test_the_picture_names_frequencies(found: cdcr.Modes, tmp_path: Path) -> None:
    settings = dict(mpl.rcParams)
    figure = found.plot(4)
    assert len(figure.axes) == 4
    labels = [text.get_text() for text in figure.texts]
    for k in range(4):
        assert labels[k].startswith(f"mode {k + 1}: {found.frequency_hz[k]:.3g} Hz")
    # Rest in black, beside it two phases to each side; the farthest point moves by 15 %.
    lines = figure.axes[0].lines
    assert len(lines) == 5
    rest, moved = np.array(lines[-1].get_data_3d()), np.array(lines[0].get_data_3d())
    farthest = np.max(np.linalg.norm(moved - rest, axis=0))
    assert farthest == pytest.approx(0.15 * found.model.robot.length, rel=0.1)
    figure.savefig(tmp_path / "modes.png")
    assert (tmp_path / "modes.png").stat().st_size > 10_000
    assert dict(mpl.rcParams) == settings
