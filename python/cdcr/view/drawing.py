"""A robot drawn into a scene of viser, and moved there."""

from __future__ import annotations

from typing import Any

import numpy as np

from cdcr.base.arrays import FloatArray
from cdcr.base.rotations import quaternions
from cdcr.plotting.geometry import base_frame, base_plate
from cdcr.plotting.style import BLACK, COLORS, DISK, GREY, LIGHT_GREY
from cdcr.view.colors import rgb, section_rgb, shaded, tension_colors
from cdcr.view.live import LiveModel, round_up
from cdcr.view.placement import OVERLAP, Poses, cylinder, place, sizes
from cdcr.view.session import TRAIL_POINTS, Moment

LINE, TRAIL_LINE = 2.5, 2.0  # of cables and of the trail [px]
GHOST = 0.3  # opacity of reference and estimate
GHOSTS = {"reference": GREY, "estimate": COLORS[1]}
FRAME, ARROW = 0.07, 0.012  # length of axes and width of the arrow over the robot's length
MARKER = 0.03  # diameter of a measured marker over the robot's length
BACKGROUND, TRAIL_COLOR, PULL_COLOR = (255, 255, 255), GREY, BLACK
MARKER_COLOR = COLORS[3]
CELLS = 8  # of the grid on the floor, over the robot's length


class Drawing:
    """Everything that a scene shows of a robot.

    Parameters
    ----------
    scene : viser.SceneApi
        Where it is drawn.
    model : LiveModel
        The robot.
    moment : Moment
        What is shown first.
    scale : float
        Tension at the end of the scale of colours [N]; more tension widens it.
    """

    def __init__(self, scene: Any, model: LiveModel, moment: Moment, scale: float) -> None:
        self.sizes, self.scale = sizes(model), scale
        length = model.robot.length
        self._floor(scene, model)
        at = place(model, moment.q)
        solid = {"lod": "off", "cast_shadow": False, "receive_shadow": False}
        colors = section_rgb(model.num_sections)[self.sizes.backbone_section]
        self.backbone = _cylinders(
            scene, "/robot/backbone", at.backbone, self.sizes.backbone, colors, **solid
        )
        self.disks = _cylinders(
            scene, "/robot/disks", at.disks, self.sizes.disks, rgb(DISK), **solid
        )
        self.marks = _cylinders(
            scene, "/robot/marks", at.marks, self.sizes.marks, rgb(BLACK), **solid
        )
        self.cables: Any = None
        if len(at.cables):
            self.cables = scene.add_line_segments(
                "/robot/cables",
                at.cables,
                np.zeros((len(at.cables), 2, 3), np.uint8),
                thickness=LINE,
                thickness_units="screen",
            )
        self.tool: Any = None
        if len(at.tool):
            color = shaded(np.tile(rgb(GREY), (1, 2, 1)))
            self.tool = scene.add_line_segments(
                "/robot/tool", at.tool, color, thickness=LINE, thickness_units="screen"
            )
        self.frames = scene.add_batched_axes(
            "/robot/frames",
            at.frames.wxyz,
            at.frames.position,
            axes_length=FRAME * length,
            axes_radius=FRAME * length / 25,
        )
        self.trail = scene.add_line_segments(
            "/robot/trail",
            _pieces(np.tile(at.tip, (TRAIL_POINTS, 1))),
            _fading(),
            thickness=TRAIL_LINE,
            thickness_units="screen",
        )
        self.arrow = scene.add_arrows(
            "/robot/pull",
            np.zeros((1, 2, 3)),
            shaded(rgb(PULL_COLOR)),
            shaft_radius=ARROW * length / 2,
            head_radius=ARROW * length,
            head_length=3 * ARROW * length,
            visible=False,
        )
        self.markers: Any = None
        if moment.markers is not None:
            self.markers = scene.add_point_cloud(
                "/markers",
                moment.markers.astype(np.float32),
                rgb(MARKER_COLOR),
                point_size=MARKER * length,
                point_shape="circle",
                precision="float32",
            )
        self.ghosts: dict[str, list[Any]] = {}
        for name, q in self._beside(moment):
            faint = {**solid, "opacity": GHOST}
            there, tint = place(model, q), rgb(GHOSTS[name])
            self.ghosts[name] = [
                _cylinders(scene, f"/{name}/{part}", poses, scales, tint, **faint)
                for part, poses, scales in (
                    ("backbone", there.backbone, self.sizes.backbone),
                    ("disks", there.disks, self.sizes.disks),
                )
            ]

    def update(self, model: LiveModel, moment: Moment, trail: FloatArray) -> None:
        """Show another moment, and the path of the tip (TRAIL_POINTS, 3) [m]."""
        at = place(model, moment.q)
        _move(self.backbone, at.backbone)
        if self.sizes.stretches:
            scales = self.sizes.backbone.copy()
            scales[:, 2] = OVERLAP * at.lengths
            self.backbone.batched_scales = scales.astype(np.float32)
        _move(self.disks, at.disks)
        _move(self.marks, at.marks)
        _move(self.frames, at.frames)
        if self.tool is not None:
            self.tool.points = at.tool.astype(np.float32)
        if self.cables is not None:
            largest = float(moment.tension.max())
            if largest > self.scale:
                self.scale = round_up(largest)
            colors = tension_colors(moment.tension, self.scale)[self.sizes.pieces]
            self.cables.points = at.cables.astype(np.float32)
            self.cables.colors = shaded(np.repeat(colors[:, None], 2, axis=1))
        self.trail.points = _pieces(trail).astype(np.float32)
        if moment.markers is not None:
            self.markers.points = moment.markers.astype(np.float32)
        for name, q in self._beside(moment):
            there = place(model, q)
            for handle, poses in zip(self.ghosts[name], (there.backbone, there.disks), strict=True):
                _move(handle, poses)

    @staticmethod
    def _beside(moment: Moment) -> list[tuple[str, FloatArray]]:
        """Return the name and the state of each ghost that a moment has."""
        both = {"reference": moment.reference, "estimate": moment.estimate}
        return [(name, q) for name, q in both.items() if q is not None]

    def show_pull(self, start: FloatArray | None, end: FloatArray | None = None) -> None:
        """Show an arrow from a point to another (3,) [m], or none."""
        if start is not None:
            self.arrow.points = np.array([[start, end]], dtype=np.float32)
        if self.arrow.visible != (start is not None):
            self.arrow.visible = start is not None

    def _floor(self, scene: Any, model: LiveModel) -> None:
        """Draw what stands still: a grid in the plane of the base, and the base plate."""
        length, (orientation, base) = model.robot.length, base_frame(model.robot)
        cell = round_up(length / CELLS)
        side = 2 * cell * round(0.8 * length / cell)
        scene.add_grid(
            "/floor",
            width=side,
            height=side,
            cell_size=cell,
            section_size=side,
            cell_color=rgb(LIGHT_GREY),
            section_color=rgb(LIGHT_GREY),
            shadow_opacity=0.0,
            wxyz=quaternions(orientation),
            position=base,
        )
        rim = base_plate(model)
        radius, thick = float(np.linalg.norm(rim[0])), length / 60
        _cylinders(
            scene,
            "/base",
            Poses(quaternions(orientation)[None], (base - thick / 2 * orientation[:, 2])[None]),
            np.array([[radius, radius, thick]]),
            rgb(GREY),
            cast_shadow=False,
        )


def _cylinders(
    scene: Any, name: str, poses: Poses, scales: FloatArray, colors: Any, **look: Any
) -> Any:
    """Draw cylinders, or nothing where there are none."""
    if not len(scales):
        return None
    return scene.add_batched_meshes_simple(
        name,
        *cylinder(),
        poses.wxyz,
        poses.position,
        batched_scales=scales,
        batched_colors=shaded(colors),
        **look,
    )


def _move(handle: Any, poses: Poses) -> None:
    if handle is not None:
        handle.batched_wxyzs = poses.wxyz.astype(np.float32)
        handle.batched_positions = poses.position.astype(np.float32)


def _pieces(points: FloatArray) -> FloatArray:
    """Return the straight pieces (N - 1, 2, 3) between points (N, 3)."""
    return np.stack([points[:-1], points[1:]], axis=1)


def _fading() -> Any:
    """Return the colours of the trail's pieces, fainter where longer ago."""
    share = np.linspace(0.0, 1.0, TRAIL_POINTS)[:, None]
    faded = share * rgb(TRAIL_COLOR) + (1.0 - share) * BACKGROUND
    return shaded(_pieces(faded))
