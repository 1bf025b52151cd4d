"""Rotations as vectors and as quaternions."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray, finite

_ORTHONORMAL = 1e-5  # float32 and six digits are taken, as elsewhere, and made right
_EXACT = 1e-12  # what is nearer stays as it is


def quaternions(R: FloatArray) -> FloatArray:
    """Return the unit quaternions (..., 4) of rotation matrices (..., 3, 3), w first."""
    xx, yy, zz = (R[..., i, i] for i in range(3))
    x, y, z = (R[..., j, i] - R[..., i, j] for i, j in ((1, 2), (2, 0), (0, 1)))
    xy, xz, yz = (R[..., i, j] + R[..., j, i] for i, j in ((0, 1), (0, 2), (1, 2)))
    # Four times the products of its components; the row of the largest has no cancellation.
    rows = [
        [1 + xx + yy + zz, x, y, z],
        [x, 1 + xx - yy - zz, xy, xz],
        [y, xy, 1 - xx + yy - zz, yz],
        [z, xz, yz, 1 - xx - yy + zz],
    ]
    products = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    largest = np.argmax(np.diagonal(products, axis1=-2, axis2=-1), axis=-1)
    row = np.take_along_axis(products, largest[..., None, None], axis=-2)[..., 0, :]
    return np.asarray(row / np.linalg.norm(row, axis=-1, keepdims=True))


def rotation_vector(R: ArrayLike) -> FloatArray:
    """Axis times angle of rotation matrices, as references of a tip's pose have them.

    Parameters
    ----------
    R : (..., 3, 3) array_like
        Rotation matrices, such as `Model.tip` tells.

    Returns
    -------
    (..., 3) array
        At most pi long [rad].

    Raises
    ------
    ValueError
        For another shape, or what is no rotation.

    Examples
    --------
    >>> import cdcr
    >>> cdcr.rotation_vector([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).round(6) + 0.0
    array([0.      , 0.      , 1.570796])
    """
    matrices = finite(R, "R")
    if matrices.shape[-2:] != (3, 3):
        raise ValueError(f"R must have shape (..., 3, 3), got {matrices.shape}")
    missed = np.abs(np.swapaxes(matrices, -1, -2) @ matrices - np.eye(3)).max(initial=0.0)
    if missed > _ORTHONORMAL or np.any(np.linalg.det(matrices) < 0.0):
        raise ValueError("R must be a rotation matrix, R^T R = 1 and det R = 1")
    if missed > _EXACT:
        left, _, right = np.linalg.svd(matrices)
        matrices = left @ right
    found = quaternions(matrices)
    found = np.where(found[..., :1] < 0.0, -found, found)
    sine = np.linalg.norm(found[..., 1:], axis=-1, keepdims=True)
    angle = 2.0 * np.arctan2(sine, found[..., :1])
    scale = np.divide(angle, sine, out=np.full_like(sine, 2.0), where=sine > 0.0)
    return np.asarray(scale * found[..., 1:])


def rotation_of(vector: FloatArray) -> FloatArray:
    """Return the rotation matrix (3, 3) of a rotation vector (3,)."""
    x, y, z = vector
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    angle = float(np.linalg.norm(vector))
    half = np.sinc(angle / (2.0 * np.pi))
    return np.asarray(np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * half**2 * cross @ cross)
