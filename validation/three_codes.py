"""Two soft links pulled by two tendons, by SoRoMoX and SoRoSim: soromox_three_codes.

    python validation/three_codes.py FOLDER [--parts 6]

Both pull with 1 N from rest; nothing is fitted. The strains of both codes are Legendre polynomials
of order 1 in bending, twist and stretch, as are those of the rods here. Their material is damped by
a viscosity eta: in bending by 3 eta I, in twist by eta J, in stretch by 3 eta A. How far the tips
are apart at most, and at the end, is told on standard error. SciPy reads the file of SoRoSim.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from common import FloatArray, Row, amplitude, positive, read_columns, rms, script, watch

import cdcr

LINK, RADIUS, MODULUS, DENSITY, VISCOSITY = 0.3, 0.03, 1e6, 1000.0, 1e4  # SI
NAME = "end_effector_position_tendon_driven_gvs_"
# Their bending angles turn about the other axes: the first tendon pulls towards -x.
AXES = np.array([-1.0, 1.0, 1.0])
EVERY = 100  # of the 30001 times of SoRoSim


def robot(parts: int, **kind: int) -> cdcr.Robot:
    """Return the links, each in so many parts."""
    length, area, second = LINK / parts, np.pi * RADIUS**2, np.pi / 4.0 * RADIUS**4
    piece = cdcr.Section(
        length=length,
        backbone_mass=DENSITY * area * length,
        backbone_diameter=2.0 * RADIUS,
        youngs_modulus=MODULUS,
        shear_modulus=MODULUS / 3.0,  # of Poisson's ratio 0.5
        damping=3.0 * VISCOSITY * second / length,
        twist_damping=VISCOSITY * 2.0 * second / length,
        stretch_damping=3.0 * VISCOSITY * area / length,
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
    strains = {"bending_order": 1, "twist_order": 1, "stretch_order": 1}
    kinds = {
        f"arcs in {parts} + {parts} parts": robot(parts),
        "rods of order 1, with twist and stretch": robot(1, **strains),
    }
    found = []
    for code, (t, tip) in theirs(folder).items():
        for name, described in kinds.items():
            with watch() as spent:
                model = cdcr.Model(described)
                still = np.zeros(model.num_coordinates)
                run = cdcr.simulate(model, still, still, t=t, tension=[1.0, 1.0], throw=True)
            error = rms(run.tip - tip)
            apart = 1e3 * np.linalg.norm(run.tip - tip, axis=1)
            print(f"{code} and {name}: tips at most {apart.max():.3f} mm apart, at the end "
                  f"{apart[-1]:.3f} mm", file=sys.stderr)  # fmt: skip
            found.append(
                Row(f"two pulled links, beside {code}", name, 0, np.nan, error,
                    100.0 * error / amplitude(tip), "amplitude", model.num_coordinates, spent[0])
            )  # fmt: skip
    return found


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--parts", type=positive, default=6, help="arcs that each link is cut into")
    given = parser.parse_args()
    script(lambda: rows(given.folder, given.parts))


if __name__ == "__main__":
    main()
