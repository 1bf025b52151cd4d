"""Dynamics, steps and kinematics of a model as functions of JAX."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from cdcr.jax._callback import function_of
from cdcr.model import maps
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench


def dynamics(model: Model, wrenches: Wrench | Sequence[Wrench] = ()) -> Callable[..., Any]:
    """Accelerations, `Model.forward_dynamics`, as a function of JAX with exact derivatives.

    A batch, by leading dimensions or under `vmap`, is one call into the core. A state that is none
    (bent too far, not finite) gives NaN; a tension below 0 N goes on in a straight line.

    Parameters
    ----------
    model : Model
        The robot.
    wrenches : Wrench or sequence of Wrench, optional
        Constant forces and moments on the backbone.

    Returns
    -------
    callable
        Of (q, qd, tension), arrays (..., d), (..., d), (..., num_cables), whose leading
        dimensions broadcast, to qdd (..., d) [rad/s^2, m/s^2].

    Raises
    ------
    ValueError
        For a robot without inertia, wrenches that are none of it, and, when called, wrong shapes
        or JAX in single precision.
    ImportError
        Where JAX is missing.

    Examples
    --------
    >>> import cdcr.jax
    >>> import jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> qdd = cdcr.jax.dynamics(model)
    >>> slope = jax.jit(jax.jacobian(qdd))([0.0, 0.0], [0.0, 0.0], [0.0, 0.0, 0.0])
    >>> [[round(float(one), 1) + 0.0 for one in row] for row in slope]
    [[-82.7, 0.0], [0.0, -82.7]]
    """
    return function_of(maps.dynamics(model, wrenches))


def step(
    model: Model,
    period: float,
    *,
    substeps: int = 1,
    wrenches: Wrench | Sequence[Wrench] = (),
) -> Callable[..., Any]:
    """One period of Runge-Kutta 4 under held commands, with its exact derivatives.

    The step that `Simulator` takes; its derivatives are those of the very step, not of the
    continuous motion. `jax.lax.scan` makes a motion of it.

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
    callable
        Of (x, tension), arrays (..., 2d) and (..., num_cables), to x_next (..., 2d), where x is
        (q, qd) [rad, m, rad/s, m/s].

    Raises
    ------
    ValueError
        As `dynamics`, and for a period or substeps that are not positive.

    Examples
    --------
    >>> import cdcr.jax
    >>> import jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> step = cdcr.jax.step(model, 0.01)
    >>> [round(float(one), 4) + 0.0 for one in step([0.0] * 4, [5.0, 0.0, 0.0])]
    [0.0011, 0.0, 0.216, 0.0]
    """
    return function_of(maps.step(model, period, substeps, wrenches))


def tip(model: Model) -> Callable[..., Any]:
    """Where the tip, or the robot's tool, is and how it is turned, with exact derivatives.

    Parameters
    ----------
    model : Model
        The robot.

    Returns
    -------
    callable
        Of q (..., d), to the rotation matrix R (..., 3, 3) and the position p (..., 3) in the
        base frame [m], as `Model.tip` gives them.

    Raises
    ------
    ValueError
        When called, for wrong shapes or JAX in single precision.

    Examples
    --------
    >>> import cdcr.jax
    >>> import jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> R, p = cdcr.jax.tip(model)([0.4, 0.0])
    >>> p.round(4).tolist()
    [0.1583, 0.0, 0.7808]
    """
    return function_of(maps.tip(model))


def cable_lengths(model: Model) -> Callable[..., Any]:
    """Lengths of all cables, `Model.cable_lengths`, with their exact derivatives.

    Parameters
    ----------
    model : Model
        The robot.

    Returns
    -------
    callable
        Of q (..., d), to lengths (..., num_cables) [m].

    Raises
    ------
    ValueError
        When called, for wrong shapes or JAX in single precision.

    Examples
    --------
    >>> import cdcr.jax
    >>> import jax
    >>> jax.config.update("jax_enable_x64", True)
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> cdcr.jax.cable_lengths(model)([0.4, 0.0]).round(3).tolist()
    [0.794, 0.806, 0.806]
    """
    return function_of(maps.cable_lengths(model))
