"""Controllers and estimators copied and pickled in the middle of a run go on as the others do."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import cdcr

MODEL = cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81)))
ACTUATORS = [cdcr.Actuator(time_constant=0.01, dead_time=0.002)]
SENSORS = [
    cdcr.Sensor(kind="tip", noise=1e-3, delay=3e-3),
    cdcr.Sensor(kind="lengths", noise=1e-4),
    cdcr.Sensor(kind="base_force", noise=1.0, delay=1e-3),
]
WAYS: dict[str, Callable[[Any], Any]] = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda thing: pickle.loads(pickle.dumps(thing)),
}
LIMITS: dict[str, Any] = {"min_tension": 0.5, "max_tension": 40.0, "max_rate": 200.0}


def extended() -> cdcr.ExtendedKalman:
    heavier = cdcr.Model(cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), payload=0.01))
    return cdcr.ExtendedKalman(
        MODEL, sensors=SENSORS, actuators=ACTUATORS, force_at=(0, 1.0), variants=heavier
    )


def feedback() -> cdcr.StateFeedback:
    gain = np.random.default_rng(2).normal(size=(9, 12))
    return cdcr.StateFeedback(MODEL, gain=gain, **LIMITS)


def predictive() -> cdcr.control.Mpc:
    pytest.importorskip("piqp", reason="the extra mpc is not installed")
    return cdcr.control.Mpc(MODEL, max_tension=20.0, horizon=3)


ESTIMATORS: dict[str, Callable[[], Any]] = {
    "ExtendedKalman": extended,
    "UnscentedKalman": lambda: cdcr.UnscentedKalman(MODEL, sensors=SENSORS, force_at=(2, 1.0)),
    "MomentumObserver": lambda: cdcr.MomentumObserver(
        MODEL, actuators=ACTUATORS, force_at=(1, 0.5)
    ),
    "MomentumObserver of a filter": lambda: cdcr.MomentumObserver(
        MODEL, force_at=(1, 0.5), states=cdcr.ExtendedKalman(MODEL, sensors=SENSORS)
    ),
}
CONTROLLERS: dict[str, Callable[[], Any]] = {
    "Pid": lambda: cdcr.Pid(MODEL, kp=2.0, ki=3.0, kd=0.1, filter=0.02, **LIMITS),
    "ComputedTorque": lambda: cdcr.ComputedTorque(MODEL, **LIMITS),
    "StateFeedback": feedback,
    "TaskSpace": lambda: cdcr.TaskSpace(MODEL, **LIMITS),
    "Mpc": predictive,
}


def state(k: int) -> tuple[Any, Any]:
    angles = np.arange(6) + 0.05 * k
    return 0.05 + 0.02 * np.sin(angles), 0.1 * np.cos(angles)


def estimated(estimator: Any, first: int) -> Any:
    """What an estimator tells in some updates: everything, to the last bit."""
    found = []
    for k in range(first, first + 8):
        q, qd = state(k)
        lengths = MODEL.cable_lengths(q) if k % 3 != 1 else None
        told = [MODEL.tip(q)[1], lengths, np.array([0.0, 0.0, -0.1])]
        both = estimator.update(told, np.full(9, 1.0 + 0.1 * k), q, qd)
        more = [*estimator.values.values(), *estimator.deviations.values()]
        found.append(np.concatenate([*both, more]))
    return np.array(found)


def commanded(controller: Any, first: int) -> Any:
    times = range(first, first + 8)
    return np.array([controller.update(k * controller.period, *state(k)) for k in times])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", ESTIMATORS)
def test_a_copied_estimator_goes_on_alike_and_by_itself(name: str, way: str) -> None:
    one = ESTIMATORS[name]()
    anew = WAYS[way](one)
    one.reset(*state(0))
    estimated(one, 0)
    other = WAYS[way](one)
    expected = estimated(one, 8)
    np.testing.assert_array_equal(estimated(other, 8), expected)
    assert np.ptp(expected, axis=0).max() > 0.0
    with pytest.raises(ValueError, match="call reset with a state first"):
        estimated(anew, 8)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", CONTROLLERS)
def test_a_copied_controller_goes_on_alike_and_by_itself(name: str, way: str) -> None:
    one = CONTROLLERS[name]()
    size = 3 if name in ("TaskSpace", "Mpc") else 6
    end = MODEL.tip(np.full(6, 0.05))[1] if size == 3 else np.full(6, 0.05)
    start = MODEL.tip(np.zeros(6))[1] if size == 3 else np.zeros(6)
    one.path = cdcr.ReferencePath.spline([0.0, 1.0], [start, end])
    commanded(one, 0)
    other = WAYS[way](one)
    expected = commanded(one, 8)
    # What the optimiser's BLAS adds up may depend on where arrays begin.
    off = 1e-9 * np.abs(expected).max() if name == "Mpc" else 0.0
    np.testing.assert_allclose(commanded(other, 8), expected, rtol=0.0, atol=off)
    assert np.ptp(expected, axis=0).max() > 0.0
