"""The model: a robot made ready for computing."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import count, one_of, require_kind, require_truth, short
from cdcr.model.inverse_kinematics import InverseKinematics
from cdcr.model.modes import Modes
from cdcr.model.statespace import StateSpaceModel
from cdcr.model.statics import checked_allocation, checked_equilibrium
from cdcr.robot.robot import Robot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from cdcr.model.wrench import Wrench

FORMULATIONS = tuple(f.name.replace("_", "-") for f in _core.Formulation)


class Model(StateSpaceModel):
    """Equations of motion of a robot: M(q) qdd + h(q, qd) = B F.

    A model never changes, so threads may share one. q, qd, qdd are coordinates and their rates,
    base to tip, shape (d,): for a section of constant curvature its bending vector in rad, rad/s,
    rad/s^2, for others also what `coordinate_names` says, stretch in m. Tensions have shape
    (num_cables,) in N. Every method raises ValueError naming the argument when its shape is wrong,
    it is not finite, a tension is negative, or a section is bent beyond ``cdcr.max_bending``.

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
        require_kind("robot", robot, Robot)
        if not one_of(formulation, FORMULATIONS):
            raise ValueError(f"formulation must be one of {FORMULATIONS}, got {short(formulation)}")
        super().__init__(robot._to_core(), _core.Formulation[formulation.replace("-", "_")])
        self._robot = robot
        self._formulation = formulation

    def __setattr__(self, name: str, value: object) -> None:
        """Keep what is private; refuse the rest, which would change nothing."""
        if type(self) is Model and not name.startswith("_"):
            raise AttributeError(
                f"a Model stays what it was made of, so its {name} cannot be set: make another of "
                "another Robot, or of another gravity by with_gravity"
            )
        super().__setattr__(name, value)

    def with_gravity(self, gravity: ArrayLike) -> Model:
        """Return the same model under another gravity, which shares its tables.

        Gravity enters by the weights of cpp/README.md eq. (15) alone.

        Parameters
        ----------
        gravity : (3,) array_like
            In the base frame [m/s^2].

        Returns
        -------
        Model

        Raises
        ------
        ValueError
            For what is no vector of three finite numbers.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> hanging = model.with_gravity([0.0, 0.0, 9.81])
        >>> hanging.robot.gravity
        (0.0, 0.0, 9.81)
        """
        vector = finite(gravity, "gravity")
        if vector.shape != (3,):
            raise ValueError(f"gravity must have shape (3,), got {vector.shape}")
        model = Model.__new__(Model)
        _core.Model.__init__(model, self, vector)
        model._robot = replace(self._robot, gravity=tuple(vector.tolist()))
        model._formulation = self._formulation
        return model

    @property
    def robot(self) -> Robot:
        """The robot that it was made of, as described."""
        return self._robot

    @property
    def formulation(self) -> str:
        """Which inertia functions are used."""
        return self._formulation

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle by description."""
        return (Model, (self._robot, self._formulation))

    def __repr__(self) -> str:
        sections, cables = count(self.num_sections, "section"), count(self.num_cables, "cable")
        return f"<Model of {sections}, {cables}, formulation {self._formulation!r}>"

    @overload
    def equilibrium(
        self,
        tension: ArrayLike | None = ...,
        q0: ArrayLike | None = ...,
        wrenches: Wrench | Sequence[Wrench] = ...,
        *,
        throw: Literal[True] = ...,
    ) -> FloatArray: ...
    @overload
    def equilibrium(
        self,
        tension: ArrayLike | None = ...,
        q0: ArrayLike | None = ...,
        wrenches: Wrench | Sequence[Wrench] = ...,
        *,
        throw: Literal[False],
    ) -> _core.Equilibrium: ...
    def equilibrium(
        self,
        tension: ArrayLike | None = None,
        q0: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
        *,
        throw: bool = True,
    ) -> FloatArray | _core.Equilibrium:
        """Coordinates at rest under constant commands and wrenches, cpp/README.md eq. (18).

        Newton's method, downhill in energy where all loads have one; where that fails, the load
        grows from nothing to all, then other starts are tried. Friction of cables is left out: with
        it the robot rests anywhere in a range of shapes about this one. A warning says so; with
        ``throw=False`` the answer does. `quasi_static` remembers the way, and has friction. The
        answer may be unstable when gravity is strong and the start is a point of rest; with
        ``throw=False`` it tells.

        Parameters
        ----------
        tension : (num_cables,) array_like, optional
            Cable tensions [N]; lengths [m] for cables driven by length. None: no tension, the
            lengths of the straight robot.
        q0 : (d,) array_like, optional
            Where to start [rad, m]; by default the answer without gravity.
        wrenches : Wrench or sequence of Wrench, optional
            Constant forces and moments on the backbone.
        throw : bool, optional
            False: return all that was found, and raise nothing where nothing was. The old name of
            that is `find_equilibrium`.

        Returns
        -------
        (d,) array or Equilibrium
            Coordinates; with ``throw=False`` also whether it is stable, the tensions
            there, and a status.

        Raises
        ------
        ConvergenceError
            If there is no equilibrium within the bending limit, or none was found.
        """
        require_truth("throw", throw)
        found = self._rest(tension, q0, wrenches)
        return checked_equilibrium(found, warn=True) if throw else found

    def modes(
        self,
        q: ArrayLike,
        tension: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> Modes:
        """Natural frequencies and mode shapes of small motions about a shape.

        The undamped ones are those of K phi = w^2 M phi, cpp/several-sections.md eq. (44), where K
        is the static stiffness with the springs of length-driven cables and the wrenches; the
        eigenvalues of `linearize` add damping, eq. (45). Where wrenches make K unsymmetric, its
        symmetric part makes the shapes, and the eigenvalues alone tell all.

        Parameters
        ----------
        q : (..., d) array_like
            The shape, at rest there or held [rad, m]; or an array of shapes.
        tension : (..., num_cables) array_like, optional
            Cable tensions [N]; lengths [m] for cables driven by length. None: as in `equilibrium`.
        wrenches : Wrench or sequence of Wrench, optional
            Constant forces and moments on the backbone.

        Returns
        -------
        Modes
            Its arrays have the leading dimensions of `q` and `tension`, broadcast.

        Raises
        ------
        ValueError
            For arguments that are no states or commands, and for a robot without inertia there.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> model.modes([0.0, 0.0], [0.0, 0.0, 0.0])
        <Modes at 1.448, 1.448 Hz, stable>
        """
        frequency, squared, mode, ratio, pairs, stable = self._modes(q, tension, wrenches)
        leading = stable.shape[:-1]
        at = np.array(np.broadcast_to(q, frequency.shape), dtype=np.float64)
        eigenvalues = pairs.view(np.complex128)[..., 0]
        every = stable[..., 0] > 0.0
        lasting = every if leading else bool(every)
        return Modes(self, at, frequency, squared, mode, ratio, eigenvalues, lasting)

    @overload
    def allocate(
        self,
        force: ArrayLike,
        min_tension: float = ...,
        max_tension: float = ...,
        *,
        method: str = ...,
        q: ArrayLike | None = ...,
        throw: Literal[True] = ...,
    ) -> FloatArray: ...
    @overload
    def allocate(
        self,
        force: ArrayLike,
        min_tension: float = ...,
        max_tension: float = ...,
        *,
        method: str = ...,
        q: ArrayLike | None = ...,
        throw: Literal[False],
    ) -> _core.Allocation: ...
    def allocate(
        self,
        force: ArrayLike,
        min_tension: float = 0.0,
        max_tension: float = math.inf,
        *,
        method: str = "automatic",
        q: ArrayLike | None = None,
        throw: bool = True,
    ) -> FloatArray | _core.Allocation:
        """Least-norm cable tensions within limits that give a generalised force.

        cpp/README.md eq. (20), cpp/several-sections.md eq. (46).

        Parameters
        ----------
        force : (d,) array_like
            Generalised force [N m], [N] of stretch, as `inverse_dynamics` returns it.
        min_tension, max_tension : float, optional
            Limits of every tension [N], 0 <= min_tension <= max_tension.
        method : {"automatic", "sections", "search"}, optional
            The closed form, section by section, is for robots with three cables that end at every
            section; the search takes any cables. Both give the same; by default the first is taken
            where it applies.
        q : (d,) array_like, optional
            Where the robot is [rad, m]; to be given where the actuation matrix depends on it.
        throw : bool, optional
            False: return all that was found, the nearest tensions where none give that force. The
            old name of that is `find_tension`.

        Returns
        -------
        (num_cables,) array or Allocation
            Tensions [N]; with ``throw=False`` also their force, whether that is the one asked for,
            and the cables in the way.

        Raises
        ------
        InfeasibleError
            If no tensions within the limits give that force; it carries the nearest ones and names
            the cables that are in the way.
        """
        require_truth("throw", throw)
        found = self.find_tension(force, min_tension, max_tension, method, q)
        return checked_allocation(found, force, (min_tension, max_tension)) if throw else found

    def inverse_kinematics(
        self,
        p: ArrayLike,
        R: ArrayLike | None = None,
        q0: ArrayLike | None = None,
        *,
        max_theta: ArrayLike | None = None,
        orientation_weight: float | None = None,
        tolerance: float | None = None,
        seeds: int = 100,
        iterations: int = 100,
    ) -> InverseKinematics:
        """Coordinates that bring the tip to a point, and to an orientation if one is given.

        Damped least squares from several starts, until one leads there; otherwise the nearest that
        was found, with its distance and why. One section without an orientation has a closed form,
        which needs no start, unless a tool is away from the tip. cpp/README.md eq. (7),
        cpp/several-sections.md eqs. (47) to (49).

        Parameters
        ----------
        p : (3,) array_like
            Tip position, that of the robot's tool, in the base frame [m].
        R : (3, 3) array_like, optional
            Tip orientation in the base frame, a rotation matrix.
        q0 : (d,) array_like, optional
            Where to start first [rad, m].
        max_theta : float or (n,) array_like, optional
            Largest bending angle, of all or of each section [rad]; by default 2 pi.
        orientation_weight : float, optional
            What one radian beside R is worth [m]; by default the robot's length / pi.
        tolerance : float, optional
            Residual that counts as reached [m]; by default 1e-9 of the robot's length.
        seeds : int, optional
            Starts at most; the same ones in every call.
        iterations : int, optional
            Steps from each start at most.

        Returns
        -------
        InverseKinematics
        """
        found = self._inverse_kinematics(
            p, R, q0, max_theta=max_theta, orientation_weight=orientation_weight,
            tolerance=tolerance, seeds=seeds, iterations=iterations,
        )  # fmt: skip
        return InverseKinematics(*found)
