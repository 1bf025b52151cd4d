"""Sweeps on a cluster of Dask: two processes of this machine, one of which is killed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import cdcr
from cdcr.sweeps import workers
from swept import Deadly, end_x, pulled

pytest.importorskip("xarray")
distributed: Any = pytest.importorskip("distributed", reason="the extra dask is not installed")

PULLS = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
    ) as made:
        yield made


def test_a_worker_that_is_killed_loses_nothing(cluster: Any, tmp_path: Path) -> None:
    here = cdcr.sweep(pulled, {"pull": PULLS}, metrics=end_x)
    died = tmp_path / "died"
    there = cdcr.sweep(
        Deadly(died, PULLS[2]),
        {"pull": PULLS},
        metrics=end_x,
        chunk=1,
        scheduler=cluster.scheduler_address,
        path=tmp_path / "pulls.nc",
    )
    assert died.exists()
    assert there.equals(here)


def test_a_client_is_an_executor_and_scenarios_travel(cluster: Any) -> None:
    parameters = {"payload": [0.0, 0.01], "t_end": [0.1, 0.2]}
    options: dict[str, Any] = {"metrics": ["final_tip_x", "theta_max_deg"]}
    here = cdcr.sweep("step-tension", parameters, jobs=1, **options)
    with distributed.Client(cluster) as client:
        there = cdcr.sweep("step-tension", parameters, executor=client, **options)
    assert there.identical(here)


def test_a_fault_of_the_program_ends_the_sweep(cluster: Any) -> None:
    with pytest.raises(KeyError, match="none"):
        cdcr.sweep(
            pulled,
            {"pull": PULLS},
            metrics={"broken": lambda run: float(vars(run)["none"])},
            scheduler=cluster.scheduler_address,
        )


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "nowhere"])
def test_a_scheduler_that_does_not_answer_is_told(
    address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert 1.0 <= workers.ANSWER <= 10.0
    monkeypatch.setattr(workers, "ANSWER", 0.5)
    with pytest.raises(OSError, match=f"no scheduler of Dask answers at {address}: "):
        cdcr.sweep(
            pulled, {"pull": PULLS}, metrics=end_x, scheduler=address, path=tmp_path / "pulls.nc"
        )
    assert list(tmp_path.iterdir()) == []
