"""Linear systems about a state, whose signals have names, as python-control takes them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray, finite
from cdcr.base.extras import require
from cdcr.model.derivatives import Derivatives
from cdcr.model.parameters import ParameterSets
from cdcr.model.shape import ShapeModel

if TYPE_CHECKING:
    from cdcr.model.model import Model
    from cdcr.model.wrench import Wrench


class StateSpaceModel(ShapeModel):
    """A model, its derivatives and linear systems."""

    @cached_property
    def _parameter_sets(self) -> ParameterSets:
        """What parameter derivatives are made of, for the parameters asked for before."""
        return ParameterSets(cast("Model", self).robot)

    def derivatives(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        tension: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> Derivatives:
        """Differentiate `forward_dynamics` by all that it takes, cpp/derivatives.md eq. (71).

        Exact to rounding, at rest or moving, through cables and wrenches too. At the kinks of a
        cable (just slack; friction at a straight section) one side is taken.

        Parameters
        ----------
        q, qd : (..., d) array_like
            Coordinates [rad, m] and their rates; or arrays of states.
        tension : (..., num_cables) array_like, optional
            Cable tensions [N]; lengths [m] for cables driven by length; by default
            `rest_command`.
        wrenches : Wrench or sequence of Wrench, optional
            Forces and moments on the backbone; of no size where only their slopes are asked for.

        Returns
        -------
        Derivatives
            Its arrays have the leading dimensions of `q`, `qd` and `tension`, broadcast.

        Raises
        ------
        ValueError
            For arguments that are no states or commands, and for a robot without inertia there.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> model.derivatives([0.0, 0.0], [0.0, 0.0], [0.0, 0.0, 0.0]).dqdd_dq.round(1) + 0.0
        array([[-82.7,   0. ],
               [  0. , -82.7]])
        """
        return Derivatives(*self._derivatives(q, qd, tension, wrenches))

    def parameter_derivatives(
        self,
        q: ArrayLike,
        qd: ArrayLike,
        tension: ArrayLike,
        parameters: str | Sequence[str],
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> FloatArray:
        """Differentiate `forward_dynamics` by numbers of the robot, cpp/sensitivities.md eq. (116).

        Exact to rounding by masses, stiffnesses, damping, gravity and the like; by all else, such
        as lengths and diameters, to about 1e-12, of rods to about 1e-9.

        Parameters
        ----------
        q, qd : (..., d) array_like
            Coordinates [rad, m] and their rates; or arrays of states.
        tension : (..., num_cables) array_like
            Cable tensions [N]; lengths [m] for cables driven by length.
        parameters : str or sequence of str
            Which, by path as in `cdcr.rollout`: ``sections.1.youngs_modulus``, ``payload``,
            ``gravity.z``. Sections and cables count from 1; ``*`` is all of them, as they grow by
            the same amount.
        wrenches : Wrench or sequence of Wrench, optional
            Forces and moments on the backbone.

        Returns
        -------
        (..., d, k) array
            Of the accelerations [rad/s^2], in rows, by the parameters, in SI units. Of the force
            that keeps given accelerations [N m] it is ``-mass_matrix(q)`` times that.

        Raises
        ------
        ValueError
            For arguments that are no states or commands, a robot without inertia there, and a path
            that leads to no number, or to a whole one.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> still = [0.0, 0.0]
        >>> by_modulus = model.parameter_derivatives(
        ...     [0.5, 0.0], still, [0.0, 0.0, 0.0], "sections.1.youngs_modulus"
        ... )
        >>> modulus = model.robot.sections[0].youngs_modulus
        >>> acceleration = model.forward_dynamics([0.5, 0.0], still, [0.0, 0.0, 0.0])
        >>> bool(abs(by_modulus[0, 0] * modulus - acceleration[0]) < 1e-11 * abs(acceleration[0]))
        True
        """
        found = self._parameter_sets.find(self, parameters)
        return self._parameter_derivatives(q, qd, tension, wrenches, found)

    def equilibrium_derivatives(
        self,
        q: ArrayLike,
        tension: ArrayLike,
        parameters: str | Sequence[str],
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> FloatArray:
        """Differentiate `equilibrium` by numbers of the robot, cpp/sensitivities.md eq. (119).

        As accurate as `parameter_derivatives`. Where the robot buckles the stiffness is singular,
        and the answer infinite or NaN.

        Parameters
        ----------
        q : (..., d) array_like
            Equilibrium shapes [rad, m].
        tension : (..., num_cables) array_like
            The tensions [N] that hold them; lengths [m] for cables driven by length.
        parameters : str or sequence of str
            As in `parameter_derivatives`.
        wrenches : Wrench or sequence of Wrench, optional
            Forces and moments on the backbone.

        Returns
        -------
        (..., d, k) array
            Of the coordinates [rad], in rows, by the parameters, in SI units.

        Raises
        ------
        ValueError
            As from `parameter_derivatives`.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> pull = [5.0, 0.0, 0.0]
        >>> q = model.equilibrium(pull)
        >>> by_radius = model.equilibrium_derivatives(q, pull, "sections.1.cable_radius")
        >>> print(f"{by_radius[0, 0] * 1e-3:.4f} rad for each mm")
        0.0138 rad for each mm
        """
        found = self._parameter_sets.find(self, parameters)
        return self._equilibrium_derivatives(q, tension, wrenches, found)

    def to_statespace(
        self,
        q: ArrayLike | None = None,
        tension: ArrayLike | None = None,
        outputs: str | Sequence[str] = ("q", "qd"),
        *,
        qd: ArrayLike | None = None,
        wrenches: Wrench | Sequence[Wrench] = (),
    ) -> Any:
        """Linear system about a state, for python-control. Needs the extra ``control``.

        xd = A x + B u, y = C x from `linearize`, cpp/README.md eq. (19): x, u and y are differences
        from the state, the tensions and the outputs here. About an equilibrium that is the motion
        beside it. Where the robot does not rest or stay under these tensions, the system tells how
        two motions that begin near this state part at first; it leaves out the acceleration that
        both have there, ``forward_dynamics(q, qd, tension)``, and holds only as long as they are
        near it: linearise anew on the way.

        Parameters
        ----------
        q : (d,) array_like, optional
            The shape [rad]; by default the equilibrium under these tensions and wrenches.
        tension : (num_cables,) array_like, optional
            Cable tensions [N]; lengths [m] for cables driven by length. None: no tension, the
            lengths of the straight robot.
        outputs : str or sequence of str, optional
            Any of "q" [rad], "qd" [rad/s], "tip", the position in the base frame [m], and
            "lengths" of the cables [m]; the whole state by default.
        qd : (d,) array_like, optional
            Rates [rad/s]; zero by default.
        wrenches : Wrench or sequence of Wrench, optional
            Constant forces and moments on the backbone.

        Returns
        -------
        control.StateSpace
            States with the names of the coordinates, ``q1_x``, ``q1_y``, ..., then ``qd1_x``, ...;
            of twist and stretch ``t1``, ``e1``, ``td1``, ...; inputs ``tension1``, ..., or
            ``command1`` of a cable driven by length; outputs ``tip_x``, ``length1``, ...

        Raises
        ------
        ValueError
            For unknown outputs, arguments that are no states or commands, and a robot without
            inertia there.
        ImportError
            Where python-control is missing.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
        >>> system = model.to_statespace(tension=[5.0, 0.0, 0.0], outputs=["tip"])
        >>> system.output_labels
        ['tip_x', 'tip_y', 'tip_z']
        >>> print(f"{abs(system['tip_x', 'tension1'].dcgain()):.4f} m/N")
        0.0206 m/N
        """
        from cdcr.model.signals import find_outputs, input_names, state_names
        from cdcr.model.statics import checked_equilibrium

        chosen = find_outputs(outputs)
        control: Any = require("control", "control")
        model = cast("Model", self)
        command = model.rest_command() if tension is None else tension
        if q is None:
            shape = checked_equilibrium(model._rest(command, wrenches=wrenches))
        else:
            shape = finite(q, "q")
        rates = np.zeros(model.num_coordinates) if qd is None else finite(qd, "qd")
        pulls = finite(command, "tension")
        d, cables = model.num_coordinates, model.num_cables
        for name, array, size in (("q", shape, d), ("qd", rates, d), ("tension", pulls, cables)):
            if array.shape != (size,):
                raise ValueError(f"{name} must have shape ({size},), got {array.shape}")
        A, B = model.linearize(shape, rates, pulls, wrenches)
        C = np.vstack([output.derivative(model, shape) for output in chosen])
        return control.StateSpace(
            *(A, B, C, np.zeros((len(C), model.num_cables))),
            states=state_names(model),
            inputs=input_names(model),
            outputs=[name for output in chosen for name in output.names(model)],
        )
