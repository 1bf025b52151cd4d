"""Which pulls would tell parameters best, by the Fisher information of their poses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, require_kind, require_truth
from cdcr.identification.channels import measured, row_of, whole
from cdcr.identification.data import UnsolvedError
from cdcr.identification.fit import prepared
from cdcr.identification.poses import Poses
from cdcr.robot.robot import Robot

_FAINT = 1e-6  # information that every direction has, so that the first choices are defined


@dataclass(frozen=True, eq=False)
class Design:
    """Commands in the order in which they tell most.

    Attributes
    ----------
    order : (k,) array of int
        Indices of the commands chosen, the most telling first; one may be chosen again.
    command : (k, num_cables) array
        These commands.
    names : tuple of str
        The parameters.
    standard_error : (k, n) array
        Of each parameter after that many poses, in its unit; infinite where not told yet.
    """

    order: FloatArray
    command: FloatArray
    names: tuple[str, ...]
    standard_error: FloatArray


def informative_commands(
    robot: Robot,
    parameters: Mapping[str, Any],
    candidates: ArrayLike | Poses,
    *,
    noise: float,
    number: int | None = None,
    repeat: bool = False,
) -> Design:
    """Choose the commands whose poses tell parameters best, before anything is measured.

    One after another, each such that the determinant of the information is largest (D-optimal):
    the volume of what remains possible then is smallest. For one parameter, that is its error.

    Parameters
    ----------
    robot : Robot
        As it is known.
    parameters : mapping
        What is sought, as in `identify`, priors too.
    candidates : (N, num_cables) array_like or Poses
        Commands that could be given; the tip is then measured. Poses say what else is measured,
        whatever their numbers are.
    noise : float
        Standard deviation of one measured number [m].
    number : int, optional
        How many to choose; by default all candidates, or as many with `repeat`.
    repeat : bool, default False
        Whether one may be chosen more than once.

    Returns
    -------
    Design

    Raises
    ------
    ValueError
        For arguments out of range, and where the model has no answer.

    Examples
    --------
    >>> import cdcr
    >>> robot = cdcr.robots.amouri2020()
    >>> pulls = [[1.0, 0.0, 0.0], [8.0, 0.0, 0.0], [4.0, 0.0, 0.0]]
    >>> best = cdcr.identification.informative_commands(
    ...     robot, {"sections[*].youngs_modulus": None}, pulls, noise=1e-3)
    >>> best.order
    array([1, 2, 0])
    """
    require_kind("robot", robot, Robot)
    check = Check()
    level = check.number("noise", noise, "a number > 0 and finite", above=0.0)
    check.done()
    if isinstance(candidates, Poses):
        poses = replace(candidates, noise=level)
    else:
        commands = measured("candidates", candidates, (None, None), row_of("candidates"))
        poses = Poses(commands, tip=np.zeros((len(commands), 3)), noise=level, name="candidates")
    require_truth("repeat", repeat)
    if not len(poses):
        raise ValueError("candidates must have at least one command, got none")
    problem = prepared(poses, robot, parameters, enough=False)
    most = len(poses)
    wanted = most if number is None else whole("number", number, 1, None if repeat else most)
    start = np.zeros(len(problem.unknowns))
    try:
        jacobian = problem.jacobian(start)
    except UnsolvedError as error:
        raise ValueError(f"the model has no answer there: {error}") from None
    told = problem.num_measurements
    rows = _by_pose(poses, jacobian[:told])
    information = jacobian[told:].T @ jacobian[told:]
    information = information + _FAINT * np.eye(start.size)
    order, errors = _choose(rows, information, wanted, repeat=repeat)
    commands = np.asarray(poses.command)
    names = tuple(one.quantity.name for one in problem.unknowns)
    return Design(order, commands[order], names, errors * problem.size)


def _by_pose(poses: Poses, jacobian: FloatArray) -> list[FloatArray]:
    """Return the rows of each pose, which stand by channels."""
    owner = np.concatenate([
        np.nonzero(np.isfinite(channel.values))[0] for channel in poses.channels
    ])  # fmt: skip
    return [jacobian[owner == i] for i in range(len(poses))]


def _choose(
    rows: list[FloatArray], information: FloatArray, wanted: int, *, repeat: bool
) -> tuple[FloatArray, FloatArray]:
    left, order, errors = list(range(len(rows))), [], []
    for _ in range(wanted):
        inverse = np.linalg.inv(information)
        # det(I + J inv J') is by how much a pose multiplies the determinant.
        gains = [
            np.linalg.slogdet(np.eye(len(rows[i])) + rows[i] @ inverse @ rows[i].T)[1] for i in left
        ]
        best = left[int(np.argmax(gains))]
        if not repeat:
            left.remove(best)
        order.append(best)
        information = information + rows[best].T @ rows[best]
        spread = np.sqrt(np.diag(np.linalg.inv(information)))
        errors.append(np.where(spread > 0.1 / np.sqrt(_FAINT), np.inf, spread))
    return np.array(order), np.array(errors)
