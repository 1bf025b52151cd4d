"""Pictures one after the other as a film: GIF by Pillow, MP4 by ffmpeg, HTML by ourselves."""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from cdcr.base.extras import find_ffmpeg
from cdcr.plotting.film_page import write_page

Frame = NDArray[np.uint8]  # (height, width, 4): red, green, blue, opacity
MAX_GIF_FPS = 50.0  # browsers slow down anything faster


def film_path(path: Path) -> Path:
    """Return the path with the suffix of the format to write, or say why it cannot be written."""
    if not path.suffix and path.name not in ("", ".."):
        return path.with_suffix(".mp4" if find_ffmpeg() else ".gif")
    suffix = path.suffix.lower()
    if suffix not in _WRITERS:
        raise ValueError(f"the file name must end in .gif, .mp4 or .html, got {path.name!r}")
    if suffix == ".mp4" and not find_ffmpeg():
        raise RuntimeError(
            f"writing {path.name} needs the program ffmpeg, which is not on the PATH; install it "
            "(pip install imageio-ffmpeg does too), or write a .gif or .html"
        )
    return path


def write_film(path: Path, suffix: str, frames: Iterable[Frame], fps: float) -> None:
    """Write frames, at least one, as a film of that suffix to a file of any name."""
    _WRITERS[suffix.lower()](path, iter(frames), fps)


def _write_gif(path: Path, frames: Iterator[Frame], fps: float) -> None:
    first = next(frames)
    # The colours of the first frame serve all, so that a waiting frame takes one byte a pixel.
    colors = _rgb(first).quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    images = [
        _rgb(frame).quantize(palette=colors, dither=Image.Dither.NONE)
        for frame in chain([first], frames)
    ]
    # Pillow looks colours up coarsely. The background, on which it shows, gets its own back.
    table = np.reshape(colors.getpalette() or [], (-1, 3))
    table[np.asarray(images[0])[0, 0]] = first[0, 0, :3]
    for image in images:
        image.putpalette(table.astype(np.uint8).tobytes())
    # A GIF counts in hundredths of a second: round the frames' times, so that errors cancel.
    times = np.rint(np.arange(len(images) + 1) * 100.0 / fps).astype(int)
    durations = (10 * np.diff(times)).tolist()  # Pillow counts in milliseconds
    options = {"append_images": images[1:], "duration": durations, "loop": 0}
    images[0].save(path, format="GIF", save_all=True, **options)


def _rgb(frame: Frame) -> Image.Image:
    return Image.fromarray(frame).convert("RGB")


def _write_mp4(path: Path, frames: Iterator[Frame], fps: float) -> None:
    first = next(frames)
    height, width, _ = first.shape
    command = [
        find_ffmpeg() or "ffmpeg",
        "-loglevel",
        "error",
        "-f",
        "rawvideo",
        "-pix_fmt",
        "rgba",
    ]
    command += ["-s", f"{width}x{height}", "-r", f"{fps:.12g}", "-i", "-"]
    command += ["-c:v", "h264", "-pix_fmt", "yuv420p"]  # what every player understands
    command += ["-f", "mp4", "-y", str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as ffmpeg:
        assert ffmpeg.stdin is not None
        try:
            for frame in chain([first], frames):
                ffmpeg.stdin.write(frame.tobytes())
        except BrokenPipeError:
            pass  # ffmpeg has given up, and says why below
        except BaseException:
            ffmpeg.kill()
            with suppress(BrokenPipeError):  # closing sends what is left
                ffmpeg.stdin.close()
            raise
        _, complaint = ffmpeg.communicate()
    if ffmpeg.returncode:
        raise RuntimeError(f"ffmpeg could not write the film: {complaint.decode().strip()}")


_WRITERS: dict[str, Callable[[Path, Iterator[Frame], float], None]] = {
    ".gif": _write_gif,
    ".mp4": _write_mp4,
    ".html": write_page,
}
