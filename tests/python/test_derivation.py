"""The derivation of cpp/README.md, equation by equation.

The reference is the origin paper's eqs. (1) and (2) with the energies of the elements of a section,
differentiated by small steps at 80 digits. Each test compares the closed form of one equation,
written here as the README writes it, with that reference, and the compiled model with both.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from mpmath.ctx_mp import MPContext  # type: ignore[import-untyped]

import cdcr

Real = Any  # a number of mp
Matrix = Any  # a matrix of mp

mp = MPContext()  # of our own: other tests keep their precision
mp.dps = 80
STEP = mp.mpf(10) ** -20  # of central differences, good to 40 digits
SAME = mp.mpf(10) ** -30  # closed forms against differences, of differences too
DOUBLE = 1e-14  # the compiled model: rounding of some dozen operations


def numbers(*values: float) -> Matrix:
    return mp.matrix([mp.mpf(value) for value in values])


# One robot that has everything, three states, and the pull of gravity from an odd direction.
SECTION = cdcr.Section(
    length=0.7,
    backbone_mass=0.04,
    backbone_diameter=0.02,
    youngs_modulus=2e7,
    disk_mass=0.03,
    disk_diameter=0.1,
    num_disks=3,
    cable_radius=0.04,
    cable_angles=(0.3, 2.0, 4.5),
    damping=0.01,
)
ROBOT = cdcr.Robot(sections=[SECTION], gravity=(3.0, -4.0, -8.0), payload=0.05)
MODEL = cdcr.Model(ROBOT)
LENGTH = mp.mpf(SECTION.length)
GRAVITY = numbers(*ROBOT.gravity)
STATES = [
    (numbers(0.7, -0.4), numbers(1.5, 2.5)),
    (numbers(-2.1, 1.3), numbers(-3.0, 0.7)),
    (numbers(1.9, 5.1), numbers(0.2, -4.0)),
]
each_state = pytest.mark.parametrize(("q", "qd"), STATES)
each_fraction = pytest.mark.parametrize("x", [mp.mpf(f) for f in ("0.35", "0.8", "1")])


# --- The reference: the paper's kinematics, elements, and differences -----------------------------


def turn(axis: int, angle: Real) -> Matrix:
    c, s = mp.cos(angle), mp.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R = mp.eye(3)
    R[i, i], R[i, j], R[j, i], R[j, j] = c, -s, s, c
    return R


def paper_position(q: Matrix, x: Real) -> Matrix:
    """Paper eq. (1)."""
    theta, phi = mp.norm(q), mp.atan2(q[1], q[0])
    bow = LENGTH / theta * (1 - mp.cos(x * theta))
    return numbers(bow * mp.cos(phi), bow * mp.sin(phi), LENGTH / theta * mp.sin(x * theta))


def paper_rotation(q: Matrix, x: Real) -> Matrix:
    """Paper eq. (2)."""
    theta, phi = mp.norm(q), mp.atan2(q[1], q[0])
    return turn(2, phi) * turn(1, x * theta) * turn(2, -phi)


def dot(u: Matrix, v: Matrix) -> Real:
    return mp.fdot(u, v)


def rate(f: Callable[[Matrix], Any], q: Matrix, qd: Matrix) -> Any:
    """Derivative of f along qd."""
    return (f(q + STEP * qd) - f(q - STEP * qd)) / (2 * STEP)


def gradient(f: Callable[[Matrix], Any], q: Matrix) -> Matrix:
    """Derivative of a scalar f, or Jacobian of a vector f with two components."""
    columns = [rate(f, q, e) for e in (numbers(1, 0), numbers(0, 1))]
    if not hasattr(columns[0], "rows"):
        return mp.matrix(columns)
    return mp.matrix([[column[i] for column in columns] for i in (0, 1)])


def elements() -> list[tuple[Real, Real, Real]]:
    """Fraction, mass and transverse inertia of Gauss's rod slices, the disks and the payload."""
    s, parts = SECTION, [(mp.mpf(1), mp.mpf(ROBOT.payload), 0.0)]
    for z, weight in zip(*mp.gauss_quadrature(40, "legendre"), strict=True):
        parts.append(((1 + z) / 2, mp.mpf(s.backbone_mass) * weight / 2, s.backbone_diameter))
    for k in range(1, s.num_disks + 1):
        parts.append((mp.mpf(k) / s.num_disks, mp.mpf(s.disk_mass), s.disk_diameter))
    return [(x, mass, mass * mp.mpf(diameter) ** 2 / 16) for x, mass, diameter in parts]


ELEMENTS = elements()


def velocities(q: Matrix, qd: Matrix, x: Real) -> tuple[Matrix, Matrix]:
    """Linear and angular velocity, the latter from the skew matrix (dR/dt) R^T."""
    spin = rate(lambda p: paper_rotation(p, x), q, qd) * paper_rotation(q, x).T
    angular = numbers(spin[2, 1], spin[0, 2], spin[1, 0])
    return rate(lambda p: paper_position(p, x), q, qd), angular


def kinetic_energy(q: Matrix, qd: Matrix) -> Real:
    """T of the elements, a thin disk's axial inertia being twice its transverse inertia."""
    total = mp.mpf(0)
    for x, mass, I_t in ELEMENTS:
        v, omega = velocities(q, qd, x)
        spin = dot(omega, paper_rotation(q, x)[:, 2])
        total += mass * dot(v, v) + I_t * (dot(omega, omega) - spin**2) + 2 * I_t * spin**2
    return total / 2


# --- The closed forms, as cpp/README.md numbers them ----------------------------------------------


def A(y: Real) -> Real:
    return (1 - mp.cos(y)) / y**2


def S(y: Real) -> Real:
    return mp.sin(y) / y


def D(y: Real) -> Real:
    return (y**2 + 2 - 2 * mp.cos(y) - 2 * y * mp.sin(y)) / y**4


def hat(u: Matrix) -> Matrix:
    return mp.matrix([[0, -u[2], u[1]], [u[2], 0, -u[0]], [-u[1], u[0], 0]])


def z_cross(q: Matrix) -> Matrix:
    return numbers(-q[1], q[0], 0)


def a_b(sigma: Real) -> tuple[Real, Real]:
    """Equations (9) and (10)."""
    theta, a, b = mp.sqrt(sigma), mp.mpf(0), mp.mpf(0)
    for x, m, I_t in ELEMENTS:
        y, I_a, m_l2 = x * theta, 2 * I_t, m * LENGTH**2
        A2, S2 = A(y) ** 2, S(y) ** 2
        a += m_l2 * x**4 * A2 + I_t * x**2 * S2 + I_a * x**4 * sigma * A2
        b += m_l2 * x**6 * (D(y) - A2) / y**2 + I_t * x**4 * (1 - S2) / y**2 - I_a * x**4 * A2
    return a, b


def G_A_S(sigma: Real) -> tuple[Real, Real]:
    """Equations (13) and (14)."""
    theta = mp.sqrt(sigma)
    return (
        mp.fsum(m * x**2 * A(x * theta) for x, m, _ in ELEMENTS),
        mp.fsum(m * x * S(x * theta) for x, m, _ in ELEMENTS),
    )


def slopes(f: Callable[[Real], tuple[Real, Real]], sigma: Real) -> list[Real]:
    """Both derivatives of f with respect to sigma."""
    pairs = zip(f(sigma + STEP), f(sigma - STEP), strict=True)
    return [(high - low) / (2 * STEP) for high, low in pairs]


def mass_matrix(q: Matrix) -> Matrix:
    """Equation (11)."""
    a, b = a_b(dot(q, q))
    return a * mp.eye(2) + b * q * q.T


def potential_energy(q: Matrix) -> Real:
    """Equation (15)."""
    G_A, G_S = G_A_S(dot(q, q))
    weight = dot(GRAVITY[:2], q) * G_A + GRAVITY[2] * G_S
    return mp.mpf(SECTION.stiffness) / 2 * dot(q, q) - LENGTH * weight


def potential_gradient(q: Matrix) -> Matrix:
    """Equation (15)."""
    (G_A, _), (dG_A, dG_S) = G_A_S(dot(q, q)), slopes(G_A_S, dot(q, q))
    g_xy = GRAVITY[:2]
    weight = g_xy * G_A + 2 * dot(g_xy, q) * dG_A * q + 2 * GRAVITY[2] * dG_S * q
    return mp.mpf(SECTION.stiffness) * q - LENGTH * weight


def bias(q: Matrix, qd: Matrix) -> Matrix:
    """Equation (16)."""
    p, w = dot(q, qd), dot(qd, qd)
    (_, b), (da, db) = a_b(dot(q, q)), slopes(a_b, dot(q, q))
    inertial = 2 * da * p * qd + (db * p**2 + (b - da) * w) * q
    return inertial + mp.mpf(SECTION.damping) * qd + potential_gradient(q)


# --- The proofs -----------------------------------------------------------------------------------


def error(actual: Any, expected: Any) -> Real:
    """Largest difference over the largest expected magnitude."""
    actual, expected = mp.matrix(actual), mp.matrix(expected)
    return mp.mnorm(actual - expected, mp.inf) / mp.mnorm(expected, mp.inf)


def floats(values: Matrix) -> list[float]:
    return [float(value) for value in values]


@each_state
@each_fraction
def test_2_position_and_3_rotation_are_the_papers(q: Matrix, qd: Matrix, x: Real) -> None:
    y, u = x * mp.norm(q), x * z_cross(q)
    r = LENGTH * numbers(x**2 * A(y) * q[0], x**2 * A(y) * q[1], x * S(y))
    R = mp.eye(3) + S(y) * hat(u) + A(y) * hat(u) ** 2
    assert error(r, paper_position(q, x)) < SAME
    assert error(R, paper_rotation(q, x)) < SAME
    assert error(R, mp.expm(hat(u))) < SAME
    R_model, r_model = MODEL.pose(floats(q), 0, float(x))
    assert error(r_model, r) < DOUBLE
    assert error(R_model.tolist(), R) < DOUBLE


@each_state
@each_fraction
def test_4_linear_and_5_angular_velocity(q: Matrix, qd: Matrix, x: Real) -> None:
    y2 = x**2 * dot(q, q)
    y = mp.sqrt(y2)
    dA, dS = x**2 * (S(y) / 2 - A(y)) / y2, x**2 * (mp.cos(y) - S(y)) / (2 * y2)
    along = 2 * LENGTH * numbers(x**2 * dA * q[0], x**2 * dA * q[1], x * dS)
    embedding = mp.matrix([[1, 0], [0, 1], [0, 0]])
    linear = LENGTH * x**2 * A(y) * embedding + along * q.T
    u, G = x * z_cross(q), (1 - S(y)) / y2
    left = mp.eye(3) + A(y) * hat(u) + G * hat(u) ** 2
    angular = x * left * mp.matrix([[0, -1], [1, 0], [0, 0]])
    assert error(linear * qd, velocities(q, qd, x)[0]) < SAME
    assert error(angular * qd, velocities(q, qd, x)[1]) < SAME
    jacobian = mp.matrix(MODEL.jacobian(floats(q), 0, float(x)).tolist())
    assert error(jacobian[:3, :], linear) < DOUBLE
    assert error(jacobian[3:, :], angular) < DOUBLE


@each_state
@each_fraction
def test_6_cables_keep_their_place_in_the_disks(q: Matrix, qd: Matrix, x: Real) -> None:
    """A cable's slope |d(r + R hole)/dx| is the same at every x, hence its length over one."""
    model_lengths = MODEL.cable_lengths(floats(q))
    for gamma, model_length in zip(SECTION.cable_angles, model_lengths, strict=True):
        hole = mp.mpf(SECTION.cable_radius) * numbers(mp.cos(gamma), mp.sin(gamma), 0)
        ends = [paper_position(q, x + h) + paper_rotation(q, x + h) * hole for h in (STEP, -STEP)]
        length = LENGTH - dot(hole[:2], q)
        assert error([mp.norm(ends[0] - ends[1]) / (2 * STEP)], [length]) < SAME
        assert error([model_length], [length]) < DOUBLE


@each_state
def test_7_inverse_kinematics(q: Matrix, qd: Matrix) -> None:
    p = paper_position(q, mp.mpf(1))
    assert error([2 * mp.atan2(mp.hypot(p[0], p[1]), p[2])], [mp.norm(q)]) < SAME
    assert error(MODEL.inverse_kinematics(floats(p)).q, q) < 10 * DOUBLE


@each_state
def test_8_to_12_kinetic_energy_of_the_elements(q: Matrix, qd: Matrix) -> None:
    a, b = a_b(dot(q, q))
    T = (a * dot(qd, qd) + b * dot(q, qd) ** 2) / 2
    inverse = (mp.eye(2) - b / (a + b * dot(q, q)) * q * q.T) / a
    assert error([T], [kinetic_energy(q, qd)]) < SAME
    assert error([dot(qd, mass_matrix(q) * qd) / 2], [T]) < SAME
    assert error(inverse * mass_matrix(q), mp.eye(2)) < SAME
    assert error([MODEL.kinetic_energy(floats(q), floats(qd))], [T]) < DOUBLE
    assert error(MODEL.mass_matrix(floats(q)).tolist(), mass_matrix(q)) < DOUBLE


@each_state
def test_13_to_15_weight_of_the_elements(q: Matrix, qd: Matrix) -> None:
    lifted = mp.fsum(m * dot(GRAVITY, paper_position(q, x)) for x, m, _ in ELEMENTS)
    U = mp.mpf(SECTION.stiffness) / 2 * dot(q, q) - lifted
    assert error([potential_energy(q)], [U]) < SAME
    assert error(potential_gradient(q), gradient(potential_energy, q)) < 10 * SAME
    assert error([MODEL.potential_energy(floats(q))], [U]) < DOUBLE


@each_state
def test_16_bias_is_lagranges(q: Matrix, qd: Matrix) -> None:
    """(dM/dt) qd - d(qd.M qd/2)/dq + c qd + dU/dq, by differences of M and U."""
    turning = rate(mass_matrix, q, qd) * qd - gradient(
        lambda p: dot(qd, mass_matrix(p) * qd) / 2, q
    )
    h = turning + mp.mpf(SECTION.damping) * qd + gradient(potential_energy, q)
    assert error(bias(q, qd), h) < SAME
    assert error(MODEL.bias(floats(q), floats(qd)), h) < 10 * DOUBLE


def acceleration(q: Matrix, qd: Matrix, tension: Matrix) -> Matrix:
    """M^-1 (B F - h)."""
    B = mp.matrix(MODEL.actuation_matrix().tolist())
    return mp.lu_solve(mass_matrix(q), B * tension - bias(q, qd))


@each_state
def test_17_power_balance(q: Matrix, qd: Matrix) -> None:
    """d(T + U)/dt = -F.ldot - c |qd|^2, the lengths being those of equation (6)."""
    F = numbers(3, 0.5, 2)
    holes = [
        mp.mpf(SECTION.cable_radius) * numbers(mp.cos(gamma), mp.sin(gamma))
        for gamma in SECTION.cable_angles
    ]
    lengths_rate = [-dot(hole, qd) for hole in holes]

    def energy(p: Matrix, pd: Matrix) -> Real:
        return dot(pd, mass_matrix(p) * pd) / 2 + potential_energy(p)

    qdd = acceleration(q, qd, F)
    after, before = (energy(q + h * qd, qd + h * qdd) for h in (STEP, -STEP))
    expected = -dot(F, lengths_rate) - mp.mpf(SECTION.damping) * dot(qd, qd)
    # B is known to the model in double precision only.
    assert error([(after - before) / (2 * STEP)], [expected]) < DOUBLE
    assert error(MODEL.forward_dynamics(floats(q), floats(qd), floats(F)), qdd) < 10 * DOUBLE


def test_18_equilibrium() -> None:
    tension = [40.0, 0.0, 10.0]
    q = numbers(*MODEL.equilibrium(tension))
    pull = MODEL.actuation_matrix() @ tension
    assert error(potential_gradient(q), pull) < 10 * DOUBLE


@each_state
def test_19_linearisation(q: Matrix, qd: Matrix) -> None:
    F = numbers(3, 0.5, 2)
    A, B = MODEL.linearize(floats(q), floats(qd), floats(F))
    by_q = gradient(lambda p: acceleration(p, qd, F), q)
    by_qd = gradient(lambda p: acceleration(q, p, F), qd)
    by_tension = mass_matrix(q) ** -1 * mp.matrix(MODEL.actuation_matrix().tolist())
    assert error(A[2:, :2].tolist(), by_q) < 100 * DOUBLE
    assert error(A[2:, 2:].tolist(), by_qd) < 100 * DOUBLE
    assert error(B[2:].tolist(), by_tension) < DOUBLE
