"""How near arcs and orders of bending come to a rod under loads: tips at rest, first frequency.

    python validation/loaded_shapes.py [--shapes 500]

A rod of TPU, 0.4 m long and 10 mm thick, is held out sideways under its weight, with a force and a
moment at the middle and at the tip, drawn in all directions, forces up to E I/l^2 and moments up
to E I/(2 l); the same loads in every run. Truth is the rod in four parts of orders 4, bending and
twist. Told are how far tips are off in percent of the length and how far they are turned away, RMS
over the shapes, and the first frequency of the rod without loads, beside the truth's. The centre
line of a round rod under loads that do not turn with it is the same whether it twists or not; how
its tip is turned is not.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable

import numpy as np
from common import FloatArray, positive, rms

import cdcr

LENGTH, RADIUS, MODULUS, POISSON, DENSITY = 0.4, 0.005, 70e6, 0.4, 1200.0  # SI
ARCS, ORDERS = (1, 4, 8, 16, 32), (1, 2, 3)
STRONGEST = np.array([1.0, 0.5])  # force over E I/l^2, moment over E I/l
SEED = 1


def rod(**orders: int) -> cdcr.Robot:
    """Return the rod, as one section of these orders."""
    section = cdcr.Section(
        length=LENGTH,
        backbone_mass=DENSITY * np.pi * RADIUS**2 * LENGTH,
        backbone_diameter=2.0 * RADIUS,
        youngs_modulus=MODULUS,
        shear_modulus=MODULUS / (2.0 * (1.0 + POISSON)),
        **orders,  # type: ignore[arg-type]
    )
    return cdcr.Robot(sections=[section], gravity=(-9.81, 0.0, 0.0))


def drawn_loads(shapes: int) -> FloatArray:
    """Return force and moment at the middle and the tip (shapes, 2, 2, 3), evenly within balls."""
    random = np.random.default_rng(SEED)
    drawn = random.standard_normal((shapes, 2, 2, 3))
    drawn /= np.linalg.norm(drawn, axis=-1, keepdims=True)
    drawn *= random.uniform(size=(shapes, 2, 2, 1)) ** (1.0 / 3.0)
    stiffness = MODULUS * np.pi / 4.0 * RADIUS**4
    scale = stiffness * STRONGEST / [LENGTH**2, LENGTH]
    return np.asarray(scale[:, np.newaxis] * drawn)


def tips_at_rest(robot: cdcr.Robot, drawn: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rotations and places of the tip at rest under each set of loads."""
    model = cdcr.Model(robot)
    places = [robot.locate(LENGTH / 2.0), robot.locate(LENGTH)]
    shapes = []
    for at_both in drawn:
        q = np.zeros(model.num_coordinates)
        for share in (0.5, 1.0):  # the loads grow, so that all models find the same shape
            loads = [
                cdcr.Wrench(
                    force=share * force, moment=share * moment, section=section, fraction=fraction
                )
                for (force, moment), (section, fraction) in zip(at_both, places, strict=True)
            ]
            q = model.equilibrium([], wrenches=loads, q0=q)
        shapes.append(q)
    return model.tip(np.array(shapes))


def turned(rotation: FloatArray, truth: FloatArray) -> float:
    """Return the RMS angle between rotations (shapes, 3, 3) [deg]."""
    cosine = 0.5 * (np.einsum("kij,kij->k", rotation, truth) - 1.0)
    return float(np.degrees(np.sqrt(np.mean(np.arccos(np.clip(cosine, -1.0, 1.0)) ** 2))))


def first_frequency(robot: cdcr.Robot) -> float:
    """Return that of bending about the straight rod without weight [Hz]."""
    model = cdcr.Model(robot).with_gravity((0.0, 0.0, 0.0))
    return float(model.modes(np.zeros(model.num_coordinates), []).frequency_hz[0])


def models() -> Iterable[tuple[str, cdcr.Robot]]:
    """Return the models that are compared, by name."""
    for parts in ARCS:
        yield f"arcs in {parts} parts" if parts > 1 else "one arc", rod().subdivide(parts)
    for order in ORDERS:
        yield f"bending order {order}", rod(bending_order=order)
    yield "two sections, bending order 1", rod(bending_order=1).subdivide(2)
    for twist in (0, 1):
        yield f"bending order 3, twist order {twist}", rod(bending_order=3, twist_order=twist)


def table(shapes: int) -> list[str]:
    """Return the rows of the table."""
    drawn = drawn_loads(shapes)
    finest = rod(bending_order=4, twist_order=4).subdivide(4)
    R, p = tips_at_rest(finest, drawn)
    frequency = first_frequency(finest)
    lines = [
        "| model | coordinates | tip off by | tip turned by | first frequency |",
        "|---|---|---|---|---|",
    ]
    for name, robot in models():
        rotation, tip = tips_at_rest(robot, drawn)
        off = 0.1 * rms(tip - p) / LENGTH  # of mm, in %
        faster = 100.0 * (first_frequency(robot) / frequency - 1.0)
        size = cdcr.Model(robot).num_coordinates
        lines.append(
            f"| {name} | {size} | {off:.3f} % | {turned(rotation, R):.2f} deg | {faster:+.3f} % |"
        )
    return lines


def main() -> None:
    """Read the argument and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--shapes", type=positive, default=500, help="that are loaded")
    print("\n".join(table(parser.parse_args().shapes)))


if __name__ == "__main__":
    main()
