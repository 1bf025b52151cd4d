"""What the model's methods refuse, each with its own sentence."""

import math
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

import cdcr
from model_calls import OF_Q, QD, QDD, TENSION, Q


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020(gravity=(1.0, 2.0, -9.81), payload=0.01))


# Every method that takes more, by what it takes.
OF_QD: dict[str, Callable[[cdcr.Model, Any], Any]] = {
    "bias": lambda m, qd: m.bias(Q, qd),
    "kinetic_energy": lambda m, qd: m.kinetic_energy(Q, qd),
    "forward_dynamics": lambda m, qd: m.forward_dynamics(Q, qd, TENSION),
    "inverse_dynamics": lambda m, qd: m.inverse_dynamics(Q, qd, QDD),
    "base_wrench": lambda m, qd: m.base_wrench(Q, qd, QDD),
    "linearize": lambda m, qd: m.linearize(Q, qd, TENSION),
}
OF_TENSION: dict[str, Callable[[cdcr.Model, Any], Any]] = {
    "forward_dynamics": lambda m, tension: m.forward_dynamics(Q, QD, tension),
    "linearize": lambda m, tension: m.linearize(Q, QD, tension),
    "equilibrium": lambda m, tension: m.equilibrium(tension),
    "find_equilibrium": lambda m, tension: m.find_equilibrium(tension),
}


def refuses(sentence: str) -> Any:
    return pytest.raises(ValueError, match=f"^{re.escape(sentence)}$")


@pytest.mark.parametrize("name", OF_Q)
def test_a_bad_bending_vector_is_refused(model: cdcr.Model, name: str) -> None:
    call = OF_Q[name]
    with refuses("q must have shape (..., 2), got (3,)"):
        call(model, [1.0, 2.0, 3.0])
    with refuses("q must have shape (..., 2), got (2, 1)"):
        call(model, [[1.0], [2.0]])
    with refuses("q must have shape (..., 2), got ()"):
        call(model, 1.0)
    with refuses("q[1] (section 1) must be finite, got nan"):
        call(model, [0.0, math.nan])
    with refuses("q must be numbers of shape (..., 2), got str"):
        call(model, "bent")
    with refuses("q must be numbers of shape (..., 2), got list"):
        call(model, [1.0, [2.0]])
    with refuses("q must bend each section by at most 3 pi rad, got 10 rad in section 1"):
        call(model, [6.0, 8.0])


@pytest.mark.parametrize("name", OF_QD)
def test_a_bad_rate_is_refused(model: cdcr.Model, name: str) -> None:
    with refuses("qd must have shape (..., 2), got (1,)"):
        OF_QD[name](model, [1.0])
    with refuses("qd[0] (section 1) must be finite, got -inf"):
        OF_QD[name](model, [-math.inf, 0.0])


def test_a_bad_acceleration_is_refused(model: cdcr.Model) -> None:
    with refuses("qdd must have shape (..., 2), got (0,)"):
        model.inverse_dynamics(Q, QD, [])
    with refuses("qdd[0] (section 1) must be finite, got inf"):
        model.inverse_dynamics(Q, QD, [math.inf, 0.0])


@pytest.mark.parametrize("name", OF_TENSION)
def test_a_bad_tension_is_refused(model: cdcr.Model, name: str) -> None:
    wanted = "(3,)" if "equilibrium" in name else "(..., 3)"
    with refuses(f"tension must have shape {wanted}, got (2,)"):
        OF_TENSION[name](model, [1.0, 2.0])
    with refuses("tension[2] (cable 3) must be finite, got nan"):
        OF_TENSION[name](model, [1.0, 2.0, math.nan])
    with refuses("tension[1] (cable 2) must be >= 0 N (a cable cannot push), got -0.5"):
        OF_TENSION[name](model, [1.0, -0.5, 0.0])


def test_a_bad_place_is_refused(model: cdcr.Model) -> None:
    for call in (model.pose, model.jacobian):
        with refuses("section must be 0 to 0, got 1"):
            call(Q, 1, 0.5)
        with refuses("section must be 0 to 0, got -1"):
            call(Q, -1, 0.5)
        with refuses("fraction must be 0 to 1, got 1.5"):
            call(Q, 0, 1.5)
        with refuses("fraction must be 0 to 1, got nan"):
            call(Q, 0, math.nan)


def test_a_bad_start_of_the_search_is_refused(model: cdcr.Model) -> None:
    with refuses("q0 must have shape (2,), got (1,)"):
        model.equilibrium(TENSION, [0.0])
    with refuses("q0 must bend each section by at most 3 pi rad, got 10 rad in section 1"):
        model.equilibrium(TENSION, [10.0, 0.0])


def test_a_bad_point_is_refused(model: cdcr.Model) -> None:
    with refuses("p must have shape (3,), got (2,)"):
        model.inverse_kinematics([0.1, 0.2])
    with refuses("p[2] must be finite, got nan"):
        model.inverse_kinematics([0.1, 0.2, math.nan])


def test_a_bad_robot_or_formulation_is_refused() -> None:
    with pytest.raises(TypeError, match=r"^robot must be a cdcr\.Robot, got str$"):
        cdcr.Model("amouri2020")  # type: ignore[arg-type]
    with refuses(
        "formulation must be one of ('exact', 'taylor', 'printed', 'printed-taylor'), got 'fast'"
    ):
        cdcr.Model(cdcr.robots.amouri2020(), formulation="fast")
    robot = cdcr.robots.amouri2020()
    two = replace(robot, sections=robot.sections * 2)
    with refuses(
        "formulation must be exact for this robot, got taylor: the paper's inertia is that of one "
        "section with equal, equally spaced disks, and nothing but a point on its tip"
    ):
        cdcr.Model(two, formulation="taylor")
