"""Films as a page of their own: pictures in HTML, which any browser plays without a network."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

_HEAD = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>A run of a cable-driven continuum robot</title>
<style>body{font-family:sans-serif;max-width:60em;margin:1em auto}img,input{width:100%}</style>
<img id="frame" alt="the robot"><input id="place" type="range" min="0" value="0" aria-label="frame">
<button id="play">pause</button>
<script>
const frames = [
"""
_TAIL = """];
const [frame, place, play] = ["frame", "place", "play"].map((id) => document.getElementById(id));
let playing = true, shown = 0;
place.max = frames.length - 1;
function show(k) {
  shown = k;
  place.value = k;
  frame.src = "data:image/png;base64," + frames[k];
}
function step() { if (playing) show((shown + 1) % frames.length); }
function toggle() { playing = !playing; play.textContent = playing ? "pause" : "play"; }
play.onclick = toggle;
place.oninput = () => { if (playing) toggle(); show(Number(place.value)); };
show(0);
setInterval(step, 1000 / FPS);
</script></html>
"""


def write_page(path: Path, frames: Iterable[NDArray[np.uint8]], fps: float) -> None:
    """Write frames (height, width, 4) as a page that plays them, over and over."""
    with path.open("w", encoding="utf-8", newline="\n") as file:
        file.write(_HEAD)
        for frame in frames:
            file.write(f'"{_png(frame)}",\n')
        file.write(_TAIL.replace("FPS", f"{fps:.12g}"))


def _png(frame: NDArray[np.uint8]) -> str:
    """Return a picture in 256 colours, in characters."""
    whole = io.BytesIO()
    Image.fromarray(frame).convert("RGB").quantize(256).save(whole, format="PNG")
    return base64.b64encode(whole.getvalue()).decode("ascii")
