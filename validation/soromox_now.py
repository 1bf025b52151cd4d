"""Two pulled links by SoRoMoX as it is now, beside its published curve: soromox_three_codes.

    python validation/soromox_now.py FOLDER [--points 5]

Prints how far its tip is from the published ones and from that of cdcr's rods. It needs packages of
its own, soromox 0.5.0, jax and diffrax, and takes a minute or two. SoRoMoX before 0.2.3, with which
its curve was made, divided 1 - cos and the like by powers of the angle of a cell up to the sixth
where they have lost their digits; a series stands in for them since.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
from common import FloatArray, positive
from three_codes import AXES, DENSITY, LINK, MODULUS, RADIUS, VISCOSITY, robot, theirs

import cdcr

COUNT = 16  # coordinates: two links, four strains, order 1
STRAINS = {"bending_order": 1, "twist_order": 1, "stretch_order": 1}


def links(points: int) -> Any:
    """Return the links in SoRoMoX, as the script published with its curve describes them."""
    import jax.numpy as jnp
    from soromox import systems
    from soromox.actuation import ThreadlikeActuator, ThreadlikeRouting

    link = systems.LinkSpec.circular(
        length=LINK,
        radius=RADIUS,
        density=DENSITY,
        reference_strain=[0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
        young_modulus=MODULUS,
        shear_modulus=MODULUS / 3.0,  # of Poisson's ratio 0.5, which is refused now
        material_damping_coefficient=VISCOSITY,
    )
    basis = systems.StrainBasisSpec("legendre", [1, 1, 1, 1, 0, 0], 1)
    piece = systems.GVSSegment(link, systems.JointSpec("fixed"), basis, points)
    routing = ThreadlikeRouting.linear(
        intercept=jnp.array([[0.0, 0.0, 0.02], [0.0, 0.02, 0.0]]),
        start_segment_index=0,
        end_segment_index=(1, 1),
    )
    return systems.GVS.from_segments(
        [piece, piece],
        gravity=jnp.array([0.0, 0.0, -9.81]),
        actuators=ThreadlikeActuator.tendons(routing),
        scale_rotational_basis_by_length=True,
    )


def run(model: Any, step: float) -> tuple[FloatArray, FloatArray]:
    """Return the tip every 0.01 s of 3 s, and where it comes to rest."""
    import jax
    import jax.numpy as jnp
    from scipy.optimize import root  # type: ignore[import-untyped]
    from soromox.systems import SystemState

    pull = jnp.ones(2)
    start = SystemState(t=0.0, y=jnp.zeros(2 * COUNT))
    found = model.rollout_to(
        initial_state=start, u=pull, t1=3.0, solver_dt=step, save_dt=1e-2, max_steps=None
    )
    tip = jax.jit(lambda q: model.forward_kinematics(q, model.length)[:3, 3])
    stiffness = model.stiffness_matrix()
    out_of_balance = jax.jit(
        lambda q: stiffness @ q + model.gravitational_force(q) - model.actuation_force(q, pull)
    )
    rest = root(out_of_balance, np.asarray(found.y[-1, :COUNT]), tol=1e-12)
    if not rest.success:
        raise RuntimeError(f"no equilibrium was found: {rest.message}")
    tips = np.asarray(jax.vmap(tip)(found.y[:, :COUNT]))
    return AXES * tips, AXES * np.asarray(tip(jnp.asarray(rest.x)))


def main() -> None:
    """Read the arguments and print how far the tips are apart."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--points", type=positive, default=5, help="of Gauss along each link")
    parser.add_argument("--step", type=float, default=1e-4, help="of the solver, in seconds")
    given = parser.parse_args()
    import jax

    jax.config.update("jax_enable_x64", True)
    tips, rest = run(links(given.points), given.step)
    model = cdcr.Model(robot(1, **STRAINS))
    still = np.zeros(model.num_coordinates)
    others = {f"{code}, published": tip for code, (_, tip) in theirs(given.folder).items()}
    times = np.linspace(0.0, 3.0, len(tips))
    ours = cdcr.simulate(model, still, still, t=times, tension=[1.0, 1.0], throw=True)
    others["cdcr, rods of order 1"] = ours.tip
    print(f"SoRoMoX here: tip {tips[-1]} m after 3 s, {rest} m at rest")
    for name, other in others.items():
        apart = 1e3 * np.linalg.norm(tips - other, axis=1)
        print(f"{name}: at most {apart.max():.4f} mm apart, at 0.1 s {apart[10]:.4f} mm, "
              f"at the end {apart[-1]:.4f} mm")  # fmt: skip


if __name__ == "__main__":
    main()
