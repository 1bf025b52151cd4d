"""``cdcr sweep``: files, tables, refusals, Ctrl-C."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("typer")
pytest.importorskip("matplotlib")
pytest.importorskip("h5netcdf")

import xarray

from command import cdcr_, everything_in, refused

DEADLINE = 100.0  # after which something hangs [s]
SWEEP = ("sweep", "step-tension", "--metric", "peak_theta,final_tip_x", "--jobs", 1)
PULLS = ("--param", "tension.1=1:3:3", "--param", "payload=0,0.01")


def test_a_grid_is_written_with_its_picture_and_told(tmp_path: Path) -> None:
    out = tmp_path / "new" / "pulls.nc"
    done = cdcr_(*SWEEP, *PULLS, "--out", out)
    assert done.exit_code == 0, done.output
    assert everything_in(out.parent) == ["pulls.nc", "pulls.png"]
    assert out.with_suffix(".png").read_bytes().startswith(b"\x89PNG")
    with xarray.open_dataset(out) as found:
        assert found["tension.1"].values.tolist() == [1.0, 2.0, 3.0]
        assert found.payload.values.tolist() == [0.0, 0.01]
        largest = float(found.peak_theta.max())
    row = next(line for line in done.stdout.splitlines() if "peak_theta" in line)
    assert row.split()[-2:] == [f"{largest:.4g}", "0"]
    again = cdcr_(*SWEEP, *PULLS, "--out", out)
    assert again.exit_code == 0
    assert f"nothing is missing in {out}" in again.stdout
    told = refused(cdcr_(*SWEEP, "--param", "payload=0,0.02", "--out", out))
    assert told.endswith("give --overwrite to replace, or another file with --out")
    replaced = cdcr_(*SWEEP, "--param", "payload=0,0.02", "--out", out, "--overwrite", "--quiet")
    assert (replaced.exit_code, replaced.output) == (0, "")


def test_json_tells_where_the_best_is(tmp_path: Path) -> None:
    out = tmp_path / "pulls.nc"
    done = cdcr_(*SWEEP, *PULLS, "--out", out, "--json", "--no-picture")
    told = json.loads(done.stdout)
    assert told["runs"] == 6
    assert told["failed"] == 0
    assert told["metrics"]["peak_theta"]["largest"]["at"]["tension.1"] == 3.0
    assert told["metrics"]["final_tip_x"]["unit"] == "m"
    assert everything_in(tmp_path) == ["pulls.nc"]


def test_samples_and_distributions(tmp_path: Path) -> None:
    out = tmp_path / "samples.nc"
    done = cdcr_(
        *SWEEP,
        *("--param", "payload=normal:0.1:0.01", "--param", "sections.1.damping=1e-3:1e-1:log"),
        *("--param", "tension.1=1:2", "--samples", "lhs:20", "--seed", 3, "--out", out),
    )
    assert done.exit_code == 0, done.output
    with xarray.open_dataset(out) as found:
        assert np.mean(found.payload) == pytest.approx(0.1, abs=0.003)
        assert np.std(found.payload) == pytest.approx(0.01, rel=0.3)
        assert np.exp(np.mean(np.log(found["sections.1.damping"]))) == pytest.approx(1e-2, rel=0.1)
        assert np.mean(found["tension.1"]) == pytest.approx(1.5, abs=0.03)


def test_a_grid_in_logarithmic_steps(tmp_path: Path) -> None:
    out = tmp_path / "steps.nc"
    cdcr_(*SWEEP, "--param", "sections.*.damping=1e-3:1e-1:3:log", "--out", out, "--no-picture")
    with xarray.open_dataset(out) as found:
        np.testing.assert_allclose(found["sections.*.damping"], [1e-3, 1e-2, 1e-1])


@pytest.mark.parametrize(
    ("given", "told"),
    [
        (("--param", "payload"), "--param must be PATH=VALUES, got 'payload'"),
        (("--param", "payload=0:1"), "--param payload must have LOW:HIGH:COUNT, LOW:HIGH:COUNT:lo"),
        (("--param", "payload=0:1:x"), "with a COUNT of 2 to 1000000, got 'payload=0:1:x'"),
        (("--param", "payload=1:0:3"), "--param payload must have values with LOW below HIGH"),
        (("--param", "payload=0:1:3:log"), "must have values with LOW above 0 where they are log"),
        (("--param", "payload=a,b"), "or numbers with commas, got 'payload=a,b'"),
        (("--param", "payload=1_0,2"), "or numbers with commas, got 'payload=1_0,2'"),
        (("--param", "payload=1,\u0661"), "or numbers with commas, got 'payload=1,\u0661'"),
        (("--param", "payload=0:1_0:3"), "--param payload must have LOW:HIGH:COUNT, LOW:HIGH"),
        (("--param", "payload=0:1:1_0"), "with a COUNT of 2 to 1000000, got 'payload=0:1:1_0'"),
        (("--param", "payload=normal:1_0:1", "--samples", "lhs:4"), "got 'payload=normal:1_0:1'"),
        (("--param", "payload=0:1", "--samples", "lhs:1_0"), "--samples must be "),
        (("--param", "payload=1,2", "--size", "1_0x8"), "--size must be 'journal' "),
        (("--param", "payload=1", "--param", "payload=2"), "each --param must be of another param"),
        (("--param", "paylod=1,2"), "there is no parameter 'paylod'. Did you mean 'payload'?"),
        (("--param", "payload=1,2", "--metric", "peak"), "there is no metric 'peak'."),
        ((), "a sweep must have a parameter, got none"),
        (("--param", "payload=1,2", "--out", "x.csv"), "the file name must end in .nc or .zarr"),
        (
            ("--param", "payload=0:1:9", "--samples", "lhs:4"),
            "--param payload must have LOW:HIGH, LOW:HIGH:log or normal:MEAN:SD where --samples is",
        ),
        (("--param", "payload=0:1", "--samples", "sobol:3"), "--samples of sobol must be a power"),
        (("--param", "payload=normal:0:0", "--samples", "lhs:4"), "normal:MEAN:SD with SD > 0"),
        (("--param", "payload=1,2", "--out", "."), "must end in .nc or .zarr, got ''"),
        (("--param", "payload=1,2", "--scheduler", "tcp://a:1"), "jobs are for this machine, and"),
    ],
)
def test_refusals(
    given: tuple[str, ...], told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert told in refused(cdcr_(*SWEEP, *given))
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == []


def test_a_run_that_fails_is_told_and_the_others_go_on(tmp_path: Path) -> None:
    file = tmp_path / "short.toml"
    file.write_text(
        'robot = "amouri2020"\nt_end = 0.1\ntension = [5, 0, 0]\n[integrator]\nmax_steps = 300\n'
    )
    sweep = ("sweep", file, "--metric", "steps", "--jobs", 1, "--no-picture")
    done = cdcr_(*sweep, "--param", "t_end=0.01,100", "--out", tmp_path / "some.nc")
    assert done.exit_code == 0, done.output
    assert "cdcr: 1 of 2 runs failed; the first, t_end 100: " in done.stderr
    done = cdcr_(*sweep, "--param", "t_end=100,200", "--out", tmp_path / "none.nc")
    assert done.exit_code == 1
    assert "cdcr: 2 of 2 runs failed; the first, t_end 100: " in done.stderr


def test_control_c_keeps_what_is_finished(tmp_path: Path) -> None:
    """The signal comes when two runs are finished."""
    code = f"""
import os, signal
from cdcr.cli import main
from cdcr.cli.run import DelayedBar
def call(self, done, name=None):
    if name == "2 of 6 runs":
        os.kill(os.getpid(), signal.SIGINT)
DelayedBar.__call__ = call
signal.signal(signal.SIGINT, signal.default_int_handler)
import cdcr.sweeps.run
cdcr.sweeps.run.LARGEST = 1
main({[*map(str, SWEEP), *PULLS, "--out", "pulls.nc", "--no-picture"]!r})
"""
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, timeout=DEADLINE, check=False)
    told = b"cdcr: interrupted; 2 of 6 runs are kept in pulls.nc.partial: the same command goes on"
    assert (done.returncode, done.stdout) == (130, b"")
    assert done.stderr.startswith(told)
    assert everything_in(tmp_path) == ["pulls.nc.partial"]
