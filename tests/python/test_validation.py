"""The scripts of validation/, run on small files in the formats of their sources, made here."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import cdcr
from validation_scripts import common, ftdcr, loaded_shapes, sorosim, three_codes, write

EXACT = 1e-4  # [mm]: of a fit to what the same model gave, which files hold to more digits


def refused(call: Callable[[], object], sentence: str) -> None:
    with pytest.raises(ValueError, match=re.escape(sentence)):
        call()


# ftdcr_v4 --------------------------------------------------------------------------------------

FTDCR = [f"servo_{k}_mm" for k in ftdcr.SERVOS] + ["tip_x", "tip_y", "tip_z"]
TRUE_CIRCLE = 4.6e-3  # [m]


def ftdcr_file(path: Path, seed: int, number: int = 5) -> Path:
    """Write poses of the drawing with another circle of its cables."""
    from dataclasses import replace

    known = ftdcr.robot()
    sections = [replace(one, cable_radius=TRUE_CIRCLE) for one in known.sections]
    model = cdcr.Model(replace(known, sections=sections))
    pull = np.random.default_rng(seed).uniform(-1.0, 2.5, (number, 9))  # [mm]
    rest = model.rest_command()
    q = np.array([model.equilibrium(rest - 1e-3 * one) for one in pull])
    return write(path, FTDCR, np.hstack([pull, 1e3 * model.tips(q)]))


def test_ftdcr_predicts_files_that_it_has_not_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # One number in place of ten, for speed.
    monkeypatch.setattr(ftdcr, "PARAMETERS", {"sections[*].cable_radius": None})
    train, test = ftdcr_file(tmp_path / "a.csv", 1), ftdcr_file(tmp_path / "b.csv", 2)
    found = ftdcr.fit(ftdcr.poses(train))
    assert found["sections[*].cable_radius"] == pytest.approx(TRUE_CIRCLE, rel=1e-6)
    monkeypatch.setattr(sys, "argv", ["ftdcr.py", "--train", str(train), "--test", str(test)])
    ftdcr.main()
    printed = capsys.readouterr().out.splitlines()[-1].split("|")
    assert float(printed[4]) < 1e-2 > float(printed[5])
    worse = np.loadtxt(test, delimiter=",", skiprows=1)
    worse[:, 9] += 3.0  # [mm]
    write(test, FTDCR, worse)
    (row,) = ftdcr.rows(train, test)
    assert row.used < EXACT
    assert row.held_out == pytest.approx(3.0, abs=EXACT)
    (row,) = ftdcr.rows(train, None)
    assert row.held_out < EXACT


def test_ftdcr_refuses_files_in_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    file = ftdcr_file(tmp_path / "a.csv", 1, 3)
    good = file.read_text()
    cells = good.splitlines()[2].split(",")
    for bad, sentence in (
        (good.replace("tip_y", "tip"), "line 1: there is no column 'tip_y' for 'tip y [mm]'"),
        (good.replace(cells[10], "x"), "line 3: tip_y must be a number, got 'x'"),
        (good.replace(cells[10], "nan"), "line 3: tip_y must be a number, got 'nan'"),
        (good.replace(cells[0], "250.0"), "line 3: servo_4_mm is pulled by 0.25 m, where the"),
        (good.replace(cells[10], "1e6"), "line 3: tip_y = 1000 m is"),
        (good.replace(cells[10] + ",", ""), "line 3: must have 12 columns, got 11"),
    ):
        assert bad != good
        file.write_text(bad)
        monkeypatch.setattr(sys, "argv", ["ftdcr.py", "--train", str(file)])
        with pytest.raises(SystemExit) as stop:
            ftdcr.main()
        assert stop.value.code == 2
        told = capsys.readouterr().err
        assert told.startswith(f"ftdcr.py: {file}, {sentence}")
        assert told.count("\n") == 1
    missing = tmp_path / "none.csv"
    monkeypatch.setattr(sys, "argv", ["ftdcr.py", "--train", str(missing), "--far"])
    with pytest.raises(SystemExit) as stop:
        ftdcr.main()
    assert stop.value.code == 2
    assert "ftdcr.py: there is no file of measurements" in capsys.readouterr().err


# SoRoSim ---------------------------------------------------------------------------------------


def test_sorosim_reads_its_format_and_agrees_with_itself(tmp_path: Path) -> None:
    beta, parts = 0.01, 2
    gravity = np.array([0.0, 0.0, -9.81])  # ours
    moment, force = np.array([0.0, 0.02, 0.0]), np.array([0.05, 0.02, 0.0])
    piece = sorosim.section(sorosim.TPU, beta, sorosim.TPU.length / parts)
    model = cdcr.Model(cdcr.Robot(sections=[piece] * parts, gravity=gravity))
    push = [
        cdcr.Wrench(section=0, fraction=1.0, force=-force),
        cdcr.Wrench(section=1, fraction=1.0, moment=moment, force=force),
    ]
    t = np.linspace(0.0, 0.2, 9)
    q0 = model.equilibrium(wrenches=push)
    tip = cdcr.simulate(model, q0, np.zeros(4), t=t).tip
    rows = np.zeros((2 + len(t), 13))
    rows[0, 0], rows[0, 10:] = beta, gravity @ sorosim.TURN  # into theirs
    for k, vector in enumerate([np.zeros(3), -force, moment, force]):
        rows[1, 1 + 3 * k : 4 + 3 * k] = vector @ sorosim.TURN
    rows[2:, 0], rows[2:, 10:] = t, tip @ sorosim.TURN
    file = write(tmp_path / "TPURod_1.txt", None, rows, "\t")
    found = sorosim.rows([tmp_path], parts=parts, order=1)
    assert found[0].model == "arcs in 2 parts"
    assert found[0].held_out < 1e-2  # two runs to a tolerance of 1e-6
    assert found[0].percent < 0.1
    write(file, None, rows[:, :12], "\t")
    refused(lambda: sorosim.rows([file], 2, 1), f"{file} must have 13 columns and 4 lines")
    with pytest.raises(FileNotFoundError, match="there is no file"):
        sorosim.rows([tmp_path / "steel"], 2, 1)
    (tmp_path / "empty").mkdir()
    refused(lambda: sorosim.rows([tmp_path / "empty"], 2, 1), "there are no files *Rod*.txt in")


# Two links by two codes ------------------------------------------------------------------------


def test_three_codes_reads_both_formats_and_agrees_with_itself(tmp_path: Path) -> None:
    from scipy.io import savemat  # type: ignore[import-untyped]

    model = cdcr.Model(three_codes.robot(1))
    t, still = np.linspace(0.0, 0.2, 5), np.zeros(4)
    tip = cdcr.simulate(model, still, still, t=t, tension=[1.0, 1.0]).tip * three_codes.AXES
    table = np.column_stack([t, tip])
    csv = tmp_path / f"{three_codes.NAME}soromox.csv"
    write(csv, ["t", "x", "y", "z"], table)
    fine = np.linspace(0.0, 0.2, 4 * three_codes.EVERY + 1)
    places = np.zeros((3, fine.size))
    places[:, :: three_codes.EVERY] = tip.T
    mat = tmp_path / f"{three_codes.NAME}sorosim.mat"
    savemat(mat, {"t": fine[:, None], "Pos_EE_all": places})
    found = three_codes.rows(tmp_path, 1)
    arcs = [row for row in found if row.model == "arcs in 1 + 1 parts"]
    assert [row.source[-7:] for row in arcs] == ["SoRoMoX", "SoRoSim"]
    assert max(row.held_out for row in arcs) < 1e-2
    savemat(mat, {"t": fine[:, None]})
    refused(lambda: three_codes.rows(tmp_path, 1), f"{mat}: there is no array 'Pos_EE_all'")
    write(csv, ["t", "x", "y", "height"], table)
    refused(lambda: three_codes.rows(tmp_path, 1), f"{csv}, line 1: there is no column 'z'")


# What they share -------------------------------------------------------------------------------


def test_columns_are_refused_by_file_line_and_column(tmp_path: Path) -> None:
    file = write(tmp_path / "a.csv", ["t", "x"], [[0.0, 1.0], [1.0, 2.0]])
    assert common.read_columns(file, ["x"]).tolist() == [[1.0], [2.0]]
    for text, sentence in (
        ("t,x\n0,1\n1,\n", "line 3: x must be a finite number, got ''"),
        ("t,x\n0,1\n1,inf\n", "line 3: x must be a finite number, got 'inf'"),
        ("t,x\n0,1\n1\n", "line 3: must have 2 columns, got 1"),
        ("t,y\n0,1\n", "line 1: there is no column 'x'; there are t, y"),
    ):
        file.write_text(text)
        refused(lambda: common.read_columns(file, ["x"]), f"{file}, {sentence}")
    file.write_text("t,x\n")
    refused(lambda: common.read_columns(file, ["x"]), f"{file} has no rows of numbers")
    file.write_text("0,1\n1,b\n")
    refused(lambda: common.read_columns(file), f"{file}, line 2: column 2 must be a finite number")


@pytest.mark.parametrize("text", ["0", "-1", "x", "1.5", ""])
def test_numbers_of_parts_are_whole(text: str) -> None:
    assert common.positive("8") == 8
    with pytest.raises(argparse.ArgumentTypeError, match="must be a whole number > 0, got '"):
        common.positive(text)


def test_the_table_is_markdown(capsys: pytest.CaptureFixture[str]) -> None:
    common.show([common.Row("a", "arcs", 2, np.nan, 1.5, 0.5, "length", 6, 0.25)])
    head, rule, row = capsys.readouterr().out.splitlines()
    assert len(head) == len(rule) == len(row)
    assert [one.strip() for one in row.split("|")[1:-1]] == [
        "a", "arcs", "2", "", "1.50", "0.50 % of length", "6", "0.25",
    ]  # fmt: skip


# Loaded shapes ---------------------------------------------------------------------------------


def test_orders_come_nearer_to_a_loaded_rod_than_arcs(capsys: pytest.CaptureFixture[str]) -> None:
    lines = loaded_shapes.table(2)
    print("\n".join(lines))
    rows = {cells[1]: cells[2:6] for line in lines[2:] for cells in [re.split(r" ?\| ?", line)]}
    off = {name: float(cells[1].split()[0]) for name, cells in rows.items()}
    turned = {name: float(cells[2].split()[0]) for name, cells in rows.items()}
    assert off["one arc"] > 10.0 * off["bending order 1"] > 10.0 * off["bending order 3"]
    assert off["bending order 3"] < off["arcs in 16 parts"] < off["arcs in 8 parts"]
    assert turned["bending order 3"] > 1.0 > 10.0 * turned["bending order 3, twist order 1"]
