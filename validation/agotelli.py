"""A real robot of one section under tension, hanging: aGotelli/dataset_CR_dynamics.

    python validation/agotelli.py FOLDER_OF_THE_REPOSITORY [--parts 6]

Backbone of 0.48 m, four cables on a circle of 37.5 mm, five disks seen by motion capture. Its record
is figshare 10.6084/m9.figshare.31990188; no licence travels with it, so nothing of it is here.

Static pulls: bending stiffness and the tilt of the base (3 numbers) from the pulls in one plane,
which then predict those in the others. Releases: weight and damping (2 more) from one, which then
predict the rest. Driven: the same five, but damping, which driven motion needs more of, from one
run along a line, which then predict the others.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
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
STILL = 2e-3  # a tip that has moved farther has been let go [m]
EVERY = 5  # rows of a driven run, whose tensions change slowly
QUIET = 0.02  # tensions below are those of a slack cable [N]
MODEL = "arcs in {} parts"


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


def release(folder: Path, name: str, known: cdcr.Robot) -> Motion:
    """Return a free release. The robot was held there by whatever force at the tip holds it."""
    from scipy.optimize import least_squares  # type: ignore[import-untyped]

    t, places = disks(one_file(folder / name, "dataVicon*.csv"))
    tip = places[:, 4]
    gone = int(np.argmax(np.linalg.norm(tip - tip[:20].mean(axis=0), axis=1) > STILL)) - 1
    begin = max(gone, 0)
    chosen = (t >= t[begin]) & (t <= t[begin] + SECONDS)
    model, last = cdcr.Model(known), len(known.sections) - 1
    held = tip[max(begin - 10, 0) : begin + 1].mean(axis=0)
    by_cable = "tendon" in name

    def shape(force: FloatArray) -> FloatArray:
        if by_cable:  # pulled by two neighbouring cables
            tension = np.maximum([force[0], force[1], -force[0], -force[1]], 0.0)
            return model.equilibrium(tension)
        return model.equilibrium(wrenches=cdcr.Wrench(section=last, force=force))

    start = held[:2] * (30.0 if by_cable else 5.0)
    size = start if by_cable else np.append(start, 0.0)
    force = least_squares(lambda x: (model.tip(shape(x))[1] - held) / 1e-3, size).x
    still = np.zeros(model.num_coordinates)
    return Motion(
        t[chosen] - t[begin], np.zeros(4), tip=tip[chosen], start=(shape(force), still),
        name=name,
    )  # fmt: skip


def driven(folder: Path, name: str) -> Motion:
    """Return a run under measured tensions, from the processed files."""
    home = folder / name / "processed"
    tension = read_columns(home / "cable_tensions.csv")
    frames = read_columns(home / "vicon_frames.csv")
    tip = frames[:, 29:32]
    flip = np.array([1.0, 1.0, 1.0]) if tip[0, 2] > 0.0 else np.array([1.0, -1.0, -1.0])
    pull = np.maximum(-tension[:, 1:], 0.0)
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
        print(f"{one.name}: predicted to {error:.2f} mm RMS, its tip goes {largest(one):.0f} mm")
    return told


def mean(values: Sequence[float]) -> float:
    """Return the root mean square, NaN of nothing."""
    return float(np.sqrt(np.mean(np.square(values)))) if values else np.nan


def rows(folder: Path, parts: int) -> list[Row]:
    """Return the rows of the table."""
    home, known, model = folder / STATICS, robot(parts), MODEL.format(parts)
    coordinates = 2 * parts
    everything = sorted(path.name for path in home.glob("statics_*"))
    plane = [name for name in everything if "xz" in name or name == "statics_0"]
    others = [name for name in everything if name not in plane]
    with watch() as spent:
        found = cdcr.identify(
            pulls(home, plane), known, {"sections[*].youngs_modulus": None, "base tilt": None}
        )
    print(found.report(), "\n")
    used = rms(found.residuals[0].values)
    held_out = rms(found.errors(pulls(home, others))[0].values)
    table = [
        Row("aGotelli, static pulls", model, 3, used, held_out, held_out / (10.0 * LENGTH),
            "length", coordinates, spent[0])
    ]  # fmt: skip
    known = found.robot

    names = sorted(path.name for path in home.glob("*release*"))
    motions = [release(home, name, known) for name in names]
    table.append(predicted("releases", motions, known, ["sections[*].backbone_mass"], parts))

    runs = sorted(path.parent.parent.name for path in (folder / DRIVEN).glob("*/processed/cable_t*"))
    lines = [name for name in runs if "plane_x_angle" in name]
    if lines:
        motions = [driven(folder / DRIVEN, name) for name in [lines[0], *sorted({*runs} - {*lines})]]
        table.append(predicted("driven", motions, known, [], parts))
    return table


def predicted(
    what: str, motions: list[Motion], known: cdcr.Robot, more: list[str], parts: int
) -> Row:
    """Return the row of motions: the first is fitted, the others are predicted."""
    names = ["sections[*].damping", *more]
    with watch() as spent:
        # Over a short time first: later swings may be taken for one another.
        near = cdcr.identify(motions[0].until(SHORT), known, dict.fromkeys(names))
        found = cdcr.identify(motions[0], near.robot, dict.fromkeys(names))
    print(found.report(), "\n")
    told = errors(found, motions[1:])
    free = what == "releases"
    share = [100.0 * error / (largest(one) if free else 1e3 * LENGTH)
             for error, one in zip(told, motions[1:], strict=True)]  # fmt: skip
    return Row(
        f"aGotelli, {what} ({len(told)} predicted)", MODEL.format(parts), 3 + len(names),
        rms(found.residuals[0].values), mean(told), mean(share),
        "amplitude" if free else "length", 2 * parts, spent[0],
    )  # fmt: skip


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="of the repository")
    parser.add_argument("--parts", type=int, default=6, help="arcs that the section is cut into")
    given = parser.parse_args()
    script(lambda: rows(given.folder, given.parts))


if __name__ == "__main__":
    main()
