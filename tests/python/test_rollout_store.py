"""Rollouts written to Zarr in chunks are those that memory holds."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

xarray = pytest.importorskip("xarray")
pytest.importorskip("zarr")

MODEL = cdcr.Model(cdcr.robots.amouri2020(damping=0.01))
N = 10
RNG = np.random.default_rng(3)
Q0, QD0 = 0.2 * RNG.normal(size=(N, 2)), RNG.normal(size=(N, 2))
RUN: dict[str, Any] = {"step": 2.0**-7, "steps": 8, "record_every": 4}
FAST = np.where(np.arange(N)[:, None] == 7, 1e5, 1.0) * QD0
GIVEN: dict[str, dict[str, Any]] = {
    "starts": {"q0": Q0, "qd0": QD0},
    "commands of each step": {"q0": Q0[0], "qd0": QD0[0], "tension": RNG.uniform(0, 2, (N, 8, 3))},
    "numbers of the robot": {"q0": Q0, "qd0": QD0, "parameters": {"payload": np.arange(N) * 1e-3}},
    "robots": {"model": [MODEL] * N, "q0": Q0, "qd0": QD0},
    "a failure": {"q0": Q0, "qd0": FAST},
    "no motion": {"q0": Q0[:0], "qd0": QD0[:0]},
    "one number for all": {"q0": Q0, "qd0": QD0, "parameters": {"payload": [0.01]}},
}


@pytest.mark.parametrize("name", GIVEN)
@pytest.mark.parametrize("chunk", [4, 10, 100])
def test_chunks_are_the_whole(name: str, chunk: int, tmp_path: Path) -> None:
    given = {"model": MODEL} | GIVEN[name] | RUN
    path = cdcr.rollout_to_zarr(tmp_path / "runs.zarr", chunk=chunk, **given)
    assert [one.name for one in tmp_path.iterdir()] == ["runs.zarr"]
    expected = cdcr.rollout(**given).to_xarray()
    with xarray.open_zarr(path) as found:
        xarray.testing.assert_allclose(found.load(), expected, rtol=0.0, atol=1e-12)
        assert json.loads(found.attrs["failures"]) == json.loads(expected.attrs["failures"])
        assert found.attrs["steps"] == expected.attrs["steps"]
        assert found.attrs["robot"] == expected.attrs["robot"]
        assert found.q.encoding["chunks"][0] == chunk or found.sizes["motion"] == 0


def test_every_chunk_has_the_wrenches_and_tells_how_far_it_is(tmp_path: Path) -> None:
    push = [cdcr.Wrench(section=0, force=(0.2, 0.0, 0.0))]
    told: list[int] = []
    path = cdcr.rollout_to_zarr(
        tmp_path / "a.zarr",
        MODEL,
        Q0,
        QD0,
        chunk=4,
        wrenches=iter(push),
        progress=told.append,
        **RUN,
    )
    expected = cdcr.rollout(MODEL, Q0, QD0, wrenches=push, **RUN).to_xarray()
    with xarray.open_zarr(path) as found:
        xarray.testing.assert_allclose(found.load(), expected, rtol=0.0, atol=1e-12)
    assert told == sorted(told)
    assert told[-1] == N


def test_a_folder_is_replaced_when_asked(tmp_path: Path) -> None:
    path = tmp_path / "runs.zarr"
    cdcr.rollout_to_zarr(path, MODEL, Q0, QD0, **RUN)
    with pytest.raises(FileExistsError, match=r"runs\.zarr exists already; pass overwrite=True"):
        cdcr.rollout_to_zarr(path, MODEL, Q0, QD0, **RUN)
    cdcr.rollout_to_zarr(path, MODEL, Q0[:3], QD0[:3], overwrite=True, **RUN)
    with xarray.open_zarr(path) as found:
        assert found.sizes["motion"] == 3


def test_what_fails_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="must have shape"):
        cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, Q0, np.zeros(3), **RUN)
    with pytest.raises(ValueError, match="as many motions of each"):
        cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, Q0, QD0[:3], chunk=4, **RUN)
    pulls = np.ones((5, 3))  # which fit each chunk of 5, but not the whole
    with pytest.raises(ValueError, match="got 10 of q0, 10 of qd0, 5 of tension"):
        cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, Q0, QD0, pulls, chunk=5, **RUN)
    with pytest.raises(ValueError, match="tension must be numbers, got list"):
        cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, Q0, QD0, [[0, 0, 0], [0]], **RUN)
    with pytest.raises(TypeError, match="parameters must be a mapping of paths to arrays, got"):
        cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, Q0, QD0, parameters=[1], **RUN)
    with pytest.raises(ValueError, match=r"the folder's name must end in .zarr, got 'runs.nc'"):
        cdcr.rollout_to_zarr(tmp_path / "runs.nc", MODEL, Q0, QD0, **RUN)
    with pytest.raises(FileNotFoundError, match="does not exist; make it first"):
        cdcr.rollout_to_zarr(tmp_path / "no" / "runs.zarr", MODEL, Q0, QD0, **RUN)
    masked = np.ma.masked_array(Q0, mask=np.eye(N, 2, dtype=bool))
    for wrong in ({"q0": masked}, {"q0": Q0, "parameters": {"payload": masked[:, 0]}}):
        with pytest.raises(ValueError, match="must be numbers, got MaskedArray with masked"):
            cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, qd0=QD0, **wrong, **RUN)
    with pytest.raises(TypeError, match="parameters must be a mapping of paths to arrays"):
        cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, Q0, QD0, parameters="payload", **RUN)
    with pytest.raises(ValueError, match="chunk must be a whole number >= 1, got 0"):
        cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, Q0, QD0, chunk=0, **RUN)
    assert list(tmp_path.iterdir()) == []


def test_a_file_is_not_replaced_by_a_folder(tmp_path: Path) -> None:
    (tmp_path / "runs.zarr").write_text("mine")
    with pytest.raises(FileExistsError, match="is no folder of Zarr; remove it"):
        cdcr.rollout_to_zarr(tmp_path / "runs.zarr", MODEL, Q0, QD0, overwrite=True, **RUN)
    assert (tmp_path / "runs.zarr").read_text() == "mine"
