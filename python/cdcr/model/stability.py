"""The largest step with which a fixed-step method keeps small motions small."""

from __future__ import annotations

import math
import warnings
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.check import one_of, require_kind, short
from cdcr.model.model import Model
from cdcr.model.statics import checked_equilibrium

# Amplification of one step, 1 + z + z^2/2 + z^3/6 + z^4/24 with z = h lambda, by power of z.
_RK4 = 1.0 / np.array([1.0, 1.0, 2.0, 6.0, 24.0])
_IMAGINARY = 2.0 * math.sqrt(2.0)  # where it leaves the unit circle along the imaginary axis
_ROUNDING = 1e-9  # share of an eigenvalue's magnitude that is rounding in its real part


def stable_step(
    model: Model,
    q: ArrayLike | None = None,
    tension: ArrayLike | None = None,
    method: Literal["rk4"] = "rk4",
) -> float:
    """Largest step with which a fixed-step method keeps small motions about a shape small.

    From the eigenvalues of `Model.linearize` at rest. Motions that grow by themselves, as those of
    a robot held where it is about to buckle, set no limit; large motions may need a smaller step.

    Parameters
    ----------
    model : Model
        The robot.
    q : (d,) array_like, optional
        The shape [rad]; by default the equilibrium under `tension`.
    tension : (num_cables,) array_like, optional
        Tensions [N], lengths [m] of cables driven by length; by default none, and the lengths of
        the straight robot.
    method : {"rk4"}, optional
        The other methods choose their steps.

    Returns
    -------
    float
        In seconds; infinite where nothing sets a limit.

    Raises
    ------
    ValueError
        For a robot without inertia, or another method.

    Examples
    --------
    >>> import cdcr
    >>> print(f"{cdcr.stable_step(cdcr.Model(cdcr.robots.amouri2020())):.4f} s")
    0.3109 s
    """
    require_kind("model", model, Model)
    if not one_of(method, ("rk4",)):
        raise ValueError(
            f"method must be 'rk4', the others choose their steps; got {short(method)}"
        )
    command = model.rest_command() if tension is None else tension
    shape = checked_equilibrium(model._rest(command)) if q is None else q
    A, _ = model.linearize(shape, np.zeros(model.num_coordinates), command)
    return min(map(_largest_step, np.linalg.eigvals(A)), default=math.inf)


def _largest_step(eigenvalue: complex) -> float:
    """Return the largest step [s] that keeps a motion with this eigenvalue [1/s] from growing."""
    size = abs(eigenvalue)
    if size == 0.0:
        return math.inf
    direction = eigenvalue / size
    if abs(direction.real) <= _ROUNDING:
        return _IMAGINARY / size
    if direction.real > 0.0:
        return math.inf
    # |amplification|^2 - 1 over the distance from zero is a polynomial in that distance, real as
    # the terms of a power and their conjugates come together.
    terms = _RK4 * direction ** np.arange(5)
    squared = np.convolve(terms, terms.conj()).real
    roots = np.roots(squared[:0:-1])
    real = roots.real[np.abs(roots.imag) <= _ROUNDING * np.abs(roots)]
    return float(np.min(real[real > 1.0])) / size


def warn_of_long_steps(model: Model, step: float, who: str, *, stacklevel: int) -> None:
    """Warn those whose steps of rk4 [s] make small motions about the robot at rest grow."""
    limit = stable_step(model, model.rest_shape)
    if step > limit:
        warnings.warn(
            f"{who} goes on by steps of {step:.3g} s, beyond the {limit:.3g} s up to which they "
            "are stable here: give more substeps",
            UserWarning,
            stacklevel=stacklevel + 1,
        )
