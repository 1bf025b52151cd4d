"""What a robot at rest is like: where it rests, how it vibrates, how stiff it is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.model.modes import Modes
from cdcr.model.stability import stable_step
from cdcr.model.statics import ConvergenceError
from cdcr.robot.robot import Robot

TAUT = 10.0  # tension to which cables driven by length are wound, that all are taut [N]
PERTURBATION = 0.1  # off a shape that does not last, towards one that does [rad]
RIGID = 1e-14  # of the largest compliance of the tip: less is rounding
STRAIGHT = 1e-6  # bent by less than this is straight [rad]


@dataclass(frozen=True, eq=False)
class Rest:
    """A robot at rest without tension, its cables driven by length just taut.

    Attributes
    ----------
    model : Model
        The robot.
    q : (d,) array
        Its shape [rad].
    command : (num_cables,) array
        Of the cables [N], [m] where driven by length.
    tension : (num_cables,) array
        What the cables pull with [N].
    stable : bool
        Whether it stays there.
    buckled : bool
        Whether it would not stay straight, although straight it is at rest.
    """

    model: Model
    q: FloatArray
    command: FloatArray
    tension: FloatArray
    stable: bool
    buckled: bool

    @property
    def words(self) -> str:
        """Where it rests."""
        angles = self.model.polar(self.q)[0].copy()
        for i, section in enumerate(self.model.robot.sections):
            if section.bending_order is None:  # bent as it was made
                angles[i] = np.hypot(*section.rest_bending)
        bends = [name.startswith("q") for name in self.model.coordinate_names]
        if max(np.max(np.abs(self.q[bends]), initial=0.0), np.max(angles)) < STRAIGHT:
            where = "straight"
        else:
            where = f"bent by {_degrees(angles)}"
        twist = self._first_of("t")
        if np.max(np.abs(twist), initial=0.0) >= STRAIGHT:
            where += f", twisted by {_degrees(twist)}"
        if self.buckled:
            where += ", buckled under its weight"
        if not self.stable:
            where += ", where it does not stay"
        if any(cable.length_driven for cable in self.model.robot.all_cables):
            where += f", cables driven by length wound to {TAUT:g} N"
        return where

    def _first_of(self, strain: str) -> FloatArray:
        """Return the first coordinate of a strain of each section that has it, base to tip."""
        names = [f"{strain}{i + 1}" for i in range(self.model.num_sections)]
        return self.q[[name in names for name in self.model.coordinate_names]]

    @cached_property
    def modes(self) -> Modes:
        """Its vibrations; ValueError for a robot without inertia."""
        return self.model.modes(self.q, self.command)

    @cached_property
    def step(self) -> float:
        """Largest stable step of rk4 [s]; ValueError for a robot without inertia."""
        return stable_step(self.model, self.q, self.command)

    @cached_property
    def _stiffness(self) -> FloatArray:
        return self.model.static_stiffness(self.q, self.command)

    @property
    def is_nondegenerate(self) -> bool:
        """Whether every small force moves it little: not so where it turns freely, or falls."""
        eigenvalues = relative_stiffness(self.model, self._stiffness)
        return bool(eigenvalues[0] > STRAIGHT * eigenvalues[-1])

    @cached_property
    def _tip(self) -> tuple[FloatArray, FloatArray]:
        """Jacobian of the tip in its own frame (3, d) and K^-1 of the robot (d, d)."""
        R, _ = self.model.tip(self.q)
        J = self.model.tip_jacobian(self.q)[:3]
        return R.T @ J, np.asarray(np.linalg.inv(self._stiffness), dtype=np.float64)

    @property
    def tip_stiffness(self) -> tuple[float, float]:
        """Force on the tip over its motion along it, along x and y of the tip [N/m].

        Infinite where no strain that it has moves the tip that way.
        """
        J, compliance = self._tip
        x, y, z = map(float, np.diag(J @ compliance @ J.T))
        least = RIGID * max(x, y, z, 0.0)
        return (1.0 / x if x > least else np.inf), (1.0 / y if y > least else np.inf)

    @property
    def tip_motion(self) -> FloatArray:
        """How far the tip goes for a pull on each cable (num_cables,), [m/N] or [m/m].

        Per newton, and per length wound where the cable is driven by length; those that are slack
        do nothing.
        """
        J, compliance = self._tip
        cables = zip(self.model.robot.all_cables, self.tension, strict=True)
        force = [
            (cable.stiffness if tension > 0.0 else 0.0) if cable.length_driven else 1.0
            for cable, tension in cables
        ]
        pull = self.model.actuation_matrix(self.q) * np.array(force)
        return np.asarray(np.linalg.norm(J @ compliance @ pull, axis=0))


def at_rest(robot: Robot) -> Rest:
    """Return where a robot rests without tension, upright or where it has buckled to.

    Raises
    ------
    ConvergenceError
        Where it finds no rest.
    """
    model = Model(robot)
    driven = np.array([cable.length_driven for cable in robot.all_cables], dtype=bool)
    command = model.commands(model.rest_shape, np.where(driven, TAUT, 0.0))
    found = model.equilibrium(command, throw=False)
    buckled = False
    if found.status.name == "ok" and not found.stable:
        # A point of rest found exactly is given back: look for the one the robot falls to.
        bends = [float(s.bending_order is not None) for s in robot.sections]
        sideways = np.outer(bends, [PERTURBATION / model.num_sections, 0.0])
        perturbation = model.coordinates(sideways.ravel())
        fallen = model.equilibrium(command, found.q + perturbation, throw=False)
        if fallen.status.name == "ok" and np.max(np.abs(fallen.q - found.q)) > STRAIGHT:
            found, buckled = fallen, True
    if found.status.name != "ok":
        raise ConvergenceError("no rest within the bending limit: its weight bends it too far")
    # Free to turn about the vertical, a buckled robot is stable in all other directions.
    eigenvalues = relative_stiffness(model, model.static_stiffness(found.q, command))
    stable = bool(eigenvalues[0] > -STRAIGHT * np.max(np.abs(eigenvalues)))
    return Rest(model, found.q, command, found.tension, stable, buckled)


def relative_stiffness(model: Model, stiffness: FloatArray) -> FloatArray:
    """Return the eigenvalues of a stiffness (d, d) over that of the backbone, increasing [1].

    Bending and stretch, which have different units, then compare.
    """
    inverse = np.linalg.inv(np.linalg.cholesky(model.elastic_stiffness))
    return np.asarray(np.linalg.eigvalsh(inverse @ stiffness @ inverse.T))


def _degrees(angles: FloatArray) -> str:
    return ", ".join(f"{angle:.2f}" for angle in np.rad2deg(angles)) + " deg"
