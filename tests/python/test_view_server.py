"""The view as it is served and recorded, and the command; no browser looks at it."""

from __future__ import annotations

import re
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.request import urlopen

import numpy as np
import pytest
from rich.console import Console

import cdcr

pytest.importorskip("matplotlib", reason="the view draws with the colours of pictures")
pytest.importorskip("viser", reason="the view is served by viser, extra view")
pytest.importorskip("typer")

from cdcr.view import Session, View
from cdcr.view.page import page
from cdcr.view.viewer import _Meter, in_notebook
from command import cdcr_, refused

ROBOT = cdcr.robots.three_sections(gravity=(0.0, 0.0, 9.81))
LONG = 30.0  # a thread or a process that takes longer hangs [s]


@pytest.fixture
def run() -> cdcr.Trajectory:
    model = cdcr.Model(ROBOT)
    t = np.linspace(0.0, 0.3, 31)
    return cdcr.simulate(model, np.zeros(6), np.zeros(6), t=t, tension=[5.0, *[0.0] * 8])


@pytest.fixture
def taken() -> Iterator[int]:
    """A port that somebody else has."""
    with socket.create_server(("127.0.0.1", 0)) as other:
        yield other.getsockname()[1]


def is_free(port: int) -> bool:
    with socket.socket() as probe:
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def port_of(view: View) -> int:
    return int(view.url.rpartition(":")[2])


def test_it_serves_this_machine_alone_and_frees_its_port() -> None:
    with ROBOT.view(port=0, browser=False) as view:
        port = port_of(view)
        assert urlopen(view.url, timeout=LONG).status == 200
        assert not is_free(port)
        assert view.url in repr(view)
        with socket.socket() as elsewhere, pytest.raises(OSError, match=r"refused|unreachable"):
            elsewhere.connect(("127.0.0.2", port))  # another address of this machine
    assert is_free(port)
    assert view.url == ""
    view.close()  # once more does no harm


def test_it_is_quiet(capfd: pytest.CaptureFixture[str], run: cdcr.Trajectory) -> None:
    run.view(port=0, browser=False).close()
    assert capfd.readouterr() == ("", "")


def test_waiting_ends_when_it_is_closed() -> None:
    view = ROBOT.view(port=0, browser=False)
    waiter = threading.Thread(target=view.wait, daemon=True)
    waiter.start()
    view.close()
    waiter.join(LONG)
    assert not waiter.is_alive()


def test_a_failure_of_the_drawing_is_told() -> None:
    view = ROBOT.view(port=0, browser=False)

    def fail() -> None:
        raise RuntimeError("cannot draw")

    view._tasks.put(fail)
    with pytest.raises(RuntimeError, match="cannot draw"):
        view.wait()
    assert view.url == ""


def test_a_failure_nobody_waits_for_is_told_too(capfd: pytest.CaptureFixture[str]) -> None:
    with ROBOT.view(port=0, browser=False) as view:

        def fail() -> None:
            raise RuntimeError("cannot draw")

        view._tasks.put(fail)
        view._thread.join(LONG)
        assert "<b>stopped</b>: cannot draw" in view._panel._status.content
    assert "stopped: cannot draw" in repr(view)
    assert capfd.readouterr() == ("", "cdcr: the view of robot has stopped: cannot draw\n")


def test_a_port_in_use(taken: int) -> None:
    with pytest.raises(OSError, match=f"^port {taken} is in use; give another one, or 0 for any"):
        ROBOT.view(port=taken, browser=False)
    assert "is in use" in refused(cdcr_("view", "amouri2020", "--port", str(taken), "--no-browser"))


def test_a_port_that_is_none() -> None:
    with pytest.raises(ValueError, match="port must be a whole number 0 to 65535, got 70000"):
        ROBOT.view(port=70000, browser=False)


def test_rates() -> None:
    meter = _Meter()
    for k in range(1000):
        meter.add(0.01, 0.005, k % 2 == 0)
    simulated, pictures = meter.rates()
    assert simulated == pytest.approx(0.5)
    assert pictures == pytest.approx(50.0, abs=1.0)


def test_the_page_holds_all_it_needs(run: cdcr.Trajectory, tmp_path: Path) -> None:
    file = View(Session(ROBOT, run=run), "run <1>").record(tmp_path / "out.html")
    text = file.read_text(encoding="utf-8")
    assert "<title>run &lt;1&gt;</title>" in text
    assert "__VISER_EMBED_DATA__" in text
    assert "@media (max-aspect-ratio: 1.1)" in text  # narrow windows
    assert "<span>5</span>" in text  # the legend, to the 5 N of the run
    for tag in re.findall(r"<(?:script|link|img|iframe)\b[^>]*>", text):
        source = re.search(r"\b(?:src|href)=[\"']?([^\"'\s>]*)", tag)
        assert source is None or source[1].startswith(("data:", "#")), tag


def test_a_robot_records_a_circle_and_a_robot_without_cables_no_legend() -> None:
    section = cdcr.Section(
        length=0.5, backbone_mass=0.01, backbone_diameter=0.003, youngs_modulus=60e9, damping=0.01
    )
    assert "cdcr-legend" not in page(Session(cdcr.Robot(sections=[section])), "rod")


def test_runs_and_robots_record_themselves(run: cdcr.Trajectory, tmp_path: Path) -> None:
    View(Session(ROBOT, run=run, speed=2.0), "run").record(tmp_path / "view.html")
    page = run.record(tmp_path / "run.html", speed=2.0)
    assert page == tmp_path / "run.html"
    sizes = [(tmp_path / name).stat().st_size for name in ("run.html", "view.html")]
    assert sizes[0] == pytest.approx(sizes[1], rel=1e-3)
    assert ROBOT.record(tmp_path / "robot.html").stat().st_size > 1e6
    with pytest.raises(FileExistsError, match="exists already"):
        run.record(page)
    odd: Any = 3
    with pytest.raises(TypeError, match="reference must be a "):
        run.record(tmp_path / "other.html", reference=odd)


def test_refusals_of_recording(run: cdcr.Trajectory, tmp_path: Path) -> None:
    view = View(Session(ROBOT, run=run), "run")
    with pytest.raises(ValueError, match=r"must end in \.html, got 'a\.gif'"):
        view.record(tmp_path / "a.gif")
    (tmp_path / "a.html").write_text("mine")
    with pytest.raises(FileExistsError, match="exists already; pass overwrite=True"):
        view.record(tmp_path / "a.html")
    with view.serve(0), pytest.raises(RuntimeError, match="close it first"):
        view.record(tmp_path / "b.html")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.html"]


def test_notebooks_show_the_page(run: cdcr.Trajectory, monkeypatch: pytest.MonkeyPatch) -> None:
    from cdcr import view as room

    monkeypatch.setattr(room, "in_notebook", lambda: True)
    view = run.view()
    assert view.url == ""
    shown = view._repr_html_()
    assert shown.startswith("<iframe srcdoc=")
    assert "__VISER_EMBED_DATA__" in shown


@pytest.mark.parametrize(
    ("shell", "notebook"),
    [(None, False), (SimpleNamespace(), False), (SimpleNamespace(kernel=object()), True)],
)
def test_a_notebook_is_what_has_a_kernel(
    shell: object, notebook: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Python, ipython in a terminal, a notebook.
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    assert in_notebook() is notebook


# --- the command ----------------------------------------------------------------------------------


def test_files_of_each_kind_are_recorded(run: cdcr.Trajectory, tmp_path: Path) -> None:
    pytest.importorskip("h5netcdf")
    ROBOT.save(tmp_path / "robot.toml")
    run.save(tmp_path / "run.nc")
    (tmp_path / "short.toml").write_text('robot = "amouri2020"\nt_end = 0.1\ntension = [1, 0, 0]\n')
    for name in ("run.nc", "short.toml"):
        out = tmp_path / f"{name}.html"
        result = cdcr_("view", str(tmp_path / name), "--record", str(out))
        assert result.exit_code == 0, result.stderr
        assert result.stdout.startswith(f"wrote {out}")
        assert "__VISER_EMBED_DATA__" in out.read_text(encoding="utf-8")


def test_the_robot_alone(run: cdcr.Trajectory, tmp_path: Path) -> None:
    pytest.importorskip("h5netcdf")
    from cdcr.cli.view import _find

    run.save(tmp_path / "run.nc")
    (tmp_path / "pull.toml").write_text('robot = "amouri2020"\nt_end = 0.1\ntension = [1, 0, 0]\n')
    expected = {
        "three-sections": cdcr.robots.three_sections(),
        "step-tension": cdcr.scenarios.get("step-tension").robot,
        str(tmp_path / "pull.toml"): cdcr.robots.amouri2020(),
        str(tmp_path / "run.nc"): ROBOT,
    }
    for target, robot in expected.items():
        shown = _find(target, Console(), robot_alone=True)
        assert (shown.run, shown.robot) == (None, robot)
        if target != "step-tension":
            assert (_find(target, Console(), robot_alone=False).run) is not None


@pytest.mark.parametrize(
    ("args", "words"),
    [
        (
            ["nothing"],
            "'nothing' is no robot or scenario of `cdcr list`, no file .toml of one, and",
        ),
        (["three-section"], "Did you mean 'three-sections'?"),
        (["missing.nc"], "there is no run missing.nc"),
        (["missing.toml"], "there is no robot or scenario file missing.toml"),
        (["factors-disks"], "nothing runs in the scenario 'factors-disks'"),
        (["amouri2020", "--record", "x.txt"], "--record must end in .html, got 'x.txt'"),
        (["amouri2020", "--speed", "-1"], "--speed must be a number > 0 and finite, got -1.0"),
        (["amouri2020", "--reference", "missing.nc"], "there is no run missing.nc"),
    ],
)
def test_mistakes(args: list[str], words: str) -> None:
    assert words in refused(cdcr_("view", *args, "--no-browser"))


def test_a_csv_has_no_robot(run: cdcr.Trajectory, tmp_path: Path) -> None:
    run.save(tmp_path / "run.csv")
    assert "holds numbers and no robot" in refused(cdcr_("view", str(tmp_path / "run.csv")))


@pytest.mark.parametrize("module", ["viser", "matplotlib"])
def test_without_the_extra(module: str) -> None:
    code = f"import sys; sys.modules[{module!r}] = None\nfrom cdcr.cli import main; main()"
    result = subprocess.run(
        [sys.executable, "-c", code, "view", "amouri2020"],
        capture_output=True,
        text=True,
        check=False,
        timeout=LONG,
    )
    assert result.returncode == 2
    assert (
        f'cdcr: {module} is needed for this and could not be imported: pip install "cdcr[view]"'
        in (result.stderr)
    )
    assert "Traceback" not in result.stderr


def test_ctrl_c_ends_it_well() -> None:
    script = (
        "import signal; from cdcr.cli import main; "
        "signal.signal(signal.SIGINT, signal.default_int_handler); "  # ignored in the background
        "main(['view', 'amouri2020', '--port', '0', '--no-browser'])"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout is not None
            line = process.stdout.readline()
            port = int(re.findall(r"^http://127\.0\.0\.1:(\d+) - Ctrl-C ends$", line)[0])
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=LONG)
        finally:
            process.kill()
    assert (process.returncode, out, err) == (0, "", "")
    assert is_free(port)
