"""A real robot of three sections driven by length: ftdcr_v4 of ContinuumRoboticsLab/opencr-mujoco.

    python validation/ftdcr.py --train train.csv [--test held_back.csv] [--folds 2] [--out fit.png]

Nine pulls and the tip by motion capture, at rest, one after another: friction remembers the way.
Where no file to predict is given, the error held out is that of stretches of the first, fifths
unless `--folds` says otherwise, left out one after another; the way through them stays.

Fitted, ten numbers: the circle of the cables, tilt and height of the base, weight of the disks, the
marker's place beside the backbone, friction of the cables at their entry, and where the assembly is
off its drawing, as parts of the data show alike: how far section 3 and one cable are wound, and the
angle of one.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
from common import Row, rms, script, watch

import cdcr
from cdcr.identification import Identified, Poses

LENGTHS = 0.06, 0.0625, 0.064  # [m]; robot.json beside the data
OFFSETS = -3.0589, -2.5615, -2.0506  # angle of the first cable of each section [rad]
CIRCLE = 4.5e-3  # [m]
FOLDS = 5  # parts that are left out
NEAR = 0.08  # tips that are bent little [m]
SERVOS = 4, 3, 9, 5, 2, 8, 6, 1, 7  # of the cables, section by section
# Of the disks nothing is known but the total of 50 g, drives and all; this one is a start.
DISK = 1e-4  # [kg]

PARAMETERS: dict[str, dict[str, float] | None] = dict.fromkeys([
    "sections[*].cable_radius",
    "base tilt",
    "base position z",
    "scale sections[*].disk_mass",
    "sections[2].command_offset",
    "command_offset[5]",
    "sections[0].cable_angles[2]",
    "tip offset y",
])  # fmt: skip
PARAMETERS["sections[*].cable_entry_friction"] = {"start": 0.1}  # [N]


def robot() -> cdcr.Robot:
    """Return the robot of the drawing; the ratio of cable and backbone stiffness is a guess."""
    sections = [
        cdcr.Section(
            length=length,
            backbone_mass=1e-3,
            backbone_diameter=1e-3,
            youngs_modulus=50e9,
            num_disks=10,
            disk_mass=DISK,
            disk_diameter=0.011,
            cable_radius=CIRCLE,
            cable_angles=[offset + k * 2.0 * np.pi / 3.0 for k in range(3)],
            cable_stiffness=6e3,
        )
        for length, offset in zip(LENGTHS, OFFSETS, strict=True)
    ]
    return cdcr.Robot(sections=sections, gravity=(0.0, 0.0, -9.81))


def poses(path: Path, every: int = 1) -> Poses:
    """Return the poses of a file."""
    columns = {f"pull {j + 1} [mm]": f"servo_{servo}_mm" for j, servo in enumerate(SERVOS)}
    columns |= {f"tip {axis} [mm]": f"tip_{axis}" for axis in "xyz"}
    return Poses.load(path, robot(), columns=columns, every=every, history=True)


def fit(train: Poses) -> Identified:
    """Return the robot identified."""
    return cdcr.identify(train, robot(), PARAMETERS)


def near_and_far(train: Path) -> None:
    """Print how a fit to tips near the axis predicts the others."""
    every = np.asarray(poses(train).tip)
    near = np.linalg.norm(every[:, :2], axis=1) < NEAR
    found = fit(some(train, near))
    used, far = (
        rms(one[np.isfinite(one).all(axis=1)])
        for one in (found.residuals[0].values, found.errors(some(train, ~near))[0].values)
    )
    print(f"fitted to tips within {1e3 * NEAR:.0f} mm of the axis to {used:.2f} mm RMS")
    print(f"predicts the others to {far:.2f} mm\n")


def some(train: Path, chosen: np.ndarray) -> Poses:
    """Return the poses of a file with some tips alone: the way to them stays."""
    told = poses(train)
    return replace(told, tip=np.where(chosen[:, None], told.tip, np.nan), gaps="skip")


def rows(
    train: Path,
    test: Path | None,
    out: Path | None = None,
    *,
    far: bool = False,
    folds: int = FOLDS,
) -> list[Row]:
    """Return the row of the table."""
    if far:
        near_and_far(train)
    used = poses(train)
    with watch() as spent:
        found = fit(used)
    print(found.report(), "\n")
    if test is None:
        held_out = 1e3 * found.cross_validate(folds).held_out[f"{used.name}: tip"]
    else:
        held_out = rms(found.errors(poses(test))[0].values)
    if out is not None:
        found.plot().savefig(out)
    return [
        Row(
            "ftdcr_v4, three sections by length", "arcs, cables as springs, entry friction",
            len(found.estimates), rms(found.residuals[0].values), held_out,
            held_out / (10.0 * sum(LENGTHS)), "length", 6, spent[0],
        )
    ]  # fmt: skip


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--train", type=Path, required=True, help="poses to fit")
    parser.add_argument("--test", type=Path, help="poses to predict")
    parser.add_argument("--far", action="store_true", help="predict large bends from small ones")
    parser.add_argument("--folds", type=int, default=FOLDS, help="parts to leave out, if no test")
    parser.add_argument("--out", type=Path, help="a picture of the fit")
    given = parser.parse_args()
    script(lambda: rows(given.train, given.test, given.out, far=given.far, folds=given.folds))


if __name__ == "__main__":
    main()
