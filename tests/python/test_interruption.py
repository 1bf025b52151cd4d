"""Ctrl-C ends whatever of the core takes long."""

from collections.abc import Callable

import numpy as np
import pytest

import cdcr
from interruption import interrupt_soon

MODEL = cdcr.Model(cdcr.robots.three_sections())


def long_step() -> None:
    simulator = cdcr.Simulator(MODEL, step=1.0, substeps=2**24)
    simulator.reset(np.zeros(6), np.zeros(6))
    simulator.step(np.zeros(9))


def long_loop_step() -> None:
    loop = cdcr.Loop(MODEL, cdcr.ComputedTorque(MODEL), substeps=2**30)
    loop.reset(np.zeros(6), np.zeros(6))
    loop.step()


def long_loop_run() -> None:
    loop = cdcr.Loop(MODEL, cdcr.ComputedTorque(MODEL), substeps=2**30)
    loop.reset(np.zeros(6), np.zeros(6))
    loop.run(1.0)


def long_search() -> None:
    MODEL.inverse_kinematics([9.0, 9.0, 9.0], np.eye(3), seeds=100000)


def long_start() -> None:
    MODEL.inverse_kinematics([0.1, 0.0, 0.1], np.eye(3), seeds=100000, iterations=100000)


def many_states() -> None:
    q = np.broadcast_to(np.full(6, 0.1), (1000, 6))
    tension = np.broadcast_to(np.zeros(9), (2000, 1, 9))
    MODEL.linearize(q, np.zeros(6), tension)


WORK = [long_step, long_loop_step, long_loop_run, long_search, long_start, many_states]


@pytest.mark.parametrize("work", WORK)
def test_control_c(work: Callable[[], None]) -> None:
    with interrupt_soon() as since:
        with pytest.raises(KeyboardInterrupt):
            work()
        assert since() < 5.0


def test_an_interrupted_step_leaves_the_state() -> None:
    simulator = cdcr.Simulator(MODEL, step=1.0, substeps=2**24)
    simulator.reset(np.full(6, 0.1), np.zeros(6))
    with interrupt_soon(), pytest.raises(KeyboardInterrupt):
        simulator.step(np.zeros(9))
    assert simulator.time == 0.0
    np.testing.assert_array_equal(simulator.q, np.full(6, 0.1))
