"""Dynamics, steps and kinematics of a model as functions of CasADi."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import require_kind
from cdcr.casadi._maps import Map
from cdcr.model.model import Model
from cdcr.model.steps import AnyDynamics, Steps, or_nan
from cdcr.model.wrench import Wrench


def dynamics(model: Model, wrenches: Wrench | Sequence[Wrench] = ()) -> Any:
    """Accelerations, `Model.forward_dynamics`, as a function of CasADi with an exact Jacobian.

    A state that is none (bent too far, not finite) gives NaN, from which IPOPT steps back. A
    tension below 0 N, which solvers try, goes on in a straight line.

    Parameters
    ----------
    model : Model
        The robot.
    wrenches : Wrench or sequence of Wrench, optional
        Constant forces and moments on the backbone.

    Returns
    -------
    casadi.Function
        Of (q, qd, tension), columns of (d,), (d,), (num_cables,), to qdd (d,)
        [rad/s^2, m/s^2]; of matrices of k columns to one of k. It has no second derivatives, does
        not pickle, and lives as long as the process: make it once.

    Raises
    ------
    ValueError
        For a robot without inertia, wrenches that are none of it, and, when called, wrong shapes.
    ImportError
        Where CasADi is missing.

    Examples
    --------
    >>> import casadi
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> qdd = cdcr.casadi.dynamics(model)
    >>> print(qdd)
    dynamics:(q[2],qd[2],tension[3])->(qdd[2]) CallbackInternal
    >>> q = casadi.MX.sym("q", 2)
    >>> slope = casadi.Function("slope", [q], [casadi.jacobian(qdd(q, [0, 0], [0, 0, 0]), q)])
    >>> slope([0.0, 0.0]).full().round(1) + 0.0
    array([[-82.7,   0. ],
           [  0. , -82.7]])
    """
    motion = AnyDynamics(model, wrenches)
    d = model.num_coordinates

    def evaluate(*state: FloatArray) -> tuple[FloatArray, ...]:
        return (motion.accelerations(*_rows(*state)),)

    def slopes(*state: FloatArray) -> tuple[FloatArray, ...]:
        return tuple(slope[0] for slope in motion.derivatives(*_rows(*state)))

    takes = {"q": (d, 1), "qd": (d, 1), "tension": (model.num_cables, 1)}
    return Map("dynamics", takes, {"qdd": (d, 1)}, evaluate, slopes)


def step(
    model: Model,
    period: float,
    *,
    substeps: int = 1,
    wrenches: Wrench | Sequence[Wrench] = (),
) -> Any:
    """One period of Runge-Kutta 4 under held commands, with its exact Jacobian.

    The step that `Simulator` takes, for multiple shooting. Its Jacobian is that of the very step,
    not of the continuous motion.

    Parameters
    ----------
    model : Model
        The robot.
    period : float
        Time for which commands are held [s].
    substeps : int, optional
        Steps of integration in it; none should be longer than `stable_step`.
    wrenches : Wrench or sequence of Wrench, optional
        Constant forces and moments on the backbone.

    Returns
    -------
    casadi.Function
        Of (x, tension), columns of (2d,) and (num_cables,), to x_next (2d,), where x is (q, qd)
        [rad, m, rad/s, m/s]; otherwise as `dynamics`.

    Raises
    ------
    ValueError
        As `dynamics`, and for a period or substeps that are not positive.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> step = cdcr.casadi.step(model, 0.01)
    >>> step([0.0, 0.0, 0.0, 0.0], [5.0, 0.0, 0.0]).full().ravel().round(4) + 0.0
    array([0.0011, 0.    , 0.216 , 0.    ])
    """
    steps = Steps(AnyDynamics(model, wrenches), period, substeps)
    states, commands = 2 * model.num_coordinates, model.num_cables

    def evaluate(*given: FloatArray) -> tuple[FloatArray, ...]:
        return (steps.end(*_rows(*given)),)

    def slopes(*given: FloatArray) -> tuple[FloatArray, ...]:
        both = steps.derivatives(*_rows(*given))[1][0]
        return both[:, :states], both[:, states:]

    takes = {"x": (states, 1), "tension": (commands, 1)}
    return Map("step", takes, {"x_next": (states, 1)}, evaluate, slopes)


def tip(model: Model) -> Any:
    """Where the tip, or the robot's tool, is and how it is turned, with exact Jacobians.

    Parameters
    ----------
    model : Model
        The robot.

    Returns
    -------
    casadi.Function
        Of q, a column of (d,), to the rotation matrix R (3, 3) and the position p (3,) in the
        base frame [m], as `Model.tip` gives them; otherwise as `dynamics`.

    Raises
    ------
    ValueError
        When called, for wrong shapes.

    Examples
    --------
    >>> import casadi
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> R, p = cdcr.casadi.tip(model)([0.4, 0.0])
    >>> p.full().ravel().round(4)
    array([0.1583, 0.    , 0.7808])
    """
    require_kind("model", model, Model)

    def evaluate(q: FloatArray) -> tuple[FloatArray, ...]:
        return or_nan(model.tip, q)

    def slopes(q: FloatArray) -> tuple[FloatArray, ...]:
        J, R = or_nan(lambda q: (model.tip_jacobian(q), model.tip(q)[0]), q)
        turned = np.cross(J[3:].T[:, None, :], R.T[None, :, :])  # (d, column of R, its entries)
        return turned.reshape(len(q), 9).T, J[:3]

    gives = {"R": (3, 3), "p": (3, 1)}
    return Map("tip", {"q": (model.num_coordinates, 1)}, gives, evaluate, slopes)


def cable_lengths(model: Model) -> Any:
    """Lengths of all cables, `Model.cable_lengths`, with their exact Jacobian.

    Parameters
    ----------
    model : Model
        The robot.

    Returns
    -------
    casadi.Function
        Of q, a column of (d,), to lengths (num_cables,) [m]; otherwise as `dynamics`.

    Raises
    ------
    ValueError
        When called, for wrong shapes.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> cdcr.casadi.cable_lengths(model)([0.4, 0.0]).full().ravel().round(3)
    array([0.794, 0.806, 0.806])
    """
    require_kind("model", model, Model)

    def evaluate(q: FloatArray) -> tuple[FloatArray, ...]:
        return or_nan(lambda q: (model.cable_lengths(q),), q)

    def slopes(q: FloatArray) -> tuple[FloatArray, ...]:
        return or_nan(lambda q: (-model.actuation_matrix(q).T,), q)

    takes = {"q": (model.num_coordinates, 1)}
    return Map("cable_lengths", takes, {"lengths": (model.num_cables, 1)}, evaluate, slopes)


def _rows(*columns: FloatArray) -> tuple[FloatArray, ...]:
    """Return the same numbers as arrays of one state each."""
    return tuple(column[None] for column in columns)
