"""Two soft links pulled by two tendons, by SoRoMoX and SoRoSim: soromox_three_codes.

    python validation/three_codes.py FOLDER [--parts 6]

Both pull with 1 N from rest. Their models twist and stretch too; nothing is fitted. Reading the
file of SoRoSim needs SciPy.
"""

from __future__ import annotations

import argparse
from dataclasses import fields
from pathlib import Path

import numpy as np
from common import FloatArray, Row, amplitude, read_columns, rms, script, watch

import cdcr

LINK, RADIUS, MODULUS, DENSITY, VISCOSITY = 0.3, 0.03, 1e6, 1000.0, 1e4  # SI
NAME = "end_effector_position_tendon_driven_gvs_"
# Their bending angles turn about the other axes: the first tendon pulls towards -x.
AXES = np.array([-1.0, 1.0, 1.0])
EVERY = 100  # of the 30001 times of SoRoSim
HAS_RODS = "bending_order" in {item.name for item in fields(cdcr.Section)}


def robot(parts: int, **kind: int) -> cdcr.Robot:
    """Return the links, each in so many parts."""
    length = LINK / parts
    second = np.pi / 4.0 * RADIUS**4
    piece = cdcr.Section(
        length=length,
        backbone_mass=DENSITY * np.pi * RADIUS**2 * length,
        backbone_diameter=2.0 * RADIUS,
        youngs_modulus=MODULUS,
        damping=3.0 * VISCOSITY * second / length,  # as theirs is: along, that of pure stretch
        **kind,  # type: ignore[arg-type]
    )
    cables = [
        cdcr.Cable(radius=0.02, angle=angle, end_section=2 * parts - 1)
        for angle in (0.0, 0.5 * np.pi)
    ]
    return cdcr.Robot(sections=[piece] * (2 * parts), cables=cables, gravity=(0.0, 0.0, -9.81))


def theirs(folder: Path) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Return times and tips of each of their codes."""
    from scipy.io import loadmat  # type: ignore[import-untyped]

    table = read_columns(folder / f"{NAME}soromox.csv", ["t", "x", "y", "z"])
    path = folder / f"{NAME}sorosim.mat"
    file = loadmat(path)
    for name in ("t", "Pos_EE_all"):
        if name not in file:
            raise ValueError(f"{path}: there is no array {name!r}")
    every = slice(None, None, EVERY)
    return {
        "SoRoMoX": (table[:, 0], AXES * table[:, 1:]),
        "SoRoSim": (file["t"][every, 0], AXES * file["Pos_EE_all"].T[every]),
    }


def rows(folder: Path, parts: int) -> list[Row]:
    """Return a row of the table for each of their codes and each of our models."""
    kinds = [(f"arcs in {parts} + {parts} parts", robot(parts))]
    if HAS_RODS:
        kinds.append(("rods, bending order 2", robot(1, bending_order=2)))
    found = []
    for code, (t, tip) in theirs(folder).items():
        for name, described in kinds:
            with watch() as spent:
                model = cdcr.Model(described)
                still = np.zeros(model.num_coordinates)
                run = cdcr.simulate(model, still, still, t=t, tension=[1.0, 1.0], throw=True)
            error = rms(run.tip - tip)
            found.append(
                Row(f"two pulled links, beside {code}", name, 0, np.nan, error,
                    100.0 * error / amplitude(tip), "amplitude", model.num_coordinates, spent[0])
            )  # fmt: skip
    return found


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--parts", type=int, default=6, help="arcs that each link is cut into")
    given = parser.parse_args()
    script(lambda: rows(given.folder, given.parts))


if __name__ == "__main__":
    main()
