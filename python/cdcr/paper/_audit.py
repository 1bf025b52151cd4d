"""The audit: the claims of the paper, in its order, each beside what its own equations give."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

from cdcr.paper.claims import appendix as appendix
from cdcr.paper.claims import assumptions as assumptions
from cdcr.paper.claims import control as control
from cdcr.paper.claims import energy as energy
from cdcr.paper.claims import kinematics as kinematics
from cdcr.paper.claims import motion as motion
from cdcr.paper.claims import response as response
from cdcr.paper.claims import scope as scope
from cdcr.paper.claims.common import VERDICTS, Claim, Verdict

__all__ = ["CHECKS", "VERDICTS", "Claim", "Verdict", "audit", "tally"]

# One function a row, each of which computes it; in the order of the paper.
CHECKS: tuple[Callable[[], Claim], ...] = (
    scope.real_time,
    scope.more_sections,
    kinematics.singularities,
    assumptions.constant_curvature,
    assumptions.friction,
    assumptions.torsion,
    kinematics.kinematics,
    kinematics.angular_velocity,
    kinematics.backbone_translation,
    kinematics.backbone_taylor,
    appendix.material_range,
    appendix.backbone_range,
    kinematics.backbone_rotation,
    kinematics.moment_of_inertia,
    energy.table_1,
    appendix.superposed_curves,
    appendix.kinetic_energy_terms,
    energy.gravity_ratio,
    energy.gravity_neglected,
    energy.elastic_energy,
    motion.generalised_forces,
    motion.two_cables,
    motion.velocity_order,
    motion.missing_fractions,
    motion.coefficients,
    response.free_oscillation,
    response.sample_step,
    response.step_tension,
    response.step_oscillation,
    response.step_orientation,
    response.two_tensions,
    control.numerical_derivatives,
    control.circle_tracking,
    control.plane_tracking,
    control.pid_gains,
    control.pid_damping,
    scope.comparison,
    scope.simple_expressions,
    appendix.disk_diameter,
    appendix.turning_with_theta,
    appendix.turning_with_phi,
    appendix.disk_translation,
    appendix.missing_cosine,
)


def audit(progress: Callable[[int], object] | None = None) -> list[Claim]:
    """Hold the claims of the origin paper against its own equations and Table 1.

    Every number is computed in the call; nothing is looked up. It takes a second or two.

    Parameters
    ----------
    progress : callable, optional
        Told the number of rows done, after each.

    Returns
    -------
    list of Claim
        In the order of the paper.

    Raises
    ------
    TypeError
        For a progress that is none.

    Examples
    --------
    >>> from cdcr.paper import audit
    >>> claims = {claim.name: claim for claim in audit()}
    >>> claims["step-tension"].verdict
    'does not hold'
    >>> print(f"{claims['step-tension'].values['degrees']:.3f} deg")
    14.978 deg
    """
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function of a number, got {type(progress).__name__}")
    claims = []
    for done, check in enumerate(CHECKS, start=1):
        claims.append(replace(check(), name=check.__name__.replace("_", "-")))
        if progress is not None:
            progress(done)
    return claims


def tally(claims: Iterable[Claim]) -> dict[Verdict, int]:
    """Return how many claims have each verdict."""
    given = [claim.verdict for claim in claims]
    return {verdict: given.count(verdict) for verdict in VERDICTS}
