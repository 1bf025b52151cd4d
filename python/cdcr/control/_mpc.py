"""Nonlinear model predictive control of the tip, one quadratic programme each period."""

from __future__ import annotations

import math
import time
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import Check, nearest, require_kind
from cdcr.base.keywords import by_keyword
from cdcr.control._programme import BoxProgramme, unit_near
from cdcr.model.memory import warn_of_memory
from cdcr.model.model import Model
from cdcr.model.stability import stable_step, warn_of_long_steps
from cdcr.model.steps import AnyDynamics, Steps

FIRST = 10  # quadratic programmes at most where there is no plan to go on from
PARTS = ("linearize", "condense", "solve")  # of an update
ATTRIBUTES = ("reference", "path", "plan", "diagnostics", "model", "horizon")
MOST_SUBSTEPS = 1000  # chosen by itself; more are asked for
SETTLED = 1e-3  # change of tensions that ends these, over their unit
USUAL = 8.0, 2e3  # largest tensions [N], and costs of a tip a robot's length away


class Plan(NamedTuple):
    """States at the ends of the steps ahead, the first of them now, and tensions held between."""

    x: FloatArray
    u: FloatArray


@by_keyword
class Mpc(_core.Controller):
    """Moves the tip along a reference, with tensions that are best over a horizon and in limits.

    Each period the steps ahead, Runge-Kutta 4 under held tensions, are made linear about the plan
    of the period before, and one quadratic programme mends the plan: the real-time iteration. What
    it makes least is the sum over the steps ahead of half

    - ``tip_weight`` times the tip's distance from the reference, squared,
    - ``rate_weight`` times the rates of the coordinates, squared,
    - ``tension_weight`` times tensions less ``min_tension``, squared,
    - ``change_weight`` times changes of tension from step to step, squared.

    It knows of no disturbance: where the robot differs from the model, an error stays. It warns
    where cables remember, and where its steps are too long to be stable. Needs PIQP, extra ``mpc``.

    Parameters
    ----------
    model : Model
        The robot that it reckons with; all cables driven by tension.
    max_tension : float
        Largest tension of every cable [N].
    min_tension : float, optional
        Least tension of every cable [N].
    period : float, optional
        Sampling period [s].
    step : float, optional
        Length of a step ahead [s], at least a period; a period unless given.
    horizon : int, optional
        How many steps it looks ahead.
    substeps : int, optional
        Steps of integration in a step ahead; by default as many as `stable_step` asks for at rest.
    tip_weight : float, optional
        [1/m^2], > 0.
    rate_weight : float, optional
        [s^2/rad^2], >= 0; [s^2/m^2] of stretch.
    tension_weight, change_weight : float, optional
        [1/N^2], > 0 and >= 0.

    Attributes
    ----------
    reference : (3,) array
        Position of the tip in the base frame [m]; that of the straight robot until set.
    path : ReferencePath or None
        Motion of the tip to follow, in place of a point.
    plan : Plan or None
        States and tensions ahead, as found last: ``plan.x`` (horizon + 1, 2d) and ``plan.u``
        (horizon, num_cables); None where no plan was found.
    diagnostics : dict
        Of the last update: "duration" [s] of processor time, that of its parts "linearize",
        "condense" and "solve", "iterations" of the solver, and "solved", 1 or 0.

    Raises
    ------
    ValueError
        For a number out of its range, cables driven by length, or a robot without inertia.
    ImportError
        Where PIQP is missing.

    Examples
    --------
    >>> import cdcr
    >>> import numpy as np
    >>> model = cdcr.Model(cdcr.robots.three_sections(gravity=(0, 0, -9.81)))
    >>> controller = cdcr.control.Mpc(model, max_tension=8.0, period=0.02, substeps=2)
    >>> controller.reference = [0.2, 0.1, 0.7]
    >>> run = cdcr.simulate(model, np.zeros(6), np.zeros(6), t=[0.0, 1.5], controller=controller)
    >>> print(f"{1e3 * np.linalg.norm(run.tip[-1] - controller.reference):.0f} mm off")
    1 mm off
    """

    def __init__(
        self,
        model: Model,
        *,
        max_tension: float,
        min_tension: float = 0.0,
        period: float = 0.02,
        step: float | None = None,
        horizon: int = 20,
        substeps: int | None = None,
        tip_weight: float = 1e4,
        rate_weight: float = 1e-2,
        tension_weight: float = 1e-3,
        change_weight: float = 1e-2,
    ) -> None:
        check = Check()
        step = period if step is None else step
        for name, value in (("period", period), ("step", step), ("tip_weight", tip_weight)):
            check.number(name, value, "a number > 0 and finite", above=0.0)
        check.number("tension_weight", tension_weight, "a number > 0 and finite", above=0.0)
        for name, value in (("rate_weight", rate_weight), ("change_weight", change_weight)):
            check.number(name, value, "a number >= 0 and finite", above=-math.ulp(0.0))
        self.horizon = check.whole("horizon", horizon, "a whole number >= 1", low=1)
        low = check.number("min_tension", min_tension, "a number >= 0 N", above=-math.ulp(0.0))
        check.number("max_tension", max_tension, "a finite number > min_tension", above=low)
        check.done()
        if not step >= period * (1.0 - 1e-9):
            check.refuse("step", f"at least the period of {period:g} s", step)
        check.done()
        dynamics = AnyDynamics(model)
        driven = [j + 1 for j, cable in enumerate(model.robot.all_cables) if cable.length_driven]
        if driven or not model.num_cables:
            what = f"cable {driven[0]} is driven by length" if driven else "this robot has none"
            raise ValueError(f"Mpc needs cables driven by tension, and {what}")
        super().__init__(period)
        self.model = self._made_for = model
        warn_of_memory(model, "Mpc", stacklevel=3)
        self._unit = unit_near((max_tension - min_tension) / USUAL[0])
        cost = unit_near(tip_weight * model.robot.length**2 / USUAL[1])
        self._programme = BoxProgramme(self._unit, cost)
        if substeps is None:
            wanted = math.ceil(step / stable_step(model, model.rest_shape))
            substeps = min(max(wanted, 1), MOST_SUBSTEPS)
        self._steps = Steps(dynamics, step, substeps)
        warn_of_long_steps(model, step / substeps, "Mpc", stacklevel=3)
        self._limits = min_tension, max_tension
        self._root_tip, self._root_rate = math.sqrt(tip_weight), math.sqrt(rate_weight)
        self._effort = _effort_matrix(self.horizon, model.num_cables, tension_weight, change_weight)
        self._change_weight, self._tension_weight = change_weight, tension_weight
        d, columns = model.num_coordinates, self.horizon * model.num_cables + 1
        # Memory for what is large: given back to the system each period, it would cost a quarter.
        self._moves = np.zeros((self.horizon, 2 * d, columns))
        self._rows = np.zeros((self.horizon, 3 + d, columns))
        self._squares = np.zeros((columns, columns))
        self._P = np.zeros((columns - 1, columns - 1))
        self._path: _core.ReferencePath | None = None
        self._point = model.tip(np.zeros(d))[1]
        self.reset()

    def __setattr__(self, name: str, value: object) -> None:
        """Refuse a misspelt attribute; a class of a user's own may have more."""
        if type(self) is Mpc and not name.startswith("_") and name not in ATTRIBUTES:
            raise AttributeError(
                f"Mpc has no attribute {name!r} that can be set.{nearest(name, ATTRIBUTES)}"
            )
        super().__setattr__(name, value)

    def __repr__(self) -> str:
        """Say how far it plans."""
        return f"<Mpc: horizon {self.horizon}, period {self.period:g} s>"

    @property
    def reference(self) -> FloatArray:
        """Position of the tip to go to, (3,) [m]."""
        return self._point

    @reference.setter
    def reference(self, value: ArrayLike) -> None:
        point = finite(value, "reference")
        if point.shape != (3,):
            raise ValueError(f"reference must have shape (3,), got {point.shape}")
        self._point, self._path = point, None

    @property
    def path(self) -> _core.ReferencePath | None:
        """Motion of the tip to follow, or None."""
        return self._path

    @path.setter
    def path(self, value: _core.ReferencePath | None) -> None:
        if value is not None:
            require_kind("path", value, _core.ReferencePath)
            if value.size != 3:
                raise ValueError(f"path must be of the tip, 3 numbers, got {value.size}")
        self._path = value

    def reset(self) -> None:
        """Forget the plan; called before each run.

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.three_sections())
        >>> controller = cdcr.control.Mpc(model, max_tension=8.0, substeps=2)
        >>> controller.reset()
        >>> controller.plan is None
        True
        """
        self.plan: Plan | None = None
        self._last: FloatArray | None = None
        self.diagnostics: dict[str, float] = {}

    def update(self, t: float, q: ArrayLike, qd: ArrayLike) -> FloatArray:
        """Return tensions for the next period.

        Parameters
        ----------
        t : float
            Now [s].
        q, qd : (d,) array_like
            Where the robot is [rad, m] and how fast it moves.

        Returns
        -------
        (num_cables,) array
            Tensions [N].

        Examples
        --------
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.three_sections())
        >>> controller = cdcr.control.Mpc(model, max_tension=8.0, substeps=2)
        >>> controller.update(0.0, [0.0] * 6, [0.0] * 6).shape  # straight, as it should be
        (9,)
        """
        begun = time.process_time()
        now = np.concatenate([finite(q, "q"), finite(qd, "qd")])
        self.diagnostics = dict.fromkeys((*PARTS, "iterations"), 0.0)
        rounds = 1
        if self.plan is None:
            rounds, self.plan = FIRST, self._first_plan(now)
        else:
            self.plan = _shifted(self.plan, self.period / self._steps.period)
        for _ in range(rounds):
            before = self.plan.u
            with np.errstate(over="ignore", invalid="ignore"):  # then there is no solution
                solved = self._mend(t, now)
            if np.abs(self.plan.u - before).max() < SETTLED * self._unit:
                break
        self._last = self.plan.u[0]
        if not solved:  # a plan that leads nowhere is not gone on from
            self.plan = None
        self.diagnostics["solved"] = float(solved)
        self.diagnostics["duration"] = time.process_time() - begun
        return self._last

    def _first_plan(self, now: FloatArray) -> Plan:
        """Return that of the least tensions, by which nothing but the start need be feasible."""
        u = np.full((self.horizon, self.model.num_cables), self._limits[0])
        return Plan(np.tile(now, (self.horizon + 1, 1)), u)

    def _wanted(self, t: float) -> FloatArray:
        ahead = t + self._steps.period * np.arange(1, self.horizon + 1)
        if self._path is None:
            return np.tile(self._point, (self.horizon, 1))
        return np.array([self._path.evaluate(at)[0] for at in ahead])

    def _mend(self, t: float, now: FloatArray) -> bool:
        """Take the plan to the solution of the quadratic programme about it, if there is one."""
        assert self.plan is not None
        N, d = self.horizon, self.model.num_coordinates
        x, u = self.plan.x.copy(), self.plan.u
        x[0] = now
        clock = [time.process_time()]
        ends, slopes = self._steps.derivatives(x[:N], u)
        tips, by_q = self.model.tips(x[1:, :d]), self.model.tip_jacobian(x[1:, :d])[:, :3]
        clock.append(time.process_time())
        self._condense(slopes, ends - x[1:])
        moves, rows = self._moves, self._rows
        np.matmul(self._root_tip * by_q, moves[:, :d], out=rows[:, :3])
        np.multiply(self._root_rate, moves[:, d:], out=rows[:, 3:])
        rows[:, :3, -1] += self._root_tip * (tips - self._wanted(t))
        rows[:, 3:, -1] += self._root_rate * x[1:, d:]
        flat = rows.reshape(-1, rows.shape[2])
        np.matmul(flat.T, flat, out=self._squares)
        np.add(self._squares[:-1, :-1], self._effort, out=self._P)
        c = self._squares[:-1, -1] + self._effort @ u.ravel() - self._held_before(u)
        clock.append(time.process_time())
        found = self._solution(c, u)
        clock.append(time.process_time())
        for part, took in zip(PARTS, np.diff(clock), strict=True):
            self.diagnostics[part] += float(took)
        if found is None:
            return False
        x[1:] += (moves.reshape(2 * N * d, -1) @ np.append(found, 1.0)).reshape(N, 2 * d)
        self.plan = Plan(x, np.clip(u + found.reshape(u.shape), *self._limits))
        return True

    def _held_before(self, u: FloatArray) -> FloatArray:
        """Return what the least tension, and the one before the first, take off the gradient."""
        pull = np.full_like(u, self._tension_weight * self._limits[0])
        pull[0] += self._change_weight * (u[0] if self._last is None else self._last)
        return pull.ravel()

    def _condense(self, slopes: FloatArray, defects: FloatArray) -> None:
        """Write how the states ahead move, by all tensions, and in the last column by defects.

        x_1 by the tensions of the first step, x_2 by those of two, and so on.
        """
        states, m = defects.shape[1], self.model.num_cables
        moves = self._moves
        for k, slope in enumerate(slopes):
            if k:
                np.matmul(slope[:, :states], moves[k - 1], out=moves[k])
            moves[k, :, k * m : (k + 1) * m] = slope[:, states:]
            moves[k, :, -1] = defects[k] + (slope[:, :states] @ moves[k - 1, :, -1] if k else 0.0)

    def _solution(self, c: FloatArray, u: FloatArray) -> FloatArray | None:
        """Return the change of tensions that is best within limits; None where it is not found."""
        if not (np.isfinite(self._P).all() and np.isfinite(c).all()):  # planned beyond all states
            return None
        low, high = (limit - u.ravel() for limit in self._limits)
        found = self._programme.solve(self._P, c, low, high)
        self.diagnostics["iterations"] += self._programme.iterations
        return found


def _effort_matrix(N: int, m: int, tension_weight: float, change_weight: float) -> FloatArray:
    """Return what tensions and their changes cost, u^T E u / 2, the one before the first apart."""
    along = np.diag(np.full(N, 2.0 * change_weight + tension_weight))
    along[-1, -1] -= change_weight
    along -= change_weight * (np.eye(N, k=1) + np.eye(N, k=-1))
    return np.asarray(np.kron(along, np.eye(m)), dtype=np.float64)


def _shifted(plan: Plan, part: float) -> Plan:
    """Return the plan as seen a part of a step later; its last step goes on as it is."""

    def ahead(rows: FloatArray) -> FloatArray:
        later: FloatArray = np.concatenate([rows[1:], rows[-1:]]) - rows
        return rows + part * later

    return Plan(ahead(plan.x), ahead(plan.u))
