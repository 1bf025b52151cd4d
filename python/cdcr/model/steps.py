"""What optimisers ask of a model: dynamics under any tension, and steps, with exact derivatives.

They try states that are none and cables that push. Here the first give NaN, from which they step
back, and the second the straight line on: accelerations are affine in every tension, friction
included, so those of u = u+ - u- with u+, u- >= 0 are f(u+) - f(u-) + f(0).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, require_kind
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench


class AnyDynamics:
    """Accelerations and their derivatives, of rows of states and of commands of any sign.

    Parameters
    ----------
    model : Model
        The robot.
    wrenches : Wrench or sequence of Wrench, optional
        Constant forces and moments on the backbone.
    parameters : sequence of str, optional
        Numbers of the robot, by path, by which derivatives are wanted beside the commands.

    Raises
    ------
    ValueError
        For a robot without inertia, and wrenches that are none of this robot.
    """

    def __init__(
        self,
        model: Model,
        wrenches: Wrench | Sequence[Wrench] = (),
        parameters: Sequence[str] = (),
    ) -> None:
        require_kind("model", model, Model)
        self.model = model
        self.wrenches = wrenches
        self.parameters = tuple(parameters)
        self.num_inputs = model.num_cables + len(self.parameters)
        self._by_tension = np.array([not c.length_driven for c in model.robot.all_cables], bool)
        rest = np.zeros(model.num_coordinates)
        model.derivatives(rest, rest, model.rest_command(), wrenches)  # refuses what it cannot take

    def accelerations(self, q: FloatArray, qd: FloatArray, u: FloatArray) -> FloatArray:
        """Return qdd, (k, d), of states (k, d) and commands (k, num_cables)."""

        def of(q: FloatArray, qd: FloatArray, u: FloatArray) -> tuple[FloatArray, ...]:
            return (self.model.forward_dynamics(q, qd, u, self.wrenches),)

        return self._sum(of, q, qd, u)[0]

    def derivatives(self, q: FloatArray, qd: FloatArray, u: FloatArray) -> tuple[FloatArray, ...]:
        """Return those of qdd by q, qd (k, d, d), and by u and parameters (k, d, num_inputs)."""

        def of(q: FloatArray, qd: FloatArray, u: FloatArray) -> tuple[FloatArray, ...]:
            by_q, by_qd, by_u = self.model.derivatives(q, qd, u, self.wrenches)[:3]
            if not self.parameters:
                return by_q, by_qd, by_u
            by_numbers = self.model.parameter_derivatives(q, qd, u, self.parameters, self.wrenches)
            return by_q, by_qd, np.concatenate([by_u, by_numbers], axis=-1)

        return self._sum(of, q, qd, u)

    def _sum(
        self,
        function: Callable[..., tuple[FloatArray, ...]],
        q: FloatArray,
        qd: FloatArray,
        u: FloatArray,
    ) -> tuple[FloatArray, ...]:
        parts = [or_nan(function, q, qd, pull) for pull in self._pulls(u)]
        if len(parts) == 1:
            return parts[0]
        return tuple(pulled - pushed + none for pulled, pushed, none in zip(*parts, strict=True))

    def _pulls(self, u: FloatArray) -> Iterator[FloatArray]:
        push = np.where(self._by_tension, np.minimum(u, 0.0), 0.0)
        yield u - push
        if push.any():
            none = np.where(self._by_tension, 0.0, u)
            yield none - push
            yield none


class Steps:
    """Steps of Runge-Kutta 4 under held commands, of rows of states, as `Simulator` takes them.

    Parameters
    ----------
    dynamics : AnyDynamics
        What moves.
    period : float
        Time for which commands are held [s].
    substeps : int, optional
        Steps of integration in it.
    """

    def __init__(self, dynamics: AnyDynamics, period: float, substeps: int = 1) -> None:
        check = Check()
        self.period = check.number("period", period, "a number > 0 s and finite", above=0.0)
        self.substeps = check.whole("substeps", substeps, "a whole number >= 1", low=1)
        check.done()
        self.dynamics = dynamics
        self._h = self.period / self.substeps

    def end(self, x: FloatArray, u: FloatArray) -> FloatArray:
        """Return the states after a period, (k, 2d), of (k, 2d) and commands (k, num_cables)."""
        h, d = self._h, x.shape[1] // 2

        def rate(x: FloatArray) -> FloatArray:
            return np.hstack([x[:, d:], self.dynamics.accelerations(x[:, :d], x[:, d:], u)])

        for _ in range(self.substeps):
            k1 = rate(x)
            k2 = rate(x + h / 2 * k1)
            k3 = rate(x + h / 2 * k2)
            k4 = rate(x + h * k3)
            x = x + h / 6 * (k1 + 2 * (k2 + k3) + k4)
        return x

    def derivatives(self, x: FloatArray, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (states after a period, [A | B]), the latter (k, 2d, 2d + num_inputs).

        A and B are derivatives by the states and by the commands (and parameters), of the very
        steps taken: each stage carries its own along.
        """
        h, d = self._h, x.shape[1] // 2
        S = np.zeros((len(x), 2 * d, 2 * d + self.dynamics.num_inputs))
        S[:, range(2 * d), range(2 * d)] = 1.0

        def rate(x: FloatArray, S: FloatArray) -> tuple[FloatArray, FloatArray]:
            q, qd = x[:, :d], x[:, d:]
            by_q, by_qd, by_u = self.dynamics.derivatives(q, qd, u)
            slope = np.concatenate([S[:, d:], np.concatenate([by_q, by_qd], axis=2) @ S], axis=1)
            slope[:, d:, 2 * d :] += by_u
            return np.hstack([qd, self.dynamics.accelerations(q, qd, u)]), slope

        for _ in range(self.substeps):
            k1, S1 = rate(x, S)
            k2, S2 = rate(x + h / 2 * k1, S + h / 2 * S1)
            k3, S3 = rate(x + h / 2 * k2, S + h / 2 * S2)
            k4, S4 = rate(x + h * k3, S + h * S3)
            x = x + h / 6 * (k1 + 2 * (k2 + k3) + k4)
            S = S + h / 6 * (S1 + 2 * (S2 + S3) + S4)
        return x, S


def or_nan(
    function: Callable[..., tuple[FloatArray, ...]], *rows: FloatArray
) -> tuple[FloatArray, ...]:
    """Return what a function of a state, or of rows, gives; NaN for each that it refuses."""
    try:
        return function(*rows)
    except ValueError:
        if rows[0].ndim == 1 or len(rows[0]) == 1:
            rest = function(*(np.zeros_like(row) for row in rows))
            return tuple(np.full_like(one, np.nan) for one in rest)
        each = [or_nan(function, *(row[i : i + 1] for row in rows)) for i in range(len(rows[0]))]
        return tuple(np.concatenate(some) for some in zip(*each, strict=True))
