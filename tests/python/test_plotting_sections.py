"""Pictures of robots of several sections: colours tell sections, kinds of line tell cables."""

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("matplotlib")

from cdcr.plotting import panels, plot_robot, space
from cdcr.plotting.animation import draw_frames
from cdcr.plotting.geometry import PIECES, robot_shape
from cdcr.plotting.robot3d import section_colors
from cdcr.plotting.style import COLORS, StyledFigure

ROUNDING = 1e-14  # sums of a few products of numbers below 1


@pytest.fixture(scope="module")
def run() -> cdcr.Trajectory:
    model = cdcr.Model(cdcr.robots.three_sections(damping=5e-3))
    tension = [1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0]
    start = np.zeros(6)
    return cdcr.simulate(model, start, start, t=np.linspace(0.0, 1.0, 51), tension=tension)


def test_the_backbone_is_that_of_its_sections(run: cdcr.Trajectory) -> None:
    shape = robot_shape(run.model, run.q[-1])
    assert [len(one) for one in shape.sections] == [PIECES + 1] * 3
    for i, section in enumerate(shape.sections):
        for fraction, point in ((0.0, section[0]), (0.5, section[PIECES // 2]), (1.0, section[-1])):
            expected = run.model.pose(run.q[-1], i, fraction)[1]
            np.testing.assert_allclose(point, expected, atol=ROUNDING)


def test_one_colour_for_a_section_and_its_cables(run: cdcr.Trajectory) -> None:
    axes = plot_robot(run.model, run.q[-1])
    backbones, cables = axes.lines[:3], axes.lines[3:12]
    assert [line.get_color() for line in backbones] == list(COLORS[:3])
    assert [line.get_label() for line in backbones] == ["section 1", "section 2", "section 3"]
    assert [line.get_color() for line in cables] == [COLORS[j // 3] for j in range(9)]
    theta, _, tension = run.plot().axes[:3]
    assert [line.get_color() for line in theta.lines] == list(COLORS[:3])
    assert [line.get_color() for line in tension.lines] == [COLORS[j // 3] for j in range(9)]
    legend = tension.get_legend()
    assert legend is not None
    names = [text.get_text() for text in legend.get_texts()]
    assert names == ["cable 1", *"23456789"]


def test_cables_that_end_together_differ(run: cdcr.Trajectory) -> None:
    dashes = [str(look["linestyle"]) for look in panels.cable_looks(run.model, 100)]
    assert len(set(dashes[:3])) == 3
    assert dashes[:3] == dashes[3:6] == dashes[6:]


@pytest.mark.parametrize("sections", [1, 2])
def test_sixteen_cables_of_a_section_all_look_different(sections: int) -> None:
    cables = [
        cdcr.Cable(angle=2.0 * np.pi * j / 16, radius=0.02, end_section=sections - 1)
        for j in range(16)
    ]
    section = replace(cdcr.robots.amouri2020().sections[0], cable_angles=())
    robot = cdcr.Robot(sections=[section] * sections, cables=cables)
    model = cdcr.Model(robot)
    looks = [
        (look["color"], str(look["linestyle"]), look.get("marker", ""))
        for look in panels.cable_looks(model, 100)
    ]
    assert len(set(looks)) == 16
    assert looks[4] != looks[0]
    still = np.zeros(model.num_coordinates)
    tension = cdcr.simulate(model, still, still, t=[0.0, 0.01], tension=np.zeros(16)).plot().axes[2]
    legend = tension.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()][-1] == "16"


def test_one_section_keeps_a_colour_for_each_cable() -> None:
    model = cdcr.Model(cdcr.robots.amouri2020())
    assert panels.cable_colors(model) == list(COLORS[:3])
    assert len(section_colors(model)) == 1


def test_phi_is_shown_only_where_there_is_one(run: cdcr.Trajectory) -> None:
    phi = panels.shown_phi(run)
    seen = np.isfinite(phi)
    assert not np.any(seen[0])  # straight
    assert np.all(np.abs(run.theta)[seen] >= panels.STRAIGHT * np.abs(run.theta).max())
    np.testing.assert_array_equal(phi[seen], np.rad2deg(run.phi)[seen])  # continuous


def test_times_and_sections_are_named_apart(run: cdcr.Trajectory) -> None:
    axes = run.plot_robot(times=[0.0, 0.5, 1.0])
    _, labels = axes.get_legend_handles_labels()
    assert labels == [
        "path of the tip",
        "0 s",
        "0.5 s",
        "1 s",
        "section 1",
        "section 2",
        "section 3",
    ]


def test_frames_of_a_film_move_every_section(run: cdcr.Trajectory) -> None:
    first, last = draw_frames(run, np.array([0.0, 1.0]))
    assert first.shape == last.shape
    assert np.any(first != last)
    np.testing.assert_array_equal(next(iter(draw_frames(run, np.array([0.0])))).shape, first.shape)


def test_a_robot_of_many_parts_is_drawn() -> None:
    model = cdcr.Model(cdcr.robots.three_sections().subdivide(3))
    axes = plot_robot(model, np.full(18, 0.1))
    colors = [tuple(np.ravel(line.get_color())) for line in axes.lines[:9]]
    assert len(set(colors)) == 9


def test_directions_on_paper_are_orthonormal() -> None:
    axes: Any = space.add_axes(StyledFigure())
    R = np.vstack([space.paper_directions(axes), space.towards_viewer(axes)])
    np.testing.assert_allclose(R @ R.T, np.eye(3), atol=ROUNDING)
    assert np.linalg.det(R) == pytest.approx(1.0, rel=ROUNDING)
    assert R[1, 2] > 0.0  # z points upwards


def test_base_orientation_turns_the_picture(run: cdcr.Trajectory) -> None:
    R = ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0))
    turned = cdcr.Model(replace(run.model.robot, base_orientation=R))
    up, down = (robot_shape(model, run.q[-1]) for model in (run.model, turned))
    np.testing.assert_allclose(down.points, up.points @ np.array(R).T, atol=ROUNDING)


def test_turns_of_a_straight_section_are_not_drawn() -> None:
    """Of a section that comes back bent, after it has turned round and round nearly straight."""
    model = cdcr.Model(cdcr.robots.three_sections())
    theta = np.concatenate([np.full(5, 0.5), np.full(40, 1e-3), np.full(5, 0.5)])
    phi = np.linspace(0.0, 8.0 * np.pi, 50)
    q = np.zeros((50, 6))
    q[:, :2] = cdcr.bending(theta, phi).reshape(50, 2)
    q[:, 2] = 0.5
    still, pulls = np.zeros((50, 6)), np.zeros((50, 9))
    options: dict[str, Any] = {"status": cdcr.Status.ok, "message": "", "stats": cdcr.Stats()}
    run = cdcr.Trajectory(model=model, t=np.arange(50.0), q=q, qd=still, tension=pulls, **options)
    assert run.phi[-1, 0] == pytest.approx(8.0 * np.pi)  # the run itself counts them
    shown = panels.shown_phi(run)[:, 0]
    np.testing.assert_allclose(shown[:5], np.rad2deg(phi[:5]), atol=1e-9)
    np.testing.assert_allclose(shown[-5:], np.rad2deg(phi[-5:]) - 1440.0, atol=1e-9)
    assert np.isnan(shown[5:45]).all()


@pytest.mark.parametrize("size", [None, "slide"])
def test_names_of_five_panels_stand_clear_of_one_another(size: Any) -> None:
    section = replace(
        cdcr.robots.amouri2020(damping=0.01).sections[0],
        shear_modulus=4e9, twist_order=0, stretch_order=0, twist_damping=0.01, stretch_damping=0.1,
    )  # fmt: skip
    model = cdcr.Model(cdcr.Robot(sections=[section]))
    run = cdcr.simulate(model, [0.1, 0.1, 0.1, 1e-3], np.zeros(4), t=np.linspace(0.0, 0.1, 5))
    figure = run.plot(size=size)
    figure.canvas.draw()
    left = [axes for axes in figure.axes if axes.get_position().x0 < 0.3]
    assert len(left) == 5
    names = sorted((axes.yaxis.label.get_window_extent() for axes in left), key=lambda box: box.y0)
    assert all(lower.y1 < upper.y0 for lower, upper in itertools.pairwise(names))
