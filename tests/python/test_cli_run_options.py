"""Options of ``cdcr run``: --film, --max-steps; numbers in options of every command."""

import re
import shutil
import sys
from pathlib import Path
from typing import Any

import pytest

from cdcr.base.extras import find_ffmpeg

pytest.importorskip("typer")
pytest.importorskip("matplotlib")
pytest.importorskip("h5netcdf")

from cdcr.cli import run as cli_run
from cdcr.scenarios import Scenario
from command import cdcr_, everything_in, refused

FILES = ["step-tension.png", "step-tension.csv", "step-tension.nc"]


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("film", ["gif", "html", "mp4"])
def test_a_film_is_written_too(tmp_path: Path, film: str) -> None:
    if film == "mp4" and not find_ffmpeg():
        pytest.skip("needs ffmpeg")
    args = ("run", "step-tension", "--out", tmp_path, "--t-end", 0.1, "--film")
    assert cdcr_(*args, film).exit_code == 0
    assert everything_in(tmp_path) == sorted([*FILES, f"step-tension.{film}"])
    begin = {"gif": b"GIF89a", "html": b"<!doctype html>", "mp4": b"ftyp"}[film]
    assert begin in (tmp_path / f"step-tension.{film}").read_bytes()[:20]


@pytest.mark.usefixtures("quick")
def test_films_of_long_runs_are_played_faster(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from PIL import Image

    monkeypatch.setattr(cli_run, "LONGEST_FILM", 0.1)
    args = ("run", "step-tension", "--out", tmp_path, "--t-end", 1.0, "--film", "gif")
    assert cdcr_(*args).exit_code == 0
    with Image.open(tmp_path / "step-tension.gif") as film:
        assert getattr(film, "n_frames", 0) == 4  # of 0.1 s, 30 a second, both ends


def test_films_that_cannot_be_written_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told = refused(cdcr_("run", "pid", "--out", tmp_path, "--film", "avi"))
    assert told == "--film must be one of mp4, gif, html, got 'avi'"
    monkeypatch.setattr(shutil, "which", lambda name: None)
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    told = refused(cdcr_("run", "pid", "--out", tmp_path, "--film", "mp4"))
    assert told.startswith("--film mp4 needs the program ffmpeg, which is not on the PATH")
    assert refused(cdcr_("run", "gravity-ratio", "--film", "gif")).endswith("takes no --film")
    assert everything_in(tmp_path) == []


def test_max_steps_is_a_whole_number_however_it_is_written(tmp_path: Path) -> None:
    few = cdcr_("run", "step-tension", "--out", tmp_path, "--max-steps", "1e0", "--format", "csv")
    assert few.exit_code == 1
    assert "more than --max-steps" in few.stderr
    half = cdcr_("run", "step-tension", "--out", tmp_path, "--max-steps", "1.5")
    assert half.exit_code == 2
    assert "'--max-steps': must be a whole number, got '1.5'" in half.stderr


def test_numbers_are_plain_decimals(tmp_path: Path) -> None:
    wrong = ["1_0", "\u0661", "\uff11", "0x10", "nan", "inf", "1 0", ""]
    options = {
        "--t-end": ("run", "pid"),
        "--rtol": ("run", "pid"),
        "--atol": ("run", "pid"),
        "--max-steps": ("run", "pid"),
        "--max-bending": ("export-c", "amouri2020"),
        "--acados": ("export-c", "amouri2020"),
        "--steps": ("export-c", "amouri2020"),
        "--fmi": ("export-fmu", "amouri2020"),
        "--step": ("export-fmu", "amouri2020"),
        "--links": ("export-mjcf", "amouri2020"),
        "--seed": ("sweep", "pid"),
        "--jobs": ("sweep", "pid"),
        "--speed": ("view", "amouri2020"),
        "--port": ("view", "amouri2020"),
    }
    for option, command in options.items():
        for text in wrong:
            out = () if command[0] == "view" else ("--out", tmp_path / "x")
            told = cdcr_(*command, *out, option, text)
            assert told.exit_code == 2
            kind = rf"'{option}': must be a (whole )?number[^,]*, got {re.escape(repr(text))}"
            assert re.search(kind, " ".join(told.stderr.split())), told.stderr
    assert everything_in(tmp_path) == []


def test_limits_of_whole_numbers_are_told() -> None:
    jobs = cdcr_("figures", "--jobs", "0").stderr
    assert "'--jobs': must be a whole number >= 1, got '0'" in jobs
    port = cdcr_("view", "amouri2020", "--port", "65536").stderr
    assert "'--port': must be a whole number 0 to 65535, got '65536'" in port


@pytest.mark.usefixtures("quick")
def test_files_that_appear_during_the_run_are_not_replaced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    simulate, other = Scenario.simulate, tmp_path / "step-tension.csv"

    def simulate_beside_another(self: Scenario, **options: Any) -> Any:
        other.write_text("of another process")
        return simulate(self, **options)

    monkeypatch.setattr(Scenario, "simulate", simulate_beside_another)
    args = ("run", "step-tension", "--out", tmp_path, "--t-end", 0.1)
    assert refused(cdcr_(*args)).startswith(f"{other} exists already; give --overwrite")
    assert everything_in(tmp_path) == ["step-tension.csv"]
    assert other.read_text() == "of another process"
    assert cdcr_(*args, "--overwrite").exit_code == 0
