"""Rods without cables, held and let go, simulated by SoRoSim: sorosim_release of opencr-mujoco.

    python validation/sorosim.py FOLDER_OR_FILES... [--parts 8] [--order 3] [--twist 1]

A wrench at the middle and one at the tip hold the rod; both are let go at the first time. Nothing
is fitted. Arcs in equal parts bend only; one section of varying curvature twists too. The runs are
as long as the files, 10 s; compared are the first 2 s, when the rods have not come to rest. How far
the tip is turned away from theirs is told in a line for each model, on standard error.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np
from common import FloatArray, Row, positive, read_columns, rms, script, watch

import cdcr

# The file's axes in ours: X along the straight rod is our Z.
TURN = np.array([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])
COMPARED = 2.0  # [s]
RTOL = 1e-6  # 1e-8 gives the same digits


@dataclass(frozen=True)
class Rod:
    """A material and its rod."""

    name: str
    length: float  # [m]
    radius: float  # [m]
    modulus: float  # [Pa]
    poisson: float
    density: float  # [kg/m^3]


TPU = Rod("TPU rods", 0.4, 5e-3, 70e6, 0.4, 1200.0)
STEEL = Rod("steel rods", 0.6, 0.8e-3, 200e9, 0.33, 7870.0)


@dataclass(frozen=True)
class Release:
    """A file: what holds the rod, and where its tip is, and how turned, after it was let go."""

    rod: Rod
    beta: float  # moment = E I (kappa + beta kappa') [s]
    gravity: FloatArray
    wrenches: tuple[cdcr.Wrench, ...]
    t: FloatArray
    tip: FloatArray  # (N, 3)
    turned: FloatArray  # (N, 3, 3), our frame of the tip in the base frame


class Found(NamedTuple):
    """A run beside a release."""

    error: float  # of the tip, RMS [mm]
    angle: float  # by which the tip is turned away from theirs, RMS [deg]
    seconds: float  # of the processor
    coordinates: int


def axis_rotations(angle: FloatArray, axis: int) -> FloatArray:
    """Return rotations (N, 3, 3) by angles (N,) about an axis of the frame."""
    j, k = (axis + 1) % 3, (axis + 2) % 3
    R = np.zeros((len(angle), 3, 3))
    R[:, axis, axis] = 1.0
    R[:, j, j] = R[:, k, k] = np.cos(angle)
    R[:, k, j] = np.sin(angle)
    R[:, j, k] = -R[:, k, j]
    return R


def read(path: Path, middle: tuple[int, float], last: int) -> Release:
    """Return a release; the wrenches at (section, fraction) and at the end of the last section."""
    rows = read_columns(path, split="\t")
    if rows.shape[1] != 13 or len(rows) < 4:
        raise ValueError(f"{path} must have 13 columns and 4 lines or more, got {rows.shape}")
    beta, gravity = rows[0, 0], TURN @ rows[0, 10:13]
    held = rows[1, 1:13].reshape(2, 2, 3) @ TURN.T
    wrenches = tuple(
        cdcr.Wrench(section=section, fraction=fraction, moment=moment, force=force)
        for (section, fraction), (moment, force) in zip((middle, (last, 1.0)), held, strict=True)
    )
    rod = TPU if path.name.startswith("TPU") else STEEL
    # Their Euler angles compose as Rx Ry Rz.
    Rx, Ry, Rz = (axis_rotations(rows[2:, 7 + k], k) for k in range(3))
    turned = TURN @ (Rx @ Ry @ Rz) @ TURN.T
    return Release(rod, beta, gravity, wrenches, rows[2:, 0], rows[2:, 10:13] @ TURN.T, turned)


def angle_between(found: FloatArray, wanted: FloatArray) -> float:
    """Return the RMS angle between rotations (N, 3, 3) [deg]."""
    cosine = 0.5 * (np.einsum("nij,nij->n", found, wanted) - 1.0)
    return float(np.rad2deg(np.sqrt(np.mean(np.arccos(np.clip(cosine, -1.0, 1.0)) ** 2))))


def section(rod: Rod, beta: float, length: float, **kind: int) -> cdcr.Section:
    """Return a piece of a rod, each strain of which is damped by beta times its stiffness."""
    return cdcr.Section(
        length=length,
        backbone_mass=rod.density * np.pi * rod.radius**2 * length,
        backbone_diameter=2.0 * rod.radius,
        youngs_modulus=rod.modulus,
        shear_modulus=rod.modulus / (2.0 * (1.0 + rod.poisson)),
        material_damping=beta,
        **kind,  # type: ignore[arg-type]
    )


def moved(path: Path, kind: tuple[int, int] | int) -> tuple[Release, cdcr.Trajectory, float]:
    """Let go a rod of orders of bending and twist, or arcs in that many parts, as a release says.

    Returned are also seconds of the processor.
    """
    parts = kind if isinstance(kind, int) else 1
    middle = (parts // 2 - 1, 1.0) if parts > 1 else (0, 0.5)
    told = read(path, middle, parts - 1)
    orders = {} if isinstance(kind, int) else {"bending_order": kind[0], "twist_order": kind[1]}
    piece = section(told.rod, told.beta, told.rod.length / parts, **orders)
    with watch() as spent:
        model = cdcr.Model(cdcr.Robot(sections=[piece] * parts, gravity=told.gravity))
        q0 = model.equilibrium(wrenches=told.wrenches)
        qd0 = np.zeros(model.num_coordinates)
        run = cdcr.simulate(model, q0, qd0, t=told.t, rtol=RTOL, atol=0.01 * RTOL, throw=True)
    return told, run, spent[0]


def beside(path: Path, kind: tuple[int, int] | int) -> Found:
    """Set a model beside a release."""
    told, run, seconds = moved(path, kind)
    early = told.t <= COMPARED
    R, p = run.model.tip(run.q[early])
    angle = angle_between(R, told.turned[early])
    return Found(rms(p - told.tip[early]), angle, seconds, run.model.num_coordinates)


def rows(paths: list[Path], parts: int, order: int, twist: int = 1) -> list[Row]:
    """Return a row of the table for each material and model."""
    files = [file for path in paths
             for file in (sorted(path.glob("*Rod*.txt")) if path.is_dir() else [path])]  # fmt: skip
    if not files:
        raise ValueError(f"there are no files *Rod*.txt in {', '.join(map(str, paths))}")
    kinds: dict[str, tuple[int, int] | int] = {
        f"arcs in {parts} parts": parts,
        f"rod, bending order {order}, twist order {twist}": (order, twist),
    }
    found = []
    for rod in (TPU, STEEL):
        chosen = [file for file in files if file.name.startswith("TPU") == (rod is TPU)]
        for name, kind in kinds.items() if chosen else ():
            every = [beside(file, kind) for file in chosen]
            error, angle = (float(np.sqrt(np.mean([one[k] ** 2 for one in every]))) for k in (0, 1))
            slowest = max(one.seconds for one in every)
            print(
                f"{rod.name} as {name}: the tip is turned away from theirs by {angle:.2f} deg RMS; "
                f"10 s took at most {slowest:.2g} s of the processor",
                file=sys.stderr,
            )
            found.append(
                Row(
                    f"SoRoSim, {rod.name} let go ({len(chosen)} runs)", name, 0, np.nan, error,
                    0.1 * error / rod.length, "length", every[0].coordinates,
                    sum(one.seconds for one in every),
                )
            )  # fmt: skip
    return found


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("paths", type=Path, nargs="+", help="files, or a folder of them")
    parser.add_argument("--parts", type=positive, default=8, help="arcs that a rod is cut into")
    parser.add_argument("--order", type=int, default=3, help="of the bending of a rod")
    parser.add_argument("--twist", type=int, default=1, help="order of its twist")
    given = parser.parse_args()
    script(lambda: rows(given.paths, given.parts, given.order, given.twist))


if __name__ == "__main__":
    main()
