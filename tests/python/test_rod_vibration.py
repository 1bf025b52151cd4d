"""Frequencies of rods: in torsion, along and in bending, against their closed forms.

``pytest -s`` prints them over the order. Beams with disks: test_beam.py.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import brentq  # type: ignore[import-untyped]

import cdcr

FloatArray = NDArray[np.float64]

# What order 4 leaves of the first frequency and of the second, in torsion and along.
FIRST, SECOND = 5e-8, 2e-3
# The same problem in other units: some hundred roundings.
ROUNDING = 1e-10
# Excess of the first frequency of a thin rod over its own [%], by order of bending, to the digits
# given with the rods' design; what rounding of those leaves.
BENDING, DIGITS = {1: 0.48, 2: 0.03, 3: 0.00}, 0.006

RATIO = 2.5  # of the inertia at the tip over the rod's own
ROD = cdcr.Section(
    length=0.4,
    backbone_mass=0.03,
    backbone_diameter=0.006,
    youngs_modulus=2e8,
    shear_modulus=8e7,
    bending_order=None,
    nodes=16,
)
# By its mass and by its moment of inertia about the axis, m d^2/8, as the backbone's slices have.
LOADED = replace(ROD, num_disks=1, disk_mass=RATIO * ROD.mass, disk_diameter=0.006)
AREA = np.pi / 4.0 * 0.006**2
SPEEDS = {  # of waves along the rod [m/s]
    "twist_order": np.sqrt(8e7 * 2.0 * ROD.second_moment_of_area * 0.4 / (0.03 * 0.006**2 / 8.0)),
    "stretch_order": np.sqrt(2e8 * AREA * 0.4 / 0.03),
}


def frequencies(section: cdcr.Section) -> FloatArray:
    """Natural frequencies of the straight section [rad/s]."""
    model = cdcr.Model(cdcr.Robot(sections=[section]))
    return np.asarray(model.modes(np.zeros(model.num_coordinates)).frequency)


def roots(ratio: float) -> FloatArray:
    """First two roots of x tan x = 1/ratio: waves in a rod with an inertia at its free end."""
    low = np.array([0.0, np.pi])

    def balance(x: float) -> float:
        return float(ratio * x * np.sin(x) - np.cos(x))

    return np.array([brentq(balance, a, a + 0.6 * np.pi, xtol=1e-15) for a in low])


@pytest.mark.parametrize("strain", SPEEDS)
@pytest.mark.parametrize("ratio", [0.0, RATIO], ids=["bare", "loaded"])
def test_waves_along_a_rod(strain: str, ratio: float) -> None:
    exact = roots(ratio) * SPEEDS[strain] / ROD.length
    if ratio == 0.0:
        assert exact[0] * ROD.length / SPEEDS[strain] == pytest.approx(0.5 * np.pi)
    errors = []
    for order in range(5):
        change: dict[str, Any] = {strain: order}
        section = replace(LOADED if ratio else ROD, **change)
        found = frequencies(section)[:2]
        errors.append(np.resize(found / exact[: len(found)] - 1.0, 2))
        print(f"\n{strain} {order}, inertia at the tip {ratio:g}: too high by {errors[-1]}")
    first, second = np.transpose(errors)
    assert np.all(first > -ROUNDING)
    assert np.all(np.diff(first[:4]) < 0.0)
    assert first[-1] < FIRST
    assert 0.0 < second[-1] < SECOND


def test_a_thin_rod_bends_as_the_textbook_says() -> None:
    thin = replace(ROD, backbone_diameter=1e-4, nodes=None)  # its slices' inertia takes off 1e-8
    flexural = thin.youngs_modulus * thin.second_moment_of_area
    # The first root of cos b cosh b = -1.
    exact = 1.8751040687**2 * np.sqrt(flexural / (thin.mass * thin.length**3))
    for order, percent in BENDING.items():
        found = 100.0 * (frequencies(replace(thin, bending_order=order))[:2] / exact - 1.0)
        print(f"\nbending order {order}: too high by {found} %")
        assert found == pytest.approx(percent, abs=DIGITS)
        assert np.all(found > 0.0)
