"""Tensions for a generalised force, as Python sees them."""

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import lsq_linear  # type: ignore[import-untyped]

import cdcr

# A handful of operations.
ROUNDING = 1e-14
# Of SciPy's answers, with the force weighted so much more than the norm.
SOLVER, WEIGHT = 1e-7, 1e5


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
    assert (
        "limited by cable 1 of section 1 at 4 N (max), cable 2 of section 1 at 0 N (min), "
        "cable 3 of section 1 at 0 N (min); the nearest force is" in str(error)
    )
    np.testing.assert_array_equal(error.tension, [4.0, 0.0, 0.0])
    np.testing.assert_allclose(error.force, [4.0 * radius, 0.0], atol=ROUNDING)
    assert error.limiting == (0, 1, 2)
    assert isinstance(error, ValueError)


def test_one_cable_pulls_one_way_only() -> None:
    model = with_cables(0.0)
    with pytest.raises(
        cdcr.InfeasibleError, match=r"limited by cable 1 of section 1 at 0 N \(min\);"
    ):
        model.allocate([-0.1, 0.0])
    np.testing.assert_allclose(model.allocate([0.019, 0.0]), [1.0], rtol=ROUNDING)


def test_the_whole_answer_tells_how_near_it_came(model: cdcr.Model) -> None:
    met = model.allocate([0.05, 0.02], throw=False)
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
    with pytest.raises(cdcr.InfeasibleError, match="no cable pulls that way; the nearest force is"):
        model.allocate([0.1, 0.0])


def chain(n: int, count: int, rng: np.random.Generator) -> cdcr.Model:
    """n sections at which `count` cables end, anywhere."""
    section = cdcr.robots.amouri2020().sections[0]
    return cdcr.Model(
        cdcr.Robot(
            sections=[
                replace(
                    section,
                    cable_angles=tuple(
                        2 * math.pi * np.arange(count) / count + rng.uniform(-0.3, 0.3, count)
                    ),
                    cable_radius=rng.uniform(0.01, 0.02),
                )
                for _ in range(n)
            ]
        )
    )


@pytest.mark.parametrize("n", range(2, 9))
@pytest.mark.parametrize("count", [3, 4])
def test_tensions_are_those_of_bounded_least_squares(n: int, count: int) -> None:
    """SciPy's bounded least squares, with the norm as a small second aim."""
    rng = np.random.default_rng(100 * n + count)
    model = chain(n, count, rng)
    B = model.actuation_matrix() / 0.02
    low, high = 0.5, 6.0
    met = 0
    for round_ in range(6):
        given = rng.uniform(0.0 if round_ % 2 else 1.0, 12.0 if round_ % 2 else 5.0, count * n)
        force = 0.02 * B @ given
        answer = model.find_tension(force, low, high)
        nearest = lsq_linear(B, B @ given, (low, high), method="bvls", tol=1e-15)
        distance = 0.02 * math.sqrt(2.0 * nearest.cost)
        assert answer.distance == pytest.approx(distance, abs=SOLVER * np.linalg.norm(force))
        assert answer.feasible == (distance <= SOLVER * np.linalg.norm(force))
        assert np.all((answer.tension >= low) & (answer.tension <= high))
        assert bool(answer.limits) != answer.feasible
        if not answer.feasible:
            continue
        met += 1
        stacked = np.vstack([WEIGHT * B, np.eye(count * n)])
        aims = np.concatenate([WEIGHT * B @ given, np.zeros(count * n)])
        least = lsq_linear(stacked, aims, (low, high), method="bvls", tol=1e-15)
        np.testing.assert_allclose(answer.tension, least.x, rtol=0.0, atol=SOLVER * high)
    assert met >= 3


def test_section_by_section_is_the_search() -> None:
    rng = np.random.default_rng(7)
    model = chain(4, 3, rng)
    for _ in range(20):
        force = model.actuation_matrix() @ rng.uniform(1.0, 9.0, 12)
        sections = model.allocate(force, 0.5, method="sections")
        np.testing.assert_allclose(sections, model.allocate(force, 0.5, method="search"), rtol=1e-8)
        np.testing.assert_array_equal(sections, model.allocate(force, 0.5))
    with pytest.raises(ValueError, match=r"^method sections needs three cables"):
        chain(2, 4, rng).allocate(np.zeros(4), method="sections")
    with pytest.raises(ValueError, match=r"^method must be one of .* got 'best'$"):
        model.allocate(np.zeros(8), method="best")


@pytest.mark.parametrize(
    ("force", "limits", "sentence"),
    [
        ([1.0, 2.0, 3.0], {}, "force must have shape (2,), got (3,)"),
        ([1.0, math.nan], {}, "force[1] (section 1) must be finite, got nan"),
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
    model: cdcr.Model, force: list[float], limits: dict[str, Any], sentence: str
) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(sentence)}"):
        model.allocate(force, **limits)
