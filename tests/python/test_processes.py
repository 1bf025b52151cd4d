"""Computations by several processes: the same results, and nobody left behind."""

import math
import os
import signal
import subprocess
import sys
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import cdcr

pytest.importorskip("typer")

from cdcr.base import processes
from cdcr.cli import figures
from command import cdcr_, everything_in, refused

DEADLINE = 100.0  # after which something hangs [s]
SLEEPERS = """
import time
from cdcr.base import processes
from cdcr.cli import main
from cdcr.cli.app import app
from cdcr.cli.plain import told_plainly

@app.command("sleep")
def sleep():
    with told_plainly():
        kept = processes._send
        def send(stream, thing):
            kept(stream, thing)
            if isinstance(thing, tuple):
                print("asked", flush=True)
        processes._send = send
        list(processes.results(time.sleep, [1000.0, 1000.0], 2))

main(["sleep"])
"""
DRAWN = ("block-diagram", "factors-disks")
TWO_FIGURES = f"""
import sys
from cdcr.cli import figures, main, page

chosen = [one for one in figures.paper_scenarios() if one.name in {DRAWN}]
figures.paper_scenarios = lambda: chosen
page.audit = list
main(["figures", "--out", sys.argv[1], "--jobs", sys.argv[2]])
"""


@pytest.mark.parametrize("count", [1, 2])
def test_results_are_those_of_the_function(count: int) -> None:
    numbers = [0.0, 1.0, 4.0, 9.0]
    found = dict(processes.results(math.sqrt, numbers, count))
    assert found == {job: math.sqrt(number) for job, number in enumerate(numbers)}


@pytest.mark.parametrize("count", [1, 2])
def test_a_failure_tells_where_and_why(count: int) -> None:
    with pytest.raises(processes.JobFailed) as caught:
        list(processes.results(int, ["1", "2", "three"], count))
    assert (caught.value.job, "'three'" in caught.value.reason) == (2, True)


def test_a_process_that_ends_is_a_failure_and_none_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[subprocess.Popen[bytes]] = []
    start: Callable[..., Any] = subprocess.Popen

    def remember(*args: Any, **options: Any) -> Any:
        started.append(start(*args, **options))
        return started[-1]

    monkeypatch.setattr(subprocess, "Popen", remember)
    with pytest.raises(processes.JobFailed) as caught:
        list(processes.results(os._exit, [3, 3, 3], 2))
    assert caught.value.reason == "its process ended with exit code 3"
    assert [worker.poll() is not None for worker in started] == [True, True]


def test_warnings_come_through() -> None:
    with pytest.warns(UserWarning, match="^look$"):
        list(processes.results(warnings.warn, ["look", "look"], 2))


@pytest.mark.parametrize(
    ("number", "code", "told"),
    [
        (signal.SIGINT, 130, b"cdcr: interrupted, no file was written\n"),
        (signal.SIGTERM, 143, b""),
        (signal.SIGKILL, -9, b""),
    ],
)
def test_whatever_ends_it_ends_its_processes(
    number: signal.Signals, code: int, told: bytes
) -> None:
    """They hold its standard error, which ends with the last of them."""
    command = [sys.executable, "-c", SLEEPERS]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=_heed_control_c
    ) as parent:
        assert parent.stdout is not None
        assert [parent.stdout.readline(), parent.stdout.readline()] == [b"asked\n"] * 2
        parent.send_signal(number)
        try:
            _, complaint = parent.communicate(timeout=DEADLINE)
        finally:
            parent.kill()
    assert (parent.returncode, complaint) == (code, told)


def _heed_control_c() -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)  # which becomes Python's own


def test_several_processes_draw_the_same_without_input_and_deaf_to_control_c(
    tmp_path: Path,
) -> None:
    pytest.importorskip("matplotlib")
    command = [sys.executable, "-c", TWO_FIGURES, str(tmp_path), "2"]
    deaf = ["sh", "-c", 'trap "" INT; exec "$0" "$@" <&-', *command]
    done = subprocess.run(deaf, capture_output=True, timeout=DEADLINE, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    assert len(everything_in(tmp_path)) == 5
    for name in DRAWN:
        for suffix, here in zip(figures.SUFFIXES, figures.draw((name, None)), strict=True):
            assert (tmp_path / f"{name}{suffix}").read_bytes() == here, name


def test_a_signal_amid_the_figures_leaves_nothing(tmp_path: Path) -> None:
    """The first picture is drawn, and the second on its way, as the signal comes."""
    pytest.importorskip("matplotlib")
    code = TWO_FIGURES.replace(
        "page.audit = list",
        """
import os, signal
from cdcr.cli import run
run.DelayedBar.__call__ = lambda self, done, name: done and os.kill(os.getpid(), signal.SIGTERM)
""",
    )
    command = [sys.executable, "-c", code, str(tmp_path / "new" / "figures"), "2"]
    done = subprocess.run(command, capture_output=True, timeout=DEADLINE, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (143, b"", b"")
    assert everything_in(tmp_path) == []


def test_what_fails_in_a_process_is_told_by_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("matplotlib")
    drawn = [replace(cdcr.scenarios.get("pid"), name=name) for name in ("nothing", "nobody")]
    monkeypatch.setattr(figures, "paper_scenarios", lambda: drawn)
    told = refused(cdcr_("figures", "--out", tmp_path / "new", "--jobs", 2))
    assert told.startswith(("the picture of 'nothing' failed: ", "the picture of 'nobody' failed:"))
    assert "there is no scenario 'no" in told
    assert everything_in(tmp_path) == []


def test_as_many_processes_as_this_one_may_use() -> None:
    assert 1 <= processes.usable() <= (os.cpu_count() or 1)
