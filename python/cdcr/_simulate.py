"""Runs: the robot under its tensions through time."""

from __future__ import annotations

import inspect
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cdcr import _core
from cdcr._model import Model
from cdcr._trajectory import SlackEvent, Trajectory
from cdcr._wrench import Wrench, loads

FloatArray = NDArray[np.float64]
Interpolation = Literal["linear", "previous"]
MethodName = Literal["bdf", "adams", "dopri5", "rk4"]


@dataclass(frozen=True, eq=False)
class TensionTable:
    """Tensions at given times.

    Parameters
    ----------
    t : (N,) array_like
        Times, strictly increasing [s]. Integrators stop exactly at each.
    tension : (N, num_cables) array_like
        Tensions at those times [N]. Before the first and after the last time these rows hold.
    interpolation : {"linear", "previous"}, optional
        Connect the rows by lines, or hold each until the next time.
    """

    t: ArrayLike
    tension: ArrayLike
    interpolation: Interpolation = "linear"

    def __post_init__(self) -> None:
        if self.interpolation not in ("linear", "previous"):
            raise ValueError(
                f"interpolation must be 'linear' or 'previous', got {self.interpolation!r}"
            )

    def __repr__(self) -> str:
        rows = " x ".join(str(size) for size in np.shape(self.tension))
        return f"<TensionTable: {rows} tensions, {self.interpolation}>"


TensionFunction: TypeAlias = Callable[..., ArrayLike]
Tension: TypeAlias = (
    "ArrayLike | TensionTable | tuple[ArrayLike, ArrayLike] | TensionFunction | None"
)


def _takes_state(function: Callable[..., Any]) -> bool:
    """Whether a tension function wants (t, q, qd) rather than t alone."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return False
    if any(p.kind is p.VAR_POSITIONAL for p in parameters):
        return True
    kinds = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    accepted = sum(p.kind in kinds for p in parameters)
    required = sum(p.kind in kinds and p.default is p.empty for p in parameters)
    if required == 3:
        return True
    if required <= 1 <= accepted:
        return False
    raise ValueError(
        f"a tension function must take (t) or (t, q, qd), got one that needs {required} arguments"
    )


def tension_input(
    model: Model, tension: Tension, break_points: Sequence[float] = ()
) -> _core.TensionInput:
    """Turn what a user gives as tension into the core's input."""
    if tension is None:
        tension = model.rest_command()
    if callable(tension):
        function = tension
        if not _takes_state(function):
            time_only = function
            function = lambda t, q, qd: time_only(t)  # noqa: E731
        return _core.TensionInput.function(model, function, [float(b) for b in break_points])
    if len(break_points) > 0:
        raise ValueError("break_points go with a tension function; a table has its own")
    if isinstance(tension, TensionTable):
        linear = tension.interpolation == "linear"
        return _core.TensionInput.table(model, tension.t, tension.tension, linear)
    if isinstance(tension, tuple) and len(tension) == 2 and np.ndim(tension[1]) == 2:
        return tension_input(model, TensionTable(tension[0], tension[1]))
    return _core.TensionInput.constant(model, cast("ArrayLike", tension))


def warn_beyond_taylor_range(model: Model, q: FloatArray) -> None:
    """Warn once when a motion leaves the range that the paper gives its Taylor factors."""
    if not model.formulation.endswith("taylor") or q.size == 0:
        return
    largest = float(np.hypot(q[:, 0::2], q[:, 1::2]).max())
    if largest > _core.taylor_range * (1.0 + 1e-9):  # the range itself is inside it
        warnings.warn(
            f"formulation {model.formulation!r} holds for |theta| up to 3 pi/5 = "
            f"{_core.taylor_range:.4f} rad; this motion reaches {largest:.4f} rad",
            UserWarning,
            stacklevel=3,
        )


def _options(given: dict[str, Any]) -> _core.Options:
    return _core.Options(**{name: value for name, value in given.items() if value is not None})


def simulate(
    model: Model,
    q0: ArrayLike,
    qd0: ArrayLike,
    *,
    t: ArrayLike,
    tension: Tension = None,
    controller: _core.Controller | None = None,
    wrenches: Wrench | Sequence[Wrench] = (),
    method: MethodName = "bdf",
    rtol: float | None = None,
    atol: float | None = None,
    step: float | None = None,
    max_step: float | None = None,
    max_steps: int | None = None,
    break_points: Sequence[float] = (),
    progress: Callable[[float], object] | None = None,
    throw: bool = False,
) -> Trajectory:
    """Run the robot from a state and sample it at output times.

    Parameters
    ----------
    model : Model
        The robot, ready for computing.
    q0, qd0 : (2n,) array_like
        Bending vectors and their rates at the first time [rad], [rad/s].
    t : (N,) array_like
        Output times, strictly increasing; the first is the start [s].
    tension : optional
        None (no tension), (num_cables,) constant tensions [N], a `TensionTable` or a pair
        ``(times, tensions)`` read as one, or a callable ``f(t)`` or ``f(t, q, qd)`` returning
        tensions. A callable is the slow path: Python is called at every evaluation. For a cable
        driven by length the number is its commanded length [m]; None leaves it straight.
    controller : Controller, optional
        In place of `tension`, such as a `Pid`: reset, then asked at the first time and each period
        after, its tensions held in between.
    wrenches : Wrench or sequence of Wrench, optional
        Forces and moments on the robot; their profiles say how they change in time.
    method : {"bdf", "adams", "dopri5", "rk4"}, optional
        bdf and adams: CVODE. dopri5: Dormand-Prince 5(4), the quickest where nothing is stiff.
        rk4: fixed step.

    Returns
    -------
    Trajectory
        A run that fails keeps the samples up to there; ``run.success`` and ``run.message`` tell.

    Other Parameters
    ----------------
    rtol, atol : float, optional
        Tolerances of one step, adaptive methods.
    step : float, optional
        Step of rk4 [s].
    max_step : float, optional
        Largest step of the adaptive methods [s].
    max_steps : int, optional
        Limit of internal steps in the run.
    break_points : sequence of float, optional
        Times at which a callable `tension` is not smooth [s]; the run stops exactly there.
    progress : callable, optional
        Told the time reached, every few hundred steps.
    throw : bool, optional
        Raise RuntimeError with the message when the run fails.

    Raises
    ------
    ValueError
        For an argument out of range; the sentence names it.
    """
    try:
        chosen = _core.Method[method]
    except KeyError:
        known = ", ".join(repr(m.name) for m in _core.Method)
        raise ValueError(f"method must be one of {known}, got {method!r}") from None
    options = _options(
        {"rtol": rtol, "atol": atol, "step": step, "max_step": max_step, "max_steps": max_steps}
    )
    if controller is not None:
        if tension is not None or len(break_points) > 0:
            raise ValueError("give either tension or controller, not both")
        raw = _core.simulate_controlled(
            model, q0, qd0, t, controller, chosen, options, progress, loads(wrenches)
        )
    else:
        source = tension_input(model, tension, break_points)
        raw = _core.simulate(model, q0, qd0, t, source, chosen, options, progress, loads(wrenches))
    run = Trajectory(
        model=model,
        t=raw.t,
        q=raw.q,
        qd=raw.qd,
        tension=raw.tension,
        status=raw.status,
        message=raw.message,
        stats=raw.stats,
        method=method,
        command=raw.command,
        slack_events=tuple(SlackEvent(*event) for event in raw.slack_events),
    )
    warn_beyond_taylor_range(model, run.q)
    if throw and not run.success:
        raise RuntimeError(run.message)
    return run
