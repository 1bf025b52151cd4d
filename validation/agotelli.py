"""A real robot of one section under tension, hanging: aGotelli/dataset_CR_dynamics.

    python validation/agotelli.py FOLDER_OF_THE_REPOSITORY [--parts 6] [--drag 0.003]

Backbone of 0.48 m, four cables on a circle of 37.5 mm, five disks in motion capture. Its record
is figshare 10.6084/m9.figshare.31990188; no licence travels with it, so nothing of it is here.

Fitted, six numbers. To two free releases, one in either plane: bending stiffness, damping, by how
much and along which direction it is stiffer. To pulls along two axes: the share of a tension that
arrives. They predict pulls between the axes and the other releases. Driven motion needs more
damping than a free swing, since the cables rub: with the share it is fitted once more, to one run
along a line, and predicts the others. Where the disks' markers sit is taken from the robot at rest.

--drag tells what releases would be with a drag of the air, which the model has not: on each disk a
force against its speed and with its square, N for each (m/s)^2. Fits take the speeds measured.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from common import (
    FloatArray,
    Row,
    amplitude,
    mean,
    positive,
    read_columns,
    rms,
    script,
    state_at,
    watch,
)

import cdcr
from cdcr.identification import Identified, Motion, Poses

LENGTH, CIRCLE, MASS = 0.48, 37.5e-3, 0.102  # [m], [m], [kg]; parameters_dataset_robot.m there
STIFFNESS = 0.088  # [N m^2], the same; where the fit begins
DIAMETER, ROD = 2.34e-3, 13.3e-3  # of nitinol of that stiffness [m], and its mass [kg]
NUM_DISKS, DISK = 4, 0.09  # beside that at the base, and about their diameter [m]
STATICS = "data_collection/dataCollectionPack/ACQUISITION_1711_vicon-m10"
DRIVEN = "data_collection/dataCollectionPack/20260127"
AT_REST = "statics_0"
SHORT = 1.5  # of a motion that is fitted first [s]
SECONDS = 12.0  # of a release that are compared
HALF, STRETCHES = 0.353, (0.0, 3.0, 6.0, SECONDS)  # a half swing, and in which it fades [s]
MOVING, FREE = 0.3, 2.5  # a tip faster than this [m/s] is on its way; cables are off it later [s]
STRIDE, ROUNDS = 4, 3  # samples between those of a drag, and runs by which it is found
MODES, AROUND = 4, 6  # in which a state is sought, and samples on either side of it
EVERY = 0.05  # of a driven run, whose tensions change slowly [s]
QUIET = 0.02  # tensions below are those of a slack cable [N]
CABLES = "1_x", "2_y", "1_-x", "2_-y"
UPRIGHT = np.array([-1.0, 1.0, -1.0])  # axes of the room, Z up, in those of the robot
MODEL, AIR = "arcs in {} parts, stiffer along a direction", ", drag"
FITTED = "tip_release-x_3", "tip_release+y_1"
DRAWN = "plane_x_angle_150_speed_1"
# Two springs along the robot, opposite each other and always taut, stiffen the plane they are in.
STIFFER = np.radians(35.0)  # of that plane from X; found by trial: the sixth number
SPRING, TAUT = 0.5, 0.4  # [N/m], and how long they are drawn [m]
FREELY = {
    "sections[*].bending_stiffness": None,
    "sections[*].damping": {"high": 0.05},
    "cables[*].stiffness": None,
}
ARRIVES = {"sections[*].command_gain": None}
RUBBED = ARRIVES | {"sections[*].damping": {"high": 0.5}}


def robot(parts: int) -> cdcr.Robot:
    """Return the robot, Z down along it."""
    section = cdcr.Section(
        length=LENGTH,
        backbone_mass=ROD,
        backbone_diameter=DIAMETER,
        youngs_modulus=60e9,
        bending_stiffness=STIFFNESS,
        num_disks=NUM_DISKS,
        disk_mass=(MASS - ROD) / NUM_DISKS,
        disk_diameter=DISK,
        cable_radius=CIRCLE,
        cable_angles=np.pi * np.array([0.0, 0.5, 1.0, 1.5]),
        damping=2e-3,
    )
    cut = cdcr.Robot(sections=[section], gravity=(0.0, 0.0, 9.81)).subdivide(parts)
    springs = [
        cdcr.Cable(radius=CIRCLE, angle=angle, end_section=parts - 1, stiffness=SPRING)
        for angle in (STIFFER, STIFFER + np.pi)
    ]
    return replace(cut, cables=springs)


def told(tensions: FloatArray) -> FloatArray:
    """Return commands of tensions (..., 4): the springs stay as they are."""
    return np.concatenate([tensions, np.full((*tensions.shape[:-1], 2), TAUT)], axis=-1)


def disks(path: Path) -> tuple[FloatArray, FloatArray]:
    """Return times and where the five disks are, from the first [m], of a raw file."""
    names = ["timestamp", *(f"disk_{k} {axis} (m)" for k in range(5) for axis in "xyz")]
    table = read_columns(path, names)
    places = table[:, 1:].reshape(-1, 5, 3)
    return table[:, 0], places - places[:1, :1].mean(axis=0)


def markers(folder: Path) -> FloatArray:
    """Return where the markers of disks 1 to 4 are seen beside the straight robot (4, 3) [m]."""
    _, places = disks(one_file(folder / AT_REST, "dataVicon*.csv"))
    along = LENGTH / NUM_DISKS * np.arange(1.0, NUM_DISKS + 1.0)
    return places.mean(axis=0)[1:] - np.outer(along, [0.0, 0.0, 1.0])


def seen_at(known: cdcr.Robot, marker: FloatArray) -> cdcr.Robot:
    """Return the robot with its tool at a marker of the last disk."""
    tool = np.eye(4)
    tool[:3, 3] = marker
    return replace(known, tool=tool)


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
        command.append(told(tension))
        tip.append(places[:, 4].mean(axis=0))
    return Poses(command, tip=tip, name="pulls")


def state(
    t: FloatArray, places: FloatArray, begin: int, model: cdcr.Model, beside: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return shape and rates at a time, in the first modes, from the disks a little around it."""
    slack = told(np.zeros(4))
    rest = model.equilibrium(slack)
    modes = model.modes(rest, slack).shape[:, :MODES]
    near = np.arange(begin - AROUND, begin + AROUND + 1)

    def seen(q: FloatArray) -> FloatArray:
        poses = [model.pose(q, *place) for place in ends(model.robot)]
        there = [place + turn @ marker for (turn, place), marker in zip(poses, beside, strict=True)]
        return np.stack(there, axis=1)

    return state_at(t[near] - t[begin], places[near, 1:], seen, rest, modes)


def ends(known: cdcr.Robot) -> list[tuple[int, float]]:
    """Return section and fraction of disks 1 to 4."""
    along = LENGTH / NUM_DISKS * np.arange(1.0, NUM_DISKS + 1.0)
    return [known.locate(min(end, known.length)) for end in along]


def drags(t: FloatArray, places: FloatArray, known: cdcr.Robot, drag: float) -> list[cdcr.Wrench]:
    """Return the drag of the air on disks that go through these places (N, NUM_DISKS, 3)."""
    t, places = t[::STRIDE], places[::STRIDE]
    speed = np.gradient(places, t, axis=0)
    force = -drag * np.linalg.norm(speed, axis=2, keepdims=True) * speed
    return [
        cdcr.Wrench(section=i, fraction=f, force=axis, profile=(t, force[:, disk, k]))
        for disk, (i, f) in enumerate(ends(known))
        for k, axis in enumerate(np.eye(3))
    ]


def in_air(motion: Motion, known: cdcr.Robot, drag: float) -> Motion:
    """Return a release with the drag of the speeds that the robot itself has, found by runs."""
    model, t = cdcr.Model(known), np.asarray(motion.t)
    air: list[cdcr.Wrench] = []
    for _ in range(ROUNDS if drag else 0):
        command = np.asarray(motion.command)[0]
        run = cdcr.simulate(model, *motion.start, t=t, command=command, wrenches=air)
        places = np.stack([model.pose(run.q, *place)[1] for place in ends(known)], axis=1)
        air = drags(t, places, known, drag)
    return replace(motion, wrenches=air)


def release(
    folder: Path, name: str, known: cdcr.Robot, beside: FloatArray, drag: float = 0.0
) -> Motion:
    """Return a free release, from when hand, string and cut cable are off it for sure."""
    t, places = disks(one_file(folder / name, "dataVicon*.csv"))
    tip = places[:, 4]
    speed = np.linalg.norm(np.gradient(tip, t, axis=0), axis=1)
    begin = int(np.argmax(t > t[np.argmax(speed > MOVING)] + FREE))
    chosen = (t >= t[begin]) & (t <= t[begin] + SECONDS)
    start = state(t, places, begin, cdcr.Model(replace(known, tool=np.eye(4))), beside)
    since, slack = t[chosen] - t[begin], told(np.zeros(4))
    air = drags(since, places[chosen, 1:], known, drag) if drag else []
    return Motion(since, slack, tip=tip[chosen], start=start, wrenches=air, name=name)


def fading(motion: Motion) -> str:
    """Return how fast swings of some sizes fade, and how often they come, as a sentence."""
    t, tip = np.asarray(motion.t), np.asarray(motion.tip)
    aside = (tip - tip.mean(axis=0))[:, :2]
    away = np.linalg.norm(aside, axis=1)
    along = aside @ np.linalg.svd(aside, full_matrices=False)[2][0]
    up = np.flatnonzero((along[:-1] < 0.0) & (along[1:] >= 0.0))
    through = t[up] - along[up] * (t[up + 1] - t[up]) / (along[up + 1] - along[up])
    count = int(t[-1] / HALF)
    middle = HALF * (np.arange(count) + 0.5)
    most = np.array([away[(t >= k * HALF) & (t < (k + 1) * HALF)].max() for k in range(count)])
    told = []
    for low, high in pairwise(STRETCHES):
        here = (middle >= low) & (middle < high)
        if here.sum() > 2:
            rate = -np.polyfit(middle[here], np.log(most[here]), 1)[0]
            turns = through[(through >= low) & (through < high)]
            hertz = (len(turns) - 1) / (turns[-1] - turns[0]) if len(turns) > 1 else np.nan
            told.append(f"of {1e3 * most[here].mean():.0f} mm by {rate:.3f} 1/s at {hertz:.4f} Hz")
    return f"{motion.name}: its swings fade, " + ", ".join(told)


def driven(folder: Path, name: str) -> Motion:
    """Return a run under measured tensions, from the raw files: their clock is one."""
    # In the processed file of one circle the base is turned by 37 degrees. Angles of its first
    # disk jump by a whole turn in the raw file: filtered, they would give such a frame.
    clock, places = disks(folder / name / "dataVicon.csv")
    columns = ["timestamp", "tension (N)"]
    forces = [read_columns(folder / name / f"dataMark10_{one}.csv", columns) for one in CABLES]
    first = max(clock[0], *(one[0, 0] for one in forces))
    last = min(clock[-1], *(one[-1, 0] for one in forces))
    t = np.arange(first, last, EVERY)
    pull = [np.maximum(-np.interp(t, *one.T), 0.0) for one in forces]
    tip = [np.interp(t, clock, places[:, 4, k]) for k in range(3)]
    return Motion(
        t - first, told(np.stack(pull, axis=1)), tip=UPRIGHT * np.stack(tip, axis=1), name=name,
        rtol=1e-6,
    )  # fmt: skip


def largest(motion: Motion) -> float:
    """Return how far the tip goes from its mean place [mm]."""
    return amplitude(np.asarray(motion.tip))


def errors(found: Identified, motions: Sequence[Motion]) -> list[float]:
    """Return the error of each motion predicted [mm]."""
    told = [rms(found.errors(one)[0].values) for one in motions]
    for one, error in zip(motions, told, strict=True):
        off = found.errors(one)[0].values
        plane = 1e3 * np.sqrt(np.mean(off**2, axis=0))
        axes = ", ".join(f"{value:.1f}" for value in plane)
        print(f"{one.name}: off by {error:.2f} mm RMS ({axes}), its tip goes {largest(one):.0f} mm")
    return told


def rows(folder: Path, parts: int, drag: float = 0.0) -> list[Row]:
    """Return the rows of the table."""
    home, model = folder / STATICS, MODEL.format(parts) + (AIR if drag else "")
    beside = markers(home)
    known = seen_at(robot(parts), beside[-1])
    names = sorted(path.name for path in home.glob("*release*"))
    motions = {name: release(home, name, known, beside, drag) for name in names}
    print("\n".join(fading(one) for one in motions.values()), "\n")
    used = [motions.pop(name) for name in FITTED]
    every = sorted(path.name for path in home.glob("statics_*"))
    others = [name for name in every if "diagonal" in name]
    poses = pulls(home, [name for name in every if name not in (AT_REST, *others)])
    with watch() as spent:
        # Over a short time first: later swings may be taken for one another.
        near = cdcr.identify([one.until(SHORT) for one in used], known, FREELY)
        free = cdcr.identify(used, near.robot, FREELY)
    print(free.report(), "\n")
    motions = {name: in_air(one, free.robot, drag) for name, one in motions.items()}
    size, swings, fitted = 2 * parts, root_mean_square(free), len(free.estimates) + 1 + bool(drag)
    by_hand = [one for name, one in motions.items() if name.startswith("tip")]
    by_cable = [one for name, one in motions.items() if not name.startswith("tip")]
    table = [
        row(what, model, fitted, swings, free, some, size, spent[0])
        for what, some in (("tip let go", by_hand), ("cable let go", by_cable))
        if some
    ]
    with watch() as spent:
        found = cdcr.identify(poses, free.robot, ARRIVES)
    print(found.report(), "\n")
    still = rms(found.errors(pulls(home, others))[0].values)
    first = Row(
        "aGotelli, pulls at rest", model, fitted + 1, root_mean_square(found), still,
        still / (10.0 * LENGTH), "length", size, spent[0],
    )  # fmt: skip
    runs = sorted(path.parent.name for path in (folder / DRIVEN).glob("[!P]*/dataVicon.csv"))
    if DRAWN in runs:
        with watch() as spent:
            found = cdcr.identify(driven(folder / DRIVEN, DRAWN), free.robot, RUBBED)
        print(found.report(), "\n")
        far = [driven(folder / DRIVEN, name) for name in runs if name != DRAWN]
        error = root_mean_square(found)
        table.append(row("driven", model, fitted + 1, error, found, far, size, spent[0]))
    return [first, *table]


def root_mean_square(found: Identified) -> float:
    """Return the error of all that was fitted [mm]."""
    return mean([rms(one.values) for one in found.residuals])


def row(
    what: str, model: str, fitted: int, used: float, found: Identified,
    motions: Sequence[Motion], size: int, seconds: float,
) -> Row:  # fmt: skip
    """Return the row of motions that are predicted."""
    told = errors(found, motions)
    free = what != "driven"
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
    parser.add_argument(
        "--parts", type=positive, default=4, help="arcs that the section is cut into"
    )
    parser.add_argument("--drag", type=float, default=0.0, help="of a disk [N s^2/m^2]")
    given = parser.parse_args()
    script(lambda: rows(given.folder, given.parts, given.drag))


if __name__ == "__main__":
    main()
