"""What tolerances give, which method is the quicker, and what `auto` chooses: three tables.

    python bench/tolerances.py [errors | stiffness | choices]

Error over 10 s against rtol, with atol a hundredth of it, and its processor time; then robots that
are more and more stiff, by bdf and by the explicit methods at rtol 1e-8; then robots and scenarios
of the package by auto, dop853 and bdf.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from operator import itemgetter
from typing import Any

import numpy as np
from rows import layout, number

import cdcr

TIMES = np.linspace(0.0, 10.0, 101)
GRAVITY = (0.0, 0.0, -9.81)
METHODS = ("bdf", "adams", "dopri5", "dop853")
EXPONENTS = (6, 7, 8, 9, 10)
TURNS = 3
BENT = [0.5, 0.1, -0.3, 0.4, 0.2, -0.6]


@dataclass
class Case:
    """A motion: a robot, where it begins, and what pulls it."""

    name: str
    robot: cdcr.Robot
    q0: list[float]
    qd0: list[float]
    tension: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.model = cdcr.Model(self.robot)

    def run(self, method: Any, rtol: float, t_end: float = 10.0) -> tuple[float, cdcr.Trajectory]:
        """Processor time [s], and the run."""
        before = time.process_time()
        run = cdcr.simulate(
            self.model,
            self.q0,
            self.qd0,
            t=TIMES * (t_end / TIMES[-1]),
            tension=self.tension or None,
            method=method,
            rtol=rtol,
            atol=rtol / 100,
        )
        return time.process_time() - before, run


def errors() -> str:
    """Give the error of each method at each tolerance, and its time."""
    one, three = cdcr.robots.amouri2020, cdcr.robots.three_sections
    cases = [
        Case("1 section, free", one(), [0.8, 0.0], [0.0, 1.0]),
        Case("1 section, damped, pulled", one(damping=0.01), [0, 0], [0, 0], [5.0, 0, 0]),
        Case("3 sections, damped, free", three(gravity=GRAVITY), BENT, [0.0] * 6),
        Case("3 sections, damped, pulled", three(gravity=GRAVITY), [0.0] * 6, [0.0] * 6,
             [2.0, 0, 0, 1.0, 0, 0, 0, 0.5, 0]),
        Case("3 sections, undamped, free", three(gravity=GRAVITY, damping=0.0), BENT, [0.0] * 6),
    ]  # fmt: skip
    rows = []
    for case in cases:
        truth = case.run("dop853", 1e-13)[1].q
        for method in METHODS:
            cells = []
            for k in EXPONENTS:
                runs = [case.run(method, 10.0**-k) for _ in range(TURNS)]
                error = np.abs(runs[0][1].q - truth).max()
                spent = 1e3 * statistics.median(took for took, _ in runs)
                cells.append(f"{error:.0e} {number(spent)}")
            rows.append([f"{case.name}, {method}", *cells])
    return layout(["error [rad], ms", *(f"rtol 1e-{k}" for k in EXPONENTS)], rows)


def stiffness() -> str:
    """Compare bdf and the explicit methods where explicit steps have to be small."""
    three = cdcr.robots.three_sections(gravity=GRAVITY)
    one = cdcr.robots.amouri2020(damping=0.01)
    driven = replace(one, sections=[replace(one.sections[0], cable_stiffness=2e4)])
    strong = cdcr.robots.amouri2020(damping=0.5)
    robots = {
        "1 section": one,
        "1 section, damping 0.5": strong,
        "1 section, lengths, 20 N/mm": driven,
        **{f"1 section in {n} parts": one.subdivide(n) for n in (2, 4, 8, 12)},
        "3 sections": three,
        **{f"3 sections in {n} parts each": three.subdivide(n) for n in (2, 4)},
    }
    rows = []
    for name, robot in robots.items():
        d = 2 * len(robot.sections)
        case = Case(name, robot, list(np.resize([0.8, 0.1], d) / d), [0.0] * d)
        if robot is driven:
            case.tension = list(case.model.rest_command() - 1e-3)
        taken = {
            m: min((case.run(m, 1e-8, 1.0) for _ in range(TURNS)), key=itemgetter(0))
            for m in ("bdf", "dopri5", "dop853")
        }
        step = cdcr.stable_step(case.model, case.q0, tension=case.tension or None)
        bdf = taken["bdf"][0]
        rows.append([
            name,
            number(1e3 * step),
            *(str(run.stats.steps) for _, run in taken.values()),
            number(1e3 * bdf),
            *(f"{taken[m][0] / bdf:.2g}" for m in ("dopri5", "dop853")),
        ])  # fmt: skip
    heads = ["RK4's largest step [ms]", "steps: bdf", "dopri5", "dop853", "bdf [ms]"]
    return layout(["1 s at rtol 1e-8", *heads, "dopri5 over bdf", "dop853 over bdf"], rows)


MOST_STEPS = 200_000  # after which a method is given up


def timed(run: Callable[[str], cdcr.Trajectory]) -> list[str]:
    """Give processor times [ms] by auto and by what it chooses from, and what it chose."""
    took, told = {}, ""
    for method in ("auto", "dop853", "bdf"):
        times = []
        for _ in range(TURNS):
            before = time.process_time()
            made = run(method)
            times.append(1e3 * (time.process_time() - before))
            if not made.success or times[-1] > 3e3:
                break
        took[method] = min(times) if made.success else float("inf")
        if method == "auto" and made.stats.method is not None:
            kept = ", stiff" if made.stats.method == "dop853" else ""
            since = "" if made.stats.stiff is None else f"{kept} from {made.stats.stiff:.2g} s on"
            told = f"{made.stats.method}{since}"
    best = min(took["dop853"], took["bdf"])
    return [*(number(one) for one in took.values()), f"{took['auto'] / best:.2f}", told]


def choices() -> str:
    """Compare auto with the better of dop853 and bdf, at the default tolerances."""
    rows = []
    for name in cdcr.robots.names():
        robot = cdcr.robots.get(name)
        for parts in (1, 4):
            if parts > 1 and any(section.is_rod for section in robot.sections):
                continue
            model = cdcr.Model(robot.subdivide(parts) if parts > 1 else robot)
            try:
                cdcr.Simulator(model)
            except ValueError:  # parts without mass have no dynamics
                continue
            still, pull = np.zeros(model.num_coordinates), model.rest_command()
            pull[0] += -1e-3 if model.robot.all_cables[0].length_driven else 1.0

            def swing(method: Any, model: cdcr.Model = model, still: Any = still,
                      pull: Any = pull) -> cdcr.Trajectory:  # fmt: skip
                return cdcr.simulate(model, still, still, t=[0.0, 1.0], tension=pull, method=method,
                                     max_steps=MOST_STEPS)  # fmt: skip

            rows.append([f"{name}, {parts} parts" if parts > 1 else name, *timed(swing)])
    for name in cdcr.scenarios.names():
        scenario = cdcr.scenarios.get(name)
        if scenario.t_end > 0.0:

            def scene(method: Any, scenario: Any = scenario) -> cdcr.Trajectory:
                return scenario.simulate(method=method, max_steps=MOST_STEPS)  # type: ignore[no-any-return]

            rows.append([f"scenario {name}", *timed(scene)])
    heads = ["auto [ms]", "dop853 [ms]", "bdf [ms]", "auto over the better", "chosen"]
    return layout(["1 s under a pull; scenarios", *heads], rows)


def main() -> None:
    """Print the tables asked for, or all."""
    tables = {"stiffness": stiffness, "choices": choices, "errors": errors}
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("tables", nargs="*", metavar="TABLE", help=f"of {', '.join(tables)}")
    names = parser.parse_args().tables or list(tables)
    for name in names:
        if name not in tables:
            parser.error(f"'{name}' is no table: {', '.join(tables)} are")
    for name in names:
        print(tables[name](), flush=True)
        print()


if __name__ == "__main__":
    main()
