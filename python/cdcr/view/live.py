"""A robot simulated now: under commands, gravity, a payload and a pull that all may change."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from numbers import Real
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from cdcr import _core
from cdcr.base.arrays import FloatArray
from cdcr.base.check import Check, format_value
from cdcr.plotting.panels import is_damped

if TYPE_CHECKING:
    from cdcr.robot.robot import Robot

PERIOD = 2e-3  # for which commands and pull are held [s]
STABLE = 1.2  # step times fastest rate; RK4 is stable up to 2.78, and bent robots are faster
MOST_SUBSTEPS = 1000
ADDED_DAMPING = 0.1  # share of critical damping, given to a robot that has none at all
# First coefficient of each strain of a section, and what damps it.
DAMPINGS = {"q{}_x": "damping", "t{}": "twist_damping", "e{}": "stretch_damping"}
MOST_BENT = 2.5  # bending angle that the largest command of a slider gives one section [rad]
CIRCLE, RAMP = 6.0, 1.0  # time of one round of `circling`, and how it begins [s]
CIRCLING = 0.5  # its share of the sliders' range, over the number of sections


class LiveModel(_core.Model):
    """The equations of motion of a robot, which knows its description as `cdcr.Model` does."""

    def __init__(self, robot: Robot, formulation: str = "exact") -> None:
        super().__init__(robot._to_core(), _core.Formulation[formulation.replace("-", "_")])
        self.robot = robot


@dataclass(frozen=True)
class Pull:
    """A spring between a point of the backbone and a point in space.

    Parameters
    ----------
    section : int
        Index of the section.
    fraction : float
        Fraction of its length.
    target : tuple of float
        The point in space [m].
    stiffness : float
        Of the spring [N/m].
    """

    section: int
    fraction: float
    target: tuple[float, ...]
    stiffness: float

    def point(self, model: _core.Model, q: FloatArray) -> FloatArray:
        """Return the point of the backbone (3,) [m]."""
        return model.pose(q, self.section, self.fraction)[1]

    def force(self, model: _core.Model, q: FloatArray) -> FloatArray:
        """Return the force on the backbone (3,) [N]."""
        return self.stiffness * (np.array(self.target) - self.point(model, q))


@dataclass(frozen=True)
class _Wrench:
    """What the core takes for a wrench."""

    section: int
    fraction: float
    force: FloatArray
    profile: ClassVar[None] = None

    def _to_core(self) -> _core.CoreWrench:
        return _core.CoreWrench(self.section, self.fraction, self.force, np.zeros(3), False)


class LiveRobot:
    """A robot that moves as time goes on. One without inertia is always at rest.

    Parameters
    ----------
    robot : Robot
        The robot.
    formulation : str
        Of the equations of motion.
    q, qd : (d,) array, optional
        Where it starts and how fast; by default at rest, without tension.
    command : (num_cables,) array, optional
        Of the cables [N], [m] where driven by length.
    start : float
        When it begins [s].
    added_damping : float, optional
        Share of critical damping; unless given, some where the robot has none at all.
    """

    def __init__(
        self,
        robot: Robot,
        formulation: str = "exact",
        *,
        q: FloatArray | None = None,
        qd: FloatArray | None = None,
        command: FloatArray | None = None,
        start: float = 0.0,
        added_damping: float | None = None,
    ) -> None:
        self.robot, self._given, self._formulation = robot, robot, formulation
        self.pull: Pull | None = None
        self.time, self.message = start, ""
        self.added_damping = first_damping(robot) if added_damping is None else added_damping
        self.model = LiveModel(robot, formulation)
        self.command = np.array(self.model.rest_command() if command is None else command)
        self._taken = self.command.copy()  # the last command that was none to refuse
        size = self.model.num_coordinates
        self.q = self._rest(self.model.rest_shape) if q is None else np.array(q)
        self.qd = np.zeros(size) if qd is None else np.array(qd)
        self._build()

    @property
    def tension(self) -> FloatArray:
        """What the cables pull with at the base (num_cables,) [N]."""
        return self.model.cable_tensions(self.q, self.qd, self.command)

    @property
    def steered(self) -> bool:
        """Whether a controller moves the cables, and no person."""
        return False

    @property
    def told(self) -> FloatArray | None:
        """State that a controller is told (d,), where there is one."""
        return None

    @property
    def pull_stiffness(self) -> float:
        """Stiffness of a spring that bends the robot well where it is pulled [N/m]."""
        bending = 1.0 / sum(1.0 / section.stiffness for section in self.robot.sections)
        return 6.0 * bending / self.robot.length**2

    def steer(self, cable: int, value: float) -> None:
        """Set the command of a cable, by its index [N], [m] where driven by length."""
        self.command[cable] = value

    def change(
        self,
        *,
        gravity: tuple[float, float, float] | None = None,
        payload: float | None = None,
        added_damping: float | None = None,
    ) -> None:
        """Go on under another gravity [m/s^2], payload [kg], share of critical damping added."""
        given, share = self._given, self.added_damping
        if gravity is not None:
            given = replace(given, gravity=gravity)
        if payload is not None:
            given = replace(given, payload=payload)
        if added_damping is not None:
            if not 0.0 <= added_damping < math.inf:
                must = "must be a number >= 0 and finite"
                raise ValueError(f"added_damping {must}, got {format_value(added_damping)}")
            share = added_damping
        self._given, self.added_damping = given, share
        self._build()

    def pull_to(self, section: int, fraction: float, target: Sequence[float]) -> None:
        """Pull a point of the backbone, by section and fraction, towards a point in space [m].

        Raises
        ------
        ValueError
            For a point that the backbone has not, and a target that is none.
        """
        self.model.pose(self.q, section, fraction)  # refuses another place
        check = Check()
        place = check.vector("target", target, "three numbers in m", "a finite number of m")
        if not all(map(math.isfinite, place)) and not check.sentences:
            check.refuse("target", "three finite numbers in m", target)
        check.done()
        self.pull = Pull(section, fraction, place, self.pull_stiffness)

    def advance(self, seconds: float, budget: float = math.inf) -> None:
        """Go on for so long [s], but compute no longer than the budget [s].

        Raises
        ------
        ValueError
            For a command that is none; the last good one is then back.
        """
        try:
            self._go_on(seconds, budget)
        except ValueError:
            self.command = self._taken.copy()
            raise
        self._taken = np.array(self.command)

    def _go_on(self, seconds: float, budget: float) -> None:
        end, patience = self.time + seconds, time.perf_counter() + budget
        if self._simulator is None:
            self.q, self.time = self._rest(self.q), end
            return
        while self.time < end - PERIOD / 2 and time.perf_counter() < patience:
            status = self._simulator.step(self.command, self._wrenches(self.q))
            self.q, self.qd = self._simulator.q, self._simulator.qd
            self.time += PERIOD
            self.message = "" if status.name == "ok" else status.name.replace("_", " ")
            if self.message:  # held where it is
                self.qd = np.zeros_like(self.qd)
                self._simulator.reset(self.q, self.qd)

    def _wrenches(self, q: FloatArray) -> Any:
        pull = self.pull
        if pull is None:
            return ()
        return (_Wrench(pull.section, pull.fraction, pull.force(self.model, q)),)

    def _rest(self, q: FloatArray) -> FloatArray:
        """Return the shape at rest nearest to q, or q where none is found."""
        found = self.model.find_equilibrium(self.command, q, self._wrenches(q))
        return np.array(found.q if found.status.name == "ok" else q)

    def _build(self) -> None:
        """Make model and simulator anew, in the state reached."""
        self.robot = _damped(self._given, self._formulation, self.added_damping)
        self.model = LiveModel(self.robot, self._formulation)
        self._simulator = None
        if self.model.has_inertia:
            A, _ = self.model.linearize(self.q, np.zeros_like(self.q), self.command)
            fastest = float(np.max(np.abs(np.linalg.eigvals(A)), initial=0.0))
            substeps = min(MOST_SUBSTEPS, max(1, math.ceil(PERIOD * fastest / STABLE)))
            self._simulator = _core.Simulator(self.model, step=PERIOD, substeps=substeps)
            self._simulator.reset(self.q, self.qd)


def seconds_of(name: str, value: float, low: float = -math.inf) -> float:
    """Return a time [s], or refuse what is none."""
    if isinstance(value, bool) or not isinstance(value, Real) or not value >= low:
        limit = "" if math.isinf(low) else f" >= {low:g}"
        raise ValueError(f"{name} must be a number{limit} in s, got {format_value(value)}")
    return float(value)


def first_damping(robot: Robot) -> float:
    """Return the share of critical damping that is added to a robot unless somebody changes it."""
    return 0.0 if is_damped(robot) else ADDED_DAMPING


def _damped(robot: Robot, formulation: str, share: float) -> Robot:
    """Return the robot with a share of the critical damping of each strain added to its own."""
    if share == 0.0:
        return robot
    model = LiveModel(robot, formulation)
    mass, stiffness = (
        np.diag(matrix) for matrix in (model.mass_matrix(model.rest_shape), model.elastic_stiffness)
    )
    sections = []
    for i, section in enumerate(robot.sections, start=1):
        own = {name.format(i): field for name, field in DAMPINGS.items()}
        added = {
            own[name]: getattr(section, own[name]) + 2.0 * share * math.sqrt(k * m)
            for name, k, m in zip(model.coordinate_names, stiffness, mass, strict=True)
            if name in own
        }
        sections.append(replace(section, **added))
    return replace(robot, sections=tuple(sections))


def command_ranges(model: LiveModel, commands: FloatArray) -> list[tuple[float, float]]:
    """Return the range of each cable's slider, wide enough for commands (N, num_cables).

    A tension goes from nothing to what bends the softest section passed by MOST_BENT; a length
    from what bends all sections passed so, to as much as that over ten longer.
    """
    ranges = []
    rest = model.rest_command()
    for j, cable in enumerate(model.robot.all_cables):
        passed = model.robot.sections[cable.start_section : cable.end_section + 1]
        if cable.length_driven:
            stroke = cable.farthest * MOST_BENT
            low, high = max(0.0, rest[j] - stroke), rest[j] + stroke / 10.0
        else:
            softest = min(section.stiffness for section in passed)
            low, high = 0.0, round_up(softest * MOST_BENT / cable.farthest)
        column = commands[:, j]
        ranges.append((min(low, *column), max(high, *column)))
    return ranges


def round_up(value: float) -> float:
    """Return the least of ..., 0.5, 1, 2, 5, 10, ... that is not less than a value > 0."""
    power = 10.0 ** math.floor(math.log10(value))
    return float(next(m * power for m in (1, 2, 5, 10) if m * power >= value * (1 - 1e-9)))


def circling(ranges: list[tuple[float, float]], model: LiveModel, time: float) -> FloatArray:
    """Return commands (num_cables,) that lead a robot round in a circle, begun gently."""
    share = CIRCLING / model.num_sections * min(1.0, time / RAMP)
    rest, command = model.rest_command(), []
    for j, (cable, (low, high)) in enumerate(zip(model.robot.all_cables, ranges, strict=True)):
        angle = np.mean(cable.route(cable.end_section)[1])
        pulled = share * max(0.0, np.cos(2.0 * np.pi * time / CIRCLE - angle))
        toward = low if cable.length_driven else high
        command.append(rest[j] + pulled * (toward - rest[j]))
    return np.array(command)
