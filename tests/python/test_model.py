"""The model's methods: what they take, give and refuse, and that derivatives are derivatives."""

import math
import pickle
import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

import cdcr
from model_calls import OF_Q, QD, QDD, TENSION, Q

# A handful of operations on numbers near one.
ROUNDING = 1e-14
# Central differences with a step of 1e-5: its square, and rounding over it.
STEP = 1e-5
DIFFERENCES = 1e-9


def hanging(**options: Any) -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020(gravity=(1.0, 2.0, -9.81), payload=0.01, **options))


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return hanging(damping=1e-3)


@pytest.fixture(scope="module")
def massless() -> cdcr.Model:
    robot = cdcr.robots.amouri2020()
    return cdcr.Model(
        replace(robot, sections=(replace(robot.sections[0], backbone_mass=0.0, disk_mass=0.0),))
    )


def refuses(sentence: str) -> Any:
    return pytest.raises(ValueError, match=f"^{re.escape(sentence)}$")


def read_only(values: NDArray[np.float64]) -> NDArray[np.float64]:
    values.setflags(write=False)
    return values


@pytest.mark.parametrize(
    "kind",
    [
        list,
        tuple,
        lambda v: np.array(v, dtype=np.float64),
        lambda v: np.array(v, dtype=np.longdouble),
        lambda v: np.repeat(np.array(v), 2)[::2],  # not contiguous
        lambda v: np.array(v[::-1])[::-1],  # negative stride
        lambda v: read_only(np.array(v)),
        lambda v: np.array(v, dtype=">f8"),  # the other byte order
    ],
)
def test_any_sequence_of_numbers_will_do(
    model: cdcr.Model, kind: Callable[[list[float]], ArrayLike]
) -> None:
    expected = model.forward_dynamics(Q, QD, TENSION)
    found = model.forward_dynamics(kind(Q), kind(QD), kind(TENSION))
    np.testing.assert_array_equal(found, expected)


def test_single_precision_and_integers_will_do(model: cdcr.Model) -> None:
    q = np.array([0.5, -0.25], dtype=np.float32)
    np.testing.assert_array_equal(model.mass_matrix(q), model.mass_matrix([0.5, -0.25]))
    np.testing.assert_array_equal(model.mass_matrix([1, 0]), model.mass_matrix([1.0, 0.0]))


@pytest.mark.parametrize("name", OF_Q)
def test_answers_are_fresh_float64(model: cdcr.Model, name: str) -> None:
    first, second = OF_Q[name](model, Q), OF_Q[name](model, Q)
    if isinstance(first, float):
        assert first == second
        return
    pairs = zip(first, second, strict=True) if isinstance(first, tuple) else [(first, second)]
    for a, b in pairs:
        assert a.dtype == np.float64
        assert a.flags.writeable
        expected = b.copy()
        a[...] = -7.0
        np.testing.assert_array_equal(b, expected)
    again = OF_Q[name](model, Q)
    again = again if isinstance(again, tuple) else (again,)
    second = second if isinstance(second, tuple) else (second,)
    for a, b in zip(again, second, strict=True):
        np.testing.assert_array_equal(a, b)


def test_the_actuation_matrix_is_a_copy(model: cdcr.Model) -> None:
    B = model.actuation_matrix()
    expected = B.copy()
    B[...] = 0.0
    np.testing.assert_array_equal(model.actuation_matrix(), expected)


def test_the_tip_is_the_end_of_the_last_section(model: cdcr.Model) -> None:
    for found, expected in zip(model.pose(Q, 0, 1.0), model.tip(Q), strict=True):
        np.testing.assert_array_equal(found, expected)
    R, p = model.pose(Q, 0, 0.0)
    np.testing.assert_array_equal(R, np.eye(3))
    np.testing.assert_array_equal(p, np.zeros(3))


@pytest.mark.parametrize("q", [[0.0, 0.0], Q, [2.0, 3.0]])
@pytest.mark.parametrize("fraction", [0.3, 1.0])
def test_jacobian_matches_differences(model: cdcr.Model, q: list[float], fraction: float) -> None:
    J = model.jacobian(q, 0, fraction)
    R = model.pose(q, 0, fraction)[0]
    assert J.shape == (6, 2)
    for k, change in enumerate(STEP * np.eye(2)):
        R_ahead, p_ahead = model.pose(q + change, 0, fraction)
        R_behind, p_behind = model.pose(q - change, 0, fraction)
        np.testing.assert_allclose(J[:3, k], (p_ahead - p_behind) / (2 * STEP), atol=DIFFERENCES)
        spin = (R_ahead - R_behind) / (2 * STEP) @ R.T
        omega = [spin[2, 1], spin[0, 2], spin[1, 0]]
        np.testing.assert_allclose(J[3:, k], omega, atol=DIFFERENCES)


@pytest.mark.parametrize("q", [[0.0, 0.0], Q, [2.0, 3.0]])
def test_linearize_matches_differences(model: cdcr.Model, q: list[float]) -> None:
    A, B = model.linearize(q, QD, TENSION)
    assert A.shape == (4, 4)
    assert B.shape == (4, 3)
    np.testing.assert_array_equal(A[:2], np.hstack([np.zeros((2, 2)), np.eye(2)]))
    np.testing.assert_array_equal(B[:2], np.zeros((2, 3)))
    inputs = np.concatenate([q, QD, TENSION])
    columns = np.hstack([A, B])[2:]
    for k, change in enumerate(STEP * np.eye(7)):
        ahead, behind = inputs + change, inputs - change
        difference = (
            model.forward_dynamics(ahead[:2], ahead[2:4], ahead[4:])
            - model.forward_dynamics(behind[:2], behind[2:4], behind[4:])
        ) / (2 * STEP)
        np.testing.assert_allclose(
            columns[:, k], difference, rtol=0.0, atol=DIFFERENCES * np.abs(columns).max()
        )


def test_derivatives_are_those_of_linearize_and_of_wrenches(model: cdcr.Model) -> None:
    wrench = cdcr.Wrench(
        section=0, fraction=0.6, force=(0.1, 0.2, -0.3), moment=(0.01, 0.02, 0.03), frame="local"
    )
    found = model.derivatives(Q, QD, TENSION, wrench)
    A, B = model.linearize(Q, QD, TENSION, wrench)
    np.testing.assert_allclose(np.hstack([found.dqdd_dq, found.dqdd_dqd]), A[2:], rtol=ROUNDING)
    np.testing.assert_allclose(found.dqdd_dtension, B[2:], rtol=ROUNDING)
    # The wrench acts linearly.
    change = model.forward_dynamics(Q, QD, TENSION, wrench) - model.forward_dynamics(Q, QD, TENSION)
    components = [*wrench.force, *wrench.moment]
    np.testing.assert_allclose(found.dqdd_dwrench[:, 0] @ components, change, rtol=DIFFERENCES)


def test_cable_lengths_of_the_straight_robot(model: cdcr.Model) -> None:
    np.testing.assert_allclose(model.cable_lengths([0.0, 0.0]), 0.802, rtol=ROUNDING)


def test_inverse_kinematics_round_trip_and_out_of_reach(model: cdcr.Model) -> None:
    answer = model.inverse_kinematics(model.tip(Q)[1])
    np.testing.assert_allclose(answer.q, Q, atol=ROUNDING)
    assert answer.reachable
    assert answer.distance <= ROUNDING
    above = model.inverse_kinematics([0.0, 0.0, 1.0])
    np.testing.assert_allclose(above.q, [0.0, 0.0], atol=ROUNDING)
    np.testing.assert_allclose(above.position, [0.0, 0.0, 0.802], atol=ROUNDING)
    assert above.distance == pytest.approx(0.198, abs=ROUNDING)
    assert not above.reachable
    assert repr(above).startswith("<InverseKinematics: q = [")
    assert repr(above).endswith(f"not reached: {above.message}>")
    assert repr(answer).endswith("reached>")


def test_equilibrium_under_five_newtons() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    theta, phi = cdcr.polar(model.equilibrium([5.0, 0.0, 0.0]))
    # r F / K, K = 0.363412 N m/rad
    assert theta == pytest.approx(0.019 * 5.0 / model.robot.sections[0].stiffness, rel=ROUNDING)
    assert f"{math.degrees(float(theta)):.4f}" == "14.9778"
    assert phi == 0.0


def test_equilibrium_balances_every_force(model: cdcr.Model) -> None:
    q = model.equilibrium(TENSION)
    unbalanced = model.bias(q, [0.0, 0.0]) - model.actuation_matrix() @ TENSION
    np.testing.assert_allclose(unbalanced, 0.0, atol=ROUNDING)
    np.testing.assert_allclose(model.equilibrium(TENSION, q), q, atol=ROUNDING)


def test_a_heavy_upright_robot_is_unstable() -> None:
    robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, -9.81), payload=0.5)
    model = cdcr.Model(robot)
    upright = model.equilibrium([0.0, 0.0, 0.0], throw=False)
    np.testing.assert_array_equal(upright.q, [0.0, 0.0])
    assert not upright.stable
    assert np.all(upright.eigenvalues < 0.0)
    fallen = model.equilibrium([0.0, 0.0, 0.0], [0.5, 0.0], throw=False)
    assert fallen.status is cdcr.Status.ok
    assert fallen.iterations > 0
    assert fallen.residual <= ROUNDING * 10.0
    # Along phi it may turn freely, so that one eigenvalue is zero.
    assert abs(fallen.eigenvalues[0]) <= 1e-12
    assert fallen.eigenvalues[1] > 0.0
    assert float(cdcr.polar(fallen.q)[0]) > 1.0
    light = cdcr.Model(cdcr.robots.amouri2020()).find_equilibrium([0.0, 0.0, 0.0])
    assert light.stable
    np.testing.assert_allclose(
        light.eigenvalues, cdcr.robots.amouri2020().sections[0].stiffness, rtol=ROUNDING
    )


def test_no_equilibrium_within_the_bending_limit() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    with pytest.raises(cdcr.ConvergenceError, match=r"^A section bent beyond 3 pi rad, past the"):
        model.equilibrium([500.0, 0.0, 0.0])
    assert model.equilibrium([500.0, 0.0, 0.0], throw=False).status is cdcr.Status.bending_limit


NO_INERTIA = (
    "the robot has no dynamics, because section 1 can bend without moving any mass: give it a "
    "backbone_mass or disks with a disk_mass, or the robot a payload"
)


def test_a_robot_without_inertia_has_statics(massless: cdcr.Model) -> None:
    assert not massless.has_inertia
    np.testing.assert_array_equal(massless.mass_matrix(Q), np.zeros((2, 2)))
    theta, _ = cdcr.polar(massless.equilibrium([5.0, 0.0, 0.0]))
    assert f"{math.degrees(float(theta)):.4f}" == "14.9778"
    assert massless.tip(Q)[1] == pytest.approx(hanging().tip(Q)[1], rel=ROUNDING)
    assert massless.allocate([0.019, 0.0])[0] == pytest.approx(2.0 / 3.0 + 1.0 / 3.0)
    K = massless.robot.sections[0].stiffness
    np.testing.assert_allclose(massless.inverse_dynamics(Q, QD, QDD), K * np.array(Q), rtol=1e-14)


def test_a_robot_without_inertia_has_no_dynamics(massless: cdcr.Model) -> None:
    calls: list[Callable[[], object]] = [
        lambda: massless.forward_dynamics(Q, QD, TENSION),
        lambda: massless.linearize(Q, QD, TENSION),
        lambda: cdcr.Simulator(massless),
        lambda: cdcr.simulate(massless, Q, QD, t=[0.0, 1.0]),
        lambda: cdcr.simulate(massless, Q, QD, t=[0.0, 1.0], controller=cdcr.Pid(massless, kp=1.0)),
    ]
    for call in calls:
        with refuses(NO_INERTIA):
            call()


@pytest.mark.parametrize("formulation", ["exact", "taylor", "printed", "printed-taylor"])
def test_pickle_and_repr(formulation: str) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020(damping=1e-3), formulation)
    again = pickle.loads(pickle.dumps(model))
    assert isinstance(again, cdcr.Model)
    assert again.robot == model.robot
    assert again.formulation == formulation
    np.testing.assert_array_equal(
        again.forward_dynamics(Q, QD, TENSION), model.forward_dynamics(Q, QD, TENSION)
    )
    assert repr(model) == f"<Model of 1 section, 3 cables, formulation {formulation!r}>"
