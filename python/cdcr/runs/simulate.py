"""Runs: the robot under its commands through time."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, require_kind, require_truth, short
from cdcr.model.model import Model
from cdcr.model.stability import stable_step
from cdcr.model.wrench import Wrench, loads
from cdcr.robot.units import ask_about_commands
from cdcr.runs.command import Command, command_input
from cdcr.runs.events import EventFunction, EventRecord, SlackEvent, watched
from cdcr.runs.fits import require_controller
from cdcr.runs.sensitivities import Asked, asked_of
from cdcr.runs.trajectory import Trajectory

MethodName = Literal["auto", "bdf", "adams", "dopri5", "dop853", "rk4", "rosenbrock"]
MAX_STEPS = 2**63 - 1  # that the core can count
METHODS = dict(_core.Method.__members__)
THROWN = (  # how a run may end whose steps are too large to be stable
    *(_core.Status.bending_limit, _core.Status.compression_limit, _core.Status.non_finite_state),
)
FIXED_STEP = ("rk4", "rosenbrock")
DEFAULT_METHOD: MethodName = "auto"


def available(method: str) -> bool:
    """Return whether this build of cdcr has a method: bdf and adams need CVODE."""
    return _core.with_cvode or method not in ("bdf", "adams")


def find_method(name: object) -> _core.Method:
    """Return the method of that name, which this build of cdcr must have."""
    if not isinstance(name, str) or name not in METHODS:
        known = ", ".join(map(repr, METHODS))
        raise ValueError(f"method must be one of {known}, got {short(name)}")
    if not available(name):
        raise ValueError(
            f"method {name!r} needs CVODE, and this cdcr was built without it: use 'dopri5' or "
            "'rk4', or install SUNDIALS (libsundials-dev) and build cdcr again"
        )
    return METHODS[name]


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


def integrator_options(
    method: object, *, max_steps: int | None = None, **given: float | None
) -> tuple[_core.Method, _core.Options]:
    """Return method and options as the core takes them, None for its defaults, or refuse them."""
    chosen = find_method(method)
    check = Check()
    told: dict[str, Any] = {
        name: check.number(name, value, "a number")
        for name, value in given.items()
        if value is not None
    }
    if max_steps is not None:
        requirement = f"a whole number 1 to {MAX_STEPS}"
        told["max_steps"] = check.whole(
            "max_steps", max_steps, requirement, low=-MAX_STEPS, high=MAX_STEPS
        )
    check.done()
    return chosen, _core.Options(**told)


def about_step(model: Model, q0: ArrayLike, step: float, status: _core.Status) -> str:
    """Return what a failed run of rk4 may be due to, beside what its message says."""
    if status not in THROWN:
        return ""
    limit = stable_step(model, q0)
    if step <= limit:
        return ""
    return f" Or the step of {step:g} s is too large: here rk4 is stable up to {limit:.3g} s."


def simulate(
    model: Model,
    q0: ArrayLike,
    qd0: ArrayLike,
    *,
    t: ArrayLike,
    tension: Command = None,
    command: Command = None,
    controller: _core.Controller | None = None,
    wrenches: Wrench | Sequence[Wrench] = (),
    method: MethodName = DEFAULT_METHOD,
    rtol: float | None = None,
    atol: float | None = None,
    step: float | None = None,
    max_step: float | None = None,
    max_steps: int | None = None,
    break_points: Sequence[float] = (),
    events: EventFunction | Sequence[EventFunction] | None = (),
    sensitivities: str | Sequence[str] | Asked = (),
    progress: Callable[[float], object] | None = None,
    throw: bool = False,
) -> Trajectory:
    """Run the robot from a state and sample it at output times.

    Parameters
    ----------
    model : Model
        The robot, ready for computing.
    q0, qd0 : (d,) array_like
        Coordinates and their rates at the first time.
    t : (N,) array_like
        Output times, strictly increasing; the first is the start [s].
    tension, command : optional
        Two names for what is asked of the cables: tensions [N], lengths [m] of cables driven by
        length. None (no tension, the lengths of the straight robot), (num_cables,) constants, a
        `TensionTable` or a pair ``(times, rows)`` read as one, or a callable ``f(t)`` or
        ``f(t, q, qd)``. A callable is the slow path: Python is called at every evaluation.
    controller : Controller, optional
        In place of `command`, such as a `Pid`: reset, then asked at the first time and each period
        after, its tensions held in between.
    wrenches : Wrench or sequence of Wrench, optional
        Forces and moments on the robot; their profiles say how they change in time.
    method : {"auto", "bdf", "adams", "dopri5", "dop853", "rk4", "rosenbrock"}, optional
        auto: dop853, and bdf from where on stability alone makes its steps small; ``run.stats``
        tells. bdf and adams: CVODE. dopri5: Dormand-Prince 5(4), quick where nothing is stiff;
        dop853: the same of order 8(5,3). Of fixed step: rk4, and rosenbrock, of order 2, stable
        whatever the step. Where cdcr was built without SUNDIALS there is no bdf and no adams, and
        auto stays with dop853.

    Returns
    -------
    Trajectory
        A run that fails keeps the samples up to there; ``run.success`` and ``run.message`` tell.

    Other Parameters
    ----------------
    rtol, atol : float, optional
        Tolerances of one step, adaptive methods; by default 1e-8, of bdf 1e-9, and a hundredth
        of rtol: angles within 1e-6 rad over 10 s.
    step : float, optional
        Step of rk4 and rosenbrock [s].
    max_step : float, optional
        Largest step of the adaptive methods [s]. Where tensions or a wrench are a callable without
        break points, no step is longer than a thousandth of the run, or than the mean distance of
        the output times, unless this says so: what is shorter than a step may be missed.
    max_steps : int, optional
        Limit of internal steps in the run; by default a million, and a hundred more for each
        stretch between break points or periods of a controller.
    break_points : sequence of float, optional
        Times at which a callable `command` is not smooth [s]; the run stops exactly there.
    events : callable or sequence of callable, optional
        What to look for, as SciPy's solve_ivp does: functions ``f(t, q, qd)``, ``f(t, y)`` with
        y = (q, qd), or ``f(t)``, that go through zero. An attribute ``terminal`` (True, or a
        number of times) ends the run there; ``direction`` > 0 counts upward, < 0 downward
        crossings alone. They are located on the interpolant of the method; see ``run.events``.
    sensitivities : str or sequence of str, optional
        By what to differentiate the run: "q0", "qd0", "tension" (the same amount more of each
        command at all times), and numbers of the robot by path, as in
        `Model.parameter_derivatives`. See ``run.sensitivities``; the steps are those of the run
        without. Not under a controller or a callable, which may be feedback.
    progress : callable, optional
        Told the time reached, every few hundred steps.
    throw : bool, optional
        Raise RuntimeError with the message when the run fails.

    Raises
    ------
    ValueError
        For an argument out of range; the sentence names it. Also for a controller that was made for
        a robot of other sizes, or that drives another run at this moment.
    TypeError
        For a model, a controller or a progress that is none.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> t = np.linspace(0, 10, 101)
    >>> run = cdcr.simulate(model, [0, 0], [0, 0], t=t, tension=[5.0, 0.0, 0.0])
    >>> print(f"{np.degrees(run.theta[-1, 0]):.3f} deg after {run.t[-1]:g} s")
    14.978 deg after 10 s
    """
    require_kind("model", model, Model)
    require_truth("throw", throw)
    chosen, options = integrator_options(
        method, rtol=rtol, atol=atol, step=step, max_step=max_step, max_steps=max_steps
    )
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function of time, got {type(progress).__name__}")
    if tension is not None and command is not None:
        raise ValueError("give either tension or command, two names for one thing, not both")
    name, asked = ("tension", tension) if command is None else ("command", command)
    by = sensitivities if isinstance(sensitivities, Asked) else asked_of(model, sensitivities)
    rest = chosen, options, progress, loads(wrenches), watched(events)
    if controller is not None:
        require_controller(controller, model)
        if asked is not None or np.size(break_points) > 0:
            raise ValueError(f"give either {name} or controller, not both")
        if by.names:
            raise ValueError(
                "sensitivities need commands over time: derivatives of a controller are not known"
            )
        raw = _core.simulate_controlled(model, q0, qd0, t, controller, *rest)
    else:
        source = command_input(model, asked, break_points, name)
        raw = _core.simulate(model, q0, qd0, t, source, *rest, by.core() if by.names else None)
    rows = (
        raw.sensitivities.reshape(len(raw.t), 2 * model.num_coordinates, -1) if by.names else None
    )
    is_rk4 = chosen == _core.Method.rk4
    due = about_step(model, q0, options.step, raw.status) if is_rk4 else ""
    on_q, on_qd = ({}, {}) if rows is None else by.split(model, rows)
    run = Trajectory._of_core(
        model=model,
        t=raw.t,
        q=raw.q,
        qd=raw.qd,
        tension=raw.tension,
        status=raw.status,
        message=raw.message + due,
        stats=raw.stats,
        method=method,
        command=raw.command,
        slack_events=tuple(SlackEvent(*event) for event in raw.slack_events),
        events=tuple(EventRecord(*event) for event in raw.events),
        deflection=raw.deflection if model.num_deflections else None,
        sensitivities=on_q,
        rate_sensitivities=on_qd,
    )
    warn_beyond_taylor_range(model, run.q)
    if run.stats.stiff is not None and not _core.with_cvode:
        warnings.warn(
            f"from t = {run.stats.stiff:.4g} s on only stability kept the steps of dop853 small; "
            "auto takes bdf there, which this cdcr was built without",
            UserWarning,
            stacklevel=2,
        )
    ask_about_commands(model.robot, run.command)
    if throw and not run.success:
        raise RuntimeError(run.message)
    return run
