"""Steps per second of environments of Gymnasium, cdcr's beside MuJoCo's of like size.

    pip install "cdcr[gym]" "gymnasium[mujoco]"
    python bench/environments.py [--quick]

Like size: Reacher has two joints and a target that is two more, and two motors, HalfCheetah nine
coordinates and six. A step is 0.02 s, 0.05 s of HalfCheetah. The environments take turns, so that
all have the same machine.
"""

from __future__ import annotations

import argparse
import statistics
import time
from dataclasses import dataclass, field
from importlib import metadata
from typing import Any

import gymnasium
import numpy as np
from rows import layout, number

import cdcr.gym

MANY = 32
ACTIONS = 64  # drawn before, in turn


@dataclass
class Contestant:
    """An environment, or many at once, and its steps in a second by clock and by own time."""

    name: str
    count: int = 1
    rates: list[float] = field(default_factory=list)
    own: list[float] = field(default_factory=list)

    def __post_init__(self) -> None:
        make = gymnasium.make if self.count == 1 else gymnasium.make_vec
        options: dict[str, Any] = {} if self.count == 1 else {"num_envs": self.count}
        self.env: Any = make(self.name, **options)
        self.env.action_space.seed(1)
        self.actions = [self.env.action_space.sample() for _ in range(ACTIONS)]
        self.env.reset(seed=1)

    def run(self, steps: int) -> None:
        """Take some steps, new episodes where one ends included."""
        before, start = time.thread_time(), time.perf_counter()
        for k in range(steps // self.count):
            *_, terminated, truncated, _ = self.env.step(self.actions[k % ACTIONS])
            if self.count == 1 and (terminated or truncated):
                self.env.reset()
        taken = steps // self.count * self.count
        self.rates.append(taken / (time.perf_counter() - start))
        self.own.append(taken / (time.thread_time() - before))

    def row(self) -> list[str]:
        """Show the environment, its size, and its rates."""
        single = getattr(self.env.unwrapped, "envs", [self.env])[0].unwrapped
        data = getattr(single, "data", None)
        size = single.model.num_coordinates if data is None else len(data.qvel)
        space = getattr(self.env, "single_action_space", self.env.action_space)
        return [
            f"{self.name}, {self.count} at once" if self.count > 1 else self.name,
            str(size),
            str(np.prod(space.shape)),
            number(statistics.median(self.rates)),
            f"{number(min(self.rates))} to {number(max(self.rates))}",
            number(statistics.median(self.own)),
        ]


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true", help="a tenth of the steps")
    steps = 2_000 if parser.parse_args().quick else 20_000
    names = ["cdcr/Reach-v0", "Reacher-v5", "cdcr/ReachThreeSections-v0", "HalfCheetah-v5"]
    contestants = [Contestant(name, count) for count in (1, MANY) for name in names]
    for _ in range(5):
        for one in contestants:
            one.run(steps)
    header = ["steps per second", "coordinates", "actuators", "median", "range", "own time"]
    print(layout(header, [one.row() for one in contestants]))
    packages = ("gymnasium", "mujoco", "numpy")
    print(
        ", ".join([f"cdcr {cdcr.__version__}", *(f"{p} {metadata.version(p)}" for p in packages)])
    )


if __name__ == "__main__":
    main()
