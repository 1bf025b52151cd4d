"""Predictive control: the plan is the optimum that IPOPT finds, limits hold, refusals."""

from __future__ import annotations

import dataclasses
import pickle
import warnings
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("piqp", reason="needs PIQP, extra mpc")

ARM = cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81)))
ONE = cdcr.Model(cdcr.robots.amouri2020(damping=0.01, gravity=(0.0, 0.0, -9.81)))
WEIGHTS: Any = {
    "tip_weight": 1e3,
    "rate_weight": 2e-2,
    "tension_weight": 3e-3,
    "change_weight": 2e-2,
}


def cost(model: Any, plan: Any, goal: Any, least: float, before: Any) -> Any:
    """What a plan costs, as the docstring of Mpc says; of numbers or of CasADi's symbols."""
    x, u = plan
    d = model.num_coordinates
    total = 0.0
    for k in range(len(u)):
        changed = u[k] - (u[k - 1] if k else before)
        off = tip_of(model)(x[k + 1][:d]) - goal
        for weight, what in (
            ("tip_weight", off),
            ("rate_weight", x[k + 1][d:]),
            ("tension_weight", u[k] - least),
            ("change_weight", changed),
        ):
            total = total + WEIGHTS[weight] * (what.T @ what) / 2.0
    return total


def tip_of(model: Any) -> Any:
    tip = cdcr.casadi.tip(model)
    return lambda q: tip(q)[1]


def test_the_first_plan_is_the_optimum() -> None:
    casadi: Any = pytest.importorskip("casadi", reason="needs CasADi, extra casadi")
    goal, now = np.array([0.25, -0.1, 0.75]), np.array([0.1, 0.05, 0.0, 0.2])
    N, period, least, most = 6, 0.05, 0.5, 2.5
    controller = cdcr.control.Mpc(
        ONE, min_tension=least, max_tension=most, period=period, horizon=N, **WEIGHTS
    )
    controller.reference = goal
    first = controller.update(0.0, now[:2], now[2:])
    plan = controller.plan
    assert plan is not None
    np.testing.assert_array_equal(first, plan.u[0])

    step = cdcr.casadi.step(ONE, period)
    opti = casadi.Opti()
    x = [casadi.MX(now), *(opti.variable(4) for _ in range(N))]
    u = [opti.variable(3) for _ in range(N)]
    for k in range(N):
        opti.subject_to(x[k + 1] == step(x[k], u[k]))
        opti.subject_to(opti.bounded(least, u[k], most))
        opti.set_initial(u[k], 1.0)
    opti.minimize(cost(ONE, (x, u), goal, least, first))
    quiet = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes", "ipopt.tol": 1e-9}
    opti.solver("ipopt", {**quiet, "ipopt.hessian_approximation": "limited-memory"})
    wanted = np.array([opti.solve().value(one) for one in u])
    assert np.isclose(wanted, most, atol=1e-6).any()
    assert np.isclose(wanted, least, atol=1e-6).any()
    for _ in range(20):  # Gauss-Newton, on the same state, comes to rest where IPOPT is
        controller._last = first
        controller._mend(0.0, now)
    assert controller.plan is not None
    np.testing.assert_allclose(controller.plan.u, wanted, rtol=0, atol=0.02)


def test_the_tip_goes_there_within_limits() -> None:
    controller = cdcr.control.Mpc(ARM, max_tension=8.0, min_tension=0.2, substeps=2)
    controller.reference = [0.2, 0.1, 0.7]
    t = np.linspace(0.0, 1.0, 51)
    run = cdcr.simulate(ARM, [0.0] * 6, [0.0] * 6, t=t, controller=controller, method="rk4")
    assert run.success
    assert run.tension.min() >= 0.2
    assert run.tension.max() == pytest.approx(8.0, abs=1e-6)
    off = np.linalg.norm(run.tip - controller.reference, axis=1)
    assert off[0] > 0.2
    assert off[20:].max() < 2e-3
    # What it foretells is what comes: the model is the robot.
    plan = controller.plan
    assert plan is not None
    simulator = cdcr.Simulator(ARM, step=0.02, substeps=2)
    simulator.reset(plan.x[0, :6], plan.x[0, 6:])
    for state, tension in zip(plan.x[1:], plan.u, strict=True):
        assert simulator.step(tension) is cdcr.Status.ok
        np.testing.assert_allclose(np.append(simulator.q, simulator.qd), state, rtol=0, atol=1e-3)


def test_a_path_is_looked_at_ahead() -> None:
    path = cdcr.ReferencePath.circle([0, 0, 0.7], [0.15, 0, 0], [0, 0.15, 0], turns=1, duration=2.0)
    controller = cdcr.control.Mpc(ARM, max_tension=20.0, substeps=2)
    controller.path = path
    q = ARM.inverse_kinematics(path.evaluate(0.0)[0]).q
    t = np.linspace(0.0, 1.0, 51)
    run = cdcr.simulate(ARM, q, np.zeros(6), t=t, controller=controller, method="rk4")
    wanted = np.array([path.evaluate(at)[0] for at in t])
    assert np.linalg.norm(run.tip - wanted, axis=1).max() < 3e-3


def test_a_plan_that_leads_nowhere_is_given_up() -> None:
    controller = cdcr.control.Mpc(ARM, max_tension=8.0, substeps=2)
    controller.update(0.0, [0.0] * 6, [0.0] * 6)
    tension = controller.update(0.02, [0.0] * 6, [1e4, *[0.0] * 5])  # bent too far a step later
    assert controller.diagnostics["solved"] == 0.0
    assert controller.plan is None
    assert ((tension >= 0.0) & (tension <= 8.0)).all()
    controller.update(0.04, [0.0] * 6, [0.0] * 6)
    assert controller.diagnostics["solved"] == 1.0


def test_pickled_it_goes_on() -> None:
    controller = cdcr.control.Mpc(ONE, max_tension=5.0, horizon=5)
    controller.update(0.0, [0.1, 0.0], [0.0, 0.0])
    other = pickle.loads(pickle.dumps(controller))
    now = (0.02, [0.11, 0.0], [0.1, 0.0])
    np.testing.assert_allclose(other.update(*now), controller.update(*now), atol=1e-2)


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e4])
def test_a_small_and_a_large_robot_are_moved_alike(size: float) -> None:
    """Lengths, times and weights in their units: the numbers of the programme are the same."""
    section = cdcr.Section(
        length=0.3 * size,
        backbone_mass=4e-3 * size**3,
        backbone_diameter=1e-3 * size,
        youngs_modulus=60e9,
        damping=2e-3 * size**4,
        cable_radius=8e-3 * size,
        cable_angles=(0.0, 2.0, 4.0),
    )
    model = cdcr.Model(cdcr.Robot(sections=[section]))
    controller = cdcr.control.Mpc(
        model,
        max_tension=5.0 * size**2,
        period=0.02 * size,
        tip_weight=1e4 / size**2,
        rate_weight=1e-2 * size**2,
        tension_weight=1e-3 / size**4,
        change_weight=1e-2 / size**4,
    )
    controller.reference = model.tip([0.4, 0.2])[1]
    run = cdcr.simulate(model, [0, 0], [0, 0], t=[0.0, 1.0 * size], controller=controller)
    assert controller.diagnostics["solved"] == 1.0
    assert np.linalg.norm(run.tip[-1] - controller.reference) < 1e-3 * 0.3 * size


@pytest.mark.parametrize("most", [1e-200, 1e200])
def test_limits_far_from_all_tensions_are_no_trouble(most: float) -> None:
    controller = cdcr.control.Mpc(ONE, max_tension=most)
    found = controller.update(0.0, np.zeros(2), np.zeros(2))
    assert np.all((found >= 0.0) & (found <= most))


def test_what_it_knows_nothing_of_is_told() -> None:
    section = dataclasses.replace(ONE.robot.sections[0], cable_friction=0.2)
    rubs = dataclasses.replace(ONE.robot, sections=(section,), presliding_stiffness=1e4)
    with pytest.warns(UserWarning, match="knows nothing of what cables and drives remember"):
        cdcr.control.Mpc(cdcr.Model(rubs), max_tension=5.0)
    with pytest.warns(UserWarning, match=r"0\.02 s, beyond the 0\.0142 s up to which they are sta"):
        cdcr.control.Mpc(ARM, max_tension=5.0, substeps=1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        cdcr.control.Mpc(ARM, max_tension=5.0)  # with as many as it needs


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ({"max_tension": 0.5, "min_tension": 1.0}, "max_tension must be a finite number > min_te"),
        ({"min_tension": -1.0}, "min_tension must be a number >= 0 N, got -1"),
        ({"period": 0.0}, "period must be a number > 0 and finite, got 0"),
        ({"period": 0.02, "step": 0.01}, r"step must be at least the period of 0\.02 s, got 0\.01"),
        ({"period": None}, r"period must be a number > 0 and finite, got None \(NoneType\)"),
        ({"step": "x"}, r"step must be a number > 0 and finite, got 'x' \(str\)"),
        ({"horizon": 0}, "horizon must be a whole number >= 1, got 0"),
        ({"substeps": 0}, "substeps must be a whole number >= 1, got 0"),
        ({"tip_weight": -1.0}, "tip_weight must be a number > 0 and finite, got -1"),
        ({"change_weight": -1.0}, "change_weight must be a number >= 0 and finite, got -1"),
    ],
)
def test_refused(options: Any, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        cdcr.control.Mpc(ARM, **({"max_tension": 5.0} | options))


def test_refused_robots_and_references() -> None:
    section = cdcr.robots.amouri2020().sections[0]
    cable = cdcr.Cable(end_section=0, radius=0.019, angle=0.3, stiffness=1e3)
    by_length = cdcr.Model(cdcr.Robot(sections=[section], cables=[cable]))
    with pytest.raises(ValueError, match="tension, and cable 4 is driven by length"):
        cdcr.control.Mpc(by_length, max_tension=5.0)
    controller = cdcr.control.Mpc(ONE, max_tension=5.0)
    driven = dataclasses.replace(section, cable_stiffness=1e3)
    for robot, told in (
        (ARM.robot, "a robot of 2 coordinates and 3 cables, but the model has 6 coordinates"),
        (cdcr.Robot(sections=[driven]), "cable 1 must be driven by tension, got one driven by len"),
    ):
        model = cdcr.Model(robot)
        with pytest.raises(ValueError, match=told):
            cdcr.Loop(model, controller)
        zeros = np.zeros(model.num_coordinates)
        with pytest.raises(ValueError, match=told):
            cdcr.simulate(model, zeros, zeros, t=[0.0, 0.1], controller=controller)
    with pytest.raises(TypeError, match=r"^Mpc lacks max_tension"):
        cdcr.control.Mpc(ARM)  # type: ignore[call-arg]
    controller = cdcr.control.Mpc(ARM, max_tension=5.0, substeps=2)
    with pytest.raises(ValueError, match=r"^reference must have shape \(3,\), got \(2,\)"):
        controller.reference = [0.1, 0.2]
    with pytest.raises(ValueError, match=r"^path must be of the tip, 3 numbers, got 2"):
        controller.path = cdcr.ReferencePath.constant([0.1, 0.2])
    with pytest.raises(TypeError, match=r"^path must be a cdcr\.ReferencePath, got int"):
        controller.path = 3  # type: ignore[assignment]
    with pytest.raises(
        AttributeError,
        match=r"^Mpc has no attribute 'reference_tip' that can be set\. Did you mean 'reference'\?",
    ):
        controller.reference_tip = [0.1, 0.2, 0.5]
    assert controller.path is None
