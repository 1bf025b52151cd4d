"""The model: a robot made ready for computing."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core
from cdcr._robot import Robot

FloatArray = NDArray[np.float64]

FORMULATIONS = tuple(f.name.replace("_", "-") for f in _core.Formulation)


class ConvergenceError(RuntimeError):
    """A search ended without an answer; the message says what to try next."""


class InfeasibleError(ValueError):
    """No tensions within the limits give the force asked for.

    Attributes
    ----------
    tension : (num_cables,) array
        Tensions that come nearest [N].
    force : (2n,) array
        The generalised force they give [N m].
    limiting : tuple of int
        Indices of the cables at a limit.
    """

    def __init__(self, message: str, answer: _core.Allocation) -> None:
        super().__init__(message)
        self.tension = answer.tension
        self.force = answer.force
        self.limiting = tuple(answer.limiting)


class InverseKinematics:
    """Answer of `Model.inverse_kinematics`.

    Attributes
    ----------
    q : (2,) array
        Bending vector [rad].
    position : (3,) array
        Tip position reached [m].
    distance : float
        From the point asked for [m].
    reachable : bool
        Whether the distance is rounding error only.
    """

    __slots__ = ("distance", "position", "q", "reachable")

    def __init__(
        self, q: FloatArray, position: FloatArray, distance: float, reachable: bool
    ) -> None:
        self.q, self.position = q, position
        self.distance, self.reachable = distance, reachable

    def __repr__(self) -> str:
        return (
            f"InverseKinematics(q={self.q}, position={self.position}, "
            f"distance={self.distance}, reachable={self.reachable})"
        )


class Model(_core.Model):
    """Equations of motion of a robot: M(q) qdd + h(q, qd) = B F.

    A model never changes, so threads may share one. q, qd, qdd are bending vectors and their rates,
    base to tip, shape (2n,) in rad, rad/s, rad/s^2; tensions have shape (num_cables,) in N. Every
    method raises ValueError naming the argument when its shape is wrong, it is not finite, a
    tension is negative, or a section is bent beyond ``cdcr.max_bending``.

    Parameters
    ----------
    robot : Robot
        The robot described.
    formulation : {"exact", "taylor", "printed", "printed-taylor"}, optional
        Which inertia functions to use; all but the first are the origin paper's, for one section.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> q = model.equilibrium([5.0, 0.0, 0.0])
    >>> print(f"{cdcr.polar(q)[0]:.6f} rad")
    0.261411 rad
    """

    def __init__(self, robot: Robot, formulation: str = "exact") -> None:
        if not isinstance(robot, Robot):
            raise TypeError(f"robot must be a cdcr.Robot, got {type(robot).__name__}")
        if formulation not in FORMULATIONS:
            raise ValueError(f"formulation must be one of {FORMULATIONS}, got {formulation!r}")
        super().__init__(robot._to_core(), _core.Formulation[formulation.replace("-", "_")])
        self._robot = robot
        self._formulation = formulation

    @property
    def robot(self) -> Robot:
        """The robot described."""
        return self._robot

    @property
    def formulation(self) -> str:
        """Which inertia functions are used."""
        return self._formulation

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle by description."""
        return (Model, (self._robot, self._formulation))

    def __repr__(self) -> str:
        return (
            f"<Model of {self.num_sections} section(s), {self.num_cables} cables, "
            f"formulation {self._formulation!r}>"
        )

    def equilibrium(self, tension: ArrayLike, q0: ArrayLike | None = None) -> FloatArray:
        """Bending vectors at rest under constant tensions: dU/dq = B F.

        Newton's method on the potential energy, made to go downhill everywhere. The answer may be
        unstable when gravity is strong and the start is a point of rest: `find_equilibrium` tells.

        Parameters
        ----------
        tension : (num_cables,) array_like
            Cable tensions [N].
        q0 : (2n,) array_like, optional
            Where to start [rad]; by default the answer without gravity.

        Returns
        -------
        (2n,) array
            In radians.

        Raises
        ------
        ConvergenceError
            If there is no equilibrium within the bending limit, or none was found.
        """
        answer = self.find_equilibrium(tension, q0)
        if answer.status is not _core.Status.ok:
            raise ConvergenceError(_core.status_message(answer.status))
        return answer.q

    def allocate(
        self, force: ArrayLike, min_tension: float = 0.0, max_tension: float = math.inf
    ) -> FloatArray:
        """Least-norm cable tensions within limits that give a generalised force.

        Parameters
        ----------
        force : (2n,) array_like
            Generalised force [N m], as `inverse_dynamics` returns it.
        min_tension, max_tension : float, optional
            Limits of every tension [N], 0 <= min_tension <= max_tension.

        Returns
        -------
        (num_cables,) array
            Tensions [N].

        Raises
        ------
        InfeasibleError
            If no tensions within the limits give that force; it carries the nearest ones.
        """
        answer = self.find_tension(force, min_tension, max_tension)
        if not answer.feasible:
            cables = ", ".join(str(cable) for cable in answer.limiting)
            raise InfeasibleError(
                f"force {np.asarray(force)} N m cannot be met with tensions from {min_tension} to "
                f"{max_tension} N: limited by cables [{cables}], the nearest force is "
                f"{answer.force}",
                answer,
            )
        return answer.tension

    def inverse_kinematics(self, p: ArrayLike) -> InverseKinematics:
        """Bending vector that brings the tip of a one-section robot to a point.

        The tip moves on a surface, so most points are out of reach: then the nearest point of the
        surface is given, with its distance.

        Parameters
        ----------
        p : (3,) array_like
            Point in the base frame [m].

        Returns
        -------
        InverseKinematics
        """
        return InverseKinematics(*self._inverse_kinematics(p))
