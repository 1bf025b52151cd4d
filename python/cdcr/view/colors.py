"""Colours of the view: tensions on a scale that colour-blind readers can order, and its legend."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import ArrayLike, NDArray

from cdcr.base.arrays import FloatArray
from cdcr.plotting.style import BLACK, COLORS

# From light to dark throughout, so that its order shows without colours; without what is too light
# to see on white.
SCALE, LIGHTEST = "YlOrRd", 0.3
SECTIONS = (COLORS[0], COLORS[2], COLORS[3], COLORS[4])  # those that are unlike the scale
Rgb = tuple[int, int, int]


def rgb(color: str) -> Rgb:
    """Return a colour as three numbers 0 to 255."""
    red, green, blue = (round(255 * part) for part in to_rgb(color))
    return red, green, blue


def shaded(colors: ArrayLike) -> NDArray[np.uint8]:
    """Return colours (..., 3) as meshes and lines of viser want them: linear in light, 0 to 255."""
    share = np.asarray(colors, dtype=np.float64) / 255
    low, high = share / 12.92, ((share + 0.055) / 1.055) ** 2.4  # IEC 61966-2-1
    return np.asarray(np.rint(255 * np.where(share <= 0.04045, low, high)), dtype=np.uint8)


def tension_colors(tension: FloatArray, largest: float) -> NDArray[np.uint8]:
    """Return a colour (M, 3) for each tension (M,), from 0 to the largest [N]."""
    share = np.clip(tension / largest, 0.0, 1.0)
    colors = mpl.colormaps[SCALE](LIGHTEST + (1.0 - LIGHTEST) * share)[:, :3]
    return np.asarray(np.rint(255 * colors), dtype=np.uint8)


def section_rgb(count: int) -> NDArray[np.uint8]:
    """Return the colour of each section's backbone (count, 3); black where there is one."""
    named = (BLACK,) if count == 1 else SECTIONS
    return np.array([rgb(named[i % len(named)]) for i in range(count)], dtype=np.uint8)


def legend(largest: float) -> str:
    """Return the scale of tensions, as HTML."""
    steps = tension_colors(np.linspace(0.0, 1.0, 9), 1.0)
    ramp = ", ".join(f"rgb({r},{g},{b})" for r, g, b in steps.tolist())
    ticks = "".join(f"<span>{value:.3g}</span>" for value in np.linspace(0.0, largest, 5))
    return (
        '<div style="padding:0.3em 0.9em;font-size:0.8em">cable tension [N]'
        f'<div style="height:0.8em;border-radius:2px;background:linear-gradient(90deg,{ramp})">'
        '</div><div style="display:flex;justify-content:space-between;'
        f'font-variant-numeric:tabular-nums">{ticks}</div></div>'
    )
