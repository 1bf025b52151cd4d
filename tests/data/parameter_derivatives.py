"""Derivatives of accelerations with respect to parameters, at 80 digits, of independent making.

A robot is a list of mass elements: one for each disk, and the points of Gauss quadrature of each
backbone. Only place and rotation of each element are written down; mass matrix, bias and weight
follow by differences at 80 digits, and so do the derivatives.
"""

import copy
import json
import sys
from pathlib import Path

import mpmath as mp

POINTS = 10
STEPS = {}


def set_digits(digits):
    """Set how many digits there are, and the steps of differences that go with them."""
    mp.mp.dps = digits
    STEPS.update(first=mp.mpf(10) ** -(digits // 3), second=mp.mpf(10) ** -(digits // 5))


set_digits(80)


def derivative_of_legendre(n, x):
    return n * (x * mp.legendre(n, x) - mp.legendre(n - 1, x)) / (x * x - 1)


def gauss(n):
    """Return points and weights on [0, 1]."""
    found = []
    for k in range(1, n + 1):
        x = mp.cos(mp.pi * (k - mp.mpf(1) / 4) / (n + mp.mpf(1) / 2))
        for _ in range(12):  # Newton
            value, slope = mp.legendre(n, x), derivative_of_legendre(n, x)
            x -= value / slope
        slope = derivative_of_legendre(n, x)
        found.append(((1 + x) / 2, 1 / ((1 - x * x) * slope**2)))
    return found


RULE = gauss(POINTS)


def turn(v):
    """Return the rotation matrix of a rotation vector."""
    s = sum(one**2 for one in v)
    if s == 0:
        return mp.eye(3)
    y = mp.sqrt(s)
    cross = mp.matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return mp.eye(3) + mp.sin(y) / y * cross + (1 - mp.cos(y)) / s * cross * cross


def arc(length, x, q):
    """Return place and rotation at a fraction of an arc."""
    qx, qy = q
    s = (qx**2 + qy**2) * x**2
    y = mp.sqrt(s)
    a = (1 - mp.cos(y)) / s
    place = mp.matrix([length * x**2 * a * qx, length * x**2 * a * qy, length * x * mp.sin(y) / y])
    return place, turn([-qy * x, qx * x, 0])


def elements(robot, q):
    """Yield mass, transverse and axial inertia, place and rotation of each element."""
    R, p = mp.eye(3), mp.matrix([0, 0, 0])
    for i, s in enumerate(robot["sections"]):
        here = [q[2 * i], q[2 * i + 1]]
        parts = [
            (s["disk_mass"], s["disk_diameter"], mp.mpf(k) / s["num_disks"])
            for k in range(1, s["num_disks"] + 1)
        ]
        if s["backbone_mass"]:
            parts += [(w * s["backbone_mass"], s["backbone_diameter"], x) for x, w in RULE]
        for m, d, x in parts:
            r, T = arc(s["length"], x, here)
            yield m, m * d**2 / 16, m * d**2 / 8, p + R * r, R * T
        r, T = arc(s["length"], mp.mpf(1), here)
        p, R = p + R * r, R * T
    if robot["payload"]:
        yield robot["payload"], mp.mpf(0), mp.mpf(0), p, R


OF_PARAMETERS = mp.mpf(10) ** -6


def moved(q, k, h):
    found = list(q)
    found[k] += h
    return found


def mass_matrix(robot, q):
    """Return M(q) from central differences of places and rotations."""
    d, h = len(q), STEPS["first"]
    sides = [
        (list(elements(robot, moved(q, k, h))), list(elements(robot, moved(q, k, -h))))
        for k in range(d)
    ]
    M = mp.zeros(d)
    for e, (m, across, along, _, R) in enumerate(elements(robot, q)):
        columns = []
        for up, down in sides:
            v = (up[e][3] - down[e][3]) / (2 * h)
            W = R.T * (up[e][4] - down[e][4]) / (2 * h)
            columns.append((v, mp.matrix([W[2, 1], W[0, 2], W[1, 0]])))
        for i in range(d):
            for j in range(d):
                (v, w), (u, o) = columns[i], columns[j]
                M[i, j] += (
                    m * (v.T * u)[0] + across * (w[0] * o[0] + w[1] * o[1]) + along * w[2] * o[2]
                )
    return M


def weight(robot, q):
    g = robot["gravity"]
    return -sum(m * sum(g[k] * p[k] for k in range(3)) for m, _, _, p, _ in elements(robot, q))


def acceleration(robot, q, qd, tensions):
    """Return qdd of the equations of motion."""
    d, h = len(q), STEPS["second"]
    M = mass_matrix(robot, q)
    dM = [
        (mass_matrix(robot, moved(q, k, h)) - mass_matrix(robot, moved(q, k, -h))) / (2 * h)
        for k in range(d)
    ]
    h = STEPS["first"]
    v = mp.matrix(qd)
    rate = mp.zeros(d)
    for k in range(d):
        rate += dM[k] * qd[k]
    force = -(rate * v)
    for k in range(d):
        force[k] += (v.T * dM[k] * v)[0] / 2
        force[k] -= (weight(robot, moved(q, k, h)) - weight(robot, moved(q, k, -h))) / (2 * h)
    for i, s in enumerate(robot["sections"]):
        K = s["youngs_modulus"] * mp.pi * s["backbone_diameter"] ** 4 / 64 / s["length"]
        for c in range(2):
            force[2 * i + c] -= K * q[2 * i + c] + s["damping"] * qd[2 * i + c]
    j = 0
    for end, s in enumerate(robot["sections"]):
        for angle in s["cable_angles"]:
            for i in range(end + 1):
                force[2 * i] += s["cable_radius"] * mp.cos(angle) * tensions[j]
                force[2 * i + 1] += s["cable_radius"] * mp.sin(angle) * tensions[j]
            j += 1
    return mp.lu_solve(M, force)


def with_number(robot, path, by):
    words = path.split(".")
    there = copy.deepcopy(robot)
    home = there
    for word in words[:-1]:
        home = home[int(word) - 1] if isinstance(home, list) else home[word]
    last = {"x": 0, "y": 1, "z": 2}.get(words[-1], words[-1])
    last = int(last) - 1 if str(last).isdigit() and isinstance(last, str) else last
    home[last] = home[last] * (1 + by)
    return there, home[last] / (1 + by)


def exact(value):
    if isinstance(value, dict):
        return {key: exact(one) for key, one in value.items()}
    if isinstance(value, list):
        return [exact(one) for one in value]
    if isinstance(value, int):
        return value
    return mp.mpf(value)


def derivative(robot, path, q, qd, tensions):
    """Central difference of sixth order."""
    total = mp.zeros(len(q), 1)
    for k, weight in ((1, mp.mpf(3) / 4), (2, -mp.mpf(3) / 20), (3, mp.mpf(1) / 60)):
        up, size = with_number(robot, path, k * OF_PARAMETERS)
        down, _ = with_number(robot, path, -k * OF_PARAMETERS)
        total += weight * (acceleration(up, q, qd, tensions) - acceleration(down, q, qd, tensions))
    return total / (OF_PARAMETERS * size)


SECTION = {
    "length": 0.3,
    "backbone_mass": 0.02,
    "backbone_diameter": 0.0011,
    "youngs_modulus": 6.1e10,
    "disk_mass": 0.004,
    "disk_diameter": 0.024,
    "num_disks": 3,
    "cable_radius": 0.0105,
    "cable_angles": [0.1, 2.2, 4.4],
    "damping": 0.0004,
}
OTHER = dict(
    SECTION,
    length=0.21,
    backbone_mass=0.011,
    backbone_diameter=0.0009,
    disk_diameter=0.017,
    cable_radius=0.008,
    cable_angles=[0.6, 2.7, 4.9],
    num_disks=2,
    damping=0.0002,
)
FIELDS = [
    "length",
    "backbone_mass",
    "backbone_diameter",
    "youngs_modulus",
    "disk_mass",
    "disk_diameter",
    "cable_radius",
    "damping",
]
CASES = [
    {
        "robot": {"sections": [SECTION], "gravity": [1.5, -0.7, -9.3], "payload": 0.013},
        "q": [0.8, -0.35],
        "qd": [2.1, 1.3],
        "tension": [1.5, 0.25, 0.75],
        "parameters": [f"sections.1.{one}" for one in FIELDS]
        + ["payload", "gravity.x", "gravity.z", "sections.1.cable_angles.2"],
    },
    {
        "robot": {"sections": [SECTION, OTHER], "gravity": [1.5, -0.7, -9.3], "payload": 0.013},
        "q": [0.8, -0.35, -0.5, 0.6],
        "qd": [2.1, 1.3, -3.2, 0.9],
        "tension": [1.5, 0.25, 0.75, 0.5, 0.625, 1.0],
        "parameters": [
            f"sections.{k}.{one}"
            for k in (1, 2)
            for one in (
                "length",
                "backbone_mass",
                "disk_diameter",
                "youngs_modulus",
                "cable_radius",
            )
        ]
        + ["payload", "gravity.y"],
    },
]


def main():
    answers = []
    for case in CASES:
        robot = exact(case["robot"])
        q, qd, tension = (exact(case[name]) for name in ("q", "qd", "tension"))
        slopes = {
            path: [mp.nstr(one, 20) for one in derivative(robot, path, q, qd, tension)]
            for path in case["parameters"]
        }
        qdd = [mp.nstr(one, 20) for one in acceleration(robot, q, qd, tension)]
        answers.append({**case, "qdd": qdd, "dqdd": slopes})
        print(case["parameters"][0], qdd, file=sys.stderr)
    Path(sys.argv[1]).write_text(json.dumps(answers, indent=1) + "\n")


if __name__ == "__main__":
    main()
