"""Parts of a rod keep what it is: volumes, routings, dampings, shapes at rest and states."""

from dataclasses import replace

import numpy as np
import pytest

import cdcr

# Sums of some twenty terms, rounded a dozen times each.
ROUNDING = 1e-13
# What is summed up at 32 nodes of a part and of the whole, after a few roundings.
AT_NODES = 1e-10

ROD = cdcr.Section(
    length=0.3,
    backbone_mass=0.02,
    backbone_diameter=(0.006, 0.004),
    backbone_inner_diameter=0.002,
    youngs_modulus=2e8,
    shear_modulus=7e7,
    damping=1e-3,
    twist_damping=2e-3,
    stretch_damping=0.4,
    material_damping=0.01,
    bending_order=2,
    twist_order=1,
    stretch_order=0,
    rest_bending=(0.3, -0.2),
    rest_twist=0.1,
    nodes=32,
)
ARC = cdcr.Section(length=0.2, backbone_mass=0.01, backbone_diameter=0.003, youngs_modulus=2e8)
CABLES = (
    cdcr.Cable(radius=[(0.01, 0.008)], angle=[(0.2, 1.7)], end_section=0),
    cdcr.Cable(radius=0.01, angle=[(0.0, 1.0), (2.0, 1.5)], end_section=1, stiffness=1e3),
    cdcr.Cable(radius=0.01, angle=2.0, start_section=1, end_section=1),
)
ROBOT = cdcr.Robot(sections=[ROD, ARC], cables=CABLES, gravity=(1.0, 2.0, -9.0), payload=0.01)
PARTS = [3, 2]
Q = np.array([0.5, -0.4, 0.2, 0.1, -0.1, 0.3, 0.2, -0.1, 0.01, 0.4, 0.1])
QD = Q[::-1].copy()


def test_shape_energy_and_power_are_those_of_the_whole() -> None:
    whole, cut = cdcr.Model(ROBOT), cdcr.Model(ROBOT.subdivide(PARTS))
    q, qd = (cdcr.subdivide_state(ROBOT, PARTS, x) for x in (Q, QD))
    assert np.abs(cut.tip(q)[1] - whole.tip(Q)[1]).max() <= AT_NODES
    assert np.abs(cut.cable_lengths(q) - whole.cable_lengths(Q)).max() <= AT_NODES
    assert cut.potential_energy(q) == pytest.approx(whole.potential_energy(Q), rel=AT_NODES)
    assert cut.kinetic_energy(q, qd) == pytest.approx(whole.kinetic_energy(Q, QD), rel=AT_NODES)
    # What damping takes: that of the bias which changes its sign with the rates.
    power = [
        state[1] @ (model.bias(*state) - model.bias(state[0], -state[1]))
        for model, state in ((whole, (Q, QD)), (cut, (q, qd)))
    ]
    assert power[1] == pytest.approx(power[0], rel=AT_NODES)


def test_rest_and_taper_go_on_from_part_to_part() -> None:
    robot = ROBOT.subdivide(PARTS)
    rods = robot.sections[:3]
    assert [section.diameters[0] for section in rods[1:]] == [one.diameters[1] for one in rods[:2]]
    assert (rods[0].diameters[0], rods[-1].diameters[1]) == ROD.diameters
    assert sum(section.mass for section in rods) == pytest.approx(ROD.mass, rel=ROUNDING)
    rest = cdcr.subdivide_state(ROBOT, PARTS, cdcr.Model(ROBOT).rest_shape)
    assert np.abs(cdcr.Model(robot).rest_shape - rest).max() <= ROUNDING


def test_cables_begin_and_end_where_they_did() -> None:
    cables = ROBOT.subdivide(PARTS).cables
    assert [(one.start_section, one.end_section) for one in cables] == [(0, 2), (0, 4), (3, 4)]
    assert cables[0].route(0)[1] == pytest.approx((0.2, 0.7))
    assert cables[1].route(4) == ((0.01, 0.01), (1.75, 1.5))
    assert cables[2].angle == 2.0


def test_states_of_parts_are_merged() -> None:
    cut = cdcr.subdivide_state(ROBOT, PARTS, np.stack([Q, QD]))
    assert np.abs(cdcr.merge_state(ROBOT, PARTS, cut) - [Q, QD]).max() <= ROUNDING
    # Parts that do what no whole section can: as much together, and a remainder that is square to
    # all that a section can do.
    other = np.random.default_rng(4).uniform(-0.3, 0.3, (31,))
    merged = cdcr.merge_state(ROBOT, PARTS, other)
    rod = other[:27].reshape(3, 9)
    together = [0, 1, 6, 8]
    assert np.abs(merged[together] - np.sum(rod[:, together], axis=0)).max() <= ROUNDING
    rest = other - cdcr.subdivide_state(ROBOT, PARTS, merged)
    assert np.abs(cdcr.merge_state(ROBOT, PARTS, rest)).max() <= ROUNDING
    with pytest.raises(ValueError, match=r"q must have shape \(\.\.\., 31\), got \(11,\)"):
        cdcr.merge_state(ROBOT, PARTS, np.zeros(11))
    with pytest.raises(ValueError, match=r"q must have shape \(\.\.\., 11\), got \(4,\)"):
        cdcr.subdivide_state(ROBOT, PARTS, np.zeros(4))


def test_many_states_at_once() -> None:
    cut = cdcr.subdivide_state(ROBOT, PARTS, np.stack([Q, QD]))
    assert np.array_equal(cut[1], cdcr.subdivide_state(ROBOT, PARTS, QD))
    rigid = replace(ROBOT, sections=(replace(ROD, bending_order=None, twist_order=None), ARC))
    assert cdcr.subdivide_state(rigid, 2, [0.3, 1.0, 0.0]).shape == (6,)
