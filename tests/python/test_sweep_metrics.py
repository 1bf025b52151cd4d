"""Metrics of a run against closed forms and other means."""

from __future__ import annotations

import math

import numpy as np
import pytest

import cdcr
from cdcr.sweeps import METRICS

MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
T = np.linspace(0.0, 10.0, 2001)


def value(name: str, run: cdcr.Trajectory) -> float:
    return float(METRICS[name].function(run))


@pytest.fixture(scope="module")
def step() -> cdcr.Trajectory:
    """Small enough to be linear."""
    pull = [0.05, 0.0, 0.0]
    return cdcr.simulate(MODEL, [0, 0], [0, 0], t=T, tension=pull, rtol=1e-10, atol=1e-14)


def test_a_small_step_is_that_of_a_damped_oscillator(step: cdcr.Trajectory) -> None:
    """Overshoot exp(-pi a/w) and an envelope exp(-a t) for the pole -a + i w."""
    rest = MODEL.equilibrium([0.05, 0, 0])
    pole = np.linalg.eigvals(MODEL.linearize(rest, [0, 0], [0.05, 0, 0])[0][::2, ::2])[0]
    a, w = -pole.real, abs(pole.imag)
    assert value("overshoot", step) == pytest.approx(math.exp(-math.pi * a / w), rel=1e-3)
    # The band is that of the largest distance, the start. The last time outside lies within the
    # half period before the envelope enters it.
    enters = math.log(math.hypot(1.0, a / w) / 0.02) / a
    assert enters - math.pi / w <= value("settling_time", step) <= enters + T[1]


def test_a_run_that_has_not_settled_has_no_such_metrics() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    run = cdcr.simulate(model, [0, 0], [0, 0], t=T, tension=[1, 0, 0])
    assert math.isnan(value("settling_time", run))
    assert math.isnan(value("overshoot", run))


def test_a_robot_at_rest(step: cdcr.Trajectory) -> None:
    q = MODEL.equilibrium([1.0, 0, 0])
    run = cdcr.simulate(MODEL, q, [0, 0], t=[0.0, 1.0], tension=[1, 0, 0])
    tip = MODEL.tip(q)[1]
    for axis, name in zip(tip, ("final_tip_x", "final_tip_y", "final_tip_z"), strict=True):
        assert value(name, run) == pytest.approx(axis, abs=1e-9)
    assert value("final_theta", run) == pytest.approx(np.linalg.norm(q))
    assert value("tip_path_length", run) < 1e-9
    assert (value("peak_tension", run), value("least_tension", run)) == (1.0, 0.0)
    assert value("mean_tension", run) == pytest.approx(1.0 / 3.0)


def test_speeds_are_those_of_differences(step: cdcr.Trajectory) -> None:
    speed = np.linalg.norm(np.diff(step.tip, axis=0), axis=1) / T[1]
    assert value("peak_tip_speed", step) == pytest.approx(speed.max(), rel=1e-3)
    length = np.sum(speed) * T[1]
    assert value("tip_path_length", step) == pytest.approx(length)
    assert value("final_tip_speed", step) < 1e-3 * speed.max()


def test_energies_add_up(step: cdcr.Trajectory) -> None:
    total = value("final_kinetic_energy", step) + value("final_potential_energy", step)
    assert total == pytest.approx(step.energy[-1])
    assert value("peak_kinetic_energy", step) == step.kinetic_energy.max()
    assert value("peak_theta", step) == np.abs(step.theta).max()
    assert value("steps", step) == step.stats.steps


def test_every_metric_says_its_unit_and_what_it_is() -> None:
    for name, metric in METRICS.items():
        assert name.isidentifier()
        assert metric.unit
        assert metric.about[0].islower()
        assert not metric.about.endswith(".")


@pytest.mark.parametrize("told", ["0.5", None, [0.5], 1j])
def test_a_metric_is_a_number(told: object) -> None:
    def odd(run: cdcr.Trajectory) -> object:
        return told

    with pytest.raises(TypeError, match=r"^metric 'odd' must return a number, got "):
        cdcr.sweep(short, {"pull": [1.0]}, metrics=odd)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["status", "message", "run", "pull"])
def test_a_metric_has_a_name_of_its_own(name: str) -> None:
    with pytest.raises(ValueError, match=f"^metric '{name}' must not have "):
        cdcr.sweep(short, {"pull": [1.0]}, metrics={name: lambda run: run.theta[-1, 0]})


def short(pull: float) -> cdcr.Trajectory:
    return cdcr.simulate(MODEL, [0, 0], [0, 0], t=[0.0, 0.1], tension=[pull, 0, 0])
