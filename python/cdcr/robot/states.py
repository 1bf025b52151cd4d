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
        Of every part its share: exactly the shape of the whole robot, as parts keep the orders.

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
                found.append(share.reshape(*state.shape[:-1], block.shape[-2] * block.shape[-1]))
    return np.concatenate(found, axis=-1)


def merge_state(robot: Robot, parts: Parts, q: ArrayLike) -> FloatArray:
    """Return the state of the whole robot whose sections bend as much as their parts together.

    Exact where the parts of a section are bent alike, and the inverse of ``subdivide_state`` then.
    Of sections that bend evenly, without twist and stretch: parts that do otherwise have no shape
    in common with one that is whole.

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
        For a wrong shape, values that are not finite, wrong `parts`, or a section that does more
        than bend evenly.

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.amouri2020()
    >>> print(cdcr.merge_state(robot, 2, [0.25, 0.0, 0.25, 0.0]))
    [0.5 0. ]
    """
    counts = _counts(robot, parts)
    for i, section in enumerate(robot.sections):
        if _strains(section) != [(1, 2)]:
            raise ValueError(
                "states can be merged of sections that bend evenly, without twist and stretch, "
                f"and section {i + 1} has orders {_orders(section)}"
            )
    state = _checked(q, 2 * int(counts.sum()))
    vectors = state.reshape(*state.shape[:-1], int(counts.sum()), 2)
    firsts = np.cumsum(counts) - counts
    sums = np.add.reduceat(vectors, firsts, axis=-2)
    return sums.reshape(*sums.shape[:-2], 2 * len(counts))


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


def _orders(section: Section) -> str:
    names = ("bending", "twist", "stretch")
    orders = (section.bending_order, section.twist_order, section.stretch_order)
    told = zip(names, orders, strict=True)
    return ", ".join(f"{name} {'locked' if order is None else order}" for name, order in told)


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
