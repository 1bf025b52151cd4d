"""States of a robot as those of its subdivided one, and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr.base.arrays import FloatArray, finite
from cdcr.robot.parts import Parts, part_counts
from cdcr.robot.robot import Robot


def subdivide_state(robot: Robot, parts: Parts, q: ArrayLike) -> FloatArray:
    """Return the state of a subdivided robot that has the shape of the whole one.

    Parameters
    ----------
    robot : Robot
        The robot of n sections, not yet subdivided.
    parts : int or sequence of int
        As in ``robot.subdivide``, m parts together.
    q : (..., 2n) array_like
        Bending vectors [rad]; or their rates.

    Returns
    -------
    (..., 2m) array
        Every part bent by its share of its section, in the unit of `q`.

    Raises
    ------
    ValueError
        For a wrong shape, values that are not finite, or wrong `parts`.

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.amouri2020()
    >>> print(cdcr.subdivide_state(robot, 2, [0.6, 0.2]))
    [0.3 0.1 0.3 0.1]
    """
    counts = _counts(robot, parts)
    vectors = _bending_vectors(q, len(counts))
    shares = np.repeat(vectors / counts[:, None], counts, axis=-2)
    return shares.reshape(*shares.shape[:-2], 2 * int(counts.sum()))


def merge_state(robot: Robot, parts: Parts, q: ArrayLike) -> FloatArray:
    """Return the state of the whole robot whose sections bend as much as their parts together.

    Exact where the parts of a section are bent alike, and the inverse of ``subdivide_state`` then.

    Parameters
    ----------
    robot : Robot
        The robot of n sections, not yet subdivided.
    parts : int or sequence of int
        As in ``robot.subdivide``, m parts together.
    q : (..., 2m) array_like
        Bending vectors of the subdivided robot [rad]; or their rates.

    Returns
    -------
    (..., 2n) array
        Bending vectors of the sections, in the unit of `q`.

    Raises
    ------
    ValueError
        For a wrong shape, values that are not finite, or wrong `parts`.

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.amouri2020()
    >>> print(cdcr.merge_state(robot, 2, [0.25, 0.0, 0.25, 0.0]))
    [0.5 0. ]
    """
    counts = _counts(robot, parts)
    vectors = _bending_vectors(q, int(counts.sum()))
    firsts = np.cumsum(counts) - counts
    sums = np.add.reduceat(vectors, firsts, axis=-2)
    return sums.reshape(*sums.shape[:-2], 2 * len(counts))


def _counts(robot: Robot, parts: Parts) -> NDArray[np.int_]:
    """Return the number of parts of each section, or refuse them."""
    if not isinstance(robot, Robot):
        raise TypeError(f"robot must be a cdcr.Robot, got {type(robot).__name__}")
    return np.array(part_counts(len(robot.sections), parts))


def _bending_vectors(q: ArrayLike, count: int) -> FloatArray:
    """Return q (..., 2 count) as (..., count, 2), or refuse it."""
    array = finite(q, "q")
    if array.ndim == 0 or array.shape[-1] != 2 * count:
        raise ValueError(f"q must have shape (..., {2 * count}), got {array.shape}")
    return array.reshape(*array.shape[:-1], count, 2)
