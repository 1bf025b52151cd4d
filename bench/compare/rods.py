"""One rod pulled by a cable, as cdcr, MuJoCo and PyElastica describe it: where its tip goes.

The robot of the paper with the mass of its disks spread along the backbone, at rest and straight;
cable 1 is pulled with 5 N for a second. Nothing damps it, nothing weighs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import soromox_arms
from numpy.typing import NDArray

import cdcr

Array = NDArray[np.float64]
PULL = 5.0  # [N]
TIMES = np.linspace(0.0, 1.0, 101)  # [s]
ROBOT = replace(soromox_arms.robot(1), gravity=(0.0, 0.0, 0.0))


def cdcr_rod(order: int, method: Any, rtol: float, parts: int = 1) -> Callable[[], Array]:
    """Tip (N, 3) where bending is a polynomial of that order in each part; 0 is an arc."""
    rod = replace(ROBOT, sections=[replace(ROBOT.sections[0], bending_order=order)])
    model = cdcr.Model(rod.subdivide(parts))
    still = np.zeros(model.num_coordinates)
    options: dict[str, Any] = {"method": method, "rtol": rtol, "atol": rtol / 100}
    return lambda: cdcr.simulate(model, still, still, t=TIMES, tension=[PULL, 0, 0], **options).tip


def mujoco_chain(links: int, steps: int) -> Callable[[], Array]:
    """Return the tip of a chain of links, with so many steps in ten milliseconds."""
    import mujoco

    from cdcr.export.mjcf import mjcf_text

    model = mujoco.MjModel.from_xml_string(mjcf_text(ROBOT, Path("rod.xml"), links=links))
    model.opt.timestep = (TIMES[1] - TIMES[0]) / steps
    data = mujoco.MjData(model)

    def run() -> Array:
        mujoco.mj_resetDataKeyframe(model, data, 0)
        data.ctrl[0] = PULL
        tip = np.empty((TIMES.size, 3))
        for place in tip:
            mujoco.mj_kinematics(model, data)
            place[:] = data.site("tip").xpos
            mujoco.mj_step(model, data, steps)
        return tip

    return run


def elastica_rod(elements: int, step: float) -> Callable[[], Array]:
    """Return the tip of a Cosserat rod; the cable is the moment that it exerts on the tip."""
    import elastica

    section = ROBOT.sections[0]
    moment = PULL * section.cable_radius

    class System(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing):
        """A rod held at its base."""

    class TipMoment(elastica.NoForces):  # type: ignore[misc]
        """About the second director of the last element."""

        def apply_torques(self, system: Any, time: Any = 0.0) -> None:
            system.external_torques[1, -1] += moment

    radius = section.backbone_diameter / 2.0
    volume = np.pi * radius**2 * section.length
    each = round((TIMES[1] - TIMES[0]) / step)

    def run() -> Array:
        system = System()
        rod = elastica.CosseratRod.straight_rod(
            elements,
            np.zeros(3),
            np.array([0.0, 0.0, 1.0]),
            np.array([1.0, 0.0, 0.0]),
            section.length,
            radius,
            section.backbone_mass / volume,
            youngs_modulus=section.youngs_modulus,
            shear_modulus=section.youngs_modulus / 2.6,
        )
        system.append(rod)
        held = {"constrained_position_idx": (0,), "constrained_director_idx": (0,)}
        system.constrain(rod).using(elastica.OneEndFixedBC, **held)
        system.add_forcing_to(rod).using(TipMoment)
        system.finalize()
        stepper = elastica.PositionVerlet()
        tip = np.empty((TIMES.size, 3))
        now = np.float64(0.0)
        for place in tip:
            place[:] = rod.position_collection[:, -1]
            for _ in range(each):
                now = stepper.step(system, now, np.float64(step))
        return tip

    return run
