"""Pictures of runs and robots: what they show is the data, with names and units."""

import dataclasses
import subprocess
import sys
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d import proj3d  # type: ignore[import-untyped]

import cdcr
from cdcr.plotting import plot_robot
from cdcr.plotting.geometry import robot_shape, states_at

# Sums of a few products of numbers below 1 [m].
ROUNDING = 1e-14

LABELS = [
    r"bending angle $\theta$ [deg]",
    r"orientation $\varphi$ [deg]",
    "tension [N]",
    "tip position [m]",
    "energy [J]",
]


@pytest.fixture(scope="module")
def model() -> cdcr.Model:
    return cdcr.Model(cdcr.robots.amouri2020(gravity=(0.0, 0.0, 9.81), damping=1e-3))


@pytest.fixture(scope="module")
def run(model: cdcr.Model) -> cdcr.Trajectory:
    """5 N on cable 1, and a sideways push."""
    t = np.linspace(0.0, 2.0, 101)
    return cdcr.simulate(model, [0.0, 0.0], [0.0, 1.0], t=t, tension=[5.0, 0.0, 0.0])


@pytest.fixture(scope="module")
def free_run() -> cdcr.Trajectory:
    model = cdcr.Model(cdcr.robots.amouri2020())
    return cdcr.simulate(model, [0.5, 0.0], [0.0, 0.0], t=np.linspace(0.0, 1.0, 51))


def _lines(axes: Any) -> dict[str, Any]:
    return {line.get_label(): line for line in axes.lines}


def test_panels_are_labelled(run: cdcr.Trajectory, free_run: cdcr.Trajectory) -> None:
    assert [axes.get_ylabel() for axes in run.plot().axes] == LABELS
    expected = [*LABELS, "relative energy error [1]"]
    assert [axes.get_ylabel() for axes in free_run.plot().axes] == expected
    lowest = [axes for axes in run.plot().axes if axes.get_xlabel()]
    assert [axes.get_xlabel() for axes in lowest] == ["time [s]"] * 2  # one for each column


def test_panels_show_the_data(run: cdcr.Trajectory) -> None:
    theta, phi, tension, tip, energy = run.plot().axes
    for axes in (theta, phi, tension, tip, energy):
        for line in axes.lines:
            np.testing.assert_array_equal(line.get_xdata(), run.t)
    np.testing.assert_array_equal(theta.lines[0].get_ydata(), np.rad2deg(run.theta[:, 0]))
    np.testing.assert_array_equal(phi.lines[0].get_ydata(), np.rad2deg(run.phi[:, 0]))
    for j, name in enumerate(["cable 1", "2", "3"]):
        np.testing.assert_array_equal(_lines(tension)[name].get_ydata(), run.tension[:, j])
    for k, name in enumerate("xyz"):
        np.testing.assert_array_equal(_lines(tip)[name].get_ydata(), run.tip[:, k])
    shown = {"kinetic": run.kinetic_energy, "potential": run.potential_energy, "total": run.energy}
    for name, values in shown.items():
        np.testing.assert_array_equal(_lines(energy)[name].get_ydata(), values)


def test_free_run_shows_its_energy_error(free_run: cdcr.Trajectory) -> None:
    error = free_run.plot().axes[-1]
    np.testing.assert_array_equal(error.lines[0].get_ydata(), free_run.energy_error)


def test_rounding_noise_does_not_fill_a_panel(free_run: cdcr.Trajectory) -> None:
    noisy = dataclasses.replace(free_run, q=free_run.q + np.array([0.0, 1e-17]))
    phi = noisy.plot().axes[1]
    low, high = phi.get_ylim()
    assert high - low >= 1.0
    assert low < np.rad2deg(noisy.phi).min() < np.rad2deg(noisy.phi).max() < high


def test_legends_lie_outside_the_data(run: cdcr.Trajectory) -> None:
    figure = run.plot()
    figure.draw_without_rendering()
    renderer = figure.canvas.get_renderer()  # type: ignore[attr-defined]
    legends = [axes.get_legend() for axes in figure.axes]
    assert [legend is not None for legend in legends] == [False, False, True, True, True]
    boxes = [legend.get_window_extent(renderer) for legend in legends if legend is not None]
    for box in boxes:
        assert not any(box.overlaps(axes.bbox) for axes in figure.axes)
        assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1
        assert figure.bbox.y0 <= box.y0 < box.y1 <= figure.bbox.y1


def test_nothing_is_cut_off(run: cdcr.Trajectory) -> None:
    for figure in (run.plot(), run.plot_robot().figure, plot_robot(run.model, [0.0, 0.0]).figure):
        figure.draw_without_rendering()
        parts = [axis for axes in figure.axes for axis in axes._axis_map.values()]
        boxes = [part.get_tightbbox() for part in [*parts, *figure.legends]]
        shown = [box for box in boxes if box is not None]
        assert len(shown) >= 3
        for box in shown:
            assert figure.bbox.x0 <= box.x0 < box.x1 <= figure.bbox.x1
            assert figure.bbox.y0 <= box.y0 < box.y1 <= figure.bbox.y1


def test_failed_run_says_so_in_its_picture(run: cdcr.Trajectory) -> None:
    t = np.linspace(0.0, 10.0, 101)
    failed = cdcr.simulate(run.model, [0.5, 0.0], [0.0, 0.0], t=t, max_steps=50)
    assert failed.plot().get_suptitle() == failed.message != ""
    assert run.plot().get_suptitle() == ""


def test_caller_settings_are_left_alone(run: cdcr.Trajectory) -> None:
    before = dict(mpl.rcParams)
    run.plot()
    run.plot_robot()
    assert dict(mpl.rcParams) == before


def test_no_window_system_is_needed() -> None:
    code = """
import sys, cdcr
model = cdcr.Model(cdcr.robots.amouri2020())
run = cdcr.simulate(model, [0.1, 0.0], [0.0, 0.0], t=[0.0, 0.1])
run.plot(), run.plot_robot()
assert "matplotlib.figure" in sys.modules
assert "matplotlib.pyplot" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_saved_text_stays_text(run: cdcr.Trajectory, tmp_path: Path) -> None:
    run.plot().savefig(tmp_path / "run.svg")
    assert "tip position [m]</text>" in (tmp_path / "run.svg").read_text(encoding="utf-8")


def test_disks_sit_on_the_backbone(model: cdcr.Model) -> None:
    q = np.array([0.7, -0.4])
    shape = robot_shape(model, q)
    (section,) = model.robot.sections
    assert len(shape.disks) == section.num_disks
    for k, rim in enumerate(shape.disks, start=1):
        R, p = model.pose(q, 0, k / section.num_disks)
        local = (rim - p) @ R
        radius = np.hypot(local[:, 0], local[:, 1])
        np.testing.assert_allclose(radius, section.disk_diameter / 2, rtol=0.0, atol=ROUNDING)
        np.testing.assert_allclose(local[:, 2], 0.0, rtol=0.0, atol=ROUNDING)
        np.testing.assert_allclose(rim.mean(axis=0), p, rtol=0.0, atol=ROUNDING)


def test_cables_run_through_the_holes(model: cdcr.Model) -> None:
    q = np.array([0.7, -0.4])
    (section,) = model.robot.sections
    cables = robot_shape(model, q).cables
    assert len(cables) == len(section.cable_angles)
    for angle, cable in zip(section.cable_angles, cables, strict=True):
        hole = section.cable_radius * np.array([np.cos(angle), np.sin(angle), 0.0])
        assert len(cable) == section.num_disks + 1
        for k, point in enumerate(cable):
            R, p = model.pose(q, 0, k / section.num_disks)
            np.testing.assert_allclose(point, p + R @ hole, rtol=0.0, atol=ROUNDING)


def test_backbone_is_smooth_and_ends_at_the_tip(model: cdcr.Model) -> None:
    q = np.array([1.5, 1.0])
    backbone = robot_shape(model, q).backbone
    np.testing.assert_array_equal(backbone[0], np.zeros(3))
    np.testing.assert_allclose(backbone[-1], model.tip(q)[1], rtol=0.0, atol=ROUNDING)
    pieces = np.linalg.norm(np.diff(backbone, axis=0), axis=1)
    assert pieces.sum() == pytest.approx(model.robot.sections[0].length, rel=1e-3)


def test_a_robot_without_disks_and_one_without_cables(model: cdcr.Model) -> None:
    (section,) = model.robot.sections
    bare = cdcr.Model(cdcr.Robot(sections=[dataclasses.replace(section, num_disks=0)]))
    q = np.array([0.7, -0.4])
    shape = robot_shape(bare, q)
    assert shape.disks == []
    offset = np.linalg.norm(shape.cables[1] - shape.backbone, axis=1)
    np.testing.assert_allclose(offset, section.cable_radius, rtol=0.0, atol=ROUNDING)
    plot_robot(bare, q).figure.draw_without_rendering()

    cableless = cdcr.Model(cdcr.Robot(sections=[dataclasses.replace(section, cable_angles=())]))
    axes = plot_robot(cableless, q)
    axes.figure.draw_without_rendering()
    assert axes.figure.legends == []
    still = cdcr.simulate(cableless, q, [0.0, 0.0], t=[0.0, 0.1])
    assert [text.get_text() for text in still.plot().axes[2].texts] == ["no cables"]


def test_robot_artists_are_the_shape(model: cdcr.Model) -> None:
    q = np.array([0.7, -0.4])
    shape = robot_shape(model, q)
    axes = plot_robot(model, q, tension=[5.0, 0.0, 2.5])
    backbone, *cables = axes.lines
    np.testing.assert_array_equal(np.array(backbone.get_data_3d()).T, shape.backbone)
    for line, cable in zip(cables, shape.cables, strict=True):
        np.testing.assert_array_equal(np.array(line.get_data_3d()).T, cable)
    assert [line.get_label() for line in cables] == [
        "cable 1: 5 N",
        "cable 2: 0 N",
        "cable 3: 2.5 N",
    ]
    assert cables[0].get_linewidth() > cables[2].get_linewidth() > cables[1].get_linewidth()
    assert len({line.get_color() for line in cables}) == 3

    axes.figure.draw_without_rendering()
    base, disks = axes.collections
    assert len(base.get_paths()) == 1
    for path, rim in zip(disks.get_paths(), shape.disks, strict=True):
        x, y, _ = proj3d.proj_transform(*rim.T, axes.get_proj())
        np.testing.assert_allclose(path.vertices[: len(rim)], np.stack([x, y], axis=1), atol=1e-12)


def test_space_is_to_scale(model: cdcr.Model) -> None:
    axes = plot_robot(model, [0.7, -0.4])
    assert [axes.get_xlabel(), axes.get_ylabel(), axes.get_zlabel()] == ["x [m]", "y [m]", "z [m]"]
    corners = np.vstack([np.zeros(3), np.eye(3)])
    x, y, _ = proj3d.proj_transform(*corners.T, axes.get_proj())
    projection = np.stack([x[1:] - x[0], y[1:] - y[0]])
    # A parallel projection P is to scale if its rows are orthogonal and equally long.
    gram = projection @ projection.T
    np.testing.assert_allclose(gram, gram[0, 0] * np.eye(2), rtol=0.0, atol=1e-12 * gram[0, 0])


def test_axes_of_ones_own_keep_their_labels_and_get_those_they_lack(model: cdcr.Model) -> None:
    axes: Any = Figure().add_subplot(projection="3d", xlabel="east [m]")
    assert plot_robot(model, [0.7, -0.4], axes) is axes
    labels = [axes.get_xlabel(), axes.get_ylabel(), axes.get_zlabel()]
    assert labels == ["east [m]", "y [m]", "z [m]"]


def test_pictures_of_ones_own_in_the_same_style(
    monkeypatch: pytest.MonkeyPatch, run: cdcr.Trajectory
) -> None:
    monkeypatch.delattr(cdcr, "plotting")
    with mpl.style.context(cdcr.plotting.STYLE):
        axes = Figure().add_subplot()
        (line,) = axes.plot([0, 1])
    assert line.get_color() == run.plot().axes[0].lines[0].get_color()


def test_robot_at_several_times(run: cdcr.Trajectory) -> None:
    axes = run.plot_robot(times=[0.0, 0.5, 2.0])
    backbones = {line.get_label(): line for line in axes.lines if line.get_label().endswith(" s")}
    assert list(backbones) == ["0 s", "0.5 s", "2 s"]
    alphas = [line.get_alpha() for line in backbones.values()]
    assert alphas == sorted(alphas)
    assert alphas[-1] == 1.0
    end = np.array(backbones["0.5 s"].get_data_3d())[:, -1]
    np.testing.assert_allclose(end, run.tip[25], rtol=0.0, atol=ROUNDING)
    assert len(run.plot_robot(num=3, ax=axes).lines) > len(backbones)


def test_states_between_samples(model: cdcr.Model, run: cdcr.Trajectory) -> None:
    np.testing.assert_allclose(states_at(run, run.t), run.q, rtol=0.0, atol=ROUNDING)
    middle = (run.t[:-1] + run.t[1:]) / 2
    fine = cdcr.simulate(
        model, run.q[0], run.qd[0], t=np.union1d(run.t, middle), tension=[5.0, 0.0, 0.0]
    )
    # h^4/384 of the largest fourth derivative, here about (10/s)^4 times 0.3 rad.
    np.testing.assert_allclose(states_at(run, middle), fine.q[1::2], rtol=0.0, atol=2e-6)


def test_refusals_name_the_item(model: cdcr.Model, run: cdcr.Trajectory) -> None:
    with pytest.raises(ValueError, match=r"^times must lie within the run, 0 to 2 s, got \[2\.5\]"):
        run.plot_robot(times=2.5)
    with pytest.raises(ValueError, match=r"^q must have shape \(2,\), got \(3,\)"):
        plot_robot(model, [0.0, 0.0, 0.0])
    with pytest.raises(ValueError, match=r"^tension must have shape \(3,\), got \(1,\)"):
        plot_robot(model, [0.0, 0.0], tension=[1.0])


def test_missing_extra_is_named(run: cdcr.Trajectory, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [name for name in sys.modules if name.startswith("cdcr.plotting")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.delattr(cdcr, "plotting")
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for draw in (run.plot, run.plot_robot, lambda: run.animate("run.gif")):
        with pytest.raises(ImportError, match=r'matplotlib .*pip install "cdcr\[plot\]"'):
            draw()


def test_a_robot_of_micrometres_is_drawn_as_one_of_metres() -> None:
    """Scaled so that its motion is the same, the limits of its panels scale with it."""
    section = cdcr.robots.amouri2020().sections[0]
    limits = []
    for scale in (1.0, 1e-5):
        small = dataclasses.replace(
            section,
            length=scale * section.length,
            backbone_diameter=scale * section.backbone_diameter,
            disk_diameter=scale * section.disk_diameter,
            cable_radius=scale * section.cable_radius,
            youngs_modulus=section.youngs_modulus / scale,  # K goes as E d^4 / l, inertia as l^2
        )
        model = cdcr.Model(cdcr.Robot(sections=[small]))
        pull = 5.0 * model.robot.sections[0].stiffness / section.stiffness / scale
        run = cdcr.simulate(
            model, [0.0, 0.0], [0.0, 0.0], t=np.linspace(0.0, 1.0, 101), tension=[pull, 0, 0]
        )
        limits.append([np.ptp(axes.get_ylim()) for axes in run.plot().axes])
    ratio = np.array(limits[1]) / np.array(limits[0])
    assert ratio.min() < 1e-4
    for value in ratio:  # each an integer power of the scale
        power = np.log(value) / np.log(1e-5)
        assert abs(power - round(power)) < 1e-2


@pytest.mark.parametrize(
    ("scale", "unit", "last"),
    [
        (1e-8, "nm", "8"),
        (1e-5, "um", "8"),
        (1e-2, "mm", "8"),
        (100.0, "m", "80"),
        (5e4, "km", "40"),
    ],
)
def test_tiny_and_huge_robots_are_drawn_in_a_unit_of_their_size(
    scale: float, unit: str, last: str
) -> None:
    section = cdcr.Section(
        length=0.8 * scale,
        backbone_mass=0.4 * scale**3,
        backbone_diameter=0.01 * scale,
        youngs_modulus=1e9,
        cable_radius=0.05 * scale,
        cable_angles=[0.0, 2.1, 4.2],
    )
    axes = plot_robot(cdcr.Model(cdcr.Robot(sections=[section])), [0.0, 0.0])
    axes.figure.draw_without_rendering()
    assert axes.get_zlabel() == f"z [{unit}]"
    assert "".join(filter(str.isdigit, axes.get_zticklabels()[-1].get_text())) == last
    assert axes.zaxis.get_offset_text().get_text() == ""
