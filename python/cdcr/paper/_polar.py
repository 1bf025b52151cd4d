"""The paper's own equations of motion, eq. (20), in bending angle theta and orientation angle phi.

    M11 thetadd + C11 thetad^2 + C13 phid^2 + c thetad + dU/dtheta = sum_j r F_j cos(gamma_j - phi)
    M22 phidd + C22 thetad phid + c theta^2 phid + dU/dphi = sum_j r F_j theta sin(gamma_j - phi)

with C11 = M11'/2, C13 = -M22'/2, C22 = M22' (22), U = K theta^2/2 (18) and ' = d/dtheta. The right
sides are (19) and (24) for any cables; weight and viscous damping c are not in the paper. Equation
(20) prints phid^2 beside C22 and thetad phid beside C13 (E1).
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import short
from cdcr.paper._elements import bow, disks, rod, sinc, sinc_slope
from cdcr.paper._factors import check_kind, checked_angles, inertia_and_slopes, only_section
from cdcr.robot.robot import Robot

VelocityOrder = Literal["mended", "printed"]

# Below this phi has lost half of its digits and M22 nearly all of its size [rad].
_STRAIGHT = 1e-8


@dataclass(frozen=True)
class PolarModel:
    """Equations of motion of a one-section robot in theta and phi, as the paper has them.

    For comparison: where the robot is straight they divide zero by zero, and are refused.
    ``cdcr.Model`` has the same motions in bending vectors q = theta (cos phi, sin phi), where
    nothing is singular. All angles may be arrays of fitting shapes.

    Parameters
    ----------
    robot : Robot
        Of one section.
    formulation : {"exact", "taylor", "printed", "printed-taylor"}, optional
        The factors in M11 and M22, as in ``cdcr.paper.inertia``.
    velocity_order : {"mended", "printed"}, optional
        How the products of velocities stand in eq. (20). As printed (E1) the free robot does not
        keep its energy.

    Raises
    ------
    ValueError
        For a robot of several sections, or an unknown formulation or order.

    Examples
    --------
    >>> import cdcr
    >>> from cdcr.paper import PolarModel
    >>> polar = PolarModel(cdcr.robots.amouri2020())
    >>> thetadd, phidd = polar.forward_dynamics(0.5, 0.0, 0.0, 2.0, [0.0, 5.0, 0.0])
    >>> print(f"{thetadd:.4f} {phidd:.4f} rad/s^2")
    -50.8495 38.6775 rad/s^2
    """

    robot: Robot
    formulation: str = "exact"
    _: KW_ONLY
    velocity_order: VelocityOrder = "mended"

    def __post_init__(self) -> None:
        """Refuse what the paper does not cover."""
        only_section(self.robot)
        check_kind(self.formulation, "formulation")
        if self.velocity_order not in ("mended", "printed"):
            raise ValueError(
                f"velocity_order must be 'mended' or 'printed', got {short(self.velocity_order)}"
            )

    def mass_matrix(self, theta: ArrayLike) -> FloatArray:
        """Return diag(M11, M22), paper eq. (21).

        Parameters
        ----------
        theta : (...) array_like
            Bending angles [rad].

        Returns
        -------
        (..., 2, 2) array
            Mass matrices [kg m^2].

        Raises
        ------
        ValueError
            Where the robot is straight, or an inertia is not positive.
        """
        (M11, M22), _ = self._inertia(checked_angles(theta))
        M = np.zeros((*np.shape(M11), 2, 2))
        M[..., 0, 0], M[..., 1, 1] = M11, M22
        return M

    def forward_dynamics(
        self,
        theta: ArrayLike,
        phi: ArrayLike,
        thetad: ArrayLike,
        phid: ArrayLike,
        tension: ArrayLike,
    ) -> tuple[Any, Any]:
        """Return the angular accelerations under cable tensions, paper eq. (20).

        Parameters
        ----------
        theta, phi : (...) array_like
            Bending and orientation angles [rad].
        thetad, phid : (...) array_like
            Their rates [rad/s].
        tension : (..., num_cables) array_like
            Cable tensions [N], none negative.

        Returns
        -------
        thetadd, phidd : float or (...) array
            Accelerations [rad/s^2].

        Raises
        ------
        ValueError
            Where the robot is straight or an inertia is not positive, and for an argument out of
            its range.
        """
        angle, direction = checked_angles(theta), finite(phi, "phi")
        bending, turning = finite(thetad, "thetad"), finite(phid, "phid")
        forces = self._checked_tension(tension)
        (M11, M22), (dM11, dM22) = self._inertia(angle)
        second, third = bending * turning, turning**2
        if self.velocity_order == "printed":
            second, third = third, second
        C11, C13, C22 = dM11 / 2.0, -dM22 / 2.0, dM22
        damping = self.robot.sections[0].damping
        Q1, Q2 = self._cable_forces(angle, direction, forces)
        dU1, dU2 = self._potential_slopes(angle, direction)
        thetadd = Q1 - dU1 - C11 * bending**2 - C13 * third - damping * bending
        phidd = Q2 - dU2 - C22 * second - damping * angle**2 * turning
        return thetadd / M11, phidd / M22

    def kinetic_energy(self, theta: ArrayLike, thetad: ArrayLike, phid: ArrayLike) -> Any:
        """Return T = (M11 thetad^2 + M22 phid^2)/2, paper eq. (9).

        Parameters
        ----------
        theta : (...) array_like
            Bending angles [rad].
        thetad, phid : (...) array_like
            Rates of bending and orientation angle [rad/s].

        Returns
        -------
        float or (...) array
            Energy [J].
        """
        bending, turning = finite(thetad, "thetad"), finite(phid, "phid")
        (M11, M22), _ = inertia_and_slopes(checked_angles(theta), self.robot, self.formulation)
        return (M11 * bending**2 + M22 * turning**2) / 2.0

    def potential_energy(self, theta: ArrayLike, phi: ArrayLike) -> Any:
        """Return elastic energy, paper eq. (18), plus weight, the latter zero at the base.

        Parameters
        ----------
        theta, phi : (...) array_like
            Bending and orientation angles [rad].

        Returns
        -------
        float or (...) array
            Energy [J].
        """
        angle, direction = checked_angles(theta), finite(phi, "phi")
        x, weight, along, _ = self._weights(direction)
        y = angle[..., np.newaxis] * x
        out, up = (x * y * bow(y)) @ weight, (x * sinc(y)) @ weight
        elastic = self.robot.sections[0].stiffness / 2.0 * angle**2
        return elastic - along * out - self.robot.gravity[2] * up

    def _inertia(self, theta: FloatArray) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
        """Return (M11, M22) and their slopes, where both are positive and theta is not zero."""
        smallest = float(np.min(np.abs(theta), initial=np.inf))
        if smallest < _STRAIGHT:
            raise ValueError(
                f"theta must be at least {_STRAIGHT:g} rad in magnitude, got {smallest:g} rad: in "
                "theta and phi the straight robot has M22 = 0 and no phi; use cdcr.Model, whose "
                "bending vector q = theta (cos phi, sin phi) is smooth there"
            )
        inertias = inertia_and_slopes(theta, self.robot, self.formulation)
        for name, value in zip(("M11", "M22"), inertias[0], strict=True):
            wrong = np.atleast_1d(value) <= 0.0
            if np.any(wrong):
                angle = np.atleast_1d(theta)[wrong][0]
                raise ValueError(
                    f"{name} must be > 0 kg m^2 to be divided by, got "
                    f"{np.atleast_1d(value)[wrong][0]:.3g} at theta = {angle:.6g} rad with "
                    f"formulation {self.formulation!r}; 'exact' is positive at every angle of a "
                    "robot that has mass"
                )
        return inertias

    def _cable_forces(
        self, theta: FloatArray, phi: FloatArray, tension: FloatArray
    ) -> tuple[Any, Any]:
        """Return the generalised forces of paper eq. (19), for any cables."""
        section = self.robot.sections[0]
        away = np.array(section.cable_angles) - phi[..., np.newaxis]
        Q1 = section.cable_radius * np.sum(tension * np.cos(away), axis=-1)
        Q2 = section.cable_radius * theta * np.sum(tension * np.sin(away), axis=-1)
        return Q1, Q2

    def _potential_slopes(self, theta: FloatArray, phi: FloatArray) -> tuple[Any, Any]:
        """Return dU/dtheta and dU/dphi."""
        elastic = self.robot.sections[0].stiffness * theta
        if not any(self.robot.gravity):
            return elastic, 0.0
        x, weight, along, across = self._weights(phi)
        y = theta[..., np.newaxis] * x
        S, A = sinc(y), bow(y)
        # Theta moves an element outwards at x^2 (S - A) and along Z at x^2 S'.
        out, up = (x**2 * (S - A)) @ weight, (x**2 * sinc_slope(y, S)) @ weight
        return elastic - along * out - self.robot.gravity[2] * up, -across * ((x * y * A) @ weight)

    def _weights(self, phi: FloatArray) -> tuple[FloatArray, FloatArray, Any, Any]:
        """Return places, masses times length, and gravity outwards and sideways of the bend."""
        section = self.robot.sections[0]
        bodies = (
            (rod(), section.backbone_mass),
            (disks(section.num_disks), section.disk_mass),
            (disks(1), self.robot.payload),
        )
        x = np.concatenate([body.x for body, _ in bodies])
        weight = section.length * np.concatenate([mass * body.weight for body, mass in bodies])
        gx, gy, _ = self.robot.gravity
        cosine, sine = np.cos(phi), np.sin(phi)
        return x, weight, gx * cosine + gy * sine, gy * cosine - gx * sine

    def _checked_tension(self, tension: ArrayLike) -> FloatArray:
        forces = finite(tension, "tension")
        num_cables = self.robot.num_cables
        if forces.ndim == 0 or forces.shape[-1] != num_cables:
            raise ValueError(
                f"tension must have shape ({num_cables},) or (..., {num_cables}), got "
                f"{forces.shape}"
            )
        if np.any(forces < 0.0):
            raise ValueError(f"tension must be >= 0 N, got {float(np.min(forces)):g} N")
        return forces
