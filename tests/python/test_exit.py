"""The end of Python while daemon threads are still in the core."""

import os
import subprocess
import sys

import pytest

START = """
import sys, threading, time
import numpy as np
import cdcr

model = cdcr.Model(cdcr.robots.amouri2020())
inside = threading.Event()
t = [0.0, 1e9]
long = dict(method="rk4", step=1e-3, max_steps=10**15)
here = [0.1, 0.0], [0.0, 0.0]

def seen(*_):
    inside.set()
    return [1.0, 0.0, 0.0]

class Seen(cdcr.Controller):
    def update(self, t, q, qd):
        return seen()

def plain():
    inside.set()
    cdcr.simulate(model, *here, t=t, **long)
def with_a_callable():
    cdcr.simulate(model, *here, t=t, tension=seen, **long)
def with_a_callable_and_bdf():
    cdcr.simulate(model, *here, t=t, tension=seen, max_steps=10**15)
def with_progress():
    cdcr.simulate(model, *here, t=t, progress=seen, **long)
def with_a_controller():
    cdcr.simulate(model, *here, t=t, controller=Seen(1e-3), **long)
def with_a_profile():
    push = cdcr.Wrench(section=0, force=(0.1, 0.0, 0.0), profile=lambda t: seen()[0])
    cdcr.simulate(model, *here, t=t, wrenches=push, **long)
def of_many_states():
    many = np.zeros((2000, 1000, 2))
    inside.set()
    while True:
        model.mass_matrix(many)
def of_a_search():
    inside.set()
    three = cdcr.Model(cdcr.robots.three_sections())
    while True:
        three.inverse_kinematics([9.0, 9.0, 9.0], np.eye(3), seeds=1000)

for _ in range(3):
    threading.Thread(target=globals()[sys.argv[1]], daemon=True).start()
inside.wait(60)
time.sleep(0.03)
"""
# How often each is tried: the nightly script, which sets the variable, tries again and again.
TIMES = max(1, int(os.environ.get("CDCR_RANDOM_TESTS", "1")))
WORK = [
    "plain",
    "with_a_callable",
    "with_a_callable_and_bdf",
    "with_progress",
    "with_a_controller",
    "with_a_profile",
    "of_many_states",
    "of_a_search",
]


@pytest.mark.parametrize("work", WORK)
def test_daemon_threads_do_not_disturb_the_end(work: str) -> None:
    for _ in range(TIMES):
        done = subprocess.run(
            [sys.executable, "-c", START, work],
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
        assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
