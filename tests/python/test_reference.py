"""The library against cases computed at 40 digits by an independent model (tests/data)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike

import cdcr

# Rounding of some dozen operations, and of the cases' own 16 digits: 6e-16 was seen.
TOLERANCE = 4e-15

Case = dict[str, Any]

ALL_CASES: list[Case] = json.loads(
    (Path(__file__).parents[1] / "data" / "dynamics_cases.json").read_text(encoding="utf-8")
)
# A model of more sections is refused for now.
CASES = [case for case in ALL_CASES if len(case["sections"]) == 1]


def model_of(case: Case) -> cdcr.Model:
    robot = cdcr.Robot(
        sections=[cdcr.Section(**section) for section in case["sections"]],
        gravity=case["gravity"],
        payload=case["payload"],
    )
    return cdcr.Model(robot)


def assert_close(actual: ArrayLike, expected: ArrayLike, scale: float | None = None) -> None:
    """Largest difference, relative to the largest expected magnitude or to `scale`."""
    actual, expected = np.asarray(actual), np.asarray(expected)
    assert actual.shape == expected.shape
    if scale is None:
        scale = float(np.abs(expected).max())
    assert np.abs(actual - expected).max() <= TOLERANCE * scale


def test_there_are_fifteen_cases_of_one_section() -> None:
    assert len(CASES) == 15


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
class TestCase:
    def test_accelerations(self, case: Case) -> None:
        tension = np.concatenate(case["tensions"])
        qdd = model_of(case).forward_dynamics(case["q"], case["qd"], tension)
        assert_close(qdd, case["qdd"])

    def test_inverse_dynamics_gives_the_force_of_the_tensions(self, case: Case) -> None:
        model = model_of(case)
        force = model.inverse_dynamics(case["q"], case["qd"], case["qdd"])
        expected = model.actuation_matrix() @ np.concatenate(case["tensions"])
        # Inertia and elastic forces cancel in the sum.
        scale = np.abs(model.mass_matrix(case["q"]) @ case["qdd"]).max() + np.abs(expected).max()
        assert_close(force, expected, scale)

    def test_mass_matrix(self, case: Case) -> None:
        assert_close(model_of(case).mass_matrix(case["q"]), case["mass_matrix"])

    def test_energies(self, case: Case) -> None:
        model = model_of(case)
        assert_close(model.kinetic_energy(case["q"], case["qd"]), case["kinetic_energy"])
        assert_close(model.potential_energy(case["q"]), case["potential_energy"])

    def test_tip(self, case: Case) -> None:
        rotation, position = model_of(case).tip(case["q"])
        assert_close(position, case["tip_position"])
        assert_close(rotation, case["tip_rotation"])
