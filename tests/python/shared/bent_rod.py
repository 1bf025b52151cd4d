"""A bare rod bent at its tip: the robot, and the elastica by elliptic integrals."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq  # type: ignore[import-untyped]
from scipy.special import (  # type: ignore[import-untyped]
    ellipe,
    ellipeinc,
    ellipk,
    ellipkinc,
)

import cdcr

FloatArray = NDArray[np.float64]

LENGTH, DIAMETER, MODULUS = 0.8, 0.005, 9.5e9
FLEXURAL = MODULUS * math.pi / 64.0 * DIAMETER**4  # E I [N m^2]

# Where the tip is: along the straight robot and across it, in lengths, and the angle turned [rad].
Tip = FloatArray


def backbone(mass: float = 0.01, **options: object) -> cdcr.Robot:
    """A bare rod, of `mass` [kg]."""
    section = cdcr.Section(
        length=LENGTH, backbone_mass=mass, backbone_diameter=DIAMETER, youngs_modulus=MODULUS
    )
    return cdcr.Robot(sections=[section], **options)  # type: ignore[arg-type]


def tip_of(model: cdcr.Model, q: FloatArray, across: FloatArray) -> Tip:
    """In the plane of the robot's axis and `across`."""
    straight = np.asarray(model.tip(np.zeros_like(q))[0])[:, 2]
    rotation, position = model.tip(q)
    tangent = rotation[:, 2]
    angle = math.atan2(tangent @ across, tangent @ straight)
    length = model.robot.length
    return np.array([position @ straight / length, position @ across / length, angle])


def elastica(load: float) -> Tip:
    """Tip of a cantilever under a dead force across it, load = F l^2/(E I), by elliptic integrals.

    With psi the angle turned, psi'^2 = 2 load (sin psi_tip - sin psi); k^2 = (1 + sin psi_tip)/2
    and sin a = 1/(k sqrt 2) turn it into sqrt(load) = K(k) - F(a, k).
    """

    def amplitude(m: float) -> float:
        return math.asin(min(1.0, 1.0 / math.sqrt(2.0 * m)))

    def excess(m: float) -> float:
        return float(ellipk(m) - ellipkinc(amplitude(m), m)) - math.sqrt(load)

    m = brentq(excess, 0.5, 1.0 - 1e-12, xtol=1e-15)
    angle = math.asin(2.0 * m - 1.0)
    along = math.sqrt(2.0 * math.sin(angle) / load)
    across = 1.0 - 2.0 / math.sqrt(load) * float(ellipe(m) - ellipeinc(amplitude(m), m))
    return np.array([along, across, angle])
