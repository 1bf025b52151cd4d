"""Runs beside each other: the interpreter goes on, and threads do not disturb each other."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import cdcr

METHODS = ["auto", "bdf", "adams", "dopri5", "dop853", "rk4"]
NUM_THREADS = 4


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020(gravity=(0.0, 0.0, -9.81), damping=1e-3))


@pytest.mark.parametrize("method", METHODS)
def test_a_run_does_not_hold_the_interpreter(model: cdcr.Model, method: Any) -> None:
    def work() -> float:
        begin = time.monotonic()
        cdcr.simulate(
            model, [0.4, 0.0], [0.0, 1.0], t=[0.0, 20.0], method=method, step=1e-4, max_step=1e-4
        )
        return time.monotonic() - begin

    with ThreadPoolExecutor(1) as pool:
        lasted = pool.submit(work)
        # Held up, this thread would not look at the clock from one end of the run to the other.
        gap, last = 0.0, time.monotonic()
        while not lasted.done():
            now = time.monotonic()
            gap, last = max(gap, now - last), now
    assert gap < 0.8 * lasted.result()


def test_threads_with_one_model_get_what_each_gets_alone(model: cdcr.Model) -> None:
    t = np.linspace(0.0, 1.0, 101)
    jobs = [(method, [3.0 + k, 0.5 * k, 1.0]) for method in METHODS for k in range(NUM_THREADS)]

    def work(job: tuple[Any, list[float]]) -> Any:
        method, pull = job
        run = cdcr.simulate(model, [0.4, -0.2], [0.0, 2.0], t=t, tension=pull, method=method)
        return run.q, run.qd, run.tip, run.energy

    alone = [work(job) for job in jobs]
    with ThreadPoolExecutor(NUM_THREADS) as pool:
        together = list(pool.map(work, jobs))
    for one, other in zip(alone, together, strict=True):
        for expected, found in zip(one, other, strict=True):
            np.testing.assert_array_equal(found, expected)


def test_threads_may_ask_one_model_at_once(model: cdcr.Model) -> None:
    random = np.random.default_rng(1)
    states = random.uniform(-2.0, 2.0, (500, 2, 2))

    def work(_: int) -> Any:
        rows = [model.forward_dynamics(q, qd, [1.0, 2.0, 0.0]) for q, qd in states]
        return np.array(rows), model.tips(states[:, 0]), model.potential_energies(states[:, 0])

    expected = work(0)
    with ThreadPoolExecutor(NUM_THREADS) as pool:
        for found in pool.map(work, range(NUM_THREADS)):
            for one, other in zip(found, expected, strict=True):
                np.testing.assert_array_equal(one, other)


def test_tension_functions_run_in_the_thread_of_their_run(model: cdcr.Model) -> None:
    def work(k: int) -> bool:
        seen: set[int] = set()

        def tension(t: float, q: Any, qd: Any) -> list[float]:
            seen.add(threading.get_ident())
            return [1.0 + k, t, 0.0]

        run = cdcr.simulate(model, [0.4, 0.0], [0.0, 1.0], t=[0.0, 0.5], tension=tension)
        assert run.tension[-1].tolist() == [1.0 + k, 0.5, 0.0]
        return seen == {threading.get_ident()}

    with ThreadPoolExecutor(NUM_THREADS) as pool:
        assert all(pool.map(work, range(NUM_THREADS)))


class EnoughError(Exception):
    pass


def test_an_exception_in_one_thread_leaves_the_others_alone(model: cdcr.Model) -> None:
    def work(k: int) -> str:
        def tension(t: float) -> list[float]:
            if k == 1 and t > 0.1:
                raise EnoughError
            return [1.0, 0.0, 0.0]

        try:
            run = cdcr.simulate(model, [0.4, 0.0], [0.0, 1.0], t=[0.0, 0.5], tension=tension)
        except EnoughError:
            return "raised"
        return run.status.name

    with ThreadPoolExecutor(NUM_THREADS) as pool:
        assert list(pool.map(work, range(4))) == ["ok", "raised", "ok", "ok"]
