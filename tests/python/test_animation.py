"""Films of runs: the right frames at the right speed, and no half-written file."""

import base64
import io
import re
import stat
import sys
import types
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import cdcr
from cdcr.base.extras import find_ffmpeg
from cdcr.plotting import plot_robot
from cdcr.plotting.animation import Film, draw_frames, frame_times
from cdcr.plotting.letters import have_room
from words import words_outside


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    model = cdcr.Model(cdcr.robots.amouri2020())
    t = np.linspace(0.0, 0.5, 26)
    return cdcr.simulate(model, [0.0, 0.0], [0.0, 1.0], t=t, tension=[5.0, 0.0, 0.0])


def test_gif_has_a_frame_for_each_moment(run: cdcr.Trajectory, tmp_path: Path) -> None:
    told: list[tuple[int, int]] = []
    path = run.animate(
        tmp_path / "run.gif",
        fps=30.0,
        speed=2.0,
        progress=lambda done, total: told.append((done, total)),
    )
    assert path == tmp_path / "run.gif"
    assert told == [(k, 8) for k in range(1, 9)]  # 0.25 s of film: 7.5 frames after the first
    with Image.open(path) as film:
        assert film.n_frames == 8
        assert film.size[0] > film.size[1] > 400
        durations = []
        for k in range(film.n_frames):
            film.seek(k)
            durations.append(film.info["duration"])
    assert sum(durations) == 270  # 8/30 s in hundredths
    assert set(durations) == {30, 40}


def test_frames_follow_the_run(run: cdcr.Trajectory) -> None:
    np.testing.assert_allclose(frame_times(run, 0.2), [0.0, 0.2, 0.4])
    np.testing.assert_allclose(frame_times(run, 0.1)[-1], 0.5)
    assert len(frame_times(run, 0.1 + 1e-12)) == 6  # rounding costs no frame
    straight, bent, again = draw_frames(run, np.array([0.0, 0.3, 0.0]))
    assert straight.dtype == np.uint8
    assert straight.shape[2] == 4
    assert straight.shape[0] % 2 == straight.shape[1] % 2 == 0
    np.testing.assert_array_equal(straight, again)  # nothing of a frame stays in the next
    middle = straight.shape[1] // 2
    changed = (straight != bent).any(axis=2)
    assert changed[:, :middle].sum() > 500  # the robot has moved
    assert changed[:, middle:].any()  # and so has the time mark


def test_suffix_chooses_the_format(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    assert run.animate(tmp_path / "run", fps=4.0) == tmp_path / "run.gif"
    with pytest.raises(RuntimeError, match=r"run\.mp4 needs the program ffmpeg"):
        run.animate(tmp_path / "run.mp4")
    assert run.animate(tmp_path / "RUN.GIF", fps=4.0).read_bytes().startswith(b"GIF89a")
    with pytest.raises(ValueError, match=r"must end in \.gif, \.mp4 or \.html, got 'run\.avi'"):
        run.animate(tmp_path / "run.avi")
    for nameless in ("", "..", "/"):
        with pytest.raises(ValueError, match=r"must end in \.gif, \.mp4 or \.html, got '(\.\.)?'"):
            run.animate(nameless)


def _install_ffmpeg(folder: Path, script: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Put a program called ffmpeg first on the PATH."""
    program = folder / "ffmpeg"
    program.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", str(folder), prepend=":")


def test_ffmpeg_is_given_every_pixel(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    _install_ffmpeg(
        tmp_path, f'echo "$@" > {tmp_path}/args; for f; do :; done; cat > "$f"', monkeypatch
    )
    path = run.animate(out / "run", fps=4.0)
    assert path == out / "run.mp4"
    frames = np.stack(list(draw_frames(run, np.array([0.0, 0.25, 0.5]))))
    assert path.read_bytes() == frames.tobytes()
    _, height, width, _ = frames.shape
    assert f"-s {width}x{height} -r 4 " in (tmp_path / "args").read_text(encoding="utf-8")
    assert list(out.iterdir()) == [path]


def test_ffmpeg_failing_is_told_in_its_words(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    _install_ffmpeg(tmp_path, "echo no such encoder >&2; exit 1", monkeypatch)
    with pytest.raises(RuntimeError, match=r"ffmpeg could not write the film: no such encoder"):
        run.animate(out / "run.mp4", fps=4.0)
    assert list(out.iterdir()) == []


@pytest.mark.skipif(find_ffmpeg() is None, reason="needs ffmpeg")
def test_mp4(run: cdcr.Trajectory, tmp_path: Path) -> None:
    path = run.animate(tmp_path / "run.mp4", fps=10.0)
    assert path.read_bytes()[4:8] == b"ftyp"


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_an_interrupted_film_leaves_nothing(
    run: cdcr.Trajectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, suffix: str
) -> None:
    out = tmp_path / "out"
    out.mkdir()
    _install_ffmpeg(tmp_path, 'for f; do :; done; cat > "$f"', monkeypatch)

    def stop(done: int, total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run.animate(out / f"run{suffix}", fps=10.0, progress=stop)
    assert list(out.iterdir()) == []


def test_no_silent_overwrite(run: cdcr.Trajectory, tmp_path: Path) -> None:
    path = tmp_path / "run.gif"
    path.write_text("precious", encoding="utf-8")
    with pytest.raises(FileExistsError, match=r"run\.gif exists already"):
        run.animate(path)
    assert path.read_text(encoding="utf-8") == "precious"
    run.animate(path, fps=4.0, overwrite=True)
    assert path.read_bytes().startswith(b"GIF89a")


def test_refusals_name_the_item(run: cdcr.Trajectory, tmp_path: Path) -> None:
    path = tmp_path / "run.gif"
    odd: Any
    for odd in (0, "x", None, float("nan"), True):
        for name in ("fps", "speed"):
            told = rf"^{name} must be a number > 0 and finite, got {odd!r} \("
            with pytest.raises(ValueError, match=told):
                run.animate(path, **{name: odd})
    with pytest.raises(ValueError, match=r"^a film has at most 100000 pictures, of 0.5 s "):
        run.animate(path, speed=1e-9)
    odd = 5
    with pytest.raises(TypeError, match=r"^path must be the path of a file, got 5 \(int\)$"):
        run.animate(odd)
    with pytest.raises(ValueError, match=r"^fps must be at most 50 in a \.gif, got 60$"):
        run.animate(path, fps=60)
    assert list(tmp_path.iterdir()) == []


def test_html_holds_every_frame(run: cdcr.Trajectory, tmp_path: Path) -> None:
    path = run.animate(tmp_path / "run.html", fps=5.0)
    text = path.read_text()
    frames = re.findall(r'^"([A-Za-z0-9+/=]+)",$', text, re.MULTILINE)
    assert len(frames) == len(frame_times(run, 1.0 / 5.0))
    for frame in (frames[0], frames[-1]):
        with Image.open(io.BytesIO(base64.b64decode(frame))) as picture:
            assert picture.format == "PNG"
    assert frames[0] != frames[-1]
    assert "1000 / 5)" in text
    assert "http" not in text


@pytest.mark.parametrize("size", [None, "journal", (15.0, 9.0)])
def test_no_word_of_a_film_is_cut(size: Any) -> None:
    """Whichever way the robot leans; and none is on another."""
    model = cdcr.Model(cdcr.robots.amouri2020())
    for theta, phi in ((0.0, 0.0), (1.5, 0.0), (1.5, 2.1), (2.5, 3.5), (1.5, 5.0)):
        q = cdcr.bending(theta, phi).ravel()
        run = cdcr.simulate(model, q, [0.0, 0.0], t=[0.0, 1e-3])
        film = Film(run, run.t, size)
        film.frame(0.0, q, run.tension[0])
        for text in film.figure.texts:
            text.set_animated(False)  # else it is drawn by `frame` alone
        assert words_outside(film.figure) == []
        assert have_room(film.figure)


def test_the_box_round_the_robot_is_closed() -> None:
    """No line of its grid ends without an edge."""
    axes = plot_robot(cdcr.Model(cdcr.robots.amouri2020()), [0.5, 0.0])
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        assert axis.pane.get_closed()
        assert axis.pane.get_edgecolor()[3] == 1.0


def test_the_program_of_a_package_will_do(monkeypatch: pytest.MonkeyPatch) -> None:
    package = types.ModuleType("imageio_ffmpeg")
    package.get_ffmpeg_exe = lambda: "/a/program"  # type: ignore[attr-defined]
    monkeypatch.setenv("PATH", "")
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", package)
    assert find_ffmpeg() == "/a/program"
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    assert find_ffmpeg() is None
