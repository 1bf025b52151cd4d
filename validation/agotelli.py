"""A real robot of one section under tension, hanging: aGotelli/dataset_CR_dynamics.

    python validation/agotelli.py FOLDER_OF_THE_REPOSITORY [--parts 6]

Backbone of 0.48 m, four cables on a circle of 37.5 mm, five disks in motion capture. Its record
is figshare 10.6084/m9.figshare.31990188; no licence travels with it, so nothing of it is here.

Stiffness, weight, damping and the tilt of the base (5 numbers) are fitted to pulls along two axes
and to one free release; they predict pulls between the axes and the other releases. Driven motion
needs more damping than a free swing, since the cables rub: that is fitted once more, to one run
along a line, and predicts the others.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from common import FloatArray, Row, read_columns, rms, script, watch

import cdcr
from cdcr.identification import Identified, Motion, Poses

LENGTH, CIRCLE, MASS = 0.48, 37.5e-3, 0.102  # [m], [m], [kg]; parameters_dataset_robot.m there
DIAMETER, MODULUS = 4e-3, 7e9  # of a backbone with E I = 0.088 N m^2
STATICS = "data_collection/dataCollectionPack/ACQUISITION_1711_vicon-m10"
DRIVEN = "data_collection/dataCollectionPack/20260127"
SHORT = 1.5  # of a motion that is fitted first [s]
SECONDS = 12.0  # of a release that are compared
MOVING, FREE = 0.3, 0.3  # a tip faster than this [m/s] is on its way, and so long after free [s]
MODES, AROUND = 4, 6  # in which a state is sought, and samples on either side of it
EVERY = 5  # rows of a driven run, whose tensions change slowly
QUIET = 0.02  # tensions below are those of a slack cable [N]
MODEL = "arcs in {} parts"
FIRST, DRAWN = "tip_release-x_3", "plane_x_angle_150_speed_1"  # that are fitted
FREELY = {
    "sections[*].youngs_modulus": None,
    "sections[*].backbone_mass": None,
    "sections[*].damping": {"high": 0.05},
    "base tilt": None,
}


def robot(parts: int) -> cdcr.Robot:
    """Return the robot, Z down along it."""
    section = cdcr.Section(
        length=LENGTH,
        backbone_mass=MASS,
        backbone_diameter=DIAMETER,
        youngs_modulus=MODULUS,
        cable_radius=CIRCLE,
        cable_angles=np.pi * np.array([0.0, 0.5, 1.0, 1.5]),
        damping=2e-3,
    )
    return cdcr.Robot(sections=[section], gravity=(0.0, 0.0, 9.81)).subdivide(parts)


def disks(path: Path) -> tuple[FloatArray, FloatArray]:
    """Return times and where the five disks are, from the first [m], of a raw file."""
    names = ["timestamp", *(f"disk_{k} {axis} (m)" for k in range(5) for axis in "xyz")]
    table = read_columns(path, names)
    places = table[:, 1:].reshape(-1, 5, 3)
    return table[:, 0] - table[0, 0], places - places[:1, :1].mean(axis=0)


def one_file(folder: Path, pattern: str) -> Path:
    """Return the file of a folder that fits a pattern, or say that there is none."""
    found = sorted(folder.glob(pattern))
    if not found:
        raise FileNotFoundError(f"there is no file {pattern} in {folder}")
    return found[0]


def pulls(folder: Path, names: Sequence[str]) -> Poses:
    """Return static poses by the means of tensions and places; two cables are measured."""
    command, tip = [], []
    for name in names:
        tension = np.zeros(4)
        for cable, pattern in ((2, "*-x*.csv"), (3, "*-y*.csv")):
            file = one_file(folder / name, f"dataMark10{pattern}")
            mean = -float(read_columns(file, ["tension (N)"]).mean())
            tension[cable] = mean if mean > QUIET else 0.0
        _, places = disks(one_file(folder / name, "dataVicon*.csv"))
        command.append(tension)
        tip.append(places[:, 4].mean(axis=0))
    return Poses(command, tip=tip, name="pulls")


def state(
    t: FloatArray, places: FloatArray, begin: int, model: cdcr.Model
) -> tuple[FloatArray, FloatArray]:
    """Return shape and rates at a time, in the first modes, from the disks a little around it."""
    from scipy.optimize import least_squares  # type: ignore[import-untyped]

    no_pull = np.zeros(model.num_cables)
    rest = model.equilibrium(no_pull)
    modes = model.modes(rest, no_pull).shape[:, :MODES]
    near = np.arange(begin - AROUND, begin + AROUND + 1)
    since = t[near] - t[begin]
    powers = since[:, None] ** np.arange(4)  # a cubic in time
    ends = model.robot.length * np.arange(1, 5) / 4.0
    at = [model.robot.locate(min(end, model.robot.length)) for end in ends]

    def apart(x: FloatArray) -> FloatArray:
        q = rest + powers @ x.reshape(4, -1) @ modes.T
        there = np.stack([model.pose(q, *place)[1] for place in at], axis=1)
        return ((there - places[near, 1:]) / 1e-3).ravel()

    found = least_squares(apart, np.zeros(4 * MODES)).x.reshape(4, -1)
    return rest + modes @ found[0], modes @ found[1]


def release(folder: Path, name: str, known: cdcr.Robot) -> Motion:
    """Return a free release, from when hand and string are off it for sure."""
    t, places = disks(one_file(folder / name, "dataVicon*.csv"))
    tip = places[:, 4]
    speed = np.linalg.norm(np.gradient(tip, t, axis=0), axis=1)
    begin = int(np.argmax(t > t[np.argmax(speed > MOVING)] + FREE))
    chosen = (t >= t[begin]) & (t <= t[begin] + SECONDS)
    start = state(t, places, begin, cdcr.Model(known))
    return Motion(t[chosen] - t[begin], np.zeros(4), tip=tip[chosen], start=start, name=name)


def driven(folder: Path, name: str) -> Motion:
    """Return a run under measured tensions, from the processed files."""
    home = folder / name / "processed"
    tension = read_columns(home / "cable_tensions.csv")
    frames = read_columns(home / "vicon_frames.csv")
    tip = frames[:, 29:32]
    pull = np.maximum(-tension[:, 1:], 0.0)
    # Frames differ between runs: Z is along the robot here, X and Y to where the cables pull.
    towards = (pull[:, :2] - pull[:, 2:]) * (tip[:, :2] - tip[:1, :2])
    flip = np.append(np.where(towards.sum(axis=0) < 0.0, -1.0, 1.0), np.sign(tip[0, 2]))
    few = slice(None, None, EVERY)
    return Motion(tension[few, 0], pull[few], tip=tip[few] * flip, name=name, rtol=1e-7)


def largest(motion: Motion) -> float:
    """Return how far the tip goes from where it ends [mm]."""
    tip = np.asarray(motion.tip)
    return float(1e3 * np.linalg.norm(tip - tip[-1], axis=1).max())


def errors(found: Identified, motions: Sequence[Motion]) -> list[float]:
    """Return the error of each motion predicted [mm]."""
    told = [rms(found.errors(one)[0].values) for one in motions]
    for one, error in zip(motions, told, strict=True):
        off = found.errors(one)[0].values
        plane = 1e3 * np.sqrt(np.mean(off**2, axis=0))
        axes = ", ".join(f"{value:.1f}" for value in plane)
        print(f"{one.name}: off by {error:.2f} mm RMS ({axes}), its tip goes {largest(one):.0f} mm")
    return told


def mean(values: Sequence[float]) -> float:
    """Return the root mean square, NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if values else np.nan


def rows(folder: Path, parts: int) -> list[Row]:
    """Return the rows of the table."""
    home, model = folder / STATICS, MODEL.format(parts)
    everything = sorted(path.name for path in home.glob("statics_*"))
    others = [name for name in everything if "diagonal" in name]
    poses = pulls(home, [name for name in everything if name not in others])
    names = sorted(path.name for path in home.glob("*release*"))
    motions = [release(home, name, robot(parts)) for name in names]
    first = motions.pop(names.index(FIRST) if FIRST in names else 0)
    with watch() as spent:
        # Over a short time first: later swings may be taken for one another.
        near = cdcr.identify([poses, first.until(SHORT)], robot(parts), FREELY)
        found = cdcr.identify([poses, first], near.robot, FREELY)
    print(found.report(), "\n")
    still = rms(found.errors(pulls(home, others))[0].values)
    fitted, size = len(found.estimates), 2 * parts
    share = still / (10.0 * LENGTH)
    used = [rms(one.values) for one in found.residuals]
    table = [
        Row(
            "aGotelli, pulls at rest",
            model,
            fitted,
            used[0],
            still,
            share,
            "length",
            size,
            spent[0],
        ),
        row("releases", model, fitted, used[1], found, motions, size, spent[0]),
    ]
    runs = sorted(
        path.parent.parent.name for path in (folder / DRIVEN).glob("*/processed/cable_t*")
    )
    if DRAWN in runs:
        used_run = driven(folder / DRIVEN, DRAWN)
        with watch() as spent:
            found = cdcr.identify(used_run, found.robot, {"sections[*].damping": {"high": 0.5}})
        print(found.report(), "\n")
        motions = [driven(folder / DRIVEN, name) for name in runs if name != DRAWN]
        used_rms = rms(found.residuals[0].values)
        table.append(row("driven", model, fitted + 1, used_rms, found, motions, size, spent[0]))
    return table


def row(
    what: str, model: str, fitted: int, used: float, found: Identified,
    motions: Sequence[Motion], size: int, seconds: float,
) -> Row:  # fmt: skip
    """Return the row of motions that are predicted."""
    told = errors(found, motions)
    free = what == "releases"
    share = [100.0 * error / (largest(one) if free else 1e3 * LENGTH)
             for error, one in zip(told, motions, strict=True)]  # fmt: skip
    return Row(
        f"aGotelli, {what} ({len(told)} predicted)", model, fitted, used, mean(told), mean(share),
        "amplitude" if free else "length", size, seconds,
    )  # fmt: skip


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="of the repository")
    parser.add_argument("--parts", type=int, default=4, help="arcs that the section is cut into")
    given = parser.parse_args()
    script(lambda: rows(given.folder, given.parts))


if __name__ == "__main__":
    main()
