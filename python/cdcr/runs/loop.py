"""Closed loops in C++: robot, actuators, sensors and controller, each at its own period."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, Literal, NamedTuple

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, require_kind, require_truth
from cdcr.base.keywords import by_keyword
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench
from cdcr.robot.units import ask_about_commands
from cdcr.runs.fits import require_controller
from cdcr.runs.loop_channels import loop_channels
from cdcr.runs.parts import Actuator, Sensor, as_dicts
from cdcr.runs.simulate import about_step
from cdcr.runs.trajectory import Trajectory


class ToldMotion(NamedTuple):
    """States over time, as `Trajectory.view` shows them beside a run."""

    t: FloatArray  # (N,) [s]
    q: FloatArray  # (N, d) [rad]
    qd: FloatArray  # (N, d) [rad/s]


@dataclass(frozen=True, eq=False, repr=False)
class LoopRun:
    """A run of a closed loop, sampled.

    Parameters
    ----------
    trajectory : Trajectory
        The motion; its command is what the cables got.
    asked : (N, num_cables) array
        What the controller asked for [N], [m].
    reference : (N, r) array
        What it followed: coordinates [rad], or of the tip the position [m] and maybe a rotation
        vector [rad]; no columns of a controller that does not tell.
    told_q, told_qd : (N, d) array
        The state that it was told [rad], [rad/s].
    measurements : tuple of (N, m) array
        What each sensor told [of its kind].
    durations : (N,) array
        Of the controller's last update, by the clock [s].
    estimated, deviations : dict of (N,) array
        What else the estimator estimates, by name, and standard deviations of that [of its kind].
    innovation, measured : (N,) array
        Of the estimator's last update: chi-square with as many degrees as values were measured [1].

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020())
    >>> loop = cdcr.Loop(model, cdcr.ComputedTorque(model))
    >>> loop.reset([0.1, 0.0], [0.0, 0.0])
    >>> loop.run(0.1, record_every=10)
    <LoopRun: 11 samples, t = 0 to 0.1 s, status ok>
    """

    trajectory: Trajectory
    asked: FloatArray
    reference: FloatArray
    told_q: FloatArray
    told_qd: FloatArray
    measurements: tuple[FloatArray, ...]
    durations: FloatArray
    estimated: dict[str, FloatArray]
    deviations: dict[str, FloatArray]
    innovation: FloatArray
    measured: FloatArray

    @property
    def told(self) -> ToldMotion:
        """What the controller was told: for ``run.trajectory.view(estimate=run.told)``."""
        return ToldMotion(self.trajectory.t, self.told_q, self.told_qd)

    def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> Path:
        """Write it to netCDF, CSV or an MCAP log; see `Trajectory.save`.

        Parameters
        ----------
        path : path-like
            The file, ending in ``.nc``, ``.csv`` or ``.mcap``, in a folder that exists.
        overwrite : bool
            Whether an existing file may be replaced.

        Returns
        -------
        Path
            The file written.

        Examples
        --------
        >>> import tempfile
        >>> from pathlib import Path
        >>> import cdcr
        >>> model = cdcr.Model(cdcr.robots.amouri2020())
        >>> loop = cdcr.Loop(model, cdcr.ComputedTorque(model))
        >>> loop.reset([0.1, 0.0], [0.0, 0.0])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     header = loop.run(0.01).save(Path(folder) / "run.csv").read_text().splitlines()[0]
        >>> "reference_q1_x [rad]" in header, "duration [s]" in header
        (True, True)
        """
        return self.trajectory.save(path, overwrite=overwrite)

    def __repr__(self) -> str:
        """Say what a person wants to know first."""
        run = self.trajectory
        end = f": {run.message}" if run.message else ""
        return (
            f"<LoopRun: {len(run)} samples, t = {run.t[0]:g} to {run.t[-1]:g} s, "
            f"status {run.status.name}{end}>"
        )


@by_keyword
class Loop(_core.Loop):
    """A closed loop in C++: the robot, its actuators and sensors and a controller.

    In a step of the plant sensors measure, estimator and controller are asked where their time has
    come, actuators move, and the robot moves under what they give. The same loop gives the same
    bits. After a failure the last good state stays until `reset`. With controllers of the package
    no Python runs inside; one written in Python is called each period, which is slower.

    Parameters
    ----------
    model : Model
        The robot.
    controller : Controller
        Its period is a whole number of steps.
    step : float, optional
        Of the plant [s].
    substeps : int, optional
        Equal steps of the method in each.
    method : {"rk4", "rosenbrock"}, optional
        Of the plant: explicit, or linearly implicit, which is stable whatever the step.
    actuators : Actuator or sequence of Actuator, optional
        One for all cables, or one for each.
    sensors : Sensor or sequence of Sensor, optional
        What is measured.
    estimator : Estimator, optional
        Makes a state of what sensors tell, which the controller is told: `ExtendedKalman`,
        `UnscentedKalman`, `MomentumObserver`.

    Raises
    ------
    ValueError
        For what is out of its range, periods and delays that are no whole numbers of steps, and a
        controller made for a robot of other sizes.
    TypeError
        For a model or a controller that is none.

    Examples
    --------
    >>> import cdcr
    >>> model = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
    >>> controller = cdcr.ComputedTorque(model, kp=64.0, kd=16.0, min_tension=0.5)
    >>> controller.reference = [0.3, 0.1]
    >>> loop = cdcr.Loop(
    ...     model,
    ...     controller,
    ...     actuators=cdcr.Actuator(time_constant=2e-3),
    ...     sensors=cdcr.Sensor(kind="coordinates", noise=1e-4),
    ... )
    >>> loop.reset([0.0, 0.0], [0.0, 0.0])
    >>> run = loop.run(3.0, record_every=10)
    >>> bool(abs(run.trajectory.q[-1] - [0.3, 0.1]).max() < 1e-3)
    True
    """

    __slots__ = ("_rk4_step",)  # a misspelt attribute is an error

    def __init__(
        self,
        model: Model,
        controller: _core.Controller,
        *,
        step: float = 1e-3,
        substeps: int = 1,
        method: Literal["rk4", "rosenbrock"] = "rk4",
        actuators: Actuator | Sequence[Actuator] = (),
        sensors: Sensor | Sequence[Sensor] = (),
        estimator: _core.Estimator | None = None,
    ) -> None:
        require_kind("model", model, Model)
        require_controller(controller, model)
        if estimator is not None:
            require_kind("estimator", estimator, _core.Estimator)
        check = Check()
        options: dict[str, Any] = {
            "step": check.number("step", step, "a number"),
            "substeps": check.whole("substeps", substeps, "a whole number >= 1"),
        }
        check.done()
        options["method"] = str(method)
        options["actuators"] = as_dicts("actuators", actuators, Actuator)
        options["sensors"] = as_dicts("sensors", sensors, Sensor)
        super().__init__(model, controller, options, estimator)
        self._rk4_step = options["step"] / options["substeps"] if method == "rk4" else 0.0

    def __repr__(self) -> str:
        """Say where it is, and what closes it."""
        names = [type(one).__name__ for one in (self.controller, self.estimator) if one is not None]
        return f"<Loop at t = {self.time:g} s, {', '.join(names)}, status {self.status.name}>"

    def run(
        self,
        duration: float,
        *,
        record_every: int = 1,
        wrenches: Wrench | Sequence[Wrench] = (),
        throw: bool = False,
    ) -> LoopRun:
        """Step over a duration and sample.

        Parameters
        ----------
        duration : float
            A whole number of steps [s].
        record_every : int, optional
            Steps between samples; the first is the state now.
        wrenches : Wrench or sequence of Wrench, optional
            Constant forces and moments on the robot.
        throw : bool, optional
            Raise RuntimeError with the message when the run fails.

        Returns
        -------
        LoopRun
            What holds over the step that begins at a sample stands in its row; in the last row,
            of which no step begins, what held before.

        Raises
        ------
        ValueError
            For an argument out of its range, or a loop without a state or that has ended.
        """
        check = Check()
        duration = check.number("duration", duration, "a number")
        every = check.whole("record_every", record_every, "a whole number >= 1")
        check.done()
        require_truth("throw", throw)
        found = self._sampled(duration, every, wrenches)
        names = ("t", "q", "qd", "tension", "command", "method", "status", "message", "stats")
        found["message"] += about_step(self.model, found["q"][0], self._rk4_step, found["status"])
        own = None if self.estimator is None else list(self.estimator.values)
        run = Trajectory(
            model=self.model,
            channels=loop_channels(self.model, found, own),
            **{name: found[name] for name in names},
        )
        ask_about_commands(self.model.robot, found["asked"])
        if throw and not run.success:
            raise RuntimeError(run.message)
        told = found["told_q"], found["told_qd"], tuple(found["told"])
        estimated, deviations = (
            {name: found[table][:, i] for i, name in enumerate(own or ())}
            for table in ("estimated", "deviations")
        )
        return LoopRun(
            run,
            found["asked"],
            found["reference"],
            *told,
            found["durations"],
            estimated=estimated,
            deviations=deviations,
            innovation=found["innovation"],
            measured=found["measured"],
        )
