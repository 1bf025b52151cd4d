"""Robots that both cdcr and SoRoMoX describe: sections of constant curvature without disks.

SoRoMoX knows uniform rods, so the mass of the disks is spread along the backbone. Its segments
bend only, its coordinates are scaled to angles, its x axis lies along the backbone, and its base
stands upright in the world, turned by a right angle about the vertical.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cdcr

Array = NDArray[np.float64]
GRAVITY = (0.0, 0.0, -9.81)


def robot(count: int) -> cdcr.Robot:
    """Return the robot of one section or of three, undamped, upright under gravity."""
    known = cdcr.robots.amouri2020() if count == 1 else cdcr.robots.three_sections(damping=0.0)
    spread = [
        replace(
            one,
            backbone_mass=one.backbone_mass + one.num_disks * one.disk_mass,
            disk_mass=0.0,
        )
        for one in known.sections
    ]
    return replace(known, sections=spread, gravity=GRAVITY)


def soromox(arm: cdcr.Robot) -> Any:
    """Return the same robot in SoRoMoX."""
    import jax

    jax.config.update("jax_enable_x64", True)
    import jax.numpy as jnp
    from soromox.systems import PCS, LinkSpec, PCSStructure

    links = [
        LinkSpec.circular(
            length=one.length,
            radius=one.backbone_diameter / 2.0,
            density=one.backbone_mass / (np.pi / 4.0 * one.backbone_diameter**2 * one.length),
            reference_strain=[0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            young_modulus=one.youngs_modulus,
            poisson_ratio=0.3,
        )
        for one in arm.sections
    ]
    structure = PCSStructure(
        strain_selector=jnp.array([False, True, True, False, False, False] * len(links)),
        scale_rotational_basis_by_length=True,
    )
    x, y, z = arm.gravity
    return PCS.from_links(links, structure=structure, gravity=jnp.array([-y, x, z]))


def theirs(q: Array) -> Array:
    """Turn bending vectors (..., 2n) into SoRoMoX's coordinates: strains about its y and z."""
    pairs = q.reshape(*q.shape[:-1], -1, 2)
    return np.stack((-pairs[..., 1], pairs[..., 0]), axis=-1).reshape(q.shape)


def back(q: Array) -> Array:
    """Turn them back."""
    pairs = np.asarray(q).reshape(*q.shape[:-1], -1, 2)
    return np.stack((pairs[..., 1], -pairs[..., 0]), axis=-1).reshape(q.shape)
