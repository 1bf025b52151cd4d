"""The gradient of one number that a motion costs: by the adjoint of its steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from cdcr.base.arrays import FloatArray, ReadOnlyArrays, finite, read_only
from cdcr.base.check import Check, as_tuple, format_value, is_iterable, require_kind, short
from cdcr.model.memory import remembers
from cdcr.model.model import Model
from cdcr.model.steps import AnyDynamics, Steps
from cdcr.model.wrench import Wrench
from cdcr.runs.rollout import rollout

_CHUNK = 256  # steps that are held at once, with all their derivatives
_SLOPES = ("q", "qd", "tip")


class Motion(NamedTuple):
    """What a cost is asked of: the rows of a motion, each `record_every` steps from the start.

    Attributes
    ----------
    t : (R,) array
        Times [s].
    q, qd : (R, d) array
        Coordinates and their rates.
    """

    t: FloatArray
    q: FloatArray
    qd: FloatArray


Cost = Callable[[Motion], "tuple[float, Mapping[str, ArrayLike]]"]


@dataclass(frozen=True, eq=False)
class Gradient(ReadOnlyArrays):
    """A cost, and its derivatives by all that the motion depends on. Arrays are read-only.

    Attributes
    ----------
    value : float
        The cost.
    q0, qd0 : (d,) array
        By the coordinates [1/rad] and rates [s/rad] at the start.
    tension : (steps, num_cables) or (num_cables,) array
        By the commands of each step, or by constant ones, as they were given [1/N], or [1/m].
    parameters : dict of str to float
        By numbers of the robot, in SI units.
    motion : Motion
        The rows that the cost was asked of.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> def bending(motion):  # at the end
    ...     slope = np.zeros_like(motion.q)
    ...     slope[-1, 0] = 1.0
    ...     return motion.q[-1, 0], {"q": slope}
    >>> found = cdcr.gradient(model, [0, 0], [0, 0], np.zeros(3), bending, step=1e-3, steps=100)
    >>> found.value, found.tension.shape
    (0.0, (3,))
    """

    value: float
    q0: FloatArray
    qd0: FloatArray
    tension: FloatArray
    motion: Motion
    parameters: Mapping[str, float] = field(default_factory=dict)


def gradient(
    model: Model,
    q0: ArrayLike,
    qd0: ArrayLike,
    tension: ArrayLike,
    cost: Cost,
    *,
    step: float,
    steps: int,
    record_every: int = 1,
    parameters: str | Sequence[str] = (),
    wrenches: Wrench | Sequence[Wrench] = (),
) -> Gradient:
    """Differentiate one number that a motion costs, by its start, all commands and parameters.

    The motion is that of `cdcr.rollout` by rk4. Its steps are followed back from the end by the
    adjoint of the method, cpp/sensitivities.md eqs. (121), (122): the derivatives are those of
    the steps as they are computed, to rounding, and cost as much for a thousand commands as for
    one. Sensitivities of `cdcr.simulate` are better where numbers are few and answers many.
    Memory: some hundred steps at a time, whatever their number.

    Parameters
    ----------
    model : Model
        The robot.
    q0, qd0 : (d,) array_like
        Coordinates and their rates at the start.
    tension : (num_cables,) or (steps, num_cables) array_like
        Tensions [N], lengths [m] of cables driven by length: constant, or held over each step.
    cost : callable
        ``cost(motion)`` of a `Motion` returns the cost and a mapping with its derivatives by
        ``"q"`` or ``"qd"`` (R, d), or by the tip's positions ``"tip"`` (R, 3); what is left out
        does not matter to it.
    step : float
        Step of rk4 [s].
    steps : int
        How many.
    record_every : int, optional
        Steps from one row of the motion to the next, a divisor of `steps`.
    parameters : str or sequence of str, optional
        Numbers of the robot by path, as in `Model.parameter_derivatives`.
    wrenches : Wrench or sequence of Wrench, optional
        Forces and moments on the robot, which do not change in time.

    Returns
    -------
    Gradient

    Raises
    ------
    ValueError
        For an argument out of range, derivatives of another shape, and robots whose cables or
        drives remember.
    TypeError
        For what is no model and no function.
    RuntimeError
        Where the motion fails, as beyond the bending limit.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> target = np.array([0.05, 0.0, 0.29])
    >>> def miss(motion):  # of the tip at the end, squared
    ...     off = model.tip(motion.q[-1])[1] - target
    ...     slope = np.zeros((len(motion.t), 3))
    ...     slope[-1] = 2 * off
    ...     return off @ off, {"tip": slope}
    >>> found = cdcr.gradient(
    ...     model, [0, 0], [0, 0], np.full((500, 3), 1.0), miss, step=1e-3, steps=500
    ... )
    >>> found.tension.shape
    (500, 3)
    """
    require_kind("model", model, Model)
    if not callable(cost):
        raise TypeError(f"cost must be a function of a motion, got {type(cost).__name__}")
    if remembers(model):
        raise ValueError(
            "there is no gradient where cables or drives remember: presliding_stiffness and "
            "backlash must be 0"
        )
    pushing = tuple(wrenches) if is_iterable(wrenches) else (wrenches,)
    if any(getattr(wrench, "profile", None) is not None for wrench in pushing):
        raise ValueError("wrenches must not change in time for a gradient, got one with a profile")
    check = Check()
    check.number("step", step, "a number > 0 s and finite", above=0.0)
    check.whole("steps", steps, "a whole number >= 1", low=1)
    check.whole("record_every", record_every, "a divisor of steps", low=1)
    check.done()
    if steps % record_every:
        raise ValueError(f"record_every must be a divisor of steps = {steps}, got {record_every}")
    pulls = np.asarray(finite(tension, "tension"))
    if pulls.shape not in ((model.num_cables,), (steps, model.num_cables)):
        raise ValueError(
            f"tension must have shape ({model.num_cables},) or ({steps}, {model.num_cables}), got "
            f"{pulls.shape}"
        )
    wanted = "a path or a sequence of paths"
    names = (
        (parameters,) if isinstance(parameters, str) else as_tuple("parameters", parameters, wanted)
    )
    moves = Steps(AnyDynamics(model, pushing, names), step)
    walk = _Walk(moves, np.broadcast_to(pulls, (steps, model.num_cables)))
    start = np.concatenate([_row(model, "q0", q0), _row(model, "qd0", qd0)])
    states, checkpoints = walk.forwards(start, record_every)
    d = model.num_coordinates
    t = np.asarray(step * record_every * np.arange(len(states)), dtype=np.float64)
    motion = Motion(t, states[:, :d], states[:, d:])
    value, slopes = _told(cost(motion))
    by_start, by_tension, by_parameter = walk.backwards(
        checkpoints, _state_slopes(model, motion, slopes), record_every
    )
    if not all(np.isfinite(one).all() for one in (by_start, by_tension, by_parameter)):
        raise RuntimeError("the gradient became infinite or not a number: use a smaller step")
    return Gradient(
        value=value,
        q0=read_only(by_start[:d]),
        qd0=read_only(by_start[d:]),
        tension=read_only(by_tension if pulls.ndim == 2 else by_tension.sum(axis=0)),
        motion=motion,
        parameters=dict(zip(names, by_parameter.tolist(), strict=True)),
    )


def _row(model: Model, name: str, given: ArrayLike) -> FloatArray:
    """Return q0 or qd0 (d,)."""
    array = np.asarray(finite(given, name))
    if array.shape != (model.num_coordinates,):
        raise ValueError(f"{name} must have shape ({model.num_coordinates},), got {array.shape}")
    return array


def _told(answer: object) -> tuple[float, Mapping[str, ArrayLike]]:
    """Return what a cost told: its value and a mapping of slopes, or refuse anything else."""
    if isinstance(answer, (tuple, list)) and len(answer) == 2 and isinstance(answer[1], Mapping):
        value = finite(answer[0], "cost")
        if value.size == 1:
            return float(value.item()), answer[1]
    raise TypeError(
        "cost must return a number and a mapping of its derivatives, such as {'q': ...}, got "
        f"{format_value(answer)}"
    )


def _state_slopes(model: Model, motion: Motion, slopes: Mapping[str, ArrayLike]) -> FloatArray:
    """Return the derivatives of a cost by the states (R, 2d)."""
    rows, d = motion.q.shape
    found = np.zeros((rows, 2 * d))
    for name, given in slopes.items():
        if name not in _SLOPES:
            known = ", ".join(map(repr, _SLOPES))
            raise ValueError(f"a cost has derivatives by {known}, got {short(name)}")
        shape = (rows, 3 if name == "tip" else d)
        values = finite(given, f"derivatives of the cost by {name}")
        if values.shape != shape:
            raise ValueError(
                f"derivatives of the cost by {name} must have shape {shape}, got {values.shape}"
            )
        if name == "tip":
            J = model.tip_jacobian(motion.q)[:, :3]
            found[:, :d] += (values[:, None] @ J)[:, 0]
        else:
            found[:, :d] += values if name == "q" else 0.0
            found[:, d:] += values if name == "qd" else 0.0
    return found


@dataclass(frozen=True)
class _Walk:
    """The steps of one motion, forwards and back, a chunk of them at a time."""

    steps: Steps
    commands: FloatArray  # (steps, num_cables)

    def forwards(self, start: FloatArray, every: int) -> tuple[FloatArray, list[FloatArray]]:
        """Return the states of all rows, and those that the chunks begin with."""
        rows, checkpoints = [start[None]], []
        for first in range(0, len(self.commands), _CHUNK):
            checkpoints.append(start)
            states = self._states(start, first)
            rows.append(states[1:][(first + np.arange(1, len(states))) % every == 0])
            start = states[-1]
        return np.concatenate(rows), checkpoints

    def _states(self, start: FloatArray, first: int) -> FloatArray:
        """Return the states (K + 1, 2d) of a chunk of steps."""
        commands = self.commands[first : first + _CHUNK]
        q0, qd0 = np.split(start, 2)
        robot = self.steps.dynamics
        run = rollout(
            robot.model, q0, qd0, commands[None], step=self.steps.period, steps=len(commands),
            wrenches=robot.wrenches, threads=1,
        )  # fmt: skip
        if run.failures:
            raise RuntimeError(run.failures[0].message)
        return np.concatenate([run.q[0], run.qd[0]], axis=1)

    def backwards(
        self, checkpoints: list[FloatArray], slopes: FloatArray, every: int
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the derivatives by the start, commands and parameters, eqs. (121), (122)."""
        states, cables = slopes.shape[1], self.commands.shape[1]
        by_inputs = np.empty((len(self.commands), self.steps.dynamics.num_inputs))
        here = slopes[-1]  # by the state reached, with all that follows from it
        for number in reversed(range(len(checkpoints))):
            first = number * _CHUNK
            before = self._states(checkpoints[number], first)[:-1]
            _, by = self.steps.derivatives(before, self.commands[first : first + _CHUNK])
            after = np.empty_like(before)
            for k in reversed(range(len(after))):
                after[k] = here
                here = here @ by[k, :, :states]
                if (first + k) % every == 0:
                    here = here + slopes[(first + k) // every]
            by_inputs[first : first + len(after)] = (after[:, None] @ by[:, :, states:])[:, 0]
        return here, by_inputs[:, :cables], by_inputs[:, cables:].sum(axis=0)
