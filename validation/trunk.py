"""A trunk of three sections at rest: StanfordASL/trunk-stack, MIT.

    python validation/trunk.py FOLDER_OF_THE_REPOSITORY [--train 5]

A vacuum hose with three disks in motion capture, six motors that each pull one cable and let out
the one across. The first files of random commands on a circle (control_inputs_circle_seed*.csv)
are fitted, the others predicted.

Fitted, twelve numbers: how far a unit of command pulls and how the cables are wound, by section;
where the base is and how it is tilted; stiffness of the cables beside that of the hose.
"""

from __future__ import annotations

import argparse
import re
from pathlib import Path

import numpy as np
from common import FloatArray, Row, read_columns, rms, script, watch

import cdcr
from cdcr.identification import Poses

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


def rows(folder: Path, train: int) -> list[Row]:
    """Return the row of the table, for the last disk."""
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
        )
    ]  # fmt: skip


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="of the repository")
    parser.add_argument("--train", type=int, default=5, help="files that are fitted")
    given = parser.parse_args()
    script(lambda: rows(given.folder, given.train))


if __name__ == "__main__":
    main()
