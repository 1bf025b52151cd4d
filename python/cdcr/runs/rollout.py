"""Rollouts: many motions in one call, on all processors."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from cdcr import _core
from cdcr.base.arrays import FloatArray, finite
from cdcr.base.check import Check, is_iterable, require_kind
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench, loads
from cdcr.robot.units import ask_about_commands
from cdcr.runs.lockstep import BatchController, run_in_lockstep
from cdcr.runs.parameters import Variation
from cdcr.runs.rollout_result import Rollout, RolloutFailure
from cdcr.runs.simulate import MethodName, integrator_options

RolloutController: TypeAlias = "_core.Pid | Sequence[_core.Controller] | BatchController"


@dataclass(frozen=True, eq=False)
class Batch:
    """The arguments of a rollout, checked and of full size: what the core takes."""

    models: Sequence[_core.Model]  # one, or N
    q0: FloatArray  # (N, d)
    qd0: FloatArray
    commands: FloatArray | None  # (1 or N, 1 or steps, num_cables); None: of controllers
    controllers: Any
    loads: _core.Loads
    method: _core.Method
    options: _core.Options
    step: float
    steps: int
    record_every: int
    threads: int
    progress: Callable[[int], object] | None
    start: float = 0.0  # time of the first step [s]

    def run(self) -> tuple[Any, ...]:
        """Run it: q, qd, commands of controllers, failures, cost."""
        return _core.rollout(
            self.models,
            self.q0,
            self.qd0,
            self.commands,
            self.controllers,
            self.loads,
            self.method,
            self.options,
            self.step,
            self.steps,
            self.record_every,
            self.start,
            self.threads,
            self.progress,
        )


def rollout(
    model: Model | Sequence[Model],
    q0: ArrayLike,
    qd0: ArrayLike,
    tension: ArrayLike | None = None,
    *,
    step: float,
    steps: int,
    command: ArrayLike | None = None,
    controller: RolloutController | None = None,
    control_every: int = 1,
    wrenches: Wrench | Sequence[Wrench] = (),
    parameters: Mapping[str, ArrayLike] | None = None,
    method: MethodName = "rk4",
    record_every: int = 1,
    threads: int = 0,
    rtol: float | None = None,
    atol: float | None = None,
    max_step: float | None = None,
    max_steps: int | None = None,
    progress: Callable[[int], object] | None = None,
) -> Rollout:
    """Run many motions at once, each as `simulate` does, on all processors.

    The numbers do not depend on how many threads there are. A motion that fails leaves the others
    alone. Ctrl-C ends the rollout at once, and returns what is done: the motions that are not have
    the status ``interrupted``.

    Parameters
    ----------
    model : Model or sequence of Model
        The robot of all motions, or one for each, with as many coordinates and cables.
    q0, qd0 : (N, d) or (d,) array_like
        Coordinates and their rates at the start, of each motion or of all.
    step : float
        Time from one command to the next, and of a step of rk4 and rosenbrock [s].
    steps : int
        How many of these each motion has.
    tension, command : (num_cables,), (N, num_cables) or (N, steps, num_cables) array_like, optional
        Two names for what is asked of the cables: tensions [N], lengths [m] of cables driven by
        length; constant, or of each step, held over it. None: no tension, the lengths of the
        straight robot.
    controller : Pid, sequence of Controller, or callable, optional
        In place of `command`. A `Pid`, copied for each motion; one for each, written in C++; or a
        function ``f(t, q, qd)`` of the time [s] and the states (N, d) of all motions, which returns
        the commands (N, num_cables): all motions then go on together. It sees NaN of those that
        failed, whose commands are not used. Robots whose cables or drives remember
        (`presliding_stiffness`, backlash) take no function.
    control_every : int, optional
        Steps from one call of that function to the next.
    wrenches : Wrench or sequence of Wrench, optional
        Forces and moments on the robot, the same in all motions; their profiles are tables.
    parameters : mapping of str to (N,) array_like, optional
        Numbers of the robot that differ from motion to motion, by path as in `cdcr.sweep`:
        ``{"sections.*.youngs_modulus": ..., "payload": ...}``, in SI units [Pa], [kg]. Sections and
        cables count from 1.
    method : {"rk4", "rosenbrock", "auto", "dopri5", "dop853", "bdf", "adams"}, optional
        As in `simulate`; rk4 and rosenbrock have the given step.
    record_every : int, optional
        Steps from one row of the result to the next, a divisor of `steps`.
    threads : int, optional
        How many; 0 for one for each processor.

    Returns
    -------
    Rollout
        Rows of all motions, R = steps / record_every + 1 each, and the failures.

    Other Parameters
    ----------------
    rtol, atol, max_step, max_steps : optional
        As in `simulate`; rk4 makes as many steps as asked for.
    progress : callable, optional
        Told how many motions have ended, now and then; under a function, how many steps.

    Raises
    ------
    ValueError
        For an argument out of range; the sentence names it, and the motion.
    TypeError
        For what is no model, no controller or no function.

    Examples
    --------
    >>> import numpy as np
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> pulls = np.zeros((1000, 3))
    >>> pulls[:, 0] = np.linspace(0.0, 5.0, 1000)
    >>> runs = cdcr.rollout(
    ...     model, [0.0, 0.0], [0.0, 0.0], tension=pulls, step=1e-3, steps=2000, record_every=2000
    ... )
    >>> runs
    <Rollout: 1000 motions, 2 rows each, t = 0 to 2 s, 1 robot, rk4, all ok>
    >>> runs.q.shape
    (1000, 2, 2)
    """
    models = _models(model)
    check = Check()
    seconds = check.number("step", step, "a number > 0 s", above=0.0)
    whole = {
        name: check.whole(name, value, f"a whole number >= {low}", low=low)
        for name, value, low in (
            ("steps", steps, 0),
            ("record_every", record_every, 1),
            ("control_every", control_every, 1),
            ("threads", threads, 0),
        )
    }
    check.done()
    chosen, options = integrator_options(
        method, rtol=rtol, atol=atol, max_step=max_step, max_steps=max_steps
    )
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function of a number, got {type(progress).__name__}")
    pushing = tuple(wrenches) if is_iterable(wrenches) else wrenches
    load = loads(pushing)
    for wrench in (pushing,) if isinstance(pushing, Wrench) else pushing:
        if callable(wrench.profile):
            raise ValueError(
                "the profile of a wrench on a rollout must be a table, got a function, which "
                "Python would have to call in every step of each motion"
            )
    if sum(given is not None for given in (tension, command, controller)) > 1:
        raise ValueError("give one of tension, command and controller")
    name, asked = ("tension", tension) if command is None else ("command", command)
    first = models[0]
    variation = Variation(first, {} if parameters is None else parameters)
    if variation.values and len(models) > 1:
        raise ValueError("parameters are those of one model, give either them or several models")
    starts = [_start(first, "q0", q0), _start(first, "qd0", qd0)]
    commands = None
    if controller is None:
        commands = _commands(first, name, asked, whole["steps"])
        ask_about_commands(first.robot, commands)
    drivers = _drivers(controller)
    together = controller is not None and not drivers and callable(controller)
    if not together and whole["control_every"] != 1:
        raise ValueError("control_every is for a function as controller, and there is none")
    motions = agree(
        q0=len(starts[0]),
        qd0=len(starts[1]),
        model=len(models),
        parameters=len(variation) if variation.values else 1,
        **{name: 1 if commands is None else len(commands)},
        controller=len(drivers) or 1,
    )
    d = first.num_coordinates
    batch = Batch(
        models=(variation.models() if variation.values else ()) or models,
        q0=np.broadcast_to(starts[0], (motions, d)),
        qd0=np.broadcast_to(starts[1], (motions, d)),
        commands=commands,
        controllers=None if together else drivers or controller,
        loads=load,
        method=chosen,
        options=options,
        step=seconds,
        steps=whole["steps"],
        record_every=whole["record_every"],
        threads=whole["threads"],
        progress=progress,
    )
    if together:
        assert callable(controller)
        q, qd, told, failures, stats = run_in_lockstep(batch, controller, whole["control_every"])
    else:
        q, qd, told, failures, stats = batch.run()
    every = batch.record_every
    rows = every * np.arange(batch.steps // every + 1)
    if told is None:
        assert commands is not None
        table = commands[:, np.minimum(rows, commands.shape[1] - 1)]
        told = np.broadcast_to(table, (motions, len(rows), first.num_cables))
    return Rollout(
        models=models,
        parameters=variation.spread(motions),
        t=np.asarray(seconds * rows, dtype=np.float64),
        q=q,
        qd=qd,
        command=told,
        failures=tuple(RolloutFailure(*failure) for failure in failures),
        stats=stats,
        method=method,
    )


def _models(given: object) -> tuple[Model, ...]:
    """Return the models of a rollout."""
    if isinstance(given, Model):
        return (given,)
    if not isinstance(given, Sequence) or len(given) == 0:
        kind = "no one" if isinstance(given, Sequence) and not given else type(given).__name__
        raise TypeError(f"model must be a cdcr.Model, or a sequence of them, got {kind}")
    for i, one in enumerate(given):
        require_kind(f"model[{i}] (motion {i + 1})", one, Model)
    return tuple(given)


def _drivers(controller: object) -> Sequence[object]:
    """Return the controllers of a sequence; nothing for one of all motions, or none."""
    if controller is None or isinstance(controller, _core.Controller) or callable(controller):
        return ()
    if not isinstance(controller, Sequence) or isinstance(controller, (str, bytes)):
        got = type(controller).__name__
        raise TypeError(f"controller must be a cdcr.Pid, a list of them or a function, got {got}")
    if not controller:
        raise ValueError("controller must be a cdcr.Pid, a list of them or a function, got no one")
    for i, one in enumerate(controller):
        require_kind(f"controller[{i}] (motion {i + 1})", one, _core.Controller)
    return controller


def _start(model: Model, name: str, given: ArrayLike) -> FloatArray:
    """Return q0 or qd0 (1 or N, d)."""
    array = finite(given, name)
    d = model.num_coordinates
    if array.ndim not in (1, 2) or array.shape[-1] != d:
        raise ValueError(f"{name} must have shape ({d},) or (N, {d}), got {array.shape}")
    return np.atleast_2d(array)


def _commands(model: Model, name: str, given: ArrayLike | None, steps: int) -> FloatArray:
    """Return commands (1 or N, 1 or steps, num_cables)."""
    if callable(given):
        raise TypeError(f"a function of the states of all motions is a controller, not a {name}")
    array = finite(model.rest_command() if given is None else given, name)
    cables = model.num_cables
    if not 1 <= array.ndim <= 3 or array.shape[-1] != cables:
        known = f"({cables},), (N, {cables}) or (N, {steps}, {cables})"
        raise ValueError(f"{name} must have shape {known}, got {array.shape}")
    if array.ndim == 3 and array.shape[1] != steps:
        raise ValueError(
            f"{name} must have shape (N, {steps}, {cables}), a row for each step, got {array.shape}"
        )
    if array.ndim == 3 and steps == 0:  # none is held, and the only row needs one
        return np.broadcast_to(model.rest_command(), (len(array), 1, cables))
    return array if array.ndim == 3 else np.atleast_2d(array)[:, None, :]


def agree(**sizes: int) -> int:
    """Return how many motions there are: what all that stand for more than one agree on."""
    several = {name: size for name, size in sizes.items() if size != 1}
    if len(set(several.values())) > 1:
        told = ", ".join(f"{size} of {name}" for name, size in several.items())
        raise ValueError(f"there must be as many motions of each, or one for all, got {told}")
    return next(iter(several.values()), 1)
