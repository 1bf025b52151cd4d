"""Models as functions of CasADi: values, exact derivatives, and optima that others confirm."""

from __future__ import annotations

import copy
import dataclasses
import gc
import pickle
from typing import Any

import numpy as np
import pytest

import cdcr

casadi: Any = pytest.importorskip("casadi", reason="needs CasADi, extra casadi")

ARM = cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81)))
PUSH = cdcr.Wrench(section=1, force=(0.1, 0.2, 0.3))
ROUNDING = 1e-9  # relative, of sums of accelerations taken in two orders
SMOOTH = 3e-6  # relative, of central differences with a step of 1e-5
QUIET = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes"}
LIMITED = {**QUIET, "ipopt.hessian_approximation": "limited-memory"}


def winding() -> cdcr.Model:
    """A rod that bends and twists, with friction, one cable of it driven by length."""
    section = cdcr.Section(
        length=0.3,
        backbone_mass=0.01,
        backbone_diameter=2e-3,
        youngs_modulus=60e9,
        shear_modulus=23e9,
        bending_order=1,
        twist_order=0,
        disk_mass=2e-3,
        disk_diameter=0.03,
        num_disks=5,
        damping=1e-3,
        cable_angles=(0.0, 2.0),
        cable_radius=0.012,
        cable_friction=0.1,
    )
    driven = cdcr.Cable(end_section=0, radius=0.012, angle=(4.0, 5.0), stiffness=2e3, damping=1.0)
    return cdcr.Model(cdcr.Robot(sections=[section], cables=[driven]))


def state(model: cdcr.Model, seed: int = 0) -> tuple[Any, Any, Any]:
    rng = np.random.default_rng(seed)
    d = model.num_coordinates
    u = np.where(model.rest_command() > 0.0, model.rest_command(), rng.uniform(1.0, 3.0))
    return 0.3 * rng.normal(size=d), rng.normal(size=d), u


def differences(f: Any, x: Any, step: float = 1e-5) -> Any:
    columns = [(f(x + step * e) - f(x - step * e)) / (2.0 * step) for e in np.eye(len(x))]
    return np.stack(columns, axis=-1)


def numbers(found: Any) -> Any:
    return found.full().squeeze()


def jacobian(f: Any, *at: Any) -> list[Any]:
    """Of the last answer of a function by each argument, where these are."""
    symbols = [casadi.MX.sym(f.name_in(i), f.size1_in(i)) for i in range(f.n_in())]
    answer = f.call(symbols)[-1]
    slopes = [casadi.jacobian(answer, symbol) for symbol in symbols]
    return [slope.full() for slope in casadi.Function("slopes", symbols, slopes).call(list(at))]


def test_dynamics_and_their_derivatives_both_ways() -> None:
    at = state(ARM)
    f = cdcr.casadi.dynamics(ARM, PUSH)
    np.testing.assert_allclose(numbers(f(*at)), ARM.forward_dynamics(*at, PUSH), rtol=ROUNDING)
    exact = ARM.derivatives(*at, PUSH)[:3]
    for found, wanted in zip(jacobian(f, *at), exact, strict=True):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=ROUNDING * abs(wanted).max())

    q, seed = casadi.MX.sym("q", 6), np.arange(1.0, 7.0)
    for transposed in (False, True):
        product = casadi.jtimes(f(q, *at[1:]), q, casadi.DM(seed), transposed)
        found = numbers(casadi.Function("product", [q], [product])(at[0]))
        wanted = (exact[0].T if transposed else exact[0]) @ seed
        np.testing.assert_allclose(found, wanted, rtol=0, atol=ROUNDING * abs(wanted).max())


def test_many_states_in_columns() -> None:
    rows: Any = [
        np.stack(some) for some in zip(*(state(ARM, seed) for seed in range(4)), strict=True)
    ]
    found = cdcr.casadi.dynamics(ARM)(*(some.T for some in rows)).full()
    wanted = ARM.forward_dynamics(*rows).T
    np.testing.assert_allclose(found, wanted, rtol=0, atol=ROUNDING * abs(wanted).max())


@pytest.mark.parametrize("model", [ARM, winding()], ids=["arcs", "rod, friction, length"])
def test_a_cable_that_pushes_goes_on_in_a_straight_line(model: cdcr.Model) -> None:
    q, qd, u = state(model)
    u[0] = -2.0
    pulled, none = u.copy(), u.copy()
    pulled[0], none[0] = 2.0, 0.0
    at_none = model.forward_dynamics(q, qd, none)
    wanted = 2.0 * at_none - model.forward_dynamics(q, qd, pulled)
    f = cdcr.casadi.dynamics(model)
    np.testing.assert_allclose(numbers(f(q, qd, u)), wanted, atol=ROUNDING * abs(wanted).max())
    by_q = differences(lambda x: numbers(f(x, qd, u)), q)
    found = jacobian(f, q, qd, u)[0]
    np.testing.assert_allclose(found, by_q, rtol=0, atol=SMOOTH * abs(by_q).max())


@pytest.mark.parametrize("model", [ARM, winding()], ids=["arcs", "rod, friction, length"])
def test_a_step_is_that_of_the_simulator_and_so_are_its_derivatives(model: cdcr.Model) -> None:
    q, qd, u = state(model)
    x = np.concatenate([q, 0.1 * qd])
    period, substeps = (0.02, 4) if model is ARM else (1e-3, 3)
    f = cdcr.casadi.step(model, period, substeps=substeps)
    simulator = cdcr.Simulator(model, step=period, substeps=substeps)

    def simulated(x: Any, u: Any) -> Any:
        simulator.reset(x[: len(x) // 2], x[len(x) // 2 :])
        assert simulator.step(u) is cdcr.Status.ok
        return np.concatenate([simulator.q, simulator.qd])

    np.testing.assert_allclose(numbers(f(x, u)), simulated(x, u), rtol=1e-7, atol=1e-9)
    A, B = jacobian(f, x, u)
    by_x, by_u = (
        differences(lambda x: simulated(x, u), x),
        differences(lambda u: simulated(x, u), u),
    )
    np.testing.assert_allclose(A, by_x, rtol=0, atol=SMOOTH * abs(by_x).max())
    np.testing.assert_allclose(B, by_u, rtol=0, atol=SMOOTH * abs(by_u).max())


@pytest.mark.parametrize("model", [ARM, winding()], ids=["arcs", "rod"])
def test_kinematics(model: cdcr.Model) -> None:
    q = state(model)[0]
    tip, lengths = cdcr.casadi.tip(model), cdcr.casadi.cable_lengths(model)
    R, p = tip(q)
    for found, wanted in zip((R, p), model.tip(q), strict=True):
        np.testing.assert_array_equal(numbers(found), wanted)
    np.testing.assert_array_equal(numbers(lengths(q)), model.cable_lengths(q))
    for f, of in (
        (tip, lambda q: model.tip(q)[1]),
        (lengths, model.cable_lengths),
        (
            casadi.Function("R", [x := casadi.MX.sym("q", len(q))], [casadi.vec(tip(x)[0])]),
            lambda q: model.tip(q)[0].ravel(order="F"),
        ),
    ):
        wanted = differences(of, q)
        np.testing.assert_allclose(jacobian(f, q)[0], wanted, rtol=0, atol=SMOOTH)


def test_the_least_pull_from_shape_to_shape() -> None:
    # Of least effort, the departures from 2 N are what moves the end, C^T times its multipliers,
    # where C is taken from Simulator by differences.
    model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    step = cdcr.casadi.step(model, 0.05)
    opti, N, goal = casadi.Opti(), 10, np.array([0.2, 0.1, 0.0, 0.0])
    x, u = opti.variable(4, N + 1), opti.variable(3, N)
    opti.subject_to(x[:, 0] == 0.0)
    for k in range(N):
        opti.subject_to(x[:, k + 1] == step(x[:, k], u[:, k]))
    opti.subject_to(x[:, N] == goal)
    opti.subject_to(opti.bounded(0.0, casadi.vec(u), 5.0))
    opti.minimize(casadi.sumsqr(u - 2.0))
    opti.set_initial(u, 2.0)
    opti.solver("ipopt", {**LIMITED, "ipopt.tol": 1e-10})
    pull = opti.solve().value(u).T.ravel()
    assert pull.min() > 0.1
    assert pull.max() < 4.9

    simulator = cdcr.Simulator(model, step=0.05)

    def end(pull: Any) -> Any:
        simulator.reset([0.0, 0.0], [0.0, 0.0])
        for tension in pull.reshape(N, 3):
            assert simulator.step(tension) is cdcr.Status.ok
        return np.concatenate([simulator.q, simulator.qd])

    np.testing.assert_allclose(end(pull), goal, rtol=0, atol=1e-8)
    C = differences(end, pull)
    left = (pull - 2.0) - C.T @ np.linalg.lstsq(C.T, pull - 2.0, rcond=None)[0]
    assert abs(left).max() < 1e-5

    opti.solver("ipopt", QUIET)
    with pytest.raises(RuntimeError, match="cdcr has no second derivatives: give the solver"):
        opti.solve()


def test_a_robot_without_cables_has_derivatives() -> None:
    section = dataclasses.replace(cdcr.robots.amouri2020().sections[0], cable_angles=())
    step = cdcr.casadi.step(cdcr.Model(cdcr.Robot(sections=[section])), 1e-3)
    at, none = np.array([0.2, 0.1, 0.3, -0.4]), np.zeros(0)
    by_state, by_nothing = jacobian(step, at, none)
    assert by_nothing.shape == (4, 0)
    wanted = differences(lambda x: numbers(step(x, none)), at)
    np.testing.assert_allclose(by_state, wanted, rtol=0, atol=SMOOTH * np.abs(wanted).max())


def test_functions_outlive_their_names() -> None:
    q, qd, u = (casadi.MX.sym(name, size) for name, size in (("q", 6), ("qd", 6), ("u", 9)))
    slope = casadi.jacobian(cdcr.casadi.dynamics(ARM)(q, qd, u), q)
    f = casadi.Function("slope", [q, qd, u], [slope])
    gc.collect()
    at = state(ARM)
    np.testing.assert_array_equal(f(*at).full(), ARM.derivatives(*at).dqdd_dq)


def test_states_that_are_none_give_nan() -> None:
    q, qd, u = state(ARM)
    assert np.isnan(numbers(cdcr.casadi.dynamics(ARM)(100.0 * q, qd, u))).all()
    assert np.isnan(numbers(cdcr.casadi.cable_lengths(ARM)(np.nan * q))).all()
    assert np.isnan(jacobian(cdcr.casadi.tip(ARM), 100.0 * q)[0]).all()
    two = np.stack([q, 100.0 * q])
    found = cdcr.casadi.dynamics(ARM)(two.T, np.stack([qd, qd]).T, u).full()
    np.testing.assert_array_equal(np.isnan(found).all(axis=0), [False, True])


def test_refusals() -> None:
    f = cdcr.casadi.dynamics(ARM)
    q, qd, u = state(ARM)
    with pytest.raises(ValueError, match=r"^q must have shape \(6,\) or \(6, k\).*, got \(5,\)$"):
        f(q[:5], qd, u)
    with pytest.raises(ValueError, match=r"^tension must have shape \(9,\) .*, got \(3, 3\)$"):
        f(q=q, qd=qd, tension=np.ones((3, 3)))
    with pytest.raises(TypeError, match=r"^dynamics takes \(q, qd, tension\), got 2 arguments$"):
        f(q, qd)
    with pytest.raises(
        TypeError, match=r"^dynamics calls Python and cannot be pickled; pickle the"
    ):
        pickle.dumps(f)
    with pytest.raises(TypeError, match="cannot be pickled"):
        f.serialize()
    assert copy.deepcopy(f) is copy.copy(f) is f
    with pytest.raises(ValueError, match=r"^period must be a number > 0 s and finite, got 0"):
        cdcr.casadi.step(ARM, 0.0)
    with pytest.raises(ValueError, match=r"^substeps must be a whole number >= 1, got 1.5"):
        cdcr.casadi.step(ARM, 0.1, substeps=1.5)  # type: ignore[arg-type]
    for function in (cdcr.casadi.dynamics, cdcr.casadi.tip, cdcr.casadi.cable_lengths):
        with pytest.raises(TypeError, match=r"^model must be a cdcr\.Model, got Robot$"):
            function(ARM.robot)  # type: ignore[arg-type]
