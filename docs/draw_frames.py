"""Draw docs/frames.svg, the frames and angles of cpp/README.md, from the model's own kinematics.

Run ``python docs/draw_frames.py`` with the package and its extra ``plot`` installed.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

import cdcr

FloatArray = NDArray[np.float64]

THETA, PHI = 1.25, 0.75
INK, BACKBONE, CABLE, PLANE = "#222222", "#1f4e79", "#b5562b", "#dbe7f3"

# Length one, and disks wide enough to be seen.
_TABLE_1 = cdcr.robots.amouri2020()
_SECTION = replace(_TABLE_1.sections[0], length=1.0, cable_radius=0.13, num_disks=5)
MODEL = cdcr.Model(replace(_TABLE_1, sections=(_SECTION,)))
Q = cdcr.bending(THETA, PHI)


def project(points: FloatArray) -> FloatArray:
    """Parallel view of points (N, 3) from the front, X nearer than Y, and somewhat from above."""
    turn, tilt = 0.45, 0.4
    right = np.array([np.cos(turn), np.sin(turn), 0.0])
    back = np.array([-np.sin(turn), np.cos(turn), 0.0])
    up = np.sin(tilt) * back + np.cos(tilt) * np.array([0.0, 0.0, 1.0])
    return np.asarray(points @ np.column_stack([right, up]))


def along_backbone(fractions: FloatArray, offset: FloatArray) -> FloatArray:
    """Points (N, 3) at an offset in the disks: the backbone, a cable, or beside it."""
    points = []
    for x in fractions:
        R, p = MODEL.pose(Q, 0, float(x))
        points.append(p + R @ offset)
    return np.array(points)


def rim(x: float, radius: float) -> FloatArray:
    """Circle (N, 3) of the disk at fraction x."""
    R, p = MODEL.pose(Q, 0, x)
    turn = np.linspace(0.0, 2.0 * np.pi, 73)
    circle = np.column_stack([np.cos(turn), np.sin(turn), 0.0 * turn])
    return np.asarray(p + radius * circle @ R.T)


def polyline(ax: Axes, points: FloatArray, **style: object) -> None:
    ax.plot(*project(points).T, **style)  # type: ignore[arg-type]


def axes_of_frame(ax: Axes, R: FloatArray, p: FloatArray, names: str, size: float) -> None:
    for k, name in enumerate(names.split()):
        start, end = project(np.array([p, p + size * R[:, k]]))
        arrow(ax, start, end)
        label(ax, end + 0.2 * (end - start), f"${name}$")


def label(ax: Axes, at: FloatArray, text: str, color: str = INK) -> None:
    ax.text(float(at[0]), float(at[1]), text, ha="center", va="center", color=color)


def arrow(ax: Axes, start: FloatArray, end: FloatArray, color: str = INK) -> None:
    style = {"arrowstyle": "-|>", "color": color, "lw": 1.1}
    head, tail = (float(end[0]), float(end[1])), (float(start[0]), float(start[1]))
    ax.annotate("", head, tail, arrowprops=style, zorder=5)


def arc(ax: Axes, centre: FloatArray, radius: float, angles: tuple[float, float]) -> None:
    turn = np.linspace(*angles, 40)
    ax.plot(centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn), color=INK, lw=0.8)


def draw_section(ax: Axes) -> None:
    """The bent section with its base and tip frames, in the plane it bends in."""
    fractions = np.linspace(0.0, 1.0, 60)
    backbone = along_backbone(fractions, np.zeros(3))
    foot = np.array([*backbone[-1, :2], 0.0])
    ax.fill(*project(np.array([*backbone, foot])).T, color=PLANE, zorder=0)
    polyline(ax, np.array([backbone[-1], foot, backbone[0]]), color=INK, lw=0.7, ls=":")
    for k in range(_SECTION.num_disks + 1):
        circle = rim(k / _SECTION.num_disks, 0.16)
        polyline(ax, circle, color="#777777", lw=0.8, zorder=1)
    for j, gamma in enumerate(_SECTION.cable_angles):
        hole = _SECTION.cable_radius * np.array([np.cos(gamma), np.sin(gamma), 0.0])
        cable = along_backbone(fractions, hole)
        polyline(ax, cable, color=CABLE, lw=1.0, zorder=2)
        R, p = MODEL.pose(Q, 0, 0.7)
        label(ax, project(p + 1.45 * R @ hole), f"{j + 1}", CABLE)
    polyline(ax, backbone, color=BACKBONE, lw=2.6, zorder=3)
    axes_of_frame(ax, np.eye(3), np.zeros(3), "X Y Z", 0.5)
    R, p = MODEL.tip(Q)
    axes_of_frame(ax, R, p, "n b t", 0.36)
    radii = np.linspace(0.0, PHI, 30)
    circle = 0.34 * np.column_stack([np.cos(radii), np.sin(radii), 0.0 * radii])
    polyline(ax, circle, color=INK, lw=0.8)
    middle = np.array([np.cos(PHI / 2), np.sin(PHI / 2), 0.0])
    label(ax, project(0.41 * middle), r"$\phi$")
    ax.set(xlim=(-0.25, 1.1), ylim=(-0.25, 1.2))
    ax.set_title("frames of the base and the tip", fontsize=9)


def draw_plane(ax: Axes) -> None:
    """The plane of bending: length, bending angle, chord."""
    theta = THETA
    x = np.linspace(0.0, 1.0, 60)
    bow, up = (1.0 - np.cos(x * theta)) / theta, np.sin(x * theta) / theta
    centre = np.array([1.0 / theta, 0.0])
    for end in (0, -1):
        ax.plot([centre[0], bow[end]], [centre[1], up[end]], color=INK, lw=0.7, ls=":")
    ax.plot([0.0, bow[-1]], [0.0, up[-1]], color=INK, lw=0.8, ls="--")
    ax.plot(bow, up, color=BACKBONE, lw=2.6)
    arrow(ax, np.zeros(2), np.array([0.0, 1.0]))
    arrow(ax, np.zeros(2), np.array([0.95, 0.0]))
    tangent = np.array([np.sin(theta), np.cos(theta)])
    arrow(ax, np.array([bow[-1], up[-1]]), np.array([bow[-1], up[-1]]) + 0.25 * tangent)
    arc(ax, centre, 0.22, (np.pi - theta, np.pi))
    arc(ax, np.zeros(2), 0.4, (np.pi / 2.0 - theta / 2.0, np.pi / 2.0))
    middle = np.pi - theta / 2.0
    label(ax, centre + 0.3 * np.array([np.cos(middle), np.sin(middle)]), r"$\theta$")
    ax.text(0.12, 0.27, r"$\theta/2$", fontsize=8)
    ax.text(bow[44] - 0.03, up[44] + 0.03, r"$s = x\,\ell$", color=BACKBONE, ha="right")
    ax.text(-0.04, 0.98, "$Z$", ha="right", va="center")
    ax.text(0.98, -0.02, r"direction of $q$", ha="right", va="top", fontsize=9)
    ax.text(centre[0] + 0.02, 0.03, r"centre, at $\ell/\theta$", fontsize=8)
    ax.text(bow[-1] + 0.27, up[-1] + 0.08, "$t$", va="center")
    ax.set(xlim=(-0.15, 1.2), ylim=(-0.15, 1.12))
    ax.set_title("the plane of bending", fontsize=9)


def draw_disk(ax: Axes) -> None:
    """A disk seen from the tip: cable angles and the bending vector."""
    turn = np.linspace(0.0, 2.0 * np.pi, 100)
    ax.plot(np.cos(turn), np.sin(turn), color="#777777", lw=1.0)
    ax.plot(0.8 * np.cos(turn), 0.8 * np.sin(turn), color=CABLE, lw=0.5, ls=":")
    for j, gamma in enumerate(_SECTION.cable_angles):
        at = 0.8 * np.array([np.cos(gamma), np.sin(gamma)])
        ax.plot(*at, "o", color=CABLE, ms=6)
        ax.text(at[0], at[1] + 0.14, f"{j + 1}", color=CABLE, ha="center", va="center")
    gamma = _SECTION.cable_angles[1]
    ax.plot([0.0, 0.8 * np.cos(gamma)], [0.0, 0.8 * np.sin(gamma)], color=CABLE, lw=0.8)
    ax.text(-0.25, 0.36, "$r$", color=CABLE, ha="right")
    arrow(ax, np.zeros(2), np.array([1.3, 0.0]))
    arrow(ax, np.zeros(2), np.array([0.0, 1.3]))
    arrow(ax, np.zeros(2), 0.62 * np.array([np.cos(PHI), np.sin(PHI)]), color=BACKBONE)
    ax.text(0.5, 0.52, "$q$", color=BACKBONE)
    arc(ax, np.zeros(2), 0.34, (0.0, PHI))
    arc(ax, np.zeros(2), 0.2, (0.0, gamma))
    ax.text(0.37, 0.11, r"$\phi$")
    ax.text(0.08, 0.24, r"$\gamma_2$", color=CABLE, fontsize=9, ha="center")
    ax.text(1.36, 0.0, "$X$", va="center")
    ax.text(0.0, 1.4, "$Y$", ha="center")
    ax.set(xlim=(-1.1, 1.5), ylim=(-1.1, 1.5))
    ax.set_title("a disk, seen from the tip", fontsize=9)


def draw() -> Figure:
    figure = Figure(figsize=(9.6, 3.6), layout="constrained")
    panels = figure.subplots(1, 3, width_ratios=[1.25, 1.0, 1.0])
    for ax, content in zip(panels, (draw_section, draw_plane, draw_disk), strict=True):
        ax.set_aspect("equal")
        ax.set_axis_off()
        content(ax)
    return figure


if __name__ == "__main__":
    # The same bytes at every run.
    mpl.rcParams["svg.hashsalt"] = "cdcr"
    target = Path(__file__).with_name("frames.svg")
    draw().savefig(target, metadata={"Date": None})
    print(f"wrote {target}")
