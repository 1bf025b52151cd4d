"""One rod beside 16 parts: how long equilibrium takes, and 10 s of motion at the same error.

    python bench/rods.py [--runs 5]

The robot of Table 1 upright under gravity, damped as in the scenario `subdivision`, let go bent by
0.7 rad. The rod has bending order 2, with twist for the equilibrium, and is taken twice: with the
nodes of its default, which leave no error beside that of its order, and with four, the fewest whose
path is as near to the true one as that of 16 parts. How far off each model is, is printed: in its
first two frequencies, and RMS over the path of its tip beside a rod of order 4. For each model the
quickest method counts, at the loosest tolerance that leaves the tip within 0.1 mm of its own path
at rtol 1e-9. Times are of the processor, medians of runs taken in turn, with their range.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from rows import layout, number

import cdcr
from cdcr.runs.simulate import MethodName, available
from cdcr.scenarios.studies.subdivision import beam

FloatArray = NDArray[np.float64]

DAMPING = 5e-4  # of the whole section [N m s/rad]
PARTS, ORDER, NODES = 16, 2, 4
TRUE_ORDER, TRUE_NODES = 4, 16
TIMES = np.linspace(0.0, 10.0, 1001)
ERROR = 1e-4  # of the tip [m]
TRUTH = 1e-9
RTOLS = (1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6)
METHODS: tuple[MethodName, ...] = ("bdf", "dopri5", "dop853", "adams")
BLOCK = 200  # equilibria in a block

ROBOT = cdcr.robots.amouri2020(damping=DAMPING, gravity=(0.0, 0.0, -9.81))
(SECTION,) = ROBOT.sections


def rod(bending_order: int = ORDER, **orders: int | None) -> cdcr.Robot:
    """Return the robot, its section of that bending order."""
    shear = SECTION.youngs_modulus / 2.6
    one = replace(SECTION, bending_order=bending_order, shear_modulus=shear, **orders)  # type: ignore[arg-type]
    return replace(ROBOT, sections=(one,))


@dataclass
class Runner:
    """A model, let go: its quickest method, and the times of that."""

    name: str
    model: cdcr.Model
    q0: FloatArray
    method: MethodName = "dopri5"
    rtol: float = TRUTH
    error: float = 0.0  # of the tip, at most [m]
    steps: int = 0
    times: list[float] = field(default_factory=list)
    path: FloatArray = field(default_factory=lambda: np.empty((0, 3)))  # of the tip, at TRUTH [m]

    def run(self, method: MethodName, rtol: float) -> tuple[cdcr.Trajectory, float]:
        """Return a run and its time [s]."""
        start = time.thread_time()
        run = cdcr.simulate(
            self.model,
            self.q0,
            np.zeros_like(self.q0),
            t=TIMES,
            method=method,
            rtol=rtol,
            atol=0.01 * rtol,
            throw=True,
        )
        return run, time.thread_time() - start

    def choose(self) -> None:
        """Find the quickest method that is near enough to the truth."""
        self.path = self.run("dop853", TRUTH)[0].tip
        best = np.inf
        for method in filter(available, METHODS):
            for rtol in RTOLS:
                run, took = self.run(method, rtol)
                error = float(np.linalg.norm(run.tip - self.path, axis=1).max())
                if error <= ERROR:
                    if took < best:
                        best, self.method, self.rtol = took, method, rtol
                        self.error, self.steps = error, run.stats.steps
                    break

    def row(self) -> list[str]:
        """Show its method and its times."""
        how = f"{self.method} rtol {self.rtol:.0e}, {self.steps} steps, {1e3 * self.error:.2g} mm"
        return [f"10 s, {self.name}", str(self.model.num_coordinates), how, *spread(self.times)]


def off(robot: cdcr.Robot) -> str:
    """Return how far the first two frequencies about straight, without weight, are off [%]."""
    model = cdcr.Model(robot).with_gravity((0.0, 0.0, 0.0))
    modes = model.modes(np.zeros(model.num_coordinates), np.zeros(model.num_cables))
    first, second = 100.0 * (modes.frequency[:4:2] / beam()[:2] - 1.0)
    return f"{first:+.2f} and {second:+.2f} %"


def spread(times: list[float]) -> list[str]:
    """Return median and range in ms."""
    low, high = (number(1e3 * one) for one in (min(times), max(times)))
    return [f"{number(1e3 * float(np.median(times)))} ms", f"{low} to {high}"]


def statics(runs: int) -> list[list[str]]:
    """Time the equilibrium of a rod that twists, and the stiffness that each of its steps takes."""
    model = cdcr.Model(rod(twist_order=0))
    tensions = np.random.default_rng(1).uniform(0.0, 3.0, (BLOCK, model.num_cables))
    rest = [model.equilibrium(tension) for tension in tensions]
    calls: dict[str, Callable[[int], object]] = {
        "equilibrium": lambda k: model.equilibrium(tensions[k]),
        "static stiffness": lambda k: model.static_stiffness(rest[k], tensions[k]),
    }
    times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(runs):
        for name, call in calls.items():
            start = time.thread_time()
            for k in range(BLOCK):
                call(k)
            times[name].append((time.thread_time() - start) / BLOCK)
    how = f"from Python, {BLOCK} draws of the tensions, 0 to 3 N"
    size = str(model.num_coordinates)
    return [[f"{name}, with twist", size, how, *spread(times[name])] for name in calls]


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--runs", type=int, default=5, help="that are timed (default: %(default)s)")
    runs = parser.parse_args().runs
    bent = cdcr.bending([0.7], [0.0])
    robots = {
        f"rod of order {ORDER}": rod(),
        f"rod of order {ORDER}, {NODES} nodes": rod(nodes=NODES),
        f"{PARTS} parts": ROBOT.subdivide(PARTS),
    }
    runners = []
    for name, robot in robots.items():
        model = cdcr.Model(robot)
        cut = len(robot.sections) > 1
        q0 = cdcr.subdivide_state(ROBOT, PARTS, bent) if cut else model.coordinates(bent)
        runners.append(Runner(f"{name}, {off(robot)}", model, q0))
    for runner in runners:
        runner.choose()
    for _ in range(runs):
        for runner in runners:
            runner.times.append(runner.run(runner.method, runner.rtol)[1])
    header = ["", "coordinates", "how", "median", "range"]
    print(layout(header, [*statics(runs), *(runner.row() for runner in runners)]))
    *quick, slow = (float(np.median(runner.times)) for runner in runners)
    for runner, one in zip(runners[:-1], quick, strict=True):
        print(f"{PARTS} parts over the {runner.name}: {number(slow / one)} times")
    true = cdcr.Model(rod(TRUE_ORDER, nodes=TRUE_NODES))
    path = Runner("true", true, true.coordinates(bent)).run("dop853", TRUTH)[0].tip
    for runner in runners:
        off_path = float(np.sqrt(np.mean(np.sum((runner.path - path) ** 2, axis=1))))
        share = 100.0 * off_path / SECTION.length
        print(f"{runner.name}: tip off its true path by {share:.3f} % of the length RMS")


if __name__ == "__main__":
    main()
