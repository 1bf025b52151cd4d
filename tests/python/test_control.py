"""Linear and nonlinear systems for python-control, and the linear quadratic regulator."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad_vec  # type: ignore[import-untyped]
from scipy.linalg import expm, solve_continuous_lyapunov  # type: ignore[import-untyped]

import cdcr

pytest.importorskip("control", reason="the extra control is not installed")
import control  # type: ignore[import-untyped]

ONE = cdcr.Model(cdcr.robots.amouri2020(damping=0.01, gravity=(1.0, 0.0, 9.0)))
THREE = cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, 9.81)))
PULL = [4.0, 1.0, 1.0]
PULLS = [3.0, 1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 1.0, 1.5]
OUTPUTS = ["q", "qd", "tip", "lengths"]

ROUNDING = 1e-12
DIFFERENCES = 1e-4  # python-control differentiates by steps of 1e-6, one-sided
RUN = 1e-7  # two integrators at rtol 1e-9


def by_length(model: cdcr.Model, stiffness: float = 2e3) -> cdcr.Model:
    sections = [
        replace(one, cable_stiffness=stiffness, cable_damping=1.0) for one in model.robot.sections
    ]
    return cdcr.Model(replace(model.robot, sections=tuple(sections)))


@pytest.mark.parametrize("drive", ["tension", "length"])
@pytest.mark.parametrize("at_rest", [True, False])
def test_the_linear_system_is_the_derivative_of_the_nonlinear_one(
    drive: str, at_rest: bool
) -> None:
    model, command = THREE, np.array(PULLS)
    if drive == "length":
        model = by_length(THREE)
        command = model.rest_command() - 0.002 * np.array(PULLS)  # all of them taut
    q = model.equilibrium(command)
    qd = np.zeros_like(q)
    if not at_rest:
        q, qd = q + 0.1, qd + np.linspace(-1.0, 1.0, len(q))
    linear = model.to_statespace(q, command, OUTPUTS, qd=qd)
    nonlinear = cdcr.control.nonlinear_system(model, OUTPUTS)
    expected = control.linearize(nonlinear, np.concatenate([q, qd]), command)
    for name in "ABCD":
        found, wanted = getattr(linear, name), getattr(expected, name)
        scale = max(1.0, np.max(np.abs(wanted)))
        np.testing.assert_allclose(found, wanted, rtol=0.0, atol=DIFFERENCES * scale)
    for labels in ("state_labels", "input_labels", "output_labels"):
        assert getattr(linear, labels) == getattr(nonlinear, labels)
    assert linear.state_labels[:3] == ["q1_x", "q1_y", "q2_x"]
    assert linear.input_labels[-1] == {"tension": "tension9", "length": "command9"}[drive]
    assert linear.output_labels[12:16] == ["tip_x", "tip_y", "tip_z", "length1"]


def test_the_nonlinear_system_runs_as_simulate_does() -> None:
    t = np.linspace(0.0, 0.5, 6)
    rows = np.linspace([0.0] * 9, PULLS, 6)
    x0 = np.linspace(-0.1, 0.1, 12)
    system = cdcr.control.nonlinear_system(THREE, OUTPUTS)
    found = control.input_output_response(
        system, t, rows.T, x0, solve_ivp_kwargs={"rtol": 1e-9, "atol": 1e-11}
    )
    run = cdcr.simulate(
        THREE, x0[:6], x0[6:], t=t, tension=(t, rows), method="dopri5", rtol=1e-9, atol=1e-11
    )
    wanted = [run.q, run.qd, run.tip, THREE.cable_lengths(run.q)]
    assert np.max(np.abs(run.qd)) > 0.5
    np.testing.assert_allclose(found.outputs.T, np.hstack(wanted), rtol=0.0, atol=RUN)


def test_the_linear_system_is_wrong_by_the_square_of_a_small_motion() -> None:
    q = ONE.equilibrium(PULL)
    system = ONE.to_statespace(tension=PULL, outputs=["q", "tip"])
    t = np.linspace(0.0, 1.0, 101)
    push = np.stack([np.sin(5.0 * t), 0.0 * t, np.cos(3.0 * t) - 1.0], axis=1)
    errors = []
    for size in (0.2, 0.1):
        found = control.forced_response(system, t, size * push.T)
        run = cdcr.simulate(ONE, q, [0.0, 0.0], t=t, tension=(t, PULL + size * push), rtol=1e-9)
        motion = np.hstack([run.q - q, run.tip - ONE.tip(q)[1]])
        assert np.max(np.abs(motion)) > 0.05 * size
        errors.append(np.max(np.abs(found.outputs.T - motion)))
    assert 3.5 < errors[0] / errors[1] < 4.5


def test_tensions_are_brought_within_limits() -> None:
    system = cdcr.control.nonlinear_system(ONE, min_tension=0.5, max_tension=3.0)
    x = np.array([0.1, 0.2, 0.3, -0.1])
    found = system.dynamics(0.0, x, np.array([-1.0, 2.0, 9.0]))
    qdd = ONE.forward_dynamics(x[:2], x[2:], [0.5, 2.0, 3.0])
    np.testing.assert_array_equal(found, [*x[2:], *qdd])


def test_wrenches_act_in_both_systems() -> None:
    push = cdcr.Wrench(section=2, force=(0.1, 0.2, 0.0))
    q, zero = THREE.equilibrium(PULLS, wrenches=push), np.zeros(6)
    linear = THREE.to_statespace(tension=PULLS, wrenches=push)
    A, B = THREE.linearize(q, zero, PULLS, push)
    np.testing.assert_array_equal(linear.A, A)
    np.testing.assert_array_equal(linear.B, B)
    nonlinear = cdcr.control.nonlinear_system(THREE, wrenches=push)
    found = nonlinear.dynamics(0.0, np.concatenate([q, zero]), np.array(PULLS))
    np.testing.assert_allclose(found, 0.0, rtol=0.0, atol=1e-6)


def weights() -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(1)
    root = rng.normal(size=(12, 12))
    product = root @ root.T
    return (product + product.T) / 2.0, np.diag(np.linspace(0.5, 2.0, 9))


def test_the_gain_is_that_of_python_control() -> None:
    q = THREE.equilibrium(PULLS)
    A, B = THREE.linearize(q, np.zeros(6), PULLS)
    Q, R = weights()
    expected, _, poles = control.lqr(A, B, Q, R)
    K = cdcr.control.lqr(THREE, q, PULLS, Q, R)
    np.testing.assert_allclose(K, expected, rtol=0.0, atol=1e-8 * np.max(np.abs(expected)))
    assert np.max(poles.real) < 0.0
    for one, other in ((2.0, [2.0] * 12), ([3.0] * 12, 3.0 * np.eye(12))):
        np.testing.assert_array_equal(
            cdcr.control.lqr(THREE, q, PULLS, one, 1.0),
            cdcr.control.lqr(THREE, q, PULLS, other, np.eye(9)),
        )


def test_no_gain_beside_it_costs_less() -> None:
    q = THREE.equilibrium(PULLS)
    A, B = THREE.linearize(q, np.zeros(6), PULLS)
    Q, R = weights()
    K = cdcr.control.lqr(THREE, q, PULLS, Q, R)
    rng = np.random.default_rng(2)

    def cost(gain: Any) -> float:
        return float(np.trace(solve_continuous_lyapunov((A - B @ gain).T, -Q - gain.T @ R @ gain)))

    for _ in range(5):
        step = 1e-3 * np.linalg.norm(K) * rng.normal(size=K.shape) / 10.0
        assert min(cost(K + step), cost(K - step)) > cost(K)


def test_the_sampled_gain_makes_the_same_integral_least() -> None:
    period = 0.05
    q = ONE.equilibrium(PULL)
    A, B = ONE.linearize(q, np.zeros(2), PULL)
    Q, R = np.diag([5.0, 4.0, 0.3, 0.2]), 0.02 * np.eye(3)
    motion = np.zeros((7, 7))
    motion[:4] = np.hstack([A, B])
    weight = np.block([[Q, np.zeros((4, 3))], [np.zeros((3, 4)), R]])
    step = expm(period * motion)
    cost, _ = quad_vec(lambda s: expm(s * motion).T @ weight @ expm(s * motion), 0.0, period)
    expected, _, poles = control.dlqr(
        step[:4, :4], step[:4, 4:], cost[:4, :4], cost[4:, 4:], cost[:4, 4:]
    )
    K = cdcr.control.lqr(ONE, q, PULL, Q, R, period)
    np.testing.assert_allclose(K, expected, rtol=0.0, atol=1e-8 * np.max(np.abs(K)))
    assert np.max(np.abs(poles)) < 0.95
    always = cdcr.control.lqr(ONE, q, PULL, Q, R)
    off = [np.max(np.abs(cdcr.control.lqr(ONE, q, PULL, Q, R, h) - always)) for h in (2e-4, 1e-4)]
    assert 1.9 < off[0] / off[1] < 2.1
    assert np.max(np.abs(K - always)) > 0.1 * np.max(np.abs(always))


class Hold(cdcr.Controller):
    """The regulator as a user writes it."""

    def __init__(self, K: np.ndarray, q: np.ndarray, tension: Any, period: float) -> None:
        super().__init__(period)
        self.K, self.q, self.tension = K, q, np.asarray(tension)

    def update(self, t: float, q: Any, qd: Any) -> Any:
        return np.maximum(0.0, self.tension - self.K @ np.concatenate([q - self.q, qd]))


def test_it_keeps_a_robot_upright_that_falls_by_itself() -> None:
    top_heavy = cdcr.robots.amouri2020(damping=1e-3, gravity=(0.0, 0.0, -9.81), payload=0.2)
    model = cdcr.Model(top_heavy)
    q, tension, period = np.zeros(2), [3.0, 3.0, 3.0], 0.02
    assert not model.equilibrium(tension, q, throw=False).stable
    K = cdcr.control.lqr(model, q, tension, Q=[10.0, 10.0, 1.0, 1.0], R=0.01, period=period)
    controller = Hold(K, q, tension, period)
    t = np.linspace(0.0, 4.0, 81)
    run = cdcr.simulate(model, [0.2, -0.1], [0.0, 0.0], t=t, controller=controller)
    alone = cdcr.simulate(model, [0.2, -0.1], [0.0, 0.0], t=t, tension=tension)
    assert np.max(np.abs(run.q[-1])) < 1e-3
    assert np.max(np.abs(alone.q[t > 2.0])) > 1.0


def test_it_damps_three_sections_faster_than_they_do_alone() -> None:
    q, period = THREE.equilibrium(PULLS), 0.005
    K = cdcr.control.lqr(THREE, q, PULLS, Q=[1.0] * 6 + [0.05] * 6, R=0.01, period=period)
    t = np.linspace(0.0, 1.0, 21)
    start = q + 0.02 * np.array([1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
    run = cdcr.simulate(THREE, start, np.zeros(6), t=t, controller=Hold(K, q, PULLS, period))
    alone = cdcr.simulate(THREE, start, np.zeros(6), t=t, tension=PULLS)
    assert np.linalg.norm(run.q[-1] - q) < 0.1 * np.linalg.norm(alone.q[-1] - q)


def test_a_slack_cable_has_no_gain() -> None:
    model = by_length(ONE)
    lengths = model.rest_command() - [0.01, 0.01, -0.05]
    q = model.equilibrium(lengths)
    assert model.cable_tensions(q, [0.0, 0.0], lengths)[2] == 0.0
    K = cdcr.control.lqr(model, q, lengths, 1.0, 1e6)
    np.testing.assert_array_equal(K[2], 0.0)
    assert np.all(np.max(np.abs(K[:2]), axis=1) > 0.0)


def test_a_shape_that_is_no_rest_is_told_of() -> None:
    away = np.array([0.05, -0.02])
    q = ONE.equilibrium(PULL) + away
    with pytest.warns(
        UserWarning, match=r"does not rest at q under tension.* q\[0\] is some 0\.05"
    ):
        cdcr.control.lqr(ONE, q, PULL, 1.0, 1.0)


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"Q": [1.0, 2.0]}, r"Q must be a number or have shape \(4,\) or \(4, 4\), got \(2,\)"),
        ({"Q": np.eye(3)}, r"Q must be a number .* got \(3, 3\)"),
        ({"R": np.ones((3, 3, 1))}, r"R must be a number or have shape \(3,\) or \(3, 3\)"),
        ({"Q": np.triu(np.ones((4, 4)))}, "Q must be symmetric"),
        ({"Q": -1.0}, "Q must be positive semidefinite, its least eigenvalue is -1"),
        ({"R": 0.0}, "R must be positive definite, its least eigenvalue is 0"),
        ({"R": [1.0, 1.0, 0.0]}, "R must be positive definite"),
        ({"Q": np.nan}, "Q"),
        ({"q": np.zeros((2, 2))}, r"q must have shape \(2,\), got \(2, 2\)"),
        ({"tension": [1.0, 2.0]}, "tension"),
        ({"period": 0.0}, r"period must be a number > 0 s and finite, or None, got 0\.0"),
        ({"period": "fast"}, "period must be a number"),
    ],
)
def test_refusals_of_the_regulator(given: dict[str, Any], sentence: str) -> None:
    arguments: dict[str, Any] = {"q": [0.0, 0.0], "tension": PULL, "Q": 1.0, "R": 1.0} | given
    with pytest.raises(ValueError, match=sentence):
        cdcr.control.lqr(ONE, **arguments)


def test_what_no_gain_can_do_is_said() -> None:
    undamped = cdcr.Model(cdcr.robots.amouri2020())
    section = replace(undamped.robot.sections[0], cable_angles=(0.0,))  # pulls in one plane alone
    with pytest.raises(ValueError, match="no gain makes all motions decay"):
        cdcr.control.lqr(cdcr.Model(cdcr.Robot(sections=[section])), [0.0, 0.0], [1.0], 1.0, 1.0)
    for period in (None, 0.01):
        with pytest.raises(ValueError, match="no gain makes all motions decay"):
            cdcr.control.lqr(undamped, [0.0, 0.0], PULL, 0.0, 1.0, period)
    section = replace(section, cable_angles=())
    with pytest.raises(ValueError, match="needs cables, and this robot has none"):
        cdcr.control.lqr(cdcr.Model(cdcr.Robot(sections=[section])), [0.0, 0.0], [], 1.0, 1.0)
    with pytest.raises(TypeError, match=r"model must be a cdcr\.Model"):
        cdcr.control.lqr(None, [0.0], [0.0], 1.0, 1.0)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"period": 100.0}, r"period must be shorter beside the 0\.8\d* s .*, got 100 s"),
        ({"period": 1e3}, "period must be shorter"),
        ({"period": 1e6}, r"period must be shorter .*, got 1e\+06 s"),
        ({"R": 1e-300}, "although all motions decay by themselves: Q and R must be nearer"),
        ({"Q": 1e300}, "Q and R must be nearer"),
        ({"Q": 1.7e308}, "Q and R must be nearer"),
    ],
)
@pytest.mark.filterwarnings("error")
def test_numbers_too_far_apart_are_said_to_be_so(given: dict[str, Any], sentence: str) -> None:
    model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    arguments: dict[str, Any] = {"Q": 1.0, "R": 0.01} | given
    with pytest.raises(ValueError, match=sentence):
        cdcr.control.lqr(model, model.equilibrium(PULL), PULL, **arguments)


def test_no_equation_of_motion_without_inertia() -> None:
    with pytest.raises(ValueError, match="no dynamics, because section 2 can bend without moving"):
        cdcr.control.nonlinear_system(cdcr.Model(cdcr.robots.rao2021()))


def test_refusals_of_systems(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ValueError, match=r"there is no output 'tips'. Did you mean 'tip'\?"):
        ONE.to_statespace(outputs="tips")
    with pytest.raises(ValueError, match="outputs must differ from each other"):
        cdcr.control.nonlinear_system(ONE, ["q", "q"])
    for nothing in [(), 3]:
        with pytest.raises(ValueError, match="outputs must be names of outputs"):
            ONE.to_statespace(outputs=nothing)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"q must have shape \(2,\), got \(5, 2\)"):
        ONE.to_statespace(np.zeros((5, 2)), PULL)
    with pytest.raises(ValueError, match="limits must be 0 <= min_tension <= max_tension"):
        cdcr.control.nonlinear_system(ONE, min_tension=2.0, max_tension=1.0)
    monkeypatch.setitem(sys.modules, "control", None)
    with pytest.raises(ImportError, match=r'pip install "cdcr\[control\]"'):
        ONE.to_statespace()
