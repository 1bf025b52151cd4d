"""validation/agotelli.py, run on files in the format of its source, made by the model here."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray
from validation_scripts import agotelli, write

STIFFNESS, DAMPING, SPRING, ARRIVES, RUBBING = 0.07, 1.5e-3, 0.6, 0.9, 0.05
MARKERS = np.array([[3e-3, 1e-3, -1e-3], [4e-3, 2e-3, 0.0], [5e-3, 6e-3, 0.0], [9e-3, 7e-3, -2e-3]])
ROOM = np.array([1.0, -0.5, 1.1])  # where the base is in the room [m]
STEP = 0.005  # of all files [s]
PREDICTED = 1.0  # [mm]: a state at the start is found from a cubic over some samples
RUN = "plane_y_angle_150_speed_1"


def true_robot(damping: float = DAMPING) -> cdcr.Robot:
    known: cdcr.Robot = agotelli.robot(1)
    section = replace(known.sections[0], bending_stiffness=STIFFNESS, damping=damping)
    springs = [replace(one, stiffness=SPRING) for one in known.cables]
    return replace(known, sections=(section,), cables=tuple(springs))


def vicon(path: Path, t: FloatArray, model: cdcr.Model, q: FloatArray, axes: Any = 1.0) -> None:
    """Write where the disks are at shapes q (N, 2)."""
    places = [np.zeros((len(t), 3))]
    for k, marker in enumerate(MARKERS):
        turn, there = model.pose(q, 0, 0.25 * (k + 1))
        places.append(there + turn @ marker)
    header = ["timestamp", *(f"disk_{k} {axis} (m)" for k in range(5) for axis in "xyz")]
    write(path, header, np.column_stack([t, *(ROOM + one * axes for one in places)]))


def forces(folder: Path, t: FloatArray, tension: FloatArray, end: str) -> None:
    for name, column in zip(agotelli.CABLES, tension.T, strict=True):
        write(folder / f"dataMark10_{name}{end}.csv", ["timestamp", "tension (N)"],
              np.column_stack([t, -column]))  # fmt: skip


def laboratory(folder: Path) -> None:
    """Write pulls, releases and driven runs."""
    home, model = folder / agotelli.STATICS, cdcr.Model(true_robot())
    few = np.linspace(0.0, 0.02, 3)
    pulls = {"statics_0": (0.0, 0.0), "statics_xz_plane_1": (3.0, 0.0),
             "statics_yz_plane_1": (0.0, 4.0), "statics_diagonal_plane_1": (3.0, 3.0)}  # fmt: skip
    for name, (x, y) in pulls.items():
        tension = np.array([0.0, 0.0, x, y])
        q = model.equilibrium(agotelli.told(ARRIVES * tension))
        q = np.tile(np.zeros(2) if name == agotelli.AT_REST else q, (3, 1))
        vicon(home / name / "dataVicon_.csv", few, model, q)
        forces(home / name, few, np.tile(tension, (3, 1)), "_")
    t = np.arange(0.0, 1.0, STEP)
    slack = agotelli.told(np.zeros(4))
    held = {"tip_release-x_3": (0.0, 0.0, 5.0, 0.2), "tip_release+y_1": (0.1, 5.0, 0.0, 0.0),
            "oscillation40s_from_tendon_release-x_3": (0.0, 0.0, 6.0, 0.0)}  # fmt: skip
    for name, pull in held.items():
        q0 = model.equilibrium(agotelli.told(np.array(pull)))
        run = cdcr.simulate(model, q0, [0.0, 0.0], t=t, command=slack, method="dopri5")
        vicon(home / name / "dataVicon_.csv", 1.7e9 + t, model, run.q)
    model, home = cdcr.Model(true_robot(RUBBING)), folder / agotelli.DRIVEN
    for name, first in ((agotelli.DRAWN, 0), (RUN, 1)):
        tension = np.zeros((len(t), 4))
        tension[:, first], tension[:, first + 2] = 1.0 + 6.0 * t, 1.0
        told = cdcr.TensionTable(t, agotelli.told(ARRIVES * tension))
        q0 = model.equilibrium(agotelli.told(ARRIVES * tension[0]))
        run = cdcr.simulate(model, q0, [0.0, 0.0], t=t, command=told, method="dopri5")
        vicon(home / name / "dataVicon.csv", 1.7e9 + t, model, run.q, agotelli.UPRIGHT)
        forces(home / name, 1.7e9 + t, tension, "")


def test_it_finds_the_robot_that_made_the_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    laboratory(tmp_path)
    for name, value in {"SHORT": 0.3, "SECONDS": 0.6, "FREE": 0.1, "EVERY": 0.02}.items():
        monkeypatch.setattr(agotelli, name, value)
    rows = {row.source: row for row in agotelli.rows(tmp_path, parts=1)}
    printed = capsys.readouterr().out
    assert list(rows) == ["aGotelli, pulls at rest", "aGotelli, cable let go (1 predicted)",
                          "aGotelli, driven (1 predicted)"]  # fmt: skip
    for row in rows.values():
        assert row.used < PREDICTED, row
        assert row.held_out < PREDICTED, row
    for name, value in (("bending_stiffness", STIFFNESS), ("all cables: stiffness", SPRING),
                        ("command_gain", ARRIVES)):  # fmt: skip
        line = next(one for one in printed.splitlines() if name in one)
        assert float(line.split()[3]) == pytest.approx(value, rel=0.02), line


def test_drag_takes_power_with_the_cube_of_the_speed() -> None:
    t, rate = np.linspace(0.0, 1.0, 101), np.array([[0.1, 0.2, 0.0], [0.0, -0.3, 0.4]])
    places = np.zeros((101, agotelli.NUM_DISKS, 3))
    places[:, 2:] = t[:, None, None] * rate
    forces = np.zeros(3), np.zeros(3)
    for wrench in agotelli.drags(t, places, agotelli.robot(2), 3e-3):
        disk = round(4.0 * (wrench.section + wrench.fraction) / 2.0) - 1
        if disk >= 2:
            forces[disk - 2][:] += wrench.at(0.5).force
        else:
            assert not np.any(wrench.at(0.5).force)
    for force, speed in zip(forces, rate, strict=True):
        assert force @ speed == pytest.approx(-3e-3 * np.linalg.norm(speed) ** 3)
        np.testing.assert_allclose(np.cross(force, speed), 0.0, atol=1e-15)


def test_files_are_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"there is no file dataVicon\*\.csv in"):
        agotelli.rows(tmp_path, parts=1)
    file = tmp_path / agotelli.STATICS / agotelli.AT_REST / "dataVicon.csv"
    write(file, ["timestamp", "disk_0 x (m)"], [[0.0, 0.0]])
    with pytest.raises(ValueError, match=r"dataVicon.csv, line 1: there is no column 'disk_0 y"):
        agotelli.rows(tmp_path, parts=1)
