"""A catheter of 55 mm pulled to either side: NavidFeizi/DeepKoopman_catheter_model.

    python validation/catheter.py FOLDER [--file test.txt]

FOLDER holds dataset_info.json and files of one experiment, as data/catheter_1T_expt_forced_5.1.2
of the repository, with which no licence travels. The file is cut into sequences, each from a state
that it tells; every other one is fitted, the others are predicted.

Fitted, six numbers: how far a command pulls, stiffness of the cables, damping, mass at the tip,
tilt of the base and where it is along the catheter.
"""

from __future__ import annotations

import argparse
import csv
import json
from pathlib import Path

import numpy as np
from common import FloatArray, Row, amplitude, mean, rms, script, watch

import cdcr
from cdcr.identification import Motion

# Cosserat_model_params of dataset_info.json there, in SI units.
LENGTH, RADIUS, MODULUS, MASS, CIRCLE = 0.055, 0.4001769660928e-3, 15.467953664e9, 0.516e-3, 1.12e-3
COMPLIANCE = 0.252e-3  # of a cable [m/N]
DAMPING, TIP = 1e-5, 1e-3  # starts [N m s/rad], [kg]
EVERY = 5  # rows
LARGEST = 2.5  # bending angle at a start [rad]
PARAMETERS = {
    "sections[*].command_gain": {"low": 0.1},
    "cables.stiffness": None,
    "sections[*].damping": None,
    "payload": None,
    "base tilt y": None,
    "base position z": None,
}


def robot() -> cdcr.Robot:
    """Return the catheter with a cable on either side, on its side: it is seen in a plane."""
    section = cdcr.Section(
        length=LENGTH,
        backbone_mass=MASS,
        backbone_diameter=2.0 * RADIUS,
        youngs_modulus=MODULUS,
        damping=DAMPING,
        cable_radius=CIRCLE,
        cable_angles=[np.pi, 0.0],  # a positive command pulls towards -x
        cable_stiffness=1.0 / COMPLIANCE,
    )
    return cdcr.Robot(sections=[section], payload=TIP, gravity=(0.0, 0.0, 0.0))


def read(path: Path) -> FloatArray:
    """Return x, its rate, z, its rate and the command (N, 5) in SI units."""
    if not path.is_file():
        raise FileNotFoundError(f"there is no file {path}")
    found = []
    with path.open(newline="") as file:
        reader = csv.reader(file)
        if next(reader, None) != ["state", "input"]:
            raise ValueError(f"{path}, line 1: the columns must be state and input")
        for row in reader:
            where = f"{path}, line {reader.line_num}"
            try:
                state, command = (json.loads(one) for one in row)
                numbers = np.array([*state, *command], dtype=float)
            except (ValueError, TypeError):
                raise ValueError(f"{where}: state and input must be lists of numbers") from None
            if numbers.shape != (5,) or not np.isfinite(numbers).all():
                raise ValueError(f"{where}: state must be 4 finite numbers and input 1, got {row}")
            found.append(1e-3 * numbers)
    if not found:
        raise ValueError(f"{path} has no rows of numbers")
    return np.array(found)


def described(folder: Path) -> tuple[float, int]:
    """Return the time between rows [s] and the rows of a sequence."""
    path = folder / "dataset_info.json"
    if not path.is_file():
        raise FileNotFoundError(f"there is no file {path}")
    table = json.loads(path.read_text())
    values = [table.get(key) for key in ("sample_time", "test_sequence_length")]
    for key, value in zip(("sample_time", "test_sequence_length"), values, strict=True):
        if not isinstance(value, int | float) or not value > 0:
            raise ValueError(f"{path}: {key} must be a number > 0, got {value!r}")
    return float(values[0]), int(values[1])


def motion(rows: FloatArray, dt: float, name: str) -> Motion:
    """Return a sequence, which begins in the bend that its first row tells."""
    model = cdcr.Model(robot())
    angle = np.linspace(-LARGEST, LARGEST, 2001)
    x = model.tips(np.column_stack([angle, np.zeros_like(angle)]))[:, 0]
    rising = (angle > -2.0) & (angle < 2.0)  # where the tip goes out as it bends
    first = np.interp(rows[0, 0], x[rising], angle[rising])
    slope = np.interp(first, angle, np.gradient(x, angle))
    start = np.array([first, 0.0]), np.array([rows[0, 1] / slope, 0.0])
    few = rows[::EVERY]
    tip = np.column_stack([few[:, 0], np.zeros(len(few)), few[:, 2]])  # y is not measured
    pull = np.column_stack([few[:, 4], -few[:, 4]])
    t = dt * EVERY * np.arange(len(few))
    return Motion(t, pull, tip=tip, start=start, pulled=True, name=name, rtol=1e-6)


def rows(folder: Path, file: str) -> list[Row]:
    """Return the row of the table."""
    dt, size = described(folder)
    table = read(folder / file)
    cut = [table[k : k + size] for k in range(0, len(table) - size + 1, size)]
    if len(cut) < 2:
        raise ValueError(f"{folder / file} must have two sequences of {size} rows or more")
    motions = [motion(one, dt, f"{file} {k + 1}") for k, one in enumerate(cut)]
    with watch() as spent:
        found = cdcr.identify(motions[::2], robot(), PARAMETERS)
    print(found.report(), "\n")
    error = [rms(found.errors(one)[0].values) for one in motions[1::2]]
    share = [100.0 * off / amplitude(np.asarray(one.tip))
             for off, one in zip(error, motions[1::2], strict=True)]  # fmt: skip
    used = [rms(one.values) for one in found.residuals]
    return [
        Row(
            f"{folder.name} ({len(error)} sequences predicted)", "an arc, cables as springs",
            len(found.estimates), mean(used), mean(error), mean(share), "amplitude", 2, spent[0],
        )
    ]  # fmt: skip


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="of an experiment")
    parser.add_argument("--file", default="test.txt", help="of the folder")
    given = parser.parse_args()
    script(lambda: rows(given.folder, given.file))


if __name__ == "__main__":
    main()
