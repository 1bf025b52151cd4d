"""One section cut into more and more parts, or given a higher order: towards a beam."""

from __future__ import annotations

import time
from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from cdcr._core import max_sections
from cdcr.base.arrays import FloatArray
from cdcr.base.check import count
from cdcr.model.model import Model
from cdcr.robots import amouri2020
from cdcr.runs.simulate import MethodName, simulate
from cdcr.runs.trajectory import Trajectory
from cdcr.scenarios.metrics import Metric

if TYPE_CHECKING:
    from cdcr.scenarios.scenario import Scenario

COUNTS = tuple(range(1, 11))
SHOWN = 3  # planar modes
STEPS = (1, 2, 4, 8)  # parts whose step responses are shown
TENSION = 5.0  # on cable 1 [N]
DAMPING = 5e-4  # of the whole section, in the step responses [N m s/rad]
END, SAMPLES = 2.0, 1001  # of the step responses [s]
PARTS, ORDERS = (1, 2, 4, 8, 16), (1, 2, 3)  # compared by coordinates and by time
METHODS: tuple[MethodName, ...] = ("dopri5", "bdf")  # of which the faster counts
TIMED = 2  # runs, of which the fastest counts


def model_of(parts: int, damping: float = 0.0) -> Model:
    """Return the robot of Table 1, its section cut into parts."""
    return Model(amouri2020(damping=damping).subdivide(parts))


def rod(order: int, damping: float = 0.0) -> Model:
    """Return the robot of Table 1 whose one section has an order of bending."""
    robot = amouri2020(damping=damping)
    return Model(replace(robot, sections=(replace(robot.sections[0], bending_order=order),)))


@lru_cache(maxsize=64)
def frequencies(parts: int) -> FloatArray:
    """Return the natural frequencies in one plane about straight, up to three [rad/s]."""
    return _frequencies(model_of(parts))


def _frequencies(model: Model) -> FloatArray:
    """Return those of a model; each comes twice, in the two planes."""
    modes = model.modes(np.zeros(model.num_coordinates), np.zeros(model.num_cables))
    return modes.frequency[0::2][:SHOWN]


@lru_cache(maxsize=1)
def beam() -> FloatArray:
    """Return those of a beam that bends freely, with the same masses (3,) [rad/s].

    The limit of many parts by Richardson's extrapolation from 16 and 32: errors fall with the
    square of the number of parts.
    """
    half, full = frequencies(max_sections // 2), frequencies(max_sections)
    return full + (full - half) / 3.0


def excess(parts: int) -> FloatArray:
    """Return by which share the frequencies of that many parts are too high, up to three [1]."""
    found = frequencies(parts)
    return found / beam()[: len(found)] - 1.0


@lru_cache(maxsize=8)
def order_excess(order: int) -> FloatArray:
    """Return the same of one section of an order of bending, up to three [1]."""
    found = _frequencies(rod(order))
    return found / beam()[: len(found)] - 1.0


def order(mode: int) -> float:
    """Return the power of 1/parts with which the excess falls, over the last doubling shown."""
    few, many = COUNTS[-1] // 2, COUNTS[-1]
    return float(np.log2(excess(few)[mode] / excess(many)[mode]))


@lru_cache(maxsize=1)
def responses() -> dict[int, Trajectory]:
    """Return the damped robot under a step of tension, by number of parts."""
    t = np.linspace(0.0, END, SAMPLES)
    return {parts: _respond(model_of(parts, DAMPING), t, rtol=1e-8, atol=1e-10) for parts in STEPS}


def _respond(model: Model, t: FloatArray, **options: Any) -> Trajectory:
    rest = np.zeros(model.num_coordinates)
    return simulate(model, rest, rest, t=t, tension=(TENSION, 0.0, 0.0), **options)


@lru_cache(maxsize=1)
def processor_times() -> dict[str, dict[int, float]]:
    """Return the processor time that the response takes, by parts and by orders [s]."""
    return {
        "parts": {parts: _processor_time(model_of(parts, DAMPING)) for parts in PARTS},
        "orders": {order: _processor_time(rod(order, DAMPING)) for order in ORDERS},
    }


def _processor_time(model: Model) -> float:
    """Return that of the fastest of several runs, by the faster method [s]."""
    spans = []
    for method in METHODS:
        for _ in range(TIMED):
            start = time.thread_time()
            _respond(model, np.array([0.0, END]), method=method, rtol=1e-6, atol=1e-8)
            spans.append(time.thread_time() - start)
    return min(spans)


def summarize(scenario: Scenario, run: None) -> tuple[Metric, ...]:
    """Return frequencies, by how much parts miss them, and how responses come together."""
    found = []
    for mode, frequency in enumerate(beam()):
        name = f"mode {mode + 1}"
        found.append(
            Metric(f"beam_{mode + 1}_rad_s", f"{name} of the beam", float(frequency), "rad/s")
        )
        for parts in COUNTS[mode:]:
            percent = 100.0 * float(excess(parts)[mode])
            label = f"{name}: too high with {count(parts, 'part')}"
            found.append(Metric(f"excess_{mode + 1}_of_{parts}", label, percent, "%"))
        found.append(Metric(f"order_{mode + 1}", f"{name}: order of convergence", order(mode), ""))
    for k in ORDERS:
        for mode, share in enumerate(order_excess(k)):
            label = f"mode {mode + 1}: too high with bending order {k}, {2 * (k + 1)} coordinates"
            key = f"excess_{mode + 1}_of_order_{k}"
            found.append(Metric(key, label, 100.0 * float(share), "%"))
    for mode, share in enumerate(excess(PARTS[-1])):
        label = f"mode {mode + 1}: too high with {PARTS[-1]} parts, {2 * PARTS[-1]} coordinates"
        key = f"excess_{mode + 1}_of_{PARTS[-1]}"
        found.append(Metric(key, label, 100.0 * float(share), "%"))
    for parts, span in processor_times()["parts"].items():
        label = f"processor time of {END:g} s of motion with {count(parts, 'part')}"
        found.append(Metric(f"time_{parts}_ms", label, 1e3 * span, "ms"))
    for k, span in processor_times()["orders"].items():
        label = f"processor time of {END:g} s of motion with bending order {k}"
        found.append(Metric(f"time_order_{k}_ms", label, 1e3 * span, "ms"))
    finest = responses()[STEPS[-1]]
    for parts, other in responses().items():
        away = 1e3 * float(np.max(np.abs(other.tip - finest.tip)))
        if parts != STEPS[-1]:
            label = f"step: tip of {parts} from that of {STEPS[-1]} parts, at most"
            found.append(Metric(f"step_{parts}_mm", label, away, "mm"))
    return tuple(found)
