"""What derivatives of runs and by parameters cost, beside the differences that they replace."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from python_rows import Timed

import cdcr

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rows import Row

FIELDS = ("youngs_modulus", "length", "cable_radius")
PATHS = [f"sections.{i}.{field}" for i in (1, 2, 3) for field in FIELDS] + ["payload"]


def sensitivity_rows(quick: bool) -> Iterator[Row]:
    """Three sections that swing for 2 s, by ten parameters."""
    robot = cdcr.robots.three_sections(gravity=(0.0, 0.0, -9.81), payload=0.01)
    damped = tuple(replace(section, damping=3e-3) for section in robot.sections)
    model = cdcr.Model(replace(robot, sections=damped))
    q0, still, times = np.full(6, 0.2), np.zeros(6), np.linspace(0.0, 2.0, 11)
    model.parameter_derivatives(q0, still, np.ones(9), PATHS)  # makes the set
    states = np.random.default_rng(1).uniform(-0.5, 0.5, (1000, 6))
    count = 5 if quick else 30
    pulls = np.ones((400, 9))

    def adjoint() -> None:
        cdcr.gradient(
            model, q0, still, pulls, lambda motion: (0.0, {"q": motion.q}), step=5e-3, steps=400
        )

    yield Timed(adjoint, count, 1e-3).row(
        "gradient by 3600 tensions, 400 steps of 3 sections", "ms"
    )
    yield Timed(
        lambda: model.parameter_derivatives(states, still, np.ones(9), PATHS), count, 1e-3
    ).row("parameter_derivatives, 3 sections, 10 parameters", "us")
    for name, by in (("", ()), (", 10 sensitivities", PATHS)):

        def run(by: object = by) -> None:
            cdcr.simulate(
                model, q0, still, t=times, tension=np.ones(9), method="dop853", rtol=1e-8,
                sensitivities=by,  # type: ignore[arg-type]
            )  # fmt: skip

        yield Timed(run, count, 1e-3).row(f"2 s of 3 sections, dop853 rtol 1e-8{name}", "ms")
