"""States of a robot as those of its subdivided one, and back."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr.base.arrays import FloatArray, finite
from cdcr.robot.parts import Parts, part_counts
from cdcr.robot.robot import Robot
from cdcr.robot.section import Section


def subdivide_state(robot: Robot, parts: Parts, q: ArrayLike) -> FloatArray:
    """Return the state of a subdivided robot that has the shape of the whole one.

    Parameters
    ----------
    robot : Robot
        The robot of n sections, not yet subdivided.
    parts : int or sequence of int
        As in ``robot.subdivide``, m parts together.
    q : (..., d) array_like
        Coordinates; or their rates.

    Returns
    -------
    (..., D) array
        Coordinates, of every part its share: exactly the shape of the whole robot, as parts keep
        the orders.

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
    strains = [_strains(section) for section in robot.sections]
    state = _checked(q, sum(size * width for one in strains for size, width in one))
    found: list[FloatArray] = []
    first = 0
    for count, one in zip(counts, strains, strict=True):
        blocks = []
        for size, width in one:
            end = first + size * width
            blocks.append(state[..., first:end].reshape(*state.shape[:-1], size, width))
            first = end
        for part in range(count):
            for block in blocks:
                share = _restriction(block.shape[-2], part, count) @ block / count
                found.append(share.reshape(*state.shape[:-1], share.shape[-2] * share.shape[-1]))
    return np.concatenate(found, axis=-1)


def merge_state(robot: Robot, parts: Parts, q: ArrayLike) -> FloatArray:
    """Return the state of the whole robot that is nearest to that of its parts.

    Each section bends, twists and stretches as much as its parts together, and its strains, of the
    orders that it has, come nearest to theirs in the mean square along it. Exact where a whole
    section can have the shape of its parts, and the inverse of ``subdivide_state`` then.

    Parameters
    ----------
    robot : Robot
        The robot of n sections, not yet subdivided.
    parts : int or sequence of int
        As in ``robot.subdivide``, m parts together.
    q : (..., D) array_like
        Coordinates of the subdivided robot [rad], stretch [m]; or their rates.

    Returns
    -------
    (..., d) array
        Coordinates of the sections, in the units of `q`.

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
    strains = [_strains(section) for section in robot.sections]
    widths = [sum(size * width for size, width in one) for one in strains]
    state = _checked(q, int(np.dot(counts, widths)))
    found: list[FloatArray] = []
    first = 0
    for count, one, whole in zip(counts, strains, widths, strict=True):
        end = first + count * whole
        of_parts = state[..., first:end].reshape(*state.shape[:-1], count, whole)
        first, begin = end, 0
        for size, width in one:
            block = of_parts[..., begin : begin + size * width]
            block = block.reshape(*block.shape[:-1], size, width)
            begin += size * width
            share = np.zeros((*state.shape[:-1], size, width))
            for part in range(count):
                share += _extension(size, part, count) @ block[..., part, :, :]
            found.append(share.reshape(*state.shape[:-1], size * width))
    return np.concatenate(found, axis=-1)


def _counts(robot: Robot, parts: Parts) -> NDArray[np.int_]:
    """Return the number of parts of each section, or refuse them."""
    if not isinstance(robot, Robot):
        raise TypeError(f"robot must be a cdcr.Robot, got {type(robot).__name__}")
    return np.array(part_counts(len(robot.sections), parts))


def _checked(q: ArrayLike, size: int) -> FloatArray:
    """Return q (..., size), or refuse it."""
    array = finite(q, "q")
    if array.ndim == 0 or array.shape[-1] != size:
        raise ValueError(f"q must have shape (..., {size}), got {array.shape}")
    return array


def _strains(section: Section) -> list[tuple[int, int]]:
    """Return the number of coefficients of each strain that is not locked, and their width."""
    orders = (section.bending_order, section.twist_order, section.stretch_order)
    return [
        (order + 1, width)
        for order, width in zip(orders, (2, 1, 1), strict=True)
        if order is not None
    ]


def _restriction(size: int, part: int, count: int) -> FloatArray:
    """Return the Legendre coefficients on a part from those on the whole (size, size)."""
    from numpy.polynomial.legendre import leggauss, legvander

    points, weights = leggauss(size)
    on_whole = (2.0 * part + points + 1.0) / count - 1.0
    norms = np.arange(size) + 0.5
    projection = (norms[:, None] * legvander(points, size - 1).T) * weights
    return np.asarray(projection @ legvander(on_whole, size - 1))


def _extension(size: int, part: int, count: int) -> FloatArray:
    """Return what the Legendre coefficients on a part add to those on the whole (size, size)."""
    norms = 2.0 * np.arange(size) + 1.0
    return np.asarray(_restriction(size, part, count).T * norms[:, None] / norms[None, :])
