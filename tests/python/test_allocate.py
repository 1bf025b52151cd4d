"""Tensions for a generalised force, as Python sees them."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

import cdcr

# A handful of operations.
ROUNDING = 1e-14


@pytest.fixture
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020())


def with_cables(*angles: float) -> cdcr.Model:
    robot = cdcr.robots.amouri2020()
    return cdcr.Model(replace(robot, sections=(replace(robot.sections[0], cable_angles=angles),)))


def test_the_force_is_met_by_tensions_of_which_one_is_zero(model: cdcr.Model) -> None:
    B = model.actuation_matrix()
    for phi in np.radians(np.arange(-180.0, 180.0, 15.0)):
        force = 0.2 * np.array([np.cos(phi), np.sin(phi)])
        tension = model.allocate(force)
        assert tension.dtype == np.float64
        np.testing.assert_allclose(B @ tension, force, rtol=0.0, atol=ROUNDING)
        assert abs(tension.min()) <= ROUNDING * tension.max()


def test_pretension_is_common_to_all_three(model: cdcr.Model) -> None:
    slack = model.allocate([0.05, 0.02])
    tight = model.allocate([0.05, 0.02], min_tension=1.5)
    np.testing.assert_allclose(tight - slack, 1.5, rtol=10 * ROUNDING)


def test_an_infeasible_force_names_the_cables(model: cdcr.Model) -> None:
    radius = model.robot.sections[0].cable_radius
    force = np.array([10.0 * radius, 0.0])
    with pytest.raises(cdcr.InfeasibleError) as caught:
        model.allocate(force, max_tension=4.0)
    error = caught.value
    assert str(error).startswith(f"force {force} N m cannot be met with tensions from 0.0 to 4.0 N")
    assert "limited by cables [0, 1, 2], the nearest force is" in str(error)
    np.testing.assert_array_equal(error.tension, [4.0, 0.0, 0.0])
    np.testing.assert_allclose(error.force, [4.0 * radius, 0.0], atol=ROUNDING)
    assert error.limiting == (0, 1, 2)
    assert isinstance(error, ValueError)


def test_one_cable_pulls_one_way_only() -> None:
    model = with_cables(0.0)
    with pytest.raises(cdcr.InfeasibleError, match=r"limited by cables \[0\]"):
        model.allocate([-0.1, 0.0])
    np.testing.assert_allclose(model.allocate([0.019, 0.0]), [1.0], rtol=ROUNDING)


def test_find_tension_tells_how_near_it_came(model: cdcr.Model) -> None:
    met = model.find_tension([0.05, 0.02], 0.0, math.inf)
    assert met.feasible
    assert met.distance <= ROUNDING
    assert met.limiting == []
    radius = model.robot.sections[0].cable_radius
    missed = model.find_tension([10.0 * radius, 0.0], 0.0, 4.0)
    assert not missed.feasible
    assert missed.limiting == [0, 1, 2]
    assert missed.distance == pytest.approx(6.0 * radius, rel=ROUNDING)
    np.testing.assert_array_equal(missed.force, model.actuation_matrix() @ missed.tension)


def test_no_cables_no_force() -> None:
    model = with_cables()
    assert model.allocate([0.0, 0.0]).shape == (0,)
    with pytest.raises(cdcr.InfeasibleError, match=r"limited by cables \[\]"):
        model.allocate([0.1, 0.0])


@pytest.mark.parametrize(
    ("force", "limits", "sentence"),
    [
        ([1.0, 2.0, 3.0], {}, "force must have shape (2,), got (3,)"),
        ([1.0, math.nan], {}, "force[1] must be finite, got nan"),
        ([0.0, 0.0], {"min_tension": -1.0}, "min_tension must be >= 0 N (a cable cannot push)"),
        ([0.0, 0.0], {"min_tension": math.nan}, "min_tension must be >= 0 N (a cable cannot push)"),
        (
            [0.0, 0.0],
            {"min_tension": 2.0, "max_tension": 1.0},
            "tension limits must satisfy min_tension <= max_tension, got min_tension 2 N and "
            "max_tension 1 N",
        ),
        (
            [0.0, 0.0],
            {"max_tension": math.nan},
            "tension limits must satisfy min_tension <= max_tension, got min_tension 0 N and "
            "max_tension nan N",
        ),
    ],
)
def test_refusals(
    model: cdcr.Model, force: list[float], limits: dict[str, float], sentence: str
) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}"):
        model.allocate(force, **limits)
