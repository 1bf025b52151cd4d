"""The default method and its tolerances, and the linearly implicit method, from Python."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.runs.simulate import available

TEN_SECONDS = np.linspace(0.0, 10.0, 101)
PULL = np.array([3.0, 0.0, 0.0])
BY_DEFAULT = 1e-6  # error of an angle over ten seconds that the defaults are made for [rad]
GRAVITY = (0.0, 0.0, -9.81)
ONE, THREE = cdcr.robots.amouri2020, cdcr.robots.three_sections
CASES: dict[str, tuple[cdcr.Robot, list[float], list[float], list[float]]] = {
    "one section, free": (ONE(), [0.8, 0.0], [0.0, 1.0], [0.0] * 3),
    "one section, pulled": (ONE(damping=0.01), [0.0] * 2, [0.0] * 2, [5.0, 0.0, 0.0]),
    "three sections, pulled": (
        THREE(gravity=GRAVITY),
        [0.0] * 6,
        [0.0] * 6,
        [2.0, 0, 0, 1.0, 0, 0, 0, 0.5, 0],
    ),
    "three sections, free": (
        THREE(gravity=GRAVITY),
        [0.5, 0.1, -0.3, 0.4, 0.2, -0.6],
        [0.0] * 6,
        [0.0] * 9,
    ),
}


class Steady(cdcr.Controller):
    """The same tensions at all times."""

    def update(self, t: float, q: Any, qd: Any) -> Any:
        return PULL


@pytest.mark.parametrize("case", CASES)
def test_default_tolerances_give_a_millionth_of_a_radian(case: str) -> None:
    robot, q0, qd0, tension = CASES[case]
    drive: dict[str, Any] = {"t": TEN_SECONDS, "tension": tension}
    model = cdcr.Model(robot)
    truth = cdcr.simulate(model, q0, qd0, **drive, method="dop853", rtol=1e-13)
    for method in ("auto", "dopri5", "dop853", "adams", "bdf"):
        if available(method):
            run = cdcr.simulate(model, q0, qd0, **drive, method=method)
            assert np.abs(run.q - truth.q).max() < BY_DEFAULT, method


def test_the_absolute_tolerance_follows_the_relative_one() -> None:
    model = cdcr.Model(ONE())
    start: tuple[Any, ...] = (model, [0.8, 0.0], [0.0, 1.0])
    cases: tuple[tuple[dict[str, Any], float], ...] = (({}, 1e-8), ({"rtol": 1e-6}, 1e-6))
    for told, meant in cases:
        short = cdcr.simulate(*start, t=TEN_SECONDS, method="dopri5", **told)
        long = cdcr.simulate(*start, t=TEN_SECONDS, method="dopri5", rtol=meant, atol=0.01 * meant)
        np.testing.assert_array_equal(short.q, long.q)


def test_auto_says_what_it_chose() -> None:
    stiff = cdcr.Model(ONE(damping=0.01).subdivide(8))
    still = np.zeros(stiff.num_coordinates)
    free = cdcr.simulate(cdcr.Model(ONE()), [0.5, 0.0], [0.0, 0.0], t=[5.0, 6.0])
    assert free.method == "auto"
    assert (free.stats.method, free.stats.switches) == ("dop853", 0)
    assert free.stats.stiff is None
    options: dict[str, Any] = {"t": [5.0, 5.2], "tension": [2.0, 0.0, 0.0]}
    if available("bdf"):
        held = cdcr.simulate(stiff, still, still, **options)
        assert (held.stats.method, held.stats.switches) == ("bdf", 1)
    else:
        with pytest.warns(UserWarning, match="auto takes bdf there, which this cdcr was built"):
            held = cdcr.simulate(stiff, still, still, **options)
    assert held.stats.stiff is not None
    assert 5.0 < held.stats.stiff < 5.1


def test_steps_of_rosenbrock_in_loops_and_rollouts_are_those_of_simulate() -> None:
    """A robot in twelve parts, damped, in steps of a millisecond."""
    model = cdcr.Model(ONE(damping=0.02).subdivide(12))
    still = np.zeros(model.num_coordinates)
    t = np.arange(65) / 1024.0
    run = cdcr.simulate(
        model, still, still, t=t, tension=PULL, method="rosenbrock", step=t[1], throw=True
    )
    assert np.abs(run.q[-1]).max() > 1e-3

    many = cdcr.rollout(
        model, [still] * 3, [still] * 3, tension=PULL, step=t[1], steps=64, method="rosenbrock"
    )
    for one in many.q:
        np.testing.assert_array_equal(one, run.q)

    loop = cdcr.Loop(model, Steady(t[1]), step=t[1], method="rosenbrock")
    loop.reset(still, still)
    looped = loop.run(t[-1]).trajectory
    np.testing.assert_array_equal(looped.q, run.q)
    assert looped.stats.jacobians == 64
    with pytest.raises(ValueError, match=r"^method must be 'rk4' or 'rosenbrock', got 'euler'$"):
        cdcr.Loop(model, Steady(1e-3), method="euler")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^method must be 'rk4' or 'rosenbrock', got 'bdf'$"):
        cdcr.Simulator(model, method="bdf")
