"""Cable friction as seen from Python: capstan's ratio, heat, and a pull-release loop."""

from dataclasses import replace
from typing import Any

import numpy as np

import cdcr

MU = 0.3


def rubbing(mu: float, *, sliding_speed: float = 1e-3, damping: float = 0.0) -> cdcr.Model:
    """Table 1 with one cable."""
    robot = cdcr.robots.amouri2020(damping=damping)
    section = replace(robot.sections[0], cable_angles=(0.0,), cable_friction=mu)
    return cdcr.Model(replace(robot, sections=(section,), sliding_speed=sliding_speed))


def test_capstan_ratio_at_full_sliding() -> None:
    model = rubbing(MU)
    q, tension = [0.6, 0.8], [5.0]
    pulled = model.tensions_along(q, [3.0, 0.0], tension)[:, 0]
    let_go = model.tensions_along(q, [-3.0, 0.0], tension)[:, 0]
    np.testing.assert_allclose(pulled, [5.0, 5.0 * np.exp(-MU)], rtol=1e-14)
    np.testing.assert_allclose(let_go, [5.0, 5.0 * np.exp(MU)], rtol=1e-14)
    still = model.tensions_along(q, [0.0, 0.0], tension)[:, 0]
    np.testing.assert_array_equal(still, [5.0, 5.0])


def test_no_friction_is_the_frictionless_robot() -> None:
    model, q, qd = rubbing(0.0), [0.6, 0.8], [3.0, 1.0]
    np.testing.assert_array_equal(model.cable_force(q, qd, [5.0]), model.actuation_matrix() @ [5.0])
    assert abs(model.friction_power(q, qd, [5.0])) < 1e-15
    assert rubbing(MU).friction_power(q, qd, [5.0]) > 1e-3


def test_friction_power_is_never_negative() -> None:
    rng = np.random.default_rng(1)
    part = cdcr.robots.amouri2020().subdivide(3)
    sections = tuple(replace(s, cable_friction=0.1 * (i + 1)) for i, s in enumerate(part.sections))
    model = cdcr.Model(replace(part, sections=sections))
    for _ in range(2000):
        q, qd = rng.uniform(-1.0, 1.0, 6), 10.0 ** rng.uniform(-6, 1) * rng.uniform(-1, 1, 6)
        tension = rng.uniform(0.0, 50.0, model.num_cables)
        size = tension @ np.abs(model.actuation_matrix()).T @ np.abs(qd)
        assert model.friction_power(q, qd, tension) >= -1e-15 * size


def trapezoidal(y: Any, x: Any) -> float:
    return float(0.5 * np.sum((y[1:] + y[:-1]) * np.diff(x)))


def loop(mu: float) -> tuple[float, float]:
    """Pull to 40 N and let go over 20 s: the loop's area, and damping and friction's work [J]."""
    damping = 5e-3
    model = rubbing(mu, sliding_speed=1e-4, damping=damping)
    t = np.linspace(0.0, 20.0, 8001)
    pull = ([0.0, 10.0, 20.0], [[0.0], [40.0], [0.0]])
    zeros = [0.0, 0.0]
    run = cdcr.simulate(model, zeros, zeros, t=t, tension=pull, rtol=1e-8, atol=1e-10)
    assert run.success
    radius = model.actuation_matrix()[0, 0]
    states = zip(run.q, run.qd, run.tension, strict=True)
    heat = np.array([model.friction_power(q, v, F) + damping * v @ v for q, v, F in states])
    left = run.energy[-1] - run.energy[0]
    return radius * trapezoidal(run.tension[:, 0], run.q[:, 0]), trapezoidal(heat, t) + left


def test_pull_and_release_encloses_the_friction_work() -> None:
    (rough, heat), (smooth, damped) = loop(MU), loop(0.0)
    assert rough > 0.1
    assert abs(rough - heat) < 1e-4 * rough
    assert abs(smooth - damped) < 1e-4 * rough
    assert smooth < 0.05 * rough
