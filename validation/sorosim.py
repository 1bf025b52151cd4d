"""Rods without cables, held and let go, simulated by SoRoSim: sorosim_release of opencr-mujoco.

    python validation/sorosim.py FOLDER_OR_FILES... [--parts 8] [--order 3]

A wrench at the middle and one at the tip hold the rod; both are let go at the first time. Nothing
is fitted. Arcs in equal parts bend only; sections of varying curvature twist too, where this cdcr
has them.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
from common import FloatArray, Row, amplitude, read_columns, rms, script, watch

import cdcr

# The file's axes in ours: X along the straight rod is our Z.
TURN = np.array([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])
HAS_RODS = "bending_order" in {item.name for item in fields(cdcr.Section)}


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
    """A file: what holds the rod, and where its tip is after it was let go."""

    rod: Rod
    beta: float  # moment = E I (kappa + beta kappa') [s]
    gravity: FloatArray
    wrenches: tuple[cdcr.Wrench, ...]
    t: FloatArray
    tip: FloatArray


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
    return Release(rod, beta, gravity, wrenches, rows[2:, 0], rows[2:, 10:13] @ TURN.T)


def section(rod: Rod, beta: float, length: float, **kind: int) -> cdcr.Section:
    """Return a piece of a rod."""
    area, second = np.pi * rod.radius**2, np.pi / 4.0 * rod.radius**4
    more = {}
    if kind:  # twist, with the damping of its own stiffness
        more = {"shear_modulus": rod.modulus / (2.0 * (1.0 + rod.poisson))}
    return cdcr.Section(
        length=length,
        backbone_mass=rod.density * area * length,
        backbone_diameter=2.0 * rod.radius,
        youngs_modulus=rod.modulus,
        damping=beta * rod.modulus * second / length,
        **more,
        **kind,  # type: ignore[arg-type]
    )


def run(path: Path, parts: int, order: int | None) -> tuple[float, float, float, int]:
    """Return error and amplitude [mm], processor time [s] and coordinates."""
    middle = (0, 0.5) if order is not None else ((parts // 2 - 1, 1.0) if parts > 1 else (0, 0.5))
    told = read(path, middle, 0 if order is not None else parts - 1)
    if order is None:
        piece = section(told.rod, told.beta, told.rod.length / parts)
        pieces = [piece] * parts
    else:
        kind = {"bending_order": order, "twist_order": max(order - 1, 0)}
        pieces = [section(told.rod, told.beta, told.rod.length, **kind)]
    with watch() as spent:
        model = cdcr.Model(cdcr.Robot(sections=pieces, gravity=told.gravity))
        q0 = model.equilibrium(wrenches=told.wrenches)
        qd0 = np.zeros(model.num_coordinates)
        moved = cdcr.simulate(model, q0, qd0, t=told.t, throw=True)
    return rms(moved.tip - told.tip), amplitude(told.tip), spent[0], model.num_coordinates


def rows(paths: list[Path], parts: int, order: int) -> list[Row]:
    """Return a row of the table for each material and model."""
    files = [file for path in paths
             for file in (sorted(path.glob("*Rod*.txt")) if path.is_dir() else [path])]  # fmt: skip
    if not files:
        raise ValueError(f"there are no files *Rod*.txt in {', '.join(map(str, paths))}")
    kinds: list[tuple[str, int | None]] = [(f"arcs in {parts} parts", None)]
    if HAS_RODS:
        kinds.append((f"rod, bending order {order}", order))
    found = []
    for rod in (TPU, STEEL):
        chosen = [file for file in files if file.name.startswith("TPU") == (rod is TPU)]
        for name, kind in kinds if chosen else ():
            every = np.array([run(file, parts, kind) for file in chosen])
            error, far = np.sqrt(np.mean(every[:, 0] ** 2)), every[:, 1].mean()
            found.append(
                Row(
                    f"SoRoSim, {rod.name} let go ({len(chosen)} runs)", name, 0, np.nan,
                    float(error), float(100.0 * error / far), "amplitude",
                    int(every[0, 3]), float(every[:, 2].sum()),
                )
            )  # fmt: skip
    return found


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("paths", type=Path, nargs="+", help="files, or a folder of them")
    parser.add_argument("--parts", type=int, default=8, help="arcs that a rod is cut into")
    parser.add_argument("--order", type=int, default=3, help="of the bending of a rod")
    given = parser.parse_args()
    script(lambda: rows(given.paths, given.parts, given.order))


if __name__ == "__main__":
    main()
