"""What constant curvature costs, as the table of cpp/several-sections.md states it.

Small planar vibration of the Table 1 robot with its one physical section cut into n parts of
constant curvature, ten point disks, no rotary inertia. The beam itself is the limit of many parts.
``pytest -s`` prints the table.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import cdcr

README = Path(__file__).parents[2] / "cpp" / "several-sections.md"

TABLE_1 = cdcr.robots.amouri2020()
MANY_PARTS = 100  # within 3e-5 of the limit, in the first two frequencies
ROTARY = 5e-4  # what the rotary inertia of the disks takes off the frequency

FloatArray = NDArray[np.float64]


def frequencies(parts: int) -> FloatArray:
    """Natural frequencies [rad/s] in increasing order, each part's bending angle a coordinate."""
    s = TABLE_1.sections[0]

    def deflection(x: FloatArray) -> FloatArray:
        """Sideways motion at fractions x for a unit angle of each part: slopes add up."""
        start = np.arange(parts) / parts
        behind = np.maximum(x[:, None] - start, 0.0) ** 2
        beyond = np.maximum(x[:, None] - start - 1.0 / parts, 0.0) ** 2
        return np.asarray(s.length * parts / 2.0 * (behind - beyond))

    nodes, weights = np.polynomial.legendre.leggauss(4)  # exact: the integrand has degree four
    mass = np.zeros((parts, parts))
    for part in range(parts):
        y = deflection((part + (1.0 + nodes) / 2.0) / parts)
        mass += s.backbone_mass * y.T @ np.diag(weights / 2.0 / parts) @ y
    y = deflection(np.arange(1, s.num_disks + 1) / s.num_disks)
    mass += s.disk_mass * y.T @ y
    stiffness = s.stiffness * parts  # a shorter part is stiffer
    return np.sort(np.sqrt(np.linalg.eigvals(stiffness * np.linalg.inv(mass)).real))


def test_one_part_is_the_model() -> None:
    A, _ = cdcr.Model(TABLE_1).linearize([0.0, 0.0], [0.0, 0.0], [0.0, 0.0, 0.0])
    assert np.sqrt(-A[2, 0]) == pytest.approx(frequencies(1)[0], rel=ROTARY)
    assert np.sqrt(-A[2, 0]) == pytest.approx(9.096, abs=5e-4)


def test_frequencies_are_as_the_readme_states() -> None:
    beam = frequencies(MANY_PARTS)
    print(f"\nbeam: {beam[0]:.3f} and {beam[1]:.3f} rad/s")
    row = r"^\| (\d+) \| ([\d.]+) \| \+([\d.]+) % \| (?:\+([\d.]+) %|-) \|$"
    rows = re.findall(row, README.read_text(), re.MULTILINE)
    assert [int(parts) for parts, *_ in rows] == [1, 2, 3, 4, 8]
    for parts, first, excess, second_excess in rows:
        found = frequencies(int(parts))
        error = 100.0 * (found[:2] / beam[: len(found[:2])] - 1.0)
        print(f"{parts:>2} parts: {found[0]:.3f} rad/s,", *(f"{e:+.2f} %" for e in error))
        assert found[0] == pytest.approx(float(first), abs=5e-4)
        assert error[0] == pytest.approx(float(excess), abs=0.01)
        if second_excess:
            assert error[1] == pytest.approx(float(second_excess), abs=0.1)
    stated = re.search(r"the beam itself vibrates at ([\d.]+) rad/s", README.read_text())
    assert stated is not None
    assert beam[0] == pytest.approx(float(stated[1]), abs=5e-4)
