"""Inverse kinematics of several sections: round trips, nearest points, limits, refusals."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import NonlinearConstraint, least_squares, minimize  # type: ignore[import-untyped]

import cdcr

FloatArray = NDArray[np.float64]

# Residual that the search counts as reached, in lengths of the robot.
REACHED = 1e-9
# Two searches for the same least distance: it is flat there, so they differ by far less.
NEAREST = 1e-6
# Sections of round-trip targets bend by no more than this [rad].
USUAL_BENDING = 2.5


def arm(num_sections: int) -> cdcr.Model:
    robot = cdcr.robots.amouri2020()
    lengths = [0.25 - 0.02 * i for i in range(num_sections)]
    sections = tuple(replace(robot.sections[0], length=length) for length in lengths)
    return cdcr.Model(replace(robot, sections=sections))


MODELS = {n: arm(n) for n in (1, 2, 3, 5, 8)}


def random_bending(rng: np.random.Generator, num_sections: int) -> FloatArray:
    theta = USUAL_BENDING * np.sqrt(rng.random(num_sections))
    phi = rng.uniform(-math.pi, math.pi, num_sections)
    return np.column_stack([theta * np.cos(phi), theta * np.sin(phi)]).ravel()


def thetas(q: FloatArray) -> FloatArray:
    return np.hypot(q[0::2], q[1::2])


@pytest.mark.parametrize(
    ("num_sections", "with_rotation"),
    [*((n, False) for n in MODELS), *((n, True) for n in (1, 3, 5, 8))],
)
def test_round_trip(num_sections: int, with_rotation: bool) -> None:
    model, rng = MODELS[num_sections], np.random.default_rng(1)
    length = model.robot.length
    for _ in range(1000):
        R, p = model.tip(random_bending(rng, num_sections))
        answer = model.inverse_kinematics(p, R if with_rotation else None)
        assert answer.reachable, answer.message
        reached_R, reached_p = model.tip(answer.q)
        assert np.linalg.norm(reached_p - p) <= REACHED * length
        np.testing.assert_array_equal(answer.position, reached_p)
        np.testing.assert_array_equal(answer.rotation, reached_R)
        if with_rotation:
            assert np.linalg.norm(reached_R - R) <= 10 * REACHED
            assert answer.angle <= 10 * REACHED
        else:
            assert answer.angle == 0.0


def test_two_sections_reach_most_of_their_poses() -> None:
    # Four coordinates for a pose: starts that end beside it are more frequent.
    model, rng = MODELS[2], np.random.default_rng(2)
    poses = [model.tip(random_bending(rng, 2)) for _ in range(500)]
    assert sum(model.inverse_kinematics(p, R).reachable for R, p in poses) >= 495


def least_distance(model: cdcr.Model, p: FloatArray, rng: np.random.Generator) -> float:
    """Of the tip from p, by SciPy from many starts."""
    n = model.num_sections
    runs = (
        least_squares(
            lambda q: model.tip(q)[1] - p,
            random_bending(rng, n),
            lambda q: model.jacobian(q, n - 1, 1.0)[:3],
            bounds=(-6.0, 6.0),
            xtol=1e-10,
            ftol=1e-12,
            gtol=1e-12,
        )
        for _ in range(10)
    )
    return min(math.sqrt(2.0 * run.cost) for run in runs)


@pytest.mark.parametrize("num_sections", [2, 3, 5])
def test_nearest_point_is_scipys_or_nearer(num_sections: int) -> None:
    model, rng = MODELS[num_sections], np.random.default_rng(3)
    for _ in range(5 if num_sections < 5 else 2):
        direction = rng.normal(size=3)
        p = rng.uniform(1.05, 3.0) * model.robot.length * direction / np.linalg.norm(direction)
        answer = model.inverse_kinematics(p)
        assert not answer.reachable
        assert answer.message.startswith("p is ")
        assert answer.distance <= least_distance(model, p, rng) * (1.0 + NEAREST)


def test_nearest_point_within_limits_is_scipys_or_nearer() -> None:
    model, rng, max_theta = MODELS[3], np.random.default_rng(4), 0.6
    inside = NonlinearConstraint(lambda q: q[0::2] ** 2 + q[1::2] ** 2, 0.0, max_theta**2)
    for _ in range(3):
        p = model.robot.length * rng.normal(size=3)
        answer = model.inverse_kinematics(p, max_theta=max_theta)
        runs = (
            minimize(
                lambda q, p=p: float(np.linalg.norm(model.tip(q)[1] - p)),
                0.2 * random_bending(rng, 3),
                method="SLSQP",
                constraints=[inside],
                options={"ftol": 1e-14, "maxiter": 500},
            )
            for _ in range(5)
        )
        best = min(run.fun for run in runs if thetas(run.x).max() <= max_theta * (1.0 + 1e-9))
        assert answer.distance <= best * (1.0 + NEAREST)
        assert thetas(answer.q).max() <= max_theta


def test_the_base_may_be_turned() -> None:
    rows = ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    robot, turned = replace(MODELS[1].robot, base_orientation=rows), np.array(rows)
    point = np.array([0.05, 0.02, 0.1])
    here = MODELS[1].inverse_kinematics(point)
    there = cdcr.Model(robot).inverse_kinematics(turned @ point)
    np.testing.assert_allclose(there.q, here.q, atol=1e-15)
    np.testing.assert_allclose(there.position, turned @ here.position, atol=1e-15)


def refuses(sentence: str) -> Any:
    return pytest.raises(ValueError, match=f"^{re.escape(sentence)}$")


P = [0.1, 0.0, 0.3]
REFUSED: list[tuple[dict[str, Any], str]] = [
    ({"p": [0.1, math.inf, 0.0]}, "p[1] must be finite, got inf"),
    ({"R": [1.0, 0.0, 0.0]}, "R must have shape (3, 3), got (3,)"),
    ({"R": np.full((3, 3), math.nan)}, "R[0, 0] must be finite, got nan"),
    (
        {"R": 2.0 * np.eye(3)},
        "R must be a rotation matrix, but R^T R differs from the unit matrix by 3",
    ),
    ({"R": -np.eye(3)}, "R must be a rotation matrix, but its determinant is -1: it mirrors"),
    ({"q0": [0.0, 0.0]}, "q0 must have shape (4,), got (2,)"),
    ({"q0": [0.0, 0.0, 0.0, math.nan]}, "q0[3] (section 2) must be finite, got nan"),
    (
        {"q0": [0.0, 0.0, 10.0, 0.0]},
        "q0 must bend each section by at most 3 pi rad, got 10 rad in section 2",
    ),
    ({"max_theta": 0.0}, "max_theta must be > 0 and at most 3 pi rad, got 0"),
    (
        {"max_theta": [1.0, 10.0]},
        "max_theta[1] (section 2) must be > 0 and at most 3 pi rad, got 10",
    ),
    ({"max_theta": [1.0] * 3}, "max_theta must have shape (2,), got (3,)"),
    ({"max_theta": "wide"}, "max_theta must be numbers of shape (2,), got str"),
    ({"orientation_weight": -1.0}, "orientation_weight must be > 0 m and finite, got -1"),
    ({"tolerance": math.inf}, "tolerance must be > 0 m and finite, got inf"),
    ({"seeds": 0}, "seeds must be 1 to 100000, got 0"),
    ({"iterations": 0}, "iterations must be 1 to 100000, got 0"),
]


@pytest.mark.parametrize(("arguments", "sentence"), REFUSED)
def test_bad_input_is_refused(arguments: dict[str, Any], sentence: str) -> None:
    with refuses(sentence):
        MODELS[2].inverse_kinematics(**{"p": P, **arguments})
