"""A motion of a user's file, the tensions it needs, and what these make the robot do."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr._core import Status
from cdcr.base.arrays import FloatArray, even_times
from cdcr.model.model import Model
from cdcr.motion.inverse import Infeasible, InverseRun, check_bending, inverse_run
from cdcr.motion.reference import Reference
from cdcr.motion.splines import Motion
from cdcr.runs.command import Command, TensionTable
from cdcr.runs.simulate import simulate
from cdcr.runs.stats import total
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.file.values import error_prefix
from cdcr.scenarios.metrics import Metric, run_metrics
from cdcr.scenarios.scenario import Scenario

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def driven_by_length(model: Model) -> bool:
    """Return whether all cables are: then a motion gives lengths in place of tensions."""
    return model.num_cables > 0 and all(cable.length_driven for cable in model.robot.all_cables)


@dataclass(frozen=True, kw_only=True, eq=False)
class TrackedMotion:
    """A motion to follow: by tensions from inverse dynamics, or by the lengths that cables have.

    Parameters
    ----------
    motion : callable
        From times (M,) [s] to q, qd, qdd (3, M, d).
    where : str
        What a refusal begins with.
    min_tension, max_tension : float
        Limits of every tension [N].
    infeasible : {"raise", "nearest"}
        What to do where the limits are too narrow.
    simulate : bool
        Whether the robot then moves under the tensions, open loop.
    step : float, optional
        Time between the commands, which lines connect [s]; by default they are found anew
        whenever the integrator asks.
    shorter : float
        How much shorter than along the motion cables driven by length are wound [m].
    derivative_error : tuple of float
        Of the rates and accelerations of samples [rad/s], [rad/s^2].
    """

    motion: Motion
    where: str
    min_tension: float = 0.0
    max_tension: float = np.inf
    infeasible: Infeasible = "raise"
    simulate: bool = False
    step: float | None = None
    shorter: float = 0.0
    derivative_error: tuple[float, float] = (0.0, 0.0)

    @property
    def integrates(self) -> bool:
        """Whether the robot moves under the tensions."""
        return self.simulate

    def reference(self, t: FloatArray) -> Reference:
        """Return the motion at times (N,) [s]."""
        q, qd, qdd = self.motion(t)
        return Reference(t, q, qd, qdd, self.derivative_error, self.motion)

    def start(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return q and qd at t = 0."""
        q, qd, _ = self.motion(np.zeros(1))[:, 0]
        return tuple(q.tolist()), tuple(qd.tolist())

    def check(self, model: Model, t: FloatArray) -> None:
        """Refuse a motion that bends a section too far at any of the times (N,) [s]."""
        with error_prefix(self.where):
            check_bending(model, self.reference(t))

    def inverse(self, model: Model, t: FloatArray) -> InverseRun:
        """Return the tensions needed at times (N,) [s]."""
        with error_prefix(self.where):
            needed = inverse_run(
                model,
                self.reference(t),
                min_tension=self.min_tension,
                max_tension=self.max_tension,
                infeasible="nearest",
            )
            if self.infeasible == "raise" and not np.all(needed.feasible):
                raise ValueError(_out_of_reach(needed))
        return needed

    def run(
        self,
        model: Model,
        q0: tuple[float, ...],
        qd0: tuple[float, ...],
        t: FloatArray,
        **options: Any,
    ) -> Trajectory:
        """Run the robot under the commands needed, or return the motion itself with them."""
        if self.simulate:
            command = self.command(model, t)
            with nullcontext() if driven_by_length(model) else _warn_once():
                return simulate(model, q0, qd0, t=t, command=command, **options)
        needed = self.inverse(model, t)
        return Trajectory(
            model=model,
            t=needed.t,
            q=needed.q,
            qd=needed.reference.qd,
            tension=needed.tension,
            status=Status.ok,
            message="",
            stats=total(()),
            method="inverse dynamics",
        )

    def command(self, model: Model, t: FloatArray) -> Command:
        """Return the commands of the cables in a run with output times (N,) from 0 on [s]."""
        with error_prefix(self.where):
            times = t if self.step is None else even_times(float(t[-1]), self.step)
        if driven_by_length(model):
            if self.step is None:
                return lambda time: self._lengths(model, np.array([time]))[0]
            return TensionTable(times, self._lengths(model, times))
        needed = self.inverse(model, t)  # refuses what is out of reach at any output time
        if self.step is None:
            return needed.tension_at
        with _warn_once():
            return self.inverse(model, times).to_table()

    def first_command(self, model: Model) -> FloatArray:
        """Return the commands (num_cables,) at t = 0."""
        if driven_by_length(model):
            return np.asarray(self._lengths(model, np.zeros(1))[0])
        return np.asarray(self.inverse(model, np.array([0.0, 1e-3])).tension[0])

    def _lengths(self, model: Model, t: FloatArray) -> FloatArray:
        """Return the lengths of the cables along the motion, less `shorter` (M, num_cables) [m]."""
        return np.asarray(model.cable_lengths(self.motion(t)[0]) - self.shorter)

    def summarize(self, scenario: Scenario, run: Trajectory) -> tuple[Metric, ...]:
        """Return what every run shows, the tensions needed, and how well they lead the robot."""
        if driven_by_length(run.model):
            return (*run_metrics(scenario, run), *self._errors(run))
        with _warn_once():
            needed = self.inverse(run.model, run.t)
        found = [*run_metrics(scenario, run)]
        for j, tension in enumerate(needed.tension.T):
            key, cable = f"tension_{j + 1}", f"tension needed of cable {j + 1}"
            found += [
                Metric(f"{key}_min_N", f"{cable}, smallest", float(tension.min()), "N"),
                Metric(f"{key}_max_N", f"{cable}, largest", float(tension.max()), "N"),
            ]
        misses = float(np.sum(~needed.feasible))
        if misses:
            found.append(Metric("infeasible", "samples out of reach", misses, ""))
        rate, acceleration = self.derivative_error
        if acceleration > 0.0:
            label = "error of the motion's"
            found += [
                Metric("rate_error", f"{label} rates, estimate", rate, "rad/s"),
                Metric("acceleration_error", f"{label} accelerations", acceleration, "rad/s^2"),
            ]
        return (*found, *(self._errors(run) if self.simulate else ()))

    def _errors(self, run: Trajectory) -> tuple[Metric, ...]:
        asked = self.reference(run.t).q
        angle = np.linalg.norm(run.q - asked, axis=1)
        tip = np.linalg.norm(run.tip - run.model.tips(asked), axis=1)
        return (
            Metric("path_error_rad", "path error, largest", float(angle.max()), "rad"),
            Metric("path_error_end_rad", "path error at the end", float(angle[-1]), "rad"),
            Metric("tip_error_m", "tip from its path, furthest", float(tip.max()), "m"),
        )

    def plot(self, scenario: Scenario, run: Trajectory) -> Figure:
        """Return the picture of every run, with the motion asked for where the robot moves."""
        from cdcr.scenarios.figures.run import run_figure

        figure = run_figure(scenario, run)
        if self.simulate:
            theta, phi = run.model.polar(self.motion(run.t)[0], continuous=True)
            for axes in figure.axes[1:-1]:  # of theta, and of phi where it moves
                angles = phi if "varphi" in axes.get_ylabel() else theta
                axes.plot(run.t, np.rad2deg(angles), color="black", linewidth=1.0, dashes=(6, 4))
                axes.set_title("dashed: asked for", loc="left", fontsize=9.5)
        return figure


@contextmanager
def _warn_once() -> Iterator[None]:
    """Keep back the warning about a Taylor formulation, which is given for the run as a whole."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="formulation .* holds for")
        yield


def _out_of_reach(needed: InverseRun) -> str:
    misses = np.flatnonzero(~needed.feasible)
    first = int(misses[0])
    limiting = [str(cable + 1) for cable in needed.limiting[first]]
    cables = f"limited by cable{'' if len(limiting) == 1 else 's'} {', '.join(limiting)}"
    reason = cables if limiting else "no cable pulls that way"
    advice = "widen the limits, slow the motion down, or " if limiting else ""
    return (
        f"at t = {needed.t[first]:g} s the motion cannot be had with tensions from "
        f"{needed.min_tension:g} to {needed.max_tension:g} N ({reason}), nor at "
        f"{misses.size - 1} more of {len(needed)} samples; {advice}"
        'take the nearest tensions with infeasible = "nearest"'
    )
