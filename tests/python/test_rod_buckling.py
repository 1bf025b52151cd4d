"""When a straight rod bends by itself: under its own weight, and under a torque. Both Greenhill's.

A. G. Greenhill, "Determination of the greatest height consistent with stability", Proc. Cambridge
Phil. Soc. 4, 1881; "On the strength of shafting when exposed both to torsion and to end thrust",
Proc. Inst. Mech. Eng. 34, 1883. ``pytest -s`` prints both over the order of bending.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigvals, null_space  # type: ignore[import-untyped]
from scipy.optimize import brentq  # type: ignore[import-untyped]
from scipy.special import jv  # type: ignore[import-untyped]

import cdcr

FloatArray = NDArray[np.float64]

# What order 4 leaves of the critical weight, and two parts of it of the critical torque.
WEIGHT, TORQUE = 4e-6, 4e-4
# Of differences of fourth order [rad]; they leave about 1e-7.
STEP = 2e-2

ROD = cdcr.Section(
    length=0.5,
    backbone_mass=0.02,
    backbone_diameter=0.004,
    youngs_modulus=2e8,
    nodes=32,
)
FLEXURAL = ROD.youngs_modulus * ROD.second_moment_of_area
GJ = 20.0 * FLEXURAL  # hard to twist, so that it turns by little before it bends


# --- Own weight -----------------------------------------------------------------------------------


def critical_weight(section: cdcr.Section) -> float:
    """Weight w l^3/(E I), w by length, under which it no longer stands upright.

    The stiffness of the straight rod is linear in gravity.
    """
    still = np.zeros(cdcr.Model(cdcr.Robot(sections=[section])).num_coordinates)

    def stiffness(gravity: float) -> FloatArray:
        robot = cdcr.Robot(sections=[section], gravity=(0.0, 0.0, -gravity))
        return cdcr.Model(robot).static_stiffness(still, [])

    found = eigvals(stiffness(0.0), stiffness(0.0) - stiffness(1.0)).real
    return float(min(found[found > 0.0]) * section.mass * section.length**2 / FLEXURAL)


def test_the_tallest_column() -> None:
    first_root = brentq(partial(jv, -1.0 / 3.0), 1.5, 2.2, xtol=1e-15)
    exact = 2.25 * first_root**2
    assert exact == pytest.approx(7.8373, abs=5e-5)
    found = [critical_weight(replace(ROD, bending_order=order)) for order in range(5)]
    errors = np.array(found) / exact - 1.0
    print("\nown weight, over the order of bending: too strong by", errors)
    assert np.all(np.diff(errors) < 0.0)  # a constraint less each time
    assert 0.0 < errors[-1] < WEIGHT


# --- Torque ---------------------------------------------------------------------------------------


def held(model: cdcr.Model, q: FloatArray) -> FloatArray:
    """What holds the tip (..., 5): on the axis, along it, and not turned about it."""
    R, p = model.tip(q)
    turned = np.arctan2(R[..., 1, 0] - R[..., 0, 1], R[..., 0, 0] + R[..., 1, 1])
    return np.stack([p[..., 0], p[..., 1], R[..., 0, 2], R[..., 1, 2], turned], axis=-1)


def differences(model: cdcr.Model, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Slope (5, d) of what is held, and second derivatives (d, d) of how far the tip is turned."""
    steps = STEP * np.array([-2.0, -1.0, 1.0, 2.0])
    weights = np.array([1.0, -8.0, 8.0, -1.0]) / (12.0 * STEP)
    along = steps[:, None, None] * np.eye(len(q))  # (4, d, d)
    slope = np.tensordot(weights, held(model, q + along), axes=1).T
    both = along[:, None, :, None] + along[None, :, None, :]  # (4, 4, d, d, d)
    turned = held(model, q + both)[..., -1]
    return slope, np.einsum("k,l,klij->ij", weights, weights, turned)


def softest(model: cdcr.Model, torque: float) -> float:
    """Least eigenvalue of the energy's second variation where the ends are held."""
    twists = [name.startswith("t") for name in model.coordinate_names]
    q = np.zeros(model.num_coordinates)
    q[twists] = torque * model.robot.sections[0].length / GJ
    slope, turned = differences(model, q)
    # What holds the straight rod is the torque alone: dU/dq = torque d(turned)/dq.
    second = model.static_stiffness(q, []) - torque * turned
    allowed = null_space(slope)
    return float(np.linalg.eigvalsh(allowed.T @ second @ allowed)[0])


def critical_torque(order: int, parts: int) -> float:
    """Torque M l/(E I) at which a rod bends, clamped at both ends, free to slide at one."""
    rod = replace(ROD, bending_order=order, twist_order=0, twist_stiffness=GJ)
    model = cdcr.Model(cdcr.Robot(sections=[rod]).subdivide(parts))
    unit = FLEXURAL / ROD.length
    return float(brentq(lambda m: softest(model, m * unit), 6.0, 14.0, xtol=1e-8))


def test_a_torque_winds_a_held_rod_into_a_helix() -> None:
    exact = 2.0 * brentq(lambda x: np.sin(x) - x * np.cos(x), 4.0, 4.7, xtol=1e-15)
    cases = [(3, 1), (4, 1), (4, 2)]
    errors = np.array([critical_torque(*case) / exact - 1.0 for case in cases])
    print(f"\nM l/(E I) = {exact:.4f}: orders and parts {cases} too strong by", errors)
    assert np.all(np.diff(errors) < 0.0)
    assert 0.0 < errors[-1] < TORQUE
