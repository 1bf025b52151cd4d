"""A rod that stretches keeps a tenth of its length; what would take more says so."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import cdcr

LENGTH = 0.3
ROBOT = cdcr.Robot(
    sections=[
        cdcr.Section(
            length=LENGTH,
            backbone_mass=0.01,
            backbone_diameter=2e-3,
            youngs_modulus=60e9,
            cable_radius=0.01,
            cable_angles=[0.0, 2.1, 4.2],
            stretch_order=0,
            stretch_stiffness=50.0,
        )
    ]
)
# Three cables of 15 N press 50 N by nine tenths of the length.
MOST = [15.0, 15.0, 15.0]


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(ROBOT)


def test_up_to_the_limit_there_is_a_rest(model: cdcr.Model) -> None:
    q = model.equilibrium(np.multiply(0.99, MOST))
    assert np.isfinite(model.tip(q)[1]).all()
    np.testing.assert_allclose(q[-1], -0.99 * 0.9 * LENGTH, rtol=1e-6)


def test_equilibria_beyond_tell_compression(model: cdcr.Model) -> None:
    for pull in (1.05, 2.0):
        found = model.find_equilibrium(np.multiply(pull, MOST))
        assert found.status == cdcr.Status.compression_limit


def test_slow_ways_end_at_the_limit(model: cdcr.Model) -> None:
    run = cdcr.quasi_static(model, np.outer([0.0, 1.03], MOST), throw=False)
    assert (run.status, len(run.q)) == (cdcr.Status.not_converged, 1)
    assert np.isfinite(run.tip).all()


@pytest.mark.parametrize("height", [0.01, -0.01])
def test_tips_are_reached_by_shapes_within(model: cdcr.Model, height: float) -> None:
    found = model.inverse_kinematics([0.0, 0.0, height])
    assert np.isfinite(model.mass_matrix(found.q)).all()
    _, tip = model.tip(found.q)
    assert found.reachable == (np.linalg.norm(tip - [0.0, 0.0, height]) < 1e-6)


@pytest.mark.parametrize(
    "point", [(-0.759, -0.134, -0.906), (0.19, 1.129, -0.836), (-0.435, -0.703, -0.678)]
)
def test_shapes_of_higher_orders_stay_within(point: tuple[float, float, float]) -> None:
    (section,) = ROBOT.sections
    rod = replace(section, shear_modulus=23e9, stretch_stiffness=None)
    rod = replace(rod, bending_order=2, twist_order=0, stretch_order=1)
    model = cdcr.Model(cdcr.Robot(sections=[rod]))
    found = model.inverse_kinematics(point)
    assert np.isfinite(model.mass_matrix(found.q)).all()
    _, tip = model.tip(found.q)
    assert found.reachable == (np.linalg.norm(tip - np.array(point)) < 1e-6)
