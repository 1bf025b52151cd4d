"""Laws of mechanics on robots and states that hypothesis makes up."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import cdcr

FloatArray = NDArray[np.float64]

# A handful of operations on numbers of the size of the scale.
ROUNDING = 1e-14
# Longer chains of them.
SOLVED = 1e-13
# Central differences with a step of 1e-5: step^2 of truncation, 1e-16/step of rounding.
DIFFERENCES = 1e-8

laws = settings(max_examples=60, deadline=None)


def numbers(low: float, high: float) -> st.SearchStrategy[float]:
    """Finite numbers, without those whose squares underflow."""
    return st.floats(low, high).map(lambda value: value if abs(value) > 1e-100 else 0.0)


@st.composite
def robots(draw: st.DrawFn, damped: bool = True) -> cdcr.Robot:
    length = draw(numbers(0.05, 2.0))
    section = cdcr.Section(
        length=length,
        backbone_mass=draw(numbers(1e-3, 1.0)),
        backbone_diameter=length * draw(numbers(1e-3, 0.1)),
        youngs_modulus=draw(numbers(1e7, 2e11)),
        disk_mass=draw(numbers(0.0, 0.1)),
        disk_diameter=length * draw(numbers(0.0, 0.5)),
        num_disks=draw(st.integers(0, 64)),
        cable_radius=length * draw(numbers(1e-3, 0.2)),
        cable_angles=draw(st.lists(numbers(-7.0, 7.0), max_size=16)),
        damping=draw(numbers(0.0, 1.0)) if damped else 0.0,
    )
    gravity = draw(st.tuples(*[numbers(-10.0, 10.0)] * 3))
    return cdcr.Robot(sections=[section], gravity=gravity, payload=draw(numbers(0.0, 1.0)))


@st.composite
def bendings(draw: st.DrawFn, limit: float = 2.0 * math.pi) -> FloatArray:
    theta = draw(st.one_of(st.sampled_from([0.0, 1e-9, 1e-4]), numbers(0.0, limit)))
    return np.asarray(cdcr.bending(theta, draw(numbers(-math.pi, math.pi))), dtype=float)


def vectors(size: int, magnitude: float) -> st.SearchStrategy[FloatArray]:
    values = st.lists(numbers(-magnitude, magnitude), min_size=size, max_size=size)
    return values.map(lambda v: np.array(v, dtype=float))


def with_three_cables(robot: cdcr.Robot) -> cdcr.Robot:
    angles = (0.0, 2.0 * math.pi / 3.0, 4.0 * math.pi / 3.0)
    return replace(robot, sections=(replace(robot.sections[0], cable_angles=angles),))


def stiffness(robot: cdcr.Robot) -> float:
    """Bending stiffness E I / length [N m/rad]."""
    section = robot.sections[0]
    area_moment = math.pi * section.backbone_diameter**4 / 64.0
    return section.youngs_modulus * area_moment / section.length


def weight_moment(robot: cdcr.Robot) -> float:
    """The most that the weight can weigh in at the base [N m]."""
    section = robot.sections[0]
    mass = robot.payload + section.backbone_mass + section.num_disks * section.disk_mass
    return mass * section.length * float(np.linalg.norm(robot.gravity))


def largest(values: object) -> float:
    return float(np.abs(np.asarray(values)).max(initial=0.0))


@laws
@given(robots(), bendings())
def test_mass_matrix_is_symmetric_and_positive_definite(robot: cdcr.Robot, q: FloatArray) -> None:
    M = cdcr.Model(robot).mass_matrix(q)
    assert np.array_equal(M, M.T)
    assert np.linalg.eigvalsh(M).min() > 0.0


@laws
@given(robots(), bendings(), vectors(2, 10.0), vectors(2, 100.0))
def test_forward_dynamics_undoes_inverse_dynamics(
    robot: cdcr.Robot, q: FloatArray, qd: FloatArray, qdd: FloatArray
) -> None:
    # Tensions cannot give every force: take three cables and add what keeps all of them pulling.
    model = cdcr.Model(with_three_cables(robot))
    B = model.actuation_matrix()
    tension = np.linalg.pinv(B) @ model.inverse_dynamics(q, qd, qdd)
    tension += max(0.0, -tension.min())
    again = model.forward_dynamics(q, qd, tension)
    eigenvalues = np.linalg.eigvalsh(model.mass_matrix(q))
    forces = largest(B) * largest(tension) + largest(model.bias(q, qd))
    scale = (eigenvalues.max() * largest(qdd) + forces) / eigenvalues.min()
    assert largest(again - qdd) <= SOLVED * scale


@laws
@given(robots(), bendings(), vectors(2, 10.0), vectors(2, 100.0))
def test_inverse_dynamics_is_mass_times_acceleration_plus_bias(
    robot: cdcr.Robot, q: FloatArray, qd: FloatArray, qdd: FloatArray
) -> None:
    model = cdcr.Model(robot)
    M, h = model.mass_matrix(q), model.bias(q, qd)
    force = model.inverse_dynamics(q, qd, qdd)
    assert largest(force - (M @ qdd + h)) <= ROUNDING * (largest(M) * largest(qdd) + largest(h))


@laws
@given(robots(), bendings(), vectors(2, 10.0))
def test_kinetic_energy_is_half_qd_M_qd(robot: cdcr.Robot, q: FloatArray, qd: FloatArray) -> None:
    model = cdcr.Model(robot)
    M = model.mass_matrix(q)
    energy = model.kinetic_energy(q, qd)
    assert abs(energy - 0.5 * qd @ M @ qd) <= ROUNDING * largest(M) * (qd @ qd)
    assert energy >= 0.0


@laws
@given(robots(damped=False), bendings(), vectors(2, 10.0), numbers(-math.pi, math.pi))
def test_turning_everything_about_z_turns_the_force(
    robot: cdcr.Robot, q: FloatArray, qd: FloatArray, angle: float
) -> None:
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    x, y = turn @ np.array(robot.gravity[:2])
    turned = replace(robot, gravity=(x, y, robot.gravity[2]))
    model = cdcr.Model(robot)
    h = model.bias(q, qd)
    h_turned = cdcr.Model(turned).bias(turn @ q, turn @ qd)
    # The terms of h may cancel each other, so the scale is theirs.
    scale = stiffness(robot) * largest(q) + weight_moment(robot) + model.kinetic_energy(q, qd)
    assert largest(turn @ h - h_turned) <= SOLVED * scale


@laws
@given(robots(), bendings(), vectors(2, 1.0))
def test_tensions_pull_where_cables_shorten(
    robot: cdcr.Robot, q: FloatArray, qd: FloatArray
) -> None:
    model = cdcr.Model(robot)
    ahead, behind = model.cable_lengths(q + 0.5 * qd), model.cable_lengths(q - 0.5 * qd)
    rate = ahead - behind  # lengths are linear in q
    expected = -model.actuation_matrix().T @ qd
    assert largest(rate - expected) <= ROUNDING * (robot.sections[0].length + largest(expected))


@laws
@given(robots(), bendings())
def test_inverse_kinematics_finds_the_way_back(robot: cdcr.Robot, q: FloatArray) -> None:
    model = cdcr.Model(robot)
    _, p = model.tip(q)
    answer = model.inverse_kinematics(p)
    assert answer.reachable
    assert answer.distance <= ROUNDING * robot.sections[0].length
    assert largest(model.tip(answer.q)[1] - p) <= ROUNDING * robot.sections[0].length


@laws
@given(robots(), bendings(limit=math.pi), vectors(2, 5.0))
def test_linearisation_matches_differences(
    robot: cdcr.Robot, q: FloatArray, qd: FloatArray
) -> None:
    model = cdcr.Model(with_three_cables(robot))
    tension = np.array([1.0, 0.5, 0.0])
    A, B = model.linearize(q, qd, tension)
    step = 1e-5
    accelerations = model.forward_dynamics(q, qd, tension)
    scale = largest(A) + largest(accelerations)
    for k, change in enumerate(step * np.eye(2)):
        for column, dq, dqd in ((A[2:, k], change, 0.0), (A[2:, 2 + k], 0.0, change)):
            ahead = model.forward_dynamics(q + dq, qd + dqd, tension)
            behind = model.forward_dynamics(q - dq, qd - dqd, tension)
            numeric = (ahead - behind) / (2.0 * step)
            assert largest(column - numeric) <= DIFFERENCES * scale
    assert B.shape == (4, 3)


@laws
@given(robots(), numbers(0.0, 0.3))
def test_equilibrium_balances_the_forces(robot: cdcr.Robot, pull: float) -> None:
    model = cdcr.Model(with_three_cables(robot))
    # Weaker than the backbone, so that there is an equilibrium within the bending limit.
    assume(weight_moment(robot) < stiffness(robot))
    moment = pull * stiffness(robot)
    tension = np.array([moment / robot.sections[0].cable_radius, 0.0, 0.0])
    q = model.equilibrium(tension)
    unbalanced = model.bias(q, np.zeros(2)) - model.actuation_matrix() @ tension
    assert largest(unbalanced) <= SOLVED * (stiffness(robot) + weight_moment(robot))
