"""Between bending vectors, which the equations use, and angles, which people read."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import require_truth


def polar(
    q: ArrayLike, *, continuous: bool = False
) -> tuple[float, float] | tuple[FloatArray, FloatArray]:
    """Bending angle and orientation angle of bending vectors, cpp/README.md eq. (1).

    q = theta (cos phi, sin phi).

    Parameters
    ----------
    q : (2,) or (..., 2n) array_like
        Bending vectors, base to tip [rad].
    continuous : bool, optional
        Read the rows of q (N, 2n) as samples of a run and make phi continuous along it: full turns
        are undone, and where a section swings through straight, theta changes its sign.

    Returns
    -------
    theta, phi : float or (..., n) array
        In radians; two floats for a single (2,) vector. Without `continuous`, theta >= 0 and phi
        lies in (-pi, pi], 0 for a straight section.

    Raises
    ------
    ValueError
        If q has no even last dimension, or is not finite.
    TypeError
        For a `continuous` that is neither True nor False.

    Examples
    --------
    >>> import cdcr
    >>> theta, phi = cdcr.polar([0.3, 0.4])
    >>> print(f"{theta:.4f} rad, {phi:.4f} rad")
    0.5000 rad, 0.9273 rad
    """
    require_truth("continuous", continuous)
    vectors = finite(q, "q")
    if vectors.ndim == 0 or vectors.shape[-1] % 2 or vectors.shape[-1] == 0:
        raise ValueError(f"q must have shape (2,) or (..., 2n), got {vectors.shape}")
    if continuous:
        if vectors.ndim != 2:
            raise ValueError(f"q must have shape (N, 2n) to be continuous, got {vectors.shape}")
        return _core.polar_along(vectors)
    x, y = vectors[..., 0::2], vectors[..., 1::2]
    # + 0.0 turns a negative zero into zero, whose angle would otherwise be pi.
    theta, phi = np.hypot(x, y), np.arctan2(y + 0.0, x + 0.0)
    if vectors.shape == (2,):
        return float(theta[0]), float(phi[0])
    return theta, phi


def bending(theta: ArrayLike, phi: ArrayLike) -> FloatArray:
    """Bending vectors q = theta (cos phi, sin phi), cpp/README.md eq. (1).

    The inverse of `polar`.

    Parameters
    ----------
    theta, phi : float or (..., n) array_like
        Bending angles (a negative one bends the other way) and orientation angles [rad];
        the last axis counts sections.

    Returns
    -------
    (2,) or (..., 2n) array
        Bending vectors [rad].

    Raises
    ------
    ValueError
        If the shapes do not fit each other, or a value is not finite.

    Examples
    --------
    >>> import cdcr
    >>> cdcr.bending([0.5, 1.0], [0.0, 2.0]).round(3)
    array([ 0.5  ,  0.   , -0.416,  0.909])
    """
    angles, directions = finite(theta, "theta"), finite(phi, "phi")
    try:
        angles, directions = np.broadcast_arrays(angles, directions)
    except ValueError:
        raise ValueError(
            f"theta and phi must have fitting shapes, got {angles.shape} and {directions.shape}"
        ) from None
    q = np.stack([angles * np.cos(directions), angles * np.sin(directions)], axis=-1)
    return q if angles.ndim == 0 else q.reshape(*angles.shape[:-1], 2 * angles.shape[-1])
