"""Scenarios of rods: what they tell holds by other means."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp  # type: ignore[import-untyped]
from scipy.optimize import root  # type: ignore[import-untyped]

import cdcr
from cdcr.scenarios.studies import (
    helical_cable,
    precurved_tube,
    subdivision,
    tapered_arm,
    twist_under_load,
)
from scenario_runs import told

PICTURES = ("helical-cable", "twist-under-load", "tapered-arm", "precurved-tube")
TIMOSHENKO = 2e-3  # what orders 3 and 2 leave of a curved bar, relative
STRAIGHT = 0.1  # bending changes the twist by less, relative


def test_a_sideways_load_turns_and_twists_as_kirchhoff_says() -> None:
    """The rod's equations solved along it, by shooting, with the cable's pull on the tip disk."""
    scenario, _, found = told("twist-under-load")
    (section,), load = scenario.robot.sections, float(twist_under_load.LOADS[-1])
    area = section.second_moment_of_area
    assert section.shear_modulus is not None
    EI, GJ = section.youngs_modulus * area, 2.0 * section.shear_modulus * area
    l, hole = section.length, np.array([section.cable_radius, 0.0, 0.0])
    force = np.array([0.0, load, 0.0])  # in the base frame

    def slope(_: float, y: np.ndarray) -> np.ndarray:
        R, m = y[3:12].reshape(3, 3), y[12:]  # m is the moment in the rod, base frame
        local = R.T @ m
        # The cable runs parallel to the backbone: its tension bends with r x F t everywhere.
        u = np.array([local[0] / EI, local[1] / EI, local[2] / GJ])
        own = u + np.cross(hole, [0.0, 0.0, -twist_under_load.TENSION[0]]) / [EI, EI, GJ]
        skew = np.array([[0, -own[2], own[1]], [own[2], 0, -own[0]], [-own[1], own[0], 0]])
        return np.concatenate([R[:, 2], (R @ skew).ravel(), -np.cross(R[:, 2], force)])

    def end(m0: np.ndarray) -> np.ndarray:
        start = np.concatenate([np.zeros(3), np.eye(3).ravel(), m0])
        return np.asarray(solve_ivp(slope, (0.0, l), start, rtol=1e-8, atol=1e-10).y[:, -1])

    tip = end(root(lambda m0: end(m0)[12:], np.zeros(3), tol=1e-8).x)[:3]
    assert 1e3 * tip[1] == pytest.approx(found["rod_moved_mm"], rel=0.01)
    assert found["one_arc_moved_mm"] < 0.7 * 1e3 * tip[1]
    assert found["rod_without_twist_moved_mm"] < 0.9 * 1e3 * tip[1]


def test_a_tapered_arm_bends_as_its_moment_says() -> None:
    scenario, _, found = told("tapered-arm")
    F, E = tapered_arm.TENSIONS[-1], 1e6
    ratio = found["exact_tip"] / found["exact_base"]
    assert found["exact_base"] == pytest.approx(F * 0.014 / (E * np.pi / 64 * 0.012**4), rel=1e-3)
    assert ratio == pytest.approx(8.0, rel=1e-3)
    errors = [found[f"order_{order}_mm"] for order in tapered_arm.ORDERS]
    assert all(better < worse / 3.0 for worse, better in pairwise(errors))
    assert errors[-1] < 0.5
    assert scenario.robot.length == 0.4


def test_a_curved_tube_moves_as_timoshenkos() -> None:
    scenario, _, found = told("precurved-tube")
    assert found["compliance_mm_N"] == pytest.approx(found["exact_mm_N"], rel=TIMOSHENKO)
    # A cable takes its moment over the stiffness from the angle at rest.
    (section,) = scenario.robot.sections
    pulled = np.rad2deg(np.pi / 2 - precurved_tube.TENSIONS[-1] * 0.004 / section.stiffness)
    assert found["theta_pulled_deg"] == pytest.approx(pulled, rel=1e-6)


def test_a_helical_cable_twists_against_its_winding() -> None:
    scenario, run, found = told("helical-cable")
    assert run.success
    assert found["left_mm"] < 1e-3 * found["moved_mm"]
    rest = scenario.model.equilibrium([4.0])
    twist = rest[scenario.model.coordinate_names.index("t1")]
    straight = helical_cable.twist_of_straight(scenario, 4.0)
    assert straight < 0.0
    assert twist == pytest.approx(straight, rel=STRAIGHT)
    # Alone, without bending, it is the same.
    (section,) = scenario.robot.sections
    stiff = replace(scenario.robot, sections=(replace(section, bending_order=None),))
    (only, _) = cdcr.Model(stiff).equilibrium([4.0])
    assert only == pytest.approx(straight, rel=1e-8)


def test_orders_come_nearer_to_the_beam_than_parts() -> None:
    stated = {(1, 0): 0.355, (2, 0): 0.023, (2, 1): 0.517, (3, 1): 0.405}
    for (order, mode), percent in stated.items():
        found = 100.0 * subdivision.order_excess(order)[mode]
        assert found == pytest.approx(percent, abs=0.001)
    assert abs(subdivision.order_excess(3)[0]) < 1e-5 < subdivision.excess(16)[0]


@pytest.mark.parametrize("name", PICTURES)
def test_pictures_are_labelled_in_a_column_too(name: str) -> None:
    pytest.importorskip("matplotlib")
    scenario, run, _ = told(name)
    figure = scenario.figure(run, size="journal")
    assert scenario.title.split()[0] in figure.get_suptitle()
    for axes in figure.axes:
        assert axes.get_ylabel().rstrip().endswith("]")
