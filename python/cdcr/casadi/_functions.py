"""Dynamics, steps and kinematics of a model as functions of CasADi."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cdcr.casadi._callback import Callback
from cdcr.model import maps
from cdcr.model.model import Model
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
    return Callback.of(maps.dynamics(model, wrenches))


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
    return Callback.of(maps.step(model, period, substeps, wrenches))


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
    return Callback.of(maps.tip(model))


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
    return Callback.of(maps.cable_lengths(model))
