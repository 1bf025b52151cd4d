"""Parameters of a robot from measurements of it: least squares from one start or several."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, count, is_iterable, one_of, require_kind, short
from cdcr.base.extras import require
from cdcr.identification.channels import whole
from cdcr.identification.data import Data, UnsolvedError, require_data
from cdcr.identification.parameter import unknowns_of
from cdcr.identification.problem import Problem
from cdcr.identification.result import Identified
from cdcr.identification.search import search
from cdcr.identification.setup import Place, plain_setup
from cdcr.robot.robot import Robot

LOSSES = ("linear", "soft_l1", "huber", "cauchy")
ROUNDS = 3  # in which the noise of channels is found
SETTLED = 0.02  # relative change of a noise that needs no further round
LARGEST_SEED = 2**64
SPREAD = 3.0  # sizes of an unknown within which other starts are drawn, where there are no bounds


def identify(
    data: Data | Sequence[Data],
    robot: Robot,
    parameters: Mapping[str, Any],
    *,
    loss: str = "linear",
    starts: int = 1,
    seed: int = 0,
    max_evaluations: int = 200,
) -> Identified:
    """Find parameters of a robot, and how it is mounted, from measurements of it. Needs SciPy.

    Parameters
    ----------
    data : Poses, Motion, Frequencies, or a sequence of these
        What was measured.
    robot : Robot
        As it is known; where the search begins.
    parameters : mapping of str to anything
        What is sought, by path: ``sections[*].youngs_modulus`` (one number for all sections),
        ``sections[:].damping`` (one each), ``sections[0].cable_angles[2]``,
        ``cables[0].angle[0][1]`` (of (base, tip) pairs, which of them and which end),
        ``scale sections[*].disk_masses[*]`` (a common factor), ``cables.friction`` (of all
        cables), ``payload``; ``base tilt`` (about its X and Y), ``base yaw``, ``base position``,
        ``tip offset``, ``marker offset``, ``time shift``; and what no robot has a field for:
        ``sections[*].cable_rotation``, and ``command_offset`` and ``command_gain`` of
        ``sections[..]`` or ``[..]`` of cables. Beside it stand None, a start, or a `Parameter`
        (or a mapping with its fields) with start, bounds and prior.
    loss : {"linear", "soft_l1", "huber", "cauchy"}, optional
        How residuals count; all but the first count outliers, from two standard deviations on,
        less.
    starts : int, default 1
        Searches, from that many starts; the others are drawn within the bounds, or some sizes
        around the first.
    seed : int, default 0
        Of the starts drawn.
    max_evaluations : int, default 200
        Of the model, for each start, at most.

    Returns
    -------
    Identified
        Estimates with standard errors, the robot with them, what is left over.

    Raises
    ------
    ValueError
        For data that do not fit the robot, paths of no number, fewer measurements than parameters,
        and a start at which the model has no answer.
    ImportError
        Without SciPy, which comes with the extra ``identify``.

    Examples
    --------
    >>> import cdcr
    >>> softer = cdcr.Model(cdcr.robots.amouri2020(payload=0.05))  # what is measured
    >>> pulls = [[force, 0.0, 0.0] for force in (1.0, 2.0, 4.0, 6.0)]
    >>> tip = [softer.tip(softer.equilibrium(pull))[1] for pull in pulls]
    >>> poses = cdcr.identification.Poses(pulls, tip=tip, noise=1e-3)
    >>> robot = cdcr.robots.amouri2020(gravity=(0.0, 0.0, -9.81))  # what is known
    >>> found = cdcr.identify(poses, robot, {"sections[*].youngs_modulus": None})
    >>> found.robot.sections[0].youngs_modulus == found["sections[*].youngs_modulus"]
    True
    """
    return fit(
        data,
        robot,
        parameters,
        loss=loss,
        starts=starts,
        seed=seed,
        max_evaluations=max_evaluations,
    )


def fit(
    data: Data | Sequence[Data],
    robot: Robot,
    parameters: Mapping[str, Any],
    *,
    loss: str = "linear",
    starts: int = 1,
    seed: int = 0,
    max_evaluations: int = 200,
    first: int = 0,
    near: FloatArray | None = None,
) -> Identified:
    """Do what `identify` does, where sections and cables count from `first` in paths.

    The first search begins at `near`, values of the unknowns, where they are given.
    """
    require_kind("robot", robot, Robot)
    if not one_of(loss, LOSSES):
        raise ValueError(f"loss must be one of {', '.join(LOSSES)}, got {short(loss)}")
    starts, most = whole("starts", starts, 1), whole("max_evaluations", max_evaluations, 1)
    check = Check()
    seed = check.whole("seed", seed, "a whole number >= 0", 0, LARGEST_SEED)
    check.done()
    problem = prepared(data, robot, parameters, first=first)
    optimise = require("scipy.optimize", "identify").least_squares
    options = {"loss": loss, "max_nfev": most}
    best: Any = None
    costs = []
    begin = np.zeros(len(problem.unknowns)) if near is None else problem.counted(near)
    for start in [begin, *_drawn(problem, starts - 1, seed)]:
        solution = search(problem, start, options, optimise)
        if solution is None:
            continue
        costs.append(float(solution.cost))
        if best is None or solution.cost < best.cost:
            best = solution
    if best is None:
        raise ValueError(_no_start(problem))
    best = _with_noise(problem, best, options, optimise, loss)
    refit = partial(
        fit,
        robot=robot,
        parameters=parameters,
        loss=loss,
        max_evaluations=most,
        first=first,
        near=problem.values(best.x),
    )
    return Identified._of(problem, best, loss=loss, costs=costs, refit=refit)


def prepared(
    data: Data | Sequence[Data],
    robot: Robot,
    parameters: Mapping[str, Any],
    *,
    enough: bool = True,
    first: int = 0,
) -> Problem:
    """Return the problem that data and parameters pose, or refuse them."""
    if not (isinstance(data, Data) or is_iterable(data)):
        require_data("data", data, ", or a sequence of these")
    every = [data] if isinstance(data, Data) else list(data)
    for i, one in enumerate(every):
        require_data(f"data[{i}]", one)
        one._check(robot)
    if not every:
        raise ValueError("data must hold at least one measurement, got none")
    plain = plain_setup(robot, places_of(every))
    unknowns = unknowns_of(parameters, robot, plain, first)
    problem = Problem(every, plain, unknowns)
    if enough and problem.num_residuals < len(unknowns):
        raise ValueError(
            f"{count(problem.num_measurements, 'number')} measured cannot tell "
            f"{count(len(unknowns), 'parameter')}; measure more than in "
            f"{', '.join(one.name for one in every)}, or seek fewer"
        )
    return problem


def places_of(data: Sequence[Data]) -> tuple[Place, ...]:
    """Return the places of all markers, each once."""
    return tuple(dict.fromkeys(place for one in data for place in one.places))


def _drawn(problem: Problem, number: int, seed: int) -> list[FloatArray]:
    """Return places drawn, where more searches begin."""
    drawn = np.random.default_rng(seed)
    size = len(problem.unknowns)
    low = np.maximum(problem.low, -SPREAD)
    high = np.minimum(problem.high, SPREAD)
    # Of what is positive and begins at its own size, as many are halved as doubled.
    factors = np.array([unknown.low == 0.0 and unknown.start > 0.0 for unknown in problem.unknowns])
    found = []
    for _ in range(number):
        share = drawn.uniform(size=size)
        flat = low + share * (high - low)
        scaled = (SPREAD ** (2.0 * share - 1.0) - 1.0) * problem.origin / problem.size
        found.append(np.clip(np.where(factors, scaled, flat), problem.low, problem.high))
    return found


def _with_noise(
    problem: Problem, solution: Any, options: dict[str, Any], optimise: Any, loss: str
) -> Any:
    """Return the solution with the noise of channels that was not given, found from what is left.

    One channel alone, counted linearly, has the same estimates whatever its noise is.
    """
    unknown = [
        (i, k)
        for i, one in enumerate(problem.data)
        for k, channel in enumerate(one.channels)
        if channel.noise is None
    ]
    if not unknown:
        return solution
    alone = problem.num_measurements == problem.num_residuals and loss == "linear"
    alone = alone and sum(len(one.channels) for one in problem.data) == 1
    for _ in range(ROUNDS):
        change = _find_noise(problem, solution.x, unknown, loss)
        if change < SETTLED:
            break
        if alone:
            solution = _rescaled(solution, problem.noise[0][0])
            break
        found = search(problem, solution.x, options, optimise)
        solution = solution if found is None else found
    return solution


def _find_noise(
    problem: Problem, x: FloatArray, unknown: list[tuple[int, int]], loss: str
) -> float:
    """Set the noise of channels to what is left over; return the largest relative change."""
    _, _, answers = problem.answers(x)
    share = len(problem.unknowns) / problem.num_measurements  # degrees of freedom that the fit took
    largest = 0.0
    for i, k in unknown:
        measured = problem.data[i].channels[k].values
        left = (answers[i][k] - measured)[np.isfinite(measured)]
        if loss == "linear":
            level = float(np.sqrt(np.mean(left**2) / max(1.0 - share, 1.0 / left.size)))
        else:
            level = 1.4826 * float(np.median(np.abs(left)))
        level = max(level, 1e-12 * float(np.max(np.abs(measured[np.isfinite(measured)]))), 1e-300)
        largest = max(largest, abs(level / problem.noise[i][k] - 1.0))
        problem.noise[i][k] = level
    return largest


def _rescaled(solution: Any, level: float) -> Any:
    """Return a solution found with a noise of one, counted in the noise of its only channel."""
    solution.fun, solution.jac = solution.fun / level, solution.jac / level
    solution.cost /= level**2
    return solution


def _no_start(problem: Problem) -> str:
    try:
        problem.forget()
        start = np.zeros(len(problem.unknowns))
        problem.answers(start)
        problem.jacobian(start)
    except (UnsolvedError, ValueError) as error:
        return f"the model has no answer at the start: {error}"
    return "the model has no answer at any start"
