"""The library against cases computed at 40 digits by an independent model (tests/data).

``pytest -s`` prints the largest error for each number of sections.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

import cdcr

# Rounding of some dozen operations for each section, and of the cases' own 16 digits, times what
# solving for accelerations makes of it; 5.5e-15 was seen.
TOLERANCE = 2e-14

FloatArray = NDArray[np.float64]
Case = dict[str, Any]
Errors = dict[str, float]

CASES: list[Case] = json.loads(
    (Path(__file__).parents[1] / "data" / "dynamics_cases.json").read_text(encoding="utf-8")
)


def model_of(case: Case) -> cdcr.Model:
    robot = cdcr.Robot(
        sections=[cdcr.Section(**section) for section in case["sections"]],
        gravity=case["gravity"],
        payload=case["payload"],
    )
    return cdcr.Model(robot)


def relative(actual: ArrayLike, expected: ArrayLike, scale: float | None = None) -> float:
    """Largest difference, relative to the largest expected magnitude or to `scale`."""
    actual, expected = np.asarray(actual), np.asarray(expected)
    assert actual.shape == expected.shape
    if scale is None:
        scale = float(np.abs(expected).max())
    return float(np.abs(actual - expected).max() / scale) if scale > 0.0 else 0.0


@pytest.fixture(scope="module")
def seen() -> Iterator[dict[int, Errors]]:
    """Errors of this run by number of sections and quantity, printed at the end."""
    errors: dict[int, Errors] = {}
    yield errors
    for number, largest in sorted(errors.items()):
        print(f"\n{number} section(s):", ", ".join(f"{k} {v:.1e}" for k, v in largest.items()))


def test_there_are_cases_of_one_two_and_three_sections() -> None:
    numbers = [len(case["sections"]) for case in CASES]
    assert [numbers.count(n) for n in (1, 2, 3)] == [15, 6, 2]


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
class TestCase:
    def check(self, seen: dict[int, Errors], case: Case, what: str, error: float) -> None:
        number = len(case["sections"])
        largest = seen.setdefault(number, {})
        largest[what] = max(error, largest.get(what, 0.0))
        assert error <= TOLERANCE

    def test_accelerations(self, case: Case, seen: dict[int, Errors]) -> None:
        tension = np.concatenate(case["tensions"])
        qdd = model_of(case).forward_dynamics(case["q"], case["qd"], tension)
        self.check(seen, case, "qdd", relative(qdd, case["qdd"]))

    def test_inverse_dynamics_gives_the_force_of_the_tensions(
        self, case: Case, seen: dict[int, Errors]
    ) -> None:
        model = model_of(case)
        force = model.inverse_dynamics(case["q"], case["qd"], case["qdd"])
        expected = model.actuation_matrix() @ np.concatenate(case["tensions"])
        # Inertia and elastic forces cancel in the sum.
        inertial = np.abs(model.mass_matrix(case["q"])) @ np.abs(case["qdd"])
        scale = inertial.max() + np.abs(expected).max()
        self.check(seen, case, "force", relative(force, expected, scale))

    def test_mass_matrix(self, case: Case, seen: dict[int, Errors]) -> None:
        M = model_of(case).mass_matrix(case["q"])
        self.check(seen, case, "M", relative(M, case["mass_matrix"]))

    def test_energies(self, case: Case, seen: dict[int, Errors]) -> None:
        model = model_of(case)
        T = model.kinetic_energy(case["q"], case["qd"])
        self.check(seen, case, "T", relative(T, case["kinetic_energy"]))
        U = model.potential_energy(case["q"])
        self.check(seen, case, "U", relative(U, case["potential_energy"]))

    def test_tip(self, case: Case, seen: dict[int, Errors]) -> None:
        rotation, position = model_of(case).tip(case["q"])
        self.check(seen, case, "tip", relative(position, case["tip_position"]))
        self.check(seen, case, "tip", relative(rotation, case["tip_rotation"]))
