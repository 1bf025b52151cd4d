"""The gradient of a cost by the adjoint: differences, sensitivities forward, refusals."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr

ARM = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), payload=0.01)
ARM = replace(ARM, sections=tuple(replace(one, damping=3e-3) for one in ARM.sections))
STEPS = 300  # more than are held at once
START = (np.full(6, 0.2), np.full(6, -0.1))
OPTIONS: dict[str, Any] = {"step": 1e-3, "steps": STEPS, "record_every": 10}
TARGET = np.array([0.05, 0.02, 0.5])
# Of a difference of fourth order, over the largest of its kind: ten times what is seen.
DIFFERENCE = 1e-8


def pulls(cables: int = 9) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.random.default_rng(4).uniform(0.5, 3.0, (STEPS, cables))


def cost_of(model: cdcr.Model) -> Callable[[Any], Any]:
    """Return a cost of where the tip is on the way, and how fast the arm is."""

    def cost(motion: Any) -> Any:
        off = model.tips(motion.q) - TARGET
        slopes = {"tip": 2 * off, "qd": 2e-3 * motion.qd, "q": 0.2 * motion.q}
        return (off**2).sum() + (1e-3 * motion.qd**2 + 0.1 * motion.q**2).sum(), slopes

    return cost


def value(robot: cdcr.Robot, q0: Any, qd0: Any, tension: Any) -> float:
    """Return the cost of the rollout."""
    model = cdcr.Model(robot)
    run = cdcr.rollout(model, q0, qd0, tension[None], **OPTIONS)
    motion = type("Motion", (), {"t": run.t, "q": run.q[0], "qd": run.qd[0]})
    return float(cost_of(model)(motion)[0])


def difference(function: Callable[[float], float], size: float) -> float:
    near, far = function(size) - function(-size), function(2 * size) - function(-2 * size)
    return (8 * near - far) / (12 * size)


def arms() -> dict[str, cdcr.Robot]:
    """Arcs; taut cables driven by length; a rod."""
    section = cdcr.robots.amouri2020(damping=1e-3).sections[0]
    springs = replace(section, cable_stiffness=3e3, cable_damping=2.0)
    rod = replace(section, bending_order=1)
    return {
        "arcs": ARM,
        "springs": cdcr.Robot(sections=[springs, springs], gravity=(0.0, 0.0, 9.81), payload=0.01),
        "rod": cdcr.Robot(sections=[rod], gravity=(0.0, 0.0, 9.81), payload=0.01),
    }


@pytest.mark.parametrize("name", list(arms()))
def test_differences(name: str) -> None:
    """By the start, tensions of several steps, and numbers of the robot."""
    robot = arms()[name]
    model = cdcr.Model(robot)
    d, cables = model.num_coordinates, model.num_cables
    tension = pulls(cables)
    if name == "springs":
        tension = model.rest_command() - 8e-3 - 1e-4 * tension
    q0, qd0 = np.linspace(0.2, 0.1, d), np.full(d, -0.1)
    names = ["payload", "sections.1.youngs_modulus"]
    found = cdcr.gradient(model, q0, qd0, tension, cost_of(model), parameters=names, **OPTIONS)
    assert found.value == pytest.approx(value(robot, q0, qd0, tension), rel=1e-12)

    def check(answer: float, function: Callable[[float], float], size: float, scale: float) -> None:
        assert answer == pytest.approx(difference(function, size), abs=DIFFERENCE * scale)

    one = np.eye(d)[d - 1]
    check(
        found.q0[-1], lambda h: value(robot, q0 + h * one, qd0, tension), 1e-4, abs(found.q0).max()
    )
    check(
        found.qd0[-1],
        lambda h: value(robot, q0, qd0 + h * one, tension),
        1e-3,
        abs(found.qd0).max(),
    )
    h = 1e-5 if name == "springs" else 0.1
    for k, j in ((0, 0), (255, 1), (256, cables - 1), (STEPS - 1, 0)):
        pull = np.zeros_like(tension)
        pull[k, j] = 1.0
        check(
            found.tension[k, j],
            lambda h, pull=pull: value(robot, q0, qd0, tension + h * pull),  # type: ignore[misc]
            h, 10 * abs(found.tension).max(),
        )  # fmt: skip
    check(
        found.parameters["payload"],
        lambda h: value(replace(robot, payload=robot.payload + h), q0, qd0, tension),
        5e-5, abs(found.parameters["payload"]),
    )  # fmt: skip
    modulus = robot.sections[0].youngs_modulus

    def stiffer(h: float) -> float:
        first = replace(robot.sections[0], youngs_modulus=modulus * (1 + h))
        changed = replace(robot, sections=(first, *robot.sections[1:]))
        return value(changed, q0, qd0, tension)

    by_modulus = found.parameters["sections.1.youngs_modulus"] * modulus
    check(by_modulus, stiffer, 1e-3, abs(by_modulus))


def test_it_is_the_chain_rule_of_steps_forward() -> None:
    """To rounding: products of the derivatives of single periods, which CasADi is given too."""
    from cdcr.model.steps import AnyDynamics, Steps

    model, tension = cdcr.Model(ARM), pulls()
    cost = cost_of(model)
    found = cdcr.gradient(model, *START, tension, cost, **OPTIONS)
    steps = Steps(AnyDynamics(model), OPTIONS["step"])
    x, S = np.concatenate(START), np.eye(12)
    _, slopes = cost(found.motion)
    total = np.zeros(12)
    for k in range(STEPS + 1):
        if k % 10 == 0:
            J = model.tip_jacobian(x[:6])[:3]
            row = slopes["tip"][k // 10] @ J + slopes["q"][k // 10]
            total += row @ S[:6] + slopes["qd"][k // 10] @ S[6:]
        if k < STEPS:
            ends, by = steps.derivatives(x[None], tension[k : k + 1])
            x, S = ends[0], by[0, :, :12] @ S
    scale = abs(total).max()
    assert np.concatenate([found.q0, found.qd0]) == pytest.approx(total, abs=1e-12 * scale)


def test_it_is_that_of_sensitivities() -> None:
    """Of the run itself, whose variational equation has its own, higher order."""
    model = cdcr.Model(ARM)
    constant = np.linspace(0.5, 2.0, 9)
    cost = cost_of(model)
    options = {**OPTIONS, "step": 2.5e-4, "steps": 1200, "record_every": 40}
    found = cdcr.gradient(model, *START, constant, cost, parameters="payload", **options)
    assert found.tension.shape == (9,)
    run = cdcr.simulate(
        model, *START, t=found.motion.t, tension=constant, method="dop853", rtol=1e-11,
        sensitivities=["q0", "qd0", "tension", "payload"],
    )  # fmt: skip
    slopes = cost(found.motion)[1]
    on_q = np.einsum("ri,rij->rj", slopes["tip"], model.tip_jacobian(run.q)[:, :3]) + slopes["q"]
    for name, answer in (
        ("q0", found.q0), ("qd0", found.qd0), ("tension", found.tension),
        ("payload", np.array([found.parameters["payload"]])),
    ):  # fmt: skip
        wanted = np.einsum("rd,rdk->k", on_q, run.sensitivities[name])
        wanted += np.einsum("rd,rdk->k", slopes["qd"], run.rate_sensitivities[name])
        assert answer == pytest.approx(wanted, abs=1e-6 * abs(wanted).max()), name


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"cost": 3.0}, "cost must be a function of a motion, got float"),
        ({"steps": 0}, "steps must be a whole number >= 1"),
        ({"record_every": 7}, "record_every must be a divisor of steps = 300, got 7"),
        ({"tension": np.ones((10, 9))}, r"must have shape \(9,\) or \(300, 9\), got \(10, 9\)"),
        ({"step": -1.0}, "period must be|step must be"),
        ({"parameters": "mass"}, "there is no parameter 'mass'"),
        ({"cost": lambda m: 1.0}, "cost must return a number and a mapping of its derivatives"),
        ({"cost": lambda m: (m.q, {})}, "cost must return a number and a mapping of its deriv"),
        ({"cost": lambda m: (np.nan, {})}, "cost must be finite, got nan"),
        ({"cost": lambda m: (0.0, {"p": m.q})}, "derivatives by 'q', 'qd', 'tip', got 'p'"),
        ({"cost": lambda m: (0.0, {"q": m.q[1:]})}, r"by q must have shape \(31, 6\)"),
        (
            {"wrenches": cdcr.Wrench(section=0, force=(1, 0, 0), profile=([0, 1], [0, 1]))},
            "must not change in time",
        ),
    ],
)
def test_refusals(change: dict[str, Any], sentence: str) -> None:
    """One sentence each."""
    model = cdcr.Model(ARM)
    given = {"tension": pulls(), "cost": cost_of(model), **OPTIONS, **change}
    with pytest.raises((ValueError, TypeError), match=sentence):
        cdcr.gradient(model, *START, **given)


def test_what_remembers_and_what_fails() -> None:
    """Backlash has no derivative; a motion beyond the bending limit says so."""
    section = replace(
        cdcr.robots.amouri2020().sections[0], cable_stiffness=3e3, cable_backlash=1e-3
    )
    model = cdcr.Model(cdcr.Robot(sections=[section]))
    with pytest.raises(ValueError, match="no gradient where cables or drives remember"):
        cdcr.gradient(model, [0, 0], [0, 0], model.rest_command(), cost_of(model), **OPTIONS)
    weak = cdcr.Model(cdcr.robots.amouri2020())
    with (
        pytest.raises(RuntimeError, match="the gradient became infinite"),
        np.errstate(all="ignore"),
    ):
        cdcr.gradient(
            weak,
            *([0, 0], [0, 0], [1.0, 0, 0]),
            lambda motion: (1.0, {"q": np.full_like(motion.q, 1.7e308)}),
            step=0.01,
            steps=300,
        )
    with pytest.raises(RuntimeError, match="bend"):
        cdcr.gradient(weak, [0, 0], [0, 0], [500.0, 0, 0], cost_of(weak), **OPTIONS)
