"""Sweeps that are interrupted, killed or begun twice."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("h5netcdf")

from cdcr.sweeps import workers
from swept import Deadly, end_x, pulled

PULLS = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
OPTIONS: dict[str, Any] = {"metrics": end_x, "chunk": 1, "jobs": 1}
DEADLINE = 60.0  # after which something hangs [s]


class Counted:
    """A run that remembers what it was asked for."""

    def __init__(self) -> None:
        self.asked: list[float] = []

    def __call__(self, pull: float) -> cdcr.Trajectory:
        self.asked.append(pull)
        return pulled(pull)


def interrupted_after(number: int) -> Callable[[int, int], None]:
    def progress(done: int, total: int) -> None:
        if done == number:
            raise KeyboardInterrupt

    return progress


@pytest.fixture
def whole() -> Any:
    return cdcr.sweep(Counted(), {"pull": PULLS}, **OPTIONS)


def partial(path: Path) -> Path:
    return path.with_name(f"{path.name}.partial")


@pytest.mark.parametrize("suffix", [".nc", ".zarr"])
def test_what_is_finished_stays_and_only_the_rest_is_computed(
    tmp_path: Path, suffix: str, whole: Any
) -> None:
    if suffix == ".zarr":
        pytest.importorskip("zarr")
    path, run = tmp_path / f"pulls{suffix}", Counted()
    with pytest.raises(KeyboardInterrupt):
        cdcr.sweep(run, {"pull": PULLS}, path=path, progress=interrupted_after(4), **OPTIONS)
    assert not path.exists()
    kept = [json.loads(line)[0] for line in partial(path).read_text().splitlines()[1:]]
    assert kept == [[0], [1], [2], [3]]
    run.asked.clear()
    told: list[int] = []
    again = cdcr.sweep(
        run, {"pull": PULLS}, path=path, progress=lambda done, _: told.append(done), **OPTIONS
    )
    assert run.asked == PULLS[4:]
    assert told == [4, 5, 6]
    assert again.drop_attrs().identical(whole.drop_attrs())
    assert sorted(one.name for one in tmp_path.iterdir()) == [path.name]
    run.asked.clear()
    assert cdcr.sweep(run, {"pull": PULLS}, path=path, **OPTIONS).equals(whole)
    assert run.asked == []


@pytest.mark.parametrize("end", [b"", b"5\n", b"[[2]]\n", b'[[2],[["x","ok",""]]]\n'])
def test_a_line_that_is_not_whole_does_not_count(tmp_path: Path, whole: Any, end: bytes) -> None:
    path, run = tmp_path / "pulls.nc", Counted()
    with pytest.raises(KeyboardInterrupt):
        cdcr.sweep(run, {"pull": PULLS}, path=path, progress=interrupted_after(3), **OPTIONS)
    text = partial(path).read_bytes()
    last = text[:-1].rindex(b"\n") + 1
    partial(path).write_bytes(text[:last] + end if end else text[:-9])
    run.asked.clear()
    again = cdcr.sweep(run, {"pull": PULLS}, path=path, **OPTIONS)
    assert run.asked == PULLS[2:]
    np.testing.assert_array_equal(again.end_x, whole.end_x)


DAMAGED = {
    "a number": b"5",
    "two numbers": b"[1, 2]",
    "too few": b"[[0, 1], []]",
    "a word": b'[[0], [[["a"], "ok", ""]]]',
    "two metrics": b'[[0], [[[1.0, 2.0], "ok", ""]]]',
    "another status": b'[[0], [[[1.0], 3, ""]]]',
    "no value": b'[[0], [[[null], "ok", ""]]]',
    "nested": b"[" * 100_000,
}


@pytest.mark.parametrize("name", DAMAGED)
def test_a_damaged_line_does_not_count(name: str, tmp_path: Path, whole: Any) -> None:
    path, run = tmp_path / "pulls.nc", Counted()
    with pytest.raises(KeyboardInterrupt):
        cdcr.sweep(run, {"pull": PULLS}, path=path, progress=interrupted_after(3), **OPTIONS)
    first = partial(path).read_bytes().split(b"\n")[0]
    partial(path).write_bytes(first + b"\n" + DAMAGED[name] + b"\n")
    run.asked.clear()
    again = cdcr.sweep(run, {"pull": PULLS}, path=path, **OPTIONS)
    assert run.asked == PULLS
    np.testing.assert_array_equal(again.end_x, whole.end_x)


def test_a_killed_process_of_our_own_loses_nothing(tmp_path: Path, whole: Any) -> None:
    """The process of one run is killed; another computes it, and the runs before stay."""
    from cdcr.sweeps.jobs import Chunk, FunctionSource, Job
    from cdcr.sweeps.metrics import find_metrics

    source = FunctionSource(Deadly(tmp_path / "died", PULLS[2]), ("pull",))
    job = Job(source, find_metrics(end_x, tuple))
    rows = np.array(PULLS).reshape(-1, 1)
    chunks = [Chunk((k,), rows[[k]]) for k in range(len(PULLS))]
    with pytest.raises(workers.WorkersLost, match="its process ended by signal 9"):
        list(workers._by_processes(job, chunks, 2))
    done = {one.numbers[0]: one.outcomes[0] for one in workers._by_processes(job, chunks, 2)}
    assert [done[k].values[0] for k in range(len(PULLS))] == whole.end_x.values.tolist()


def test_lost_processes_are_started_again_but_not_for_ever(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, whole: Any
) -> None:
    compute, lost = workers._by_executor, [0]

    def losing(*args: Any, **options: Any) -> Any:
        for k, done in enumerate(compute(*args, **options)):
            if k == 2 or lost[0] > 9:
                lost[0] += 1
                raise workers.WorkersLost("its process ended by signal 9")
            yield done

    monkeypatch.setattr(workers, "_by_executor", losing)
    run = Counted()
    found = cdcr.sweep(run, {"pull": PULLS}, **OPTIONS)
    assert found.equals(whole)
    assert lost == [2]  # after two runs each
    lost[0] = 10
    with pytest.raises(RuntimeError, match="0 of 6 runs are finished"):
        cdcr.sweep(run, {"pull": PULLS}, path=tmp_path / "pulls.nc", **OPTIONS)
    assert lost == [13]
    assert list(tmp_path.iterdir()) == []


def test_an_executor_that_breaks_is_told_and_what_is_finished_stays(tmp_path: Path) -> None:
    path, run = tmp_path / "pulls.nc", Deadly(tmp_path / "died", PULLS[-1])
    options: dict[str, Any] = {"metrics": end_x, "chunk": 1, "path": path}
    with (
        ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool,
        pytest.raises(RuntimeError, match=r"of 6 runs are finished; the same sweep goes on"),
    ):
        cdcr.sweep(run, {"pull": PULLS}, executor=pool, **options)
    kept = len(partial(path).read_text().splitlines()) - 1
    assert kept >= 1
    told: list[int] = []
    found = cdcr.sweep(
        run, {"pull": PULLS}, progress=lambda done, _: told.append(done), **options, jobs=1
    )
    assert told[0] == kept
    assert np.all(np.isfinite(found.end_x))


def test_two_sweeps_of_one_file_collide_in_a_sentence(tmp_path: Path) -> None:
    path, entered, free = tmp_path / "pulls.nc", threading.Event(), threading.Event()

    def waiting(pull: float) -> cdcr.Trajectory:
        entered.set()
        free.wait(DEADLINE)
        return pulled(pull)

    first = threading.Thread(
        target=lambda: cdcr.sweep(waiting, {"pull": PULLS}, path=path, **OPTIONS)
    )
    first.start()
    try:
        assert entered.wait(DEADLINE)
        with pytest.raises(FileExistsError) as caught:
            cdcr.sweep(waiting, {"pull": PULLS}, path=path, **OPTIONS)
    finally:
        free.set()
        first.join(DEADLINE)
    told = f"another sweep is writing to {partial(path)}: wait for it, or name another file"
    assert str(caught.value) == told
    assert path.exists()  # the first has finished


def test_another_sweep_is_not_mixed_in_or_replaced(tmp_path: Path) -> None:
    path, run = tmp_path / "pulls.nc", Counted()
    with pytest.raises(KeyboardInterrupt):
        cdcr.sweep(run, {"pull": PULLS}, path=path, progress=interrupted_after(2), **OPTIONS)
    for pulls, metrics, told in (
        (PULLS[1:], end_x, "other values"),
        (PULLS, "final_theta", "other metrics"),
    ):
        with pytest.raises(FileExistsError, match=f"of a sweep with {told}; pass overwrite=True"):
            cdcr.sweep(run, {"pull": pulls}, path=path, metrics=metrics)
    cdcr.sweep(run, {"pull": PULLS[:2]}, path=path, metrics="final_theta", overwrite=True)
    assert not partial(path).exists()
    with pytest.raises(FileExistsError, match="exists already, of a sweep with other values and"):
        cdcr.sweep(run, {"pull": PULLS}, path=path, **OPTIONS)


def test_files_that_are_no_sweeps_stay(tmp_path: Path) -> None:
    path = tmp_path / "notes.nc"
    partial(path).write_text("my notes\n")
    with pytest.raises(FileExistsError, match="is no part of a sweep that cdcr has written"):
        cdcr.sweep(pulled, {"pull": PULLS}, path=path, overwrite=True, **OPTIONS)
    assert partial(path).read_text() == "my notes\n"
    pulled(1.0).save(path)
    with pytest.raises(FileExistsError, match=r"notes\.nc is no sweep that cdcr has written$"):
        cdcr.sweep(pulled, {"pull": PULLS}, path=path, overwrite=False, **OPTIONS)
    path.write_text("my notes\n")
    with pytest.raises(FileExistsError, match="is no sweep that cdcr has written"):
        cdcr.sweep(pulled, {"pull": PULLS}, path=path, **OPTIONS)
    (tmp_path / "folder.zarr").mkdir()
    pytest.importorskip("zarr")
    with pytest.raises(IsADirectoryError, match="is a folder, not a sweep"):
        cdcr.sweep(
            pulled, {"pull": PULLS}, path=tmp_path / "folder.zarr", overwrite=True, **OPTIONS
        )
