"""Where a search ends, what it costs, and whether motions tell their parameters as well as said."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.optimize import least_squares  # type: ignore[import-untyped]

import cdcr
from cdcr.base.arrays import FloatArray
from cdcr.identification import Motion, Poses, problem, search
from cdcr.identification.data import UnsolvedError
from cdcr.identification.fit import prepared
from measured import NOISE, ROBOT, pulls, tips

SEEDS = 100 if int(os.environ.get("CDCR_RANDOM_TESTS", "0")) else 6
FAR = 4.5  # standard errors: one in 150,000 draws is farther
TRUE = {"sections[*].youngs_modulus": 63e9, "sections[*].damping": 3e-4, "time shift": 4e-3}
SOUGHT: dict[str, Any] = dict.fromkeys(TRUE)
T = np.arange(0.0, 0.405, 0.01)


@pytest.fixture(scope="module")
def clean() -> FloatArray:
    """The tip of a robot let go under 3 N on cable 1, seen by a clock that is ahead [m]."""
    section = replace(ROBOT.sections[0], youngs_modulus=63e9, damping=3e-4)
    model = cdcr.Model(replace(ROBOT, sections=(section, section)))
    late = TRUE["time shift"]
    t = np.concatenate([[0.0], T[1:] - late])
    q0 = model.equilibrium([3.0, 0, 0, 0, 0, 0])
    return cdcr.simulate(model, q0, np.zeros(4), t=t, tension=np.zeros(6)).tip


def motion(clean: FloatArray, seed: int, noise: float = NOISE, **given: Any) -> Motion:
    tip = clean + np.random.default_rng(seed).normal(0.0, noise, clean.shape)
    return Motion(T, np.zeros(6), tip=tip, start=[3.0, 0, 0, 0, 0, 0], noise=noise, **given)


def test_errors_of_motions_are_as_large_as_they_are_said_to_be(clean: FloatArray) -> None:
    every = []
    for seed in range(SEEDS):
        found = cdcr.identify(motion(clean, seed), ROBOT, SOUGHT)
        every.append([(one.value - TRUE[one.path]) / one.standard_error for one in found.estimates])
    errors = np.array(every)
    assert np.abs(errors).max() < FAR
    assert abs(np.mean(errors**2) - 1.0) < FAR * np.sqrt(2.0 / errors.size)
    within = (np.abs(errors) < 1.96).mean()
    assert within > 0.95 - FAR * np.sqrt(0.05 * 0.95 / errors.size)


def test_a_search_ends_where_one_to_rounding_does(
    clean: FloatArray, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = motion(clean, 3)
    asked = []
    jacobian = problem.Problem.jacobian

    def count(self: problem.Problem, x: FloatArray) -> FloatArray:
        asked.append(x)
        return jacobian(self, x)

    monkeypatch.setattr(problem.Problem, "jacobian", count)
    found = cdcr.identify(one, ROBOT, SOUGHT)
    assert found.success
    assert len(asked) < found.evaluations <= 8  # the last steps go by derivatives found before
    whole = prepared(one, ROBOT, SOUGHT)
    exact = least_squares(
        whole.residuals, np.zeros(3), whole.jacobian, x_scale="jac", xtol=1e-14, ftol=1e-14
    )
    for estimate, value in zip(found.estimates, whole.values(exact.x), strict=True):
        assert abs(estimate.value - value) < 10.0 * search.SETTLED * estimate.standard_error


def test_bounds_far_from_the_search_cost_nothing(clean: FloatArray) -> None:
    one = motion(clean, 3)
    free = cdcr.identify(one, ROBOT, SOUGHT)
    bounds = {"low": 1e9, "high": 1e12}
    held = cdcr.identify(one, ROBOT, SOUGHT | {"sections[*].youngs_modulus": bounds})
    assert held.evaluations == free.evaluations
    assert [one.value for one in held.estimates] == [one.value for one in free.estimates]


def test_a_bound_on_the_way_holds_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    # From 60 GPa to 20 a first step along the slope leads below zero.
    bounded = []
    ways = search._Steps.search

    def note(self: search._Steps, *given: Any, **how: Any) -> Any:
        bounded.append(how["bounded"])
        return ways(self, *given, **how)

    monkeypatch.setattr(search._Steps, "search", note)
    commands = pulls(6, high=0.5)
    stiff = replace(ROBOT.sections[0], youngs_modulus=20e9)
    poses = Poses(
        commands, tip=tips(replace(ROBOT, sections=(stiff, stiff)), commands), noise=NOISE
    )
    path = "sections[*].youngs_modulus"
    found = cdcr.identify(poses, ROBOT, {path: {"start": 60e9, "low": 5e9, "high": 61e9}})
    assert found[path] == pytest.approx(20e9, rel=1e-4)
    assert not found.estimates[0].at_bound
    assert bounded == [False, True]


@pytest.mark.parametrize("away", [0.3, 1.0, 1.9])  # in steps to either side, for derivatives
def test_derivatives_close_to_a_bound_stay_off_it(clean: FloatArray, away: float) -> None:
    path = "sections[*].youngs_modulus"  # nothing has one of zero
    whole = prepared(motion(clean, 0), ROBOT, {path: None})
    x = whole.low + away * problem.STEP
    side = whole._side(x, 0, whole.setup(x))
    low, high = (one.robot.sections[0].youngs_modulus for one in (side.below, side.above))
    assert 0.0 < low < high
    assert high - low == pytest.approx(side.width * whole.size[0])


def test_motions_side_by_side_tell_what_one_after_another_do(
    clean: FloatArray, monkeypatch: pytest.MonkeyPatch
) -> None:
    several = [motion(clean, seed, name=f"motion {seed}") for seed in range(3)]
    monkeypatch.setattr(problem, "usable", lambda: 3)
    beside = cdcr.identify(several, ROBOT, SOUGHT)
    monkeypatch.setattr(problem, "usable", lambda: 1)
    after = cdcr.identify(several, ROBOT, SOUGHT)
    assert [one.value for one in beside.estimates] == [one.value for one in after.estimates]
    assert np.array_equal(beside.covariance, after.covariance)


def test_derivatives_of_a_run_are_as_good_as_its_noise_asks(clean: FloatArray) -> None:
    """A coarser run gives them; a finer one, by differences, gives the same to a thousandth."""
    whole = prepared(motion(clean, 0, rtol=None), ROBOT, SOUGHT)
    x, h = np.full(3, 0.02), 1e-3
    slopes = whole.jacobian(x)
    for k in range(3):
        step = h * np.eye(3)[k]
        solved = (whole.residuals(x + step) - whole.residuals(x - step)) / (2.0 * h)
        assert np.abs(slopes[:, k] - solved).max() < 1e-3 * np.abs(solved).max()


def test_a_search_ends_at_the_edge_of_what_the_model_answers(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    commands = pulls(20)
    soft = replace(ROBOT, sections=(replace(ROBOT.sections[0], youngs_modulus=45e9),) * 2)
    poses = Poses(commands, tip=tips(soft, commands), noise=NOISE)
    slopes, asked = problem.Problem.jacobian, []

    def edge(self: problem.Problem, x: FloatArray) -> FloatArray:
        asked.append(x)
        if len(asked) > allowed:
            raise UnsolvedError("poses, row 1: too far")
        return slopes(self, x)

    monkeypatch.setattr(problem.Problem, "jacobian", edge)
    allowed = 1
    found = cdcr.identify(poses, ROBOT, {"sections[*].youngs_modulus": None})
    assert not found.success
    assert found.message == "it came to the edge of what the model answers: poses, row 1: too far"
    assert 40e9 < found["sections[*].youngs_modulus"] < 60e9
    assert f"The search ended early: {found.message}" in found.report()
    allowed = 0
    with pytest.raises(ValueError, match="no answer at the start: poses, row 1: too far"):
        cdcr.identify(poses, ROBOT, {"sections[*].youngs_modulus": None})
