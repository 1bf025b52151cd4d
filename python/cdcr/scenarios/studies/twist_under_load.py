"""A bent robot under a sideways load: one arc, a rod, and a rod that twists."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.model.model import Model
from cdcr.model.wrench import Wrench
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

TENSION = (20.0, 0.0, 0.0)  # [N]
LOADS = np.linspace(0.0, 0.4, 9)  # sideways, on the tip [N]
# What a section does, and which fields of the scenario's that changes.
KINDS: dict[str, dict[str, Any]] = {
    "one arc": {"bending_order": 0, "twist_order": None},
    "rod without twist": {"twist_order": None},
    "rod": {},
}


class Answer(NamedTuple):
    """Shapes of rest under each of the loads."""

    model: Model
    q: FloatArray  # (loads, d)
    moved: FloatArray  # (loads,) sideways, the tip [m]
    turned: FloatArray  # (loads,) angle between the tip's frame and that without load [rad]


def answers(scenario: Scenario) -> dict[str, Answer]:
    """Return the answer of each kind of section."""
    return {kind: _answer(scenario, changes) for kind, changes in KINDS.items()}


def twist(answer: Answer) -> FloatArray:
    """Return the twist from base to tip of a rod under each of the loads (loads,) [rad]."""
    return np.asarray(answer.q[:, answer.model.coordinate_names.index("t1")])


def _answer(scenario: Scenario, changes: dict[str, Any]) -> Answer:
    robot = scenario.robot
    sections = tuple(replace(section, **changes) for section in robot.sections)
    model = Model(replace(robot, sections=sections))
    q = [model.equilibrium(TENSION)]
    for load in LOADS[1:]:
        pull = Wrench(section=0, force=(0.0, float(load), 0.0))
        q.append(model.equilibrium(TENSION, q[-1], pull))
    frames = [model.tip(shape) for shape in q]
    cosines = [(np.trace(frames[0][0].T @ R) - 1.0) / 2.0 for R, _ in frames]
    moved = np.array([p[1] for _, p in frames])
    return Answer(model, np.array(q), moved, np.arccos(np.clip(cosines, -1.0, 1.0)))


def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    """Return how far the largest load moves and turns the tip, and twists the rod."""
    found, all_of_them = [], answers(scenario)
    for kind, answer in all_of_them.items():
        key = kind.replace(" ", "_")
        moved, turned = 1e3 * float(answer.moved[-1]), float(np.rad2deg(answer.turned[-1]))
        found += [
            Metric(f"{key}_moved_mm", f"{kind}: tip moved sideways", moved, "mm"),
            Metric(f"{key}_turned_deg", f"{kind}: tip turned", turned, "deg"),
        ]
    twisted = float(np.rad2deg(twist(all_of_them["rod"])[-1]))
    return (*found, Metric("twist_deg", "rod: twist from base to tip", twisted, "deg"))
