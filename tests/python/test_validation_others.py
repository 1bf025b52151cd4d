"""validation/trunk.py and catheter.py, run on files in their sources' formats, made here."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import cdcr
from cdcr.base.arrays import FloatArray
from validation_scripts import catheter, trunk, write

GAIN, DAMPING, RATE = 0.8, 2e-5, 0.005  # what made the files; of the catheter's file [s]
DECAY = 1.0  # [mm]: states at the start are found from a cubic over some samples
NEAR = 0.1  # [mm]: of fits that begin elsewhere and end where a step is small


def refused(call: Callable[[], object], sentence: str) -> None:
    with pytest.raises((ValueError, FileNotFoundError), match=re.escape(sentence)):
        call()


def y_up(places: list[FloatArray]) -> list[FloatArray]:
    """Return places (N, 3) with Z down in the frame of the trunk's files."""
    return [np.column_stack([one[:, 0], -one[:, 2], one[:, 1]]) for one in places]


def trunk_files(home: Path, seed: int) -> Path:
    """Write commands and what they give, as the trunk's files have them."""
    model = cdcr.Model(trunk.robot())
    told = np.random.default_rng(seed).uniform(-0.4, 0.4, (4, 6))
    pull = [side * told[:, motor - 1]
            for motors in trunk.MOTORS for motor, _ in motors for side in (1, -1)]  # fmt: skip
    commands = model.rest_command() - GAIN * (trunk.UNIT * np.stack(pull, 1) + trunk.SLACK)
    q = np.array([model.equilibrium(one) for one in commands])
    places = [model.pose(q, i, 1.0)[1] for i in range(3)]
    theirs = y_up(places)
    rows = np.arange(4)
    write(home / f"control_inputs_circle_seed{seed}.csv", ["ID", *(f"u{k + 1}" for k in range(6))],
          np.column_stack([rows, told]))  # fmt: skip
    header = ["ID", *(f"{axis}{k + 1}" for k in range(3) for axis in "xyz")]
    return write(home / f"observations_circle_seed{seed}.csv", header,
                 np.column_stack([rows, *theirs]))  # fmt: skip


def test_trunk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    home = tmp_path / trunk.STEADY
    file, _ = (trunk_files(home, seed) for seed in (0, 1))
    monkeypatch.setattr(trunk, "PARAMETERS", {"sections[*].command_gain": None})
    (row,) = trunk.rows(tmp_path, train=1)
    assert max(row.used, row.held_out) < NEAR
    refused(lambda: trunk.rows(tmp_path, train=2), "there must be more than 2 observations")
    good = file.read_text()
    file.write_text(good.replace("\n1.0,", "\n7.0,"))
    refused(lambda: trunk.rows(tmp_path, train=1), f"{file}: the column ID must be that of contr")
    file.write_text(good.replace("z3", "w3"))
    refused(lambda: trunk.rows(tmp_path, train=1), f"{file}, line 1: there is no column 'z3'")


def test_trunk_let_go(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hangs = np.array([[0.1, 0.12, 0.1], [0.1, 0.12, 0.2], [0.1, 0.12, 0.3]])
    header = ["ID", *(f"{axis}{k + 1}" for k in range(3) for axis in "xyz")]
    held, t = np.zeros(30), np.arange(0.0, 4.0, trunk.STEP)
    for grams in (200, 300):
        known = trunk.hose(grams / 1e3, hangs)
        sections = [replace(one, bending_stiffness=0.12, damping=0.15) for one in known.sections]
        model = cdcr.Model(replace(known, sections=sections))
        rows = []
        for k, aside in enumerate([(0.4, 0.2), (-0.3, 0.5), (0.5, -0.4)]):
            run = cdcr.simulate(model, np.tile(aside, 3), np.zeros(6), t=t)
            q = np.concatenate([np.tile(run.q[:1], (len(held), 1)), run.q])
            places = y_up([model.pose(q, i, 1.0)[1] for i in range(3)])
            rows.append(np.column_stack([np.full(len(q), k), *places]))
        write(tmp_path / f"observations_manual_decay_{grams}g.csv", header, np.concatenate(rows))
    monkeypatch.setattr(trunk, "FITTED", (0, 1))
    (row,) = trunk.let_go(tmp_path)
    assert row.source == "trunk, let go by hand (4 predicted)"
    assert max(row.used, row.held_out) < DECAY, row
    assert trunk.let_go(tmp_path / "elsewhere") == []


def catheter_file(folder: Path, sequences: int = 2, size: int = 41) -> Path:
    """Write motions of the catheter, in mm, as its files have them."""
    known = catheter.robot()
    section = replace(known.sections[0], damping=DAMPING)
    model = cdcr.Model(replace(known, sections=[section]))
    t = RATE * np.arange(size)
    lines = ["state,input"]
    for k in range(sequences):
        told = 1e-3 * np.sin(8.0 * t + k)
        rest = model.rest_command()
        pull = GAIN * np.column_stack([told, -told])
        table = cdcr.TensionTable(t, rest - pull)
        start = np.array([0.3 - 0.2 * k, 0.0])
        run = cdcr.simulate(model, start, [0.0, 0.0], t=t, command=table, rtol=1e-8)
        speed = speeds(model, run.q, run.qd)
        for tip, rate, command in zip(run.tip, speed, told, strict=True):
            state = [1e3 * tip[0], 1e3 * rate[0], 1e3 * tip[2], 1e3 * rate[2]]
            lines.append(f'"{json.dumps(list(map(float, state)))}","[{float(1e3 * command)!r}]"')
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "dataset_info.json").write_text(
        json.dumps({"sample_time": RATE, "test_sequence_length": size})
    )
    file = folder / "test.txt"
    file.write_text("\n".join(lines) + "\n")
    return file


def speeds(model: cdcr.Model, q: FloatArray, qd: FloatArray) -> FloatArray:
    """Return rates of the tip, by differences."""
    step = 1e-6
    found: FloatArray = (model.tips(q + step * qd) - model.tips(q - step * qd)) / (2.0 * step)
    return found


def test_catheter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = catheter_file(tmp_path / "experiment")
    monkeypatch.setattr(catheter, "EVERY", 1)
    sought = {"sections[*].command_gain": {"low": 0.1}, "sections[*].damping": None}
    monkeypatch.setattr(catheter, "PARAMETERS", sought)
    (row,) = catheter.rows(file.parent, file.name)
    assert row.source == "experiment (1 sequences predicted)"
    assert max(row.used, row.held_out) < NEAR
    good = file.read_text()
    for bad, sentence in (
        ("x,y\n1,2\n", f"{file}, line 1: the columns must be state and input"),
        ("state,input\n", f"{file} has no rows of numbers"),
        (good + '"[1,2,3]","[4]"\n', f"{file}, line 84: state must be 4 finite numbers and inp"),
        (good + '"[1,2,3,x]","[4]"\n', f"{file}, line 84: state and input must be lists of n"),
        ("\n".join(good.splitlines()[:50]), "must have two sequences of 41 rows or more"),
    ):
        file.write_text(bad)
        refused(lambda: catheter.rows(file.parent, file.name), sentence)
    info = file.parent / "dataset_info.json"
    info.write_text("{}")
    refused(lambda: catheter.rows(file.parent, file.name), f"{info}: sample_time must be a number")
    info.unlink()
    refused(lambda: catheter.rows(file.parent, file.name), f"there is no file {info}")
