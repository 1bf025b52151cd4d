"""A run of one disk on a massless arc at 96 digits, and its derivatives, of independent making.

The equations of motion are those of the Lagrangian in closed form, checked against the element of
mass of parameter_derivatives.py; runs by extrapolation, their derivatives by differences of runs.
"""

import json
import sys
from pathlib import Path

import mpmath as mp
from parameter_derivatives import acceleration, set_digits

set_digits(96)


def shape(s, p):
    """Return a, b of the kinetic energy (a qd.qd + b (q.qd)^2)/2, and place over q and along Z."""
    y, m, d, length = mp.sqrt(s), p["disk_mass"], p["disk_diameter"], p["length"]
    A, S = (1 - mp.cos(y)) / s, mp.sin(y) / y
    across, along = m * d**2 / 16, m * d**2 / 8
    a = m * length**2 * A**2 + across * S**2 + along * s * A**2
    outwards = mp.sin(y) / y - (1 - mp.cos(y)) / s, mp.cos(y) / y - mp.sin(y) / s
    along_theta = m * length**2 * (outwards[0] ** 2 + outwards[1] ** 2) + across
    return a, (along_theta - a) / s, length * A, length * S


def slope(state, p):
    """Return the rate of (q, qd)."""
    x, y, u, v = state
    s, h = x * x + y * y, mp.mpf(10) ** -32
    a, b, A, _S = shape(s, p)
    da, db, dA, dS = (
        (up - down) / (2 * h) for up, down in zip(shape(s + h, p), shape(s - h, p), strict=False)
    )
    w, c = u * u + v * v, x * u + y * v
    K = p["youngs_modulus"] * mp.pi * p["backbone_diameter"] ** 4 / 64 / p["length"]
    m, gx, gz = p["disk_mass"], p["gx"], p["gz"]
    force = []
    for k, (q, qd, turn) in enumerate(((x, u, mp.cos), (y, v, mp.sin))):
        pull = p["cable_radius"] * sum(
            turn(mp.mpf(e)) * F for e, F in zip(p["cable_angles"], p["tension"], strict=False)
        )
        weight = m * ((gx * A if k == 0 else 0) + 2 * q * (gx * x * dA + gz * dS))
        bias = (2 * da * c + p["damping"]) * qd + (db * c**2 + (b - da) * w + K) * q
        force.append(pull + weight - bias)
    share = b * (x * force[0] + y * force[1]) / (a + b * s)
    return [u, v, (force[0] - share * x) / a, (force[1] - share * y) / a]


def brute_force(state, p):
    """Return the accelerations, of the disk as an element of mass."""
    section = {name: p[name] for name in SECTION if name in p} | {"num_disks": 1}
    robot = {"sections": [section], "gravity": [p["gx"], mp.mpf(0), p["gz"]], "payload": mp.mpf(0)}
    return acceleration(robot, state[:2], state[2:], p["tension"])


def step(state, p, H, columns=12):
    """Gragg's modified midpoint rule, extrapolated."""
    table = []
    first = slope(state, p)
    for k in range(columns):
        n = 2 * (k + 1)
        h = H / n
        before, here = state, [a + h * b for a, b in zip(state, first, strict=False)]
        for _ in range(n - 1):
            f = slope(here, p)
            before, here = here, [a + 2 * h * b for a, b in zip(before, f, strict=False)]
        f = slope(here, p)
        row = [[(a + b + h * c) / 2 for a, b, c in zip(before, here, f, strict=False)]]
        for j in range(k):
            ratio = (mp.mpf(k + 1) / (k - j)) ** 2
            row.append([a + (a - b) / (ratio - 1) for a, b in zip(row[j], table[j], strict=False)])
        table = row
    return table[-1], max(abs(a - b) for a, b in zip(table[-1], table[-2], strict=False))


def run(p, T, steps):
    state = [*p["q0"], *p["qd0"]]
    worst = mp.mpf(0)
    for _ in range(steps):
        state, error = step(state, p, T / steps)
        worst = max(worst, error)
    return state, worst


SECTION = {
    "length": 0.3,
    "backbone_mass": 0.0,
    "backbone_diameter": 0.0012,
    "youngs_modulus": 6.1e10,
    "disk_mass": 0.02,
    "disk_diameter": 0.05,
    "num_disks": 1,
    "cable_radius": 0.0105,
    "cable_angles": [0.1, 2.2, 4.4],
    "damping": 0.0006,
}
CASE = {
    "section": SECTION,
    "gravity": [1.5, 0.0, -9.3],
    "q0": [0.8, -0.35],
    "qd0": [2.0, 1.5],
    "tension": [1.5, 0.25, 0.75],
    "t": 0.5,
}
H = mp.mpf(10) ** -18


def numbers():
    p = {name: mp.mpf(value) for name, value in SECTION.items() if not isinstance(value, list)}
    p |= {
        "cable_angles": SECTION["cable_angles"],
        "gx": mp.mpf(CASE["gravity"][0]),
        "gz": mp.mpf(CASE["gravity"][2]),
    }
    return p | {name: [mp.mpf(one) for one in CASE[name]] for name in ("q0", "qd0", "tension")}


def moved(name, k, by):
    p = numbers()
    if k is None:
        p[name] += by
    else:
        p[name][k] += by
    return p


def main():
    steps = 30
    start = [*numbers()["q0"], *numbers()["qd0"]]
    gap = max(
        abs(a - b)
        for a, b in zip(slope(start, numbers())[2:], brute_force(start, numbers()), strict=False)
    )
    assert gap < mp.mpf(10) ** -25, gap
    T = mp.mpf(CASE["t"])
    state, worst = run(numbers(), T, steps)
    print("error of a step", mp.nstr(worst, 3), file=sys.stderr)
    answers = {**CASE, "state": [mp.nstr(one, 25) for one in state], "slopes": {}}
    wanted = [
        ("q0", 0),
        ("q0", 1),
        ("qd0", 0),
        ("qd0", 1),
        ("tension", 0),
        ("tension", 1),
        ("tension", 2),
    ]
    wanted += [(name, None) for name in ("youngs_modulus", "length", "disk_mass", "damping")]
    for name, k in wanted:
        size = abs(numbers()[name] if k is None else numbers()[name][k])
        up, _ = run(moved(name, k, H * size), T, steps)
        down, _ = run(moved(name, k, -H * size), T, steps)
        column = [mp.nstr((a - b) / (2 * H * size), 20) for a, b in zip(up, down, strict=False)]
        key = name if k is not None else f"sections.1.{name}"
        answers["slopes"].setdefault(key, []).append(column)
    Path(sys.argv[1]).write_text(json.dumps(answers, indent=1) + "\n")


if __name__ == "__main__":
    main()
