"""Robots that both cdcr and SoRoMoX describe: arcs, and a rod of varying curvature, without disks.

SoRoMoX knows uniform rods, so the mass of the disks is spread along the backbone. Its segments
bend only, its coordinates are scaled to angles, its x axis lies along the backbone, and its base
stands upright in the world, turned by a right angle about the vertical. A rod's curvature is a
sum of the same Legendre polynomials in both: GVS there, bending order 2 here.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import cdcr

Array = NDArray[np.float64]
GRAVITY = (0.0, 0.0, -9.81)
POINTS = 10  # of Gauss along the rod of SoRoMoX, which asks for at least 5


def robot(count: int, bending_order: int = 0) -> cdcr.Robot:
    """Return the robot of one section or of three, undamped, upright under gravity."""
    known = cdcr.robots.amouri2020() if count == 1 else cdcr.robots.three_sections(damping=0.0)
    spread = [
        replace(
            one,
            backbone_mass=one.backbone_mass + one.num_disks * one.disk_mass,
            disk_mass=0.0,
            bending_order=bending_order,
        )
        for one in known.sections
    ]
    return replace(known, sections=spread, gravity=GRAVITY)


def soromox(arm: cdcr.Robot) -> Any:
    """Return the same robot in SoRoMoX."""
    import jax

    jax.config.update("jax_enable_x64", True)
    import jax.numpy as jnp
    from soromox import systems

    links = [
        systems.LinkSpec.circular(
            length=one.length,
            radius=one.backbone_diameter / 2.0,
            density=one.backbone_mass / (np.pi / 4.0 * one.backbone_diameter**2 * one.length),
            reference_strain=[0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            young_modulus=one.youngs_modulus,
            poisson_ratio=0.3,
        )
        for one in arm.sections
    ]
    x, y, z = arm.gravity
    gravity = jnp.array([-y, x, z])
    order = arm.sections[0].bending_order
    if order > 0:
        basis = systems.StrainBasisSpec("legendre", ("kappa_y", "kappa_z"), order)
        fixed = systems.JointSpec("fixed")
        return systems.GVS.from_segments(
            [systems.GVSSegment(link, fixed, basis, POINTS) for link in links],
            gravity=gravity,
            scale_rotational_basis_by_length=True,
        )
    structure = systems.PCSStructure(
        strain_selector=jnp.array([False, True, True, False, False, False] * len(links)),
        scale_rotational_basis_by_length=True,
    )
    return systems.PCS.from_links(links, structure=structure, gravity=gravity)


def theirs(q: Array, arm: cdcr.Robot) -> Array:
    """Turn bending vectors (..., d) into SoRoMoX's coordinates: strains about its y and z."""
    pairs = q.reshape(*q.shape[:-1], -1, 2)
    return np.stack((-pairs[..., 1], pairs[..., 0]), axis=_components(arm)).reshape(q.shape)


def back(q: Array, arm: cdcr.Robot) -> Array:
    """Turn them back."""
    q = np.asarray(q)
    if _components(arm) == -1:
        about_y, about_z = np.moveaxis(q.reshape(*q.shape[:-1], -1, 2), -1, 0)
    else:
        about_y, about_z = np.moveaxis(q.reshape(*q.shape[:-1], 2, -1), -2, 0)
    return np.stack((about_z, -about_y), axis=-1).reshape(q.shape)


def _components(arm: cdcr.Robot) -> int:
    """Where the two components stand: last in arcs, in a rod before the orders of each."""
    return -2 if arm.sections[0].bending_order > 0 else -1
