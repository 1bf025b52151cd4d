"""A trunk of three sections, at rest and let go by hand: StanfordASL/trunk-stack, MIT.

    python validation/trunk.py FOLDER_OF_THE_REPOSITORY [--train 5]

A vacuum hose with three disks in motion capture, six motors that each pull one cable and let out
the one across. The first files of random commands on a circle (control_inputs_circle_seed*.csv)
are fitted, the others predicted.

Fitted, twelve numbers: how far a unit of command pulls and how the cables are wound, by section;
where the base is and how it is tilted; stiffness of the cables beside that of the hose.

Then it was pushed aside and let go, with loads of 200, 300 and 400 g. Two decays with the lightest
give stiffness and damping of hose and cables together, and these all other decays. Their files have
no times: samples are those of the motion capture, a hundred a second, for which the inputs of other
runs were made (stack/main/scripts/control_inputs_sampling.py).
"""

from __future__ import annotations

import argparse
import re
from dataclasses import replace
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
from cdcr.identification import Motion, Poses

STEADY = "stack/main/data/trajectories/steady_state"
LENGTHS = 0.107, 0.098, 0.119  # between the disks where nothing is pulled [m]
DIAMETER, CIRCLE, MASS = 0.045, 0.03, 0.1  # of a hose, its cables and a section: guesses [m], [kg]
UNIT = 0.03  # by which a unit of command pulls, a start [m]
SLACK = 5e-3  # by which all cables are drawn tight by springs [m]; a guess
# Motors of each section and where they pull to, as executor/experiment_node.py has it [deg].
MOTORS = ((3, 195.0), (5, -75.0)), ((2, 45.0), (4, 135.0)), ((1, 165.0), (6, 255.0))
PARAMETERS = dict.fromkeys([
    "sections[0].command_gain", "sections[1].command_gain", "sections[2].command_gain",
    "sections[0].cable_rotation", "sections[1].cable_rotation", "sections[2].cable_rotation",
    "base position", "base tilt", "cables.stiffness",
])  # fmt: skip

DECAYS = "stack/main/data/trajectories/dynamic/dc_motor_archive"
STEP = 0.01  # between samples [s]
MOVING, FREE, SECONDS = (
    0.3,
    0.1,
    2.0,
)  # speed of the tip let go [m/s], off hands later, compared [s]
AROUND = 4  # samples on either side of where a state is sought
FITTED = 1, 4  # which decays of the first file
FREELY = dict.fromkeys(["sections[*].bending_stiffness", "sections[*].damping"])


def turned(degrees: float) -> float:
    """Return an angle in radians, within half a turn."""
    return float(np.radians((degrees + 180.0) % 360.0 - 180.0))


def robot() -> cdcr.Robot:
    """Return the trunk, hanging."""
    sections = [
        cdcr.Section(
            length=length,
            backbone_mass=MASS,
            backbone_diameter=DIAMETER,
            youngs_modulus=1e6,
            cable_radius=CIRCLE,
            cable_angles=[turned(angle + across) for _, angle in motors for across in (0.0, 180.0)],
            cable_stiffness=1e3,
        )
        for length, motors in zip(LENGTHS, MOTORS, strict=True)
    ]
    return cdcr.Robot(sections=sections, gravity=(0.0, 0.0, 9.81), base_position=(0.1, 0.1, 0.0))


def poses(folder: Path, seeds: list[int], name: str) -> Poses:
    """Return the poses of some files."""
    commands, places = [], []
    for seed in seeds:
        inputs = folder / f"control_inputs_circle_seed{seed}.csv"
        seen = folder / f"observations_circle_seed{seed}.csv"
        told = read_columns(inputs, ["ID", *(f"u{k}" for k in range(1, 7))])
        disks = read_columns(seen, ["ID", *(f"{axis}{k}" for k in (1, 2, 3) for axis in "xyz")])
        if not np.array_equal(told[:, 0], disks[:, 0]):
            raise ValueError(f"{seen}: the column ID must be that of {inputs.name}")
        pull = [
            side * told[:, motor] for motors in MOTORS for motor, _ in motors for side in (1, -1)
        ]
        commands.append(UNIT * np.stack(pull, axis=1) + SLACK)
        places.append(ours(disks[:, 1:].reshape(-1, 3, 3)))
    there = np.concatenate(places)
    markers = {(i, 1.0): there[:, i] for i in range(3)}
    return Poses(np.concatenate(commands), markers=markers, pulled=True, name=name)


def ours(places: FloatArray) -> FloatArray:
    """Return places (..., 3) with Z down, where the file has Y up."""
    return np.stack([places[..., 0], places[..., 2], -places[..., 1]], axis=-1)


def hose(payload: float, places: FloatArray) -> cdcr.Robot:
    """Return the trunk with a load [kg], not pulled, above where its disks hang (..., 3)."""
    known = robot()
    sections = [
        replace(one, cable_stiffness=0.0, bending_stiffness=0.1, damping=0.1)
        for one in known.sections
    ]
    x, y, _ = places.reshape(-1, 3).mean(axis=0)
    return replace(known, sections=sections, base_position=(x, y, 0.0), payload=payload)


def decays(file: Path) -> list[FloatArray]:
    """Return where the disks went each time that the trunk was let go (N, 3, 3) [m]."""
    table = read_columns(file, ["ID", *(f"{axis}{k}" for k in (1, 2, 3) for axis in "xyz")])
    numbers, places = table[:, 0], ours(table[:, 1:].reshape(-1, 3, 3))
    return [places[numbers == number] for number in np.unique(numbers)]


def decay(places: FloatArray, known: cdcr.Robot, name: str) -> Motion:
    """Return the motion from when hands are off the trunk for sure."""
    speed = np.linalg.norm(np.gradient(places[:, 2], STEP, axis=0), axis=1)
    begin = int(np.argmax(speed > MOVING)) + round(FREE / STEP)
    model, near = cdcr.Model(known), np.arange(-AROUND, AROUND + 1)
    d = model.num_coordinates

    def seen(q: FloatArray) -> FloatArray:
        return np.stack([model.pose(q, i, 1.0)[1] for i in range(3)], axis=1)

    start = state_at(STEP * near, places[begin + near], seen, np.zeros(d), np.eye(d))
    there = places[begin : begin + round(SECONDS / STEP)]
    t, still = STEP * np.arange(len(there)), np.zeros(known.num_cables)
    markers = {(i, 1.0): there[:, i] for i in range(3)}
    return Motion(t, still, markers=markers, start=start, name=name)


def let_go(home: Path) -> list[Row]:
    """Return the row of decays, where there are files of them."""
    pattern = re.compile(r"observations_manual_decay_(\d+)g\w*\.csv")
    files = sorted((int(found[1]), one) for one in home.glob("*.csv")
                   if (found := pattern.match(one.name)))  # fmt: skip
    if not files:
        return []
    hung = np.stack([places[-1] for places in decays(files[0][1])])
    motions = {
        (grams, file.name, k): decay(places, hose(grams / 1e3, hung), f"{file.stem}, {k + 1}")
        for grams, file in files
        for k, places in enumerate(decays(file))
    }
    first, file = files[0]
    used = [motions.pop((first, file.name, k)) for k in FITTED]
    with watch() as spent:
        found = cdcr.identify(used, hose(first / 1e3, hung), FREELY)
    print(found.report(), "\n")
    errors, shares = [], []
    for (grams, _, _), one in motions.items():
        loaded = cdcr.Model(replace(found.robot, payload=grams / 1e3))
        t, tip = np.asarray(one.t), np.asarray((one.markers or {})[2, 1.0])
        run = cdcr.simulate(loaded, *one.start, t=t, command=np.zeros(loaded.num_cables))
        errors.append(rms(run.tip - tip))
        shares.append(100.0 * errors[-1] / amplitude(tip))
        print(f"{one.name}: off by {errors[-1]:.1f} mm RMS, {shares[-1]:.1f} %")
    fitted = [rms(one.values) for one in found.residuals if one.channel == "marker 3"]
    return [
        Row(
            f"trunk, let go by hand ({len(errors)} predicted)", "arcs", len(found.estimates),
            mean(fitted), mean(errors), mean(shares), "amplitude", 6, spent[0],
        )
    ]  # fmt: skip


def rows(folder: Path, train: int) -> list[Row]:
    """Return the rows of the table, for the last disk."""
    home = folder / STEADY
    pattern = re.compile(r"observations_circle_seed(\d+)\.csv")
    seeds = sorted(
        int(found[1]) for one in home.glob("*.csv") if (found := pattern.match(one.name))
    )
    if len(seeds) <= train:
        raise ValueError(f"there must be more than {train} observations_circle_seed*.csv in {home}")
    used = poses(home, seeds[:train], "used")
    with watch() as spent:
        found = cdcr.identify(used, robot(), PARAMETERS, loss="soft_l1")
    print(found.report(), "\n")
    held_out = rms(found.errors(poses(home, seeds[train:], "held out"))[2].values)
    return [
        Row(
            f"trunk, at rest ({len(seeds) - train} files predicted)", "arcs, cables as springs",
            len(found.estimates), rms(found.residuals[2].values), held_out,
            held_out / (10.0 * sum(LENGTHS)), "length", 6, spent[0],
        ),
        *let_go(folder / DECAYS),
    ]  # fmt: skip


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="of the repository")
    parser.add_argument("--train", type=positive, default=5, help="files that are fitted")
    given = parser.parse_args()
    script(lambda: rows(given.folder, given.train))


if __name__ == "__main__":
    main()
