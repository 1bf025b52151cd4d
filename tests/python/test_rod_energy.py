"""A rod without damping keeps its energy: that of the discrete model, for as long as it runs.

CDCR_LONG_RUNS=1 runs for 100 s in place of 1 s, some minutes; the nightly script does.
"""

from __future__ import annotations

import os
from dataclasses import replace

import numpy as np
import pytest

import cdcr

SECONDS = 100.0 if os.environ.get("CDCR_LONG_RUNS") else 1.0
# Of some million steps at rtol 1e-12.
DRIFT = 1e-8


@pytest.mark.parametrize(("bending", "twist", "stretch"), [(2, 0, None), (1, 0, 0)])
def test_energy_does_not_drift(bending: int, twist: int, stretch: int | None) -> None:
    robot = cdcr.robots.amouri2020(damping=0.0, gravity=(0.0, 0.0, -9.81))
    (section,) = robot.sections
    rod = replace(
        section,
        bending_order=bending,
        twist_order=twist,
        stretch_order=stretch,
        shear_modulus=section.youngs_modulus / 2.6,
    )
    model = cdcr.Model(replace(robot, sections=(rod,)))
    q0 = np.zeros(model.num_coordinates)
    q0[:4] = 0.4, 0.2, 0.1, -0.1
    run = cdcr.simulate(
        model,
        q0,
        np.zeros_like(q0),
        t=np.linspace(0.0, SECONDS, 101),
        method="dopri5",
        rtol=1e-12,
        atol=1e-14,
        max_steps=10**9,
        throw=True,
    )
    drift = np.abs(run.energy - run.energy[0]).max() / np.abs(run.energy).max()
    print(f"\n{SECONDS:g} s, {run.stats.steps} steps: drift {drift:.1e}")
    assert np.ptp(run.theta) > 0.2  # it does swing
    assert drift < DRIFT * max(SECONDS / 100.0, 0.01)
