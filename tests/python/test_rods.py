"""Rods through the public names, against an independent model at 55 digits (tests/data)."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

# What 12 nodes and 32 leave of the accelerations, relative to their largest; cpp/rods.md.
DEFAULT, MANY = 1e-7, 4e-10
# Statics at 32 nodes.
STATIC = 1e-9
# An arc by the general recursions: some hundred roundings.
ARC = 1e-12

DATA = Path(__file__).parents[1] / "data"
CASES = json.loads((DATA / "general_sections.json").read_text(encoding="utf-8"))
ORDERS = ("bending_order", "twist_order", "stretch_order")


def robot_of(case: dict[str, Any], nodes: int | None) -> cdcr.Robot:
    def fields(one: dict[str, Any]) -> dict[str, Any]:
        return {key: None if key in ORDERS and one[key] == -1 else one[key] for key in one}

    sections = [cdcr.Section(**fields(one), nodes=nodes) for one in case["sections"]]
    cables = [cdcr.Cable(**one | {"end_section": one["end_section"] - 1}) for one in case["cables"]]
    return cdcr.Robot(
        sections=sections, cables=cables, gravity=case["gravity"], payload=case["payload"]
    )


def off(found: Any, wanted: Any) -> float:
    return float(np.abs(np.asarray(found) - wanted).max() / np.abs(wanted).max())


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_cases_of_others(case: dict[str, Any]) -> None:
    state = case["q"], case["qd"], case["tension"]
    found = cdcr.Model(robot_of(case, None)).forward_dynamics(*state)
    assert off(found, case["qdd"]) <= DEFAULT
    model = cdcr.Model(robot_of(case, 32))
    assert off(model.forward_dynamics(*state), case["qdd"]) <= MANY
    R, p = model.tip(case["q"])
    assert off(p, case["tip_position"]) <= STATIC
    assert off(R, case["tip_rotation"]) <= STATIC
    assert off(model.mass_matrix(case["q"]), case["mass_matrix"]) <= STATIC
    assert off(model.cable_lengths(case["q"]), case["cable_lengths"]) <= STATIC
    assert off(model.potential_energy(case["q"]), case["potential_energy"]) <= STATIC
    pull = model.actuation_matrix(case["q"]) @ case["tension"]
    assert off(pull, case["cable_force"]) <= STATIC


def test_an_arc_is_a_rod_of_order_0() -> None:
    robot = cdcr.robots.three_sections()
    rod = replace(robot, sections=tuple(replace(one, nodes=32) for one in robot.sections))
    q, qd = np.linspace(-0.8, 0.9, 6), np.linspace(2.0, -1.0, 6)
    arcs, rods = cdcr.Model(robot), cdcr.Model(rod)
    assert rods.has_rods
    tension = np.linspace(0.5, 4.0, 9)
    wanted = arcs.forward_dynamics(q, qd, tension)
    assert off(rods.forward_dynamics(q, qd, tension), wanted) <= ARC


def test_angles_are_those_of_the_first_bending_vectors() -> None:
    section = replace(cdcr.robots.amouri2020().sections[0], bending_order=1, stretch_order=0)
    rigid = replace(section, bending_order=None, stretch_order=None)
    model = cdcr.Model(cdcr.Robot(sections=[rigid, section]))
    assert model.coordinate_names == ("q2_x", "q2_y", "q2_x_1", "q2_y_1", "e2")
    q = model.coordinates(cdcr.bending([0.0, 0.5], [0.0, 2.0]))
    theta, phi = model.polar(q + np.array([0.0, 0.0, 0.3, 0.2, 0.01]))
    assert np.abs(theta - [0.0, 0.5]).max() <= ARC
    assert np.abs(phi - [0.0, 2.0]).max() <= ARC
    with pytest.raises(ValueError, match="bending of section 1 must be 0 rad, which is locked"):
        model.coordinates([0.1, 0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match=r"bending must have shape \(\.\.\., 4\), got \(5,\)"):
        model.coordinates(q)
    with pytest.raises(ValueError, match=r"q must have shape \(\.\.\., 5\), got \(4,\)"):
        model.bending_vectors(np.zeros(4))
