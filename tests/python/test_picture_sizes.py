"""Sizes of pictures: of a journal's column, of a slide, and any other."""

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import cdcr

pytest.importorskip("matplotlib")

from matplotlib.text import Text
from PIL import Image
from typer.testing import CliRunner

from cdcr.cli.app import app
from cdcr.plotting import resize
from words import words, words_outside

CM = 1.0 / 2.54  # [in]
LEGIBLE = 5.5  # smallest letters in a journal's column [pt]


@cache
def run_of(name: str) -> Any:
    scenario = cdcr.scenarios.get(name)
    return scenario.simulate(t_end=1.0) if scenario.has_run else None


def picture(name: str, size: Any) -> Any:
    return cdcr.scenarios.get(name).figure(run_of(name), size=size)


@pytest.mark.parametrize(
    "name", ["step-tension", "pid", "factors-backbone", "length-drive", "block-diagram"]
)
def test_a_journals_column_holds_all_words(name: str) -> None:
    figure = picture(name, "journal")
    assert figure.get_figwidth() == pytest.approx(8.5 * CM)
    figure.canvas.draw()
    width, height = figure.bbox.size
    for text in figure.findobj(Text):
        if text.get_visible() and text.get_text() and text.axes is None:
            box = text.get_window_extent()
            assert box.x0 >= -1.0, text
            assert box.x1 <= width + 1.0, text
            assert box.y1 <= height + 1.0, text
            assert text.get_fontsize() >= LEGIBLE, text
    for axes in figure.axes:
        if axes.name != "3d":
            box = axes.get_tightbbox()
            assert box.x0 >= -1.0
            assert box.x1 <= width + 1.0


@pytest.mark.parametrize(
    ("size", "cm"), [("slide", (33.87, 19.05)), ((17.0, 12.0), (17.0, 12.0)), ("17x12", (17, 12))]
)
def test_sizes_are_in_centimetres(size: Any, cm: tuple[float, float]) -> None:
    sides = picture("gravity-ratio", size).get_size_inches()
    np.testing.assert_allclose(sides, np.array(cm) * CM, rtol=1e-12)


def test_no_size_is_the_size_a_picture_was_made_for() -> None:
    assert tuple(picture("block-diagram", None).get_size_inches()) == (11.0, 5.0)


@pytest.mark.parametrize("size", ["poster", "17", (0.0, 5.0), (5.0, np.inf), (1, 2, 3), 7, "axb"])
def test_other_sizes_are_refused(size: Any) -> None:
    with pytest.raises(ValueError, match=r"size must be 'journal' .*, got "):
        picture("block-diagram", size)


def test_a_run_is_drawn_in_any_size() -> None:
    run = cdcr.scenarios.get("step-tension").simulate(t_end=0.1)
    assert run.plot(size="journal").get_figwidth() == pytest.approx(8.5 * CM)


@pytest.mark.parametrize("name", ["block-diagram", "payload-drop", "pull-release"])
def test_no_words_of_a_column_cross(name: str) -> None:
    """Of the names in a picture, its numbers and its labels."""
    found = words(picture(name, "journal"))
    assert len(found) > 10
    crossing = [
        (one, other)
        for k, (one, box) in enumerate(found)
        for other, another in found[:k]
        if box.padded(-2.0).overlaps(another.padded(-2.0))
    ]
    assert crossing == []


def test_the_robot_has_any_size() -> None:
    run = cdcr.scenarios.get("step-tension").simulate(t_end=0.1)
    for size, width in (("journal", 8.5), ("slide", 33.87), ((15, 10), 15.0)):
        figure = run.plot_robot(size=size).figure
        assert figure.get_figwidth() == pytest.approx(width * CM)
        assert words_outside(figure) == []
    axes = run.plot_robot()
    with pytest.raises(ValueError, match="either ax or size"):
        run.plot_robot(ax=axes, size="slide")
    with pytest.raises(ValueError, match="size must be"):
        run.plot_robot(size="poster")


def test_modes_have_any_size() -> None:
    model = cdcr.Model(cdcr.robots.three_sections())
    modes = model.modes(np.zeros(6), model.rest_command())
    slide = modes.plot(size="slide")
    assert tuple(slide.get_size_inches()) == pytest.approx((33.87 * CM, 19.05 * CM))
    column = modes.plot(size="journal")
    assert column.get_figwidth() == pytest.approx(8.5 * CM)
    left = {round(axes.get_position().x0, 6) for axes in column.axes}
    assert (len(column.axes), len(left)) == (4, 2)  # two beside each other
    with pytest.raises(ValueError, match="size must be"):
        modes.plot(size="poster")


def test_films_have_any_size(tmp_path: Path) -> None:
    run = cdcr.scenarios.get("step-tension").simulate(t_end=0.1)
    for size, pixels in ((None, (1100, 560)), ("slide", (1920, 1080)), ((15, 9.9), (850, 560))):
        path = run.animate(tmp_path / "film.gif", fps=10, size=size, overwrite=True)
        with Image.open(path) as image:
            assert image.size == pixels
    with pytest.raises(ValueError, match="size must be"):
        run.animate(tmp_path / "other.gif", size="poster")
    assert not (tmp_path / "other.gif").exists()


def test_the_command_line_takes_a_size(tmp_path: Path) -> None:
    arguments = ["run", "block-diagram", "--out", str(tmp_path), "--size"]
    assert CliRunner().invoke(app, [*arguments, "10x8"]).exit_code == 0
    with Image.open(tmp_path / "block-diagram.png") as image:
        assert image.size == (1181, 944)  # 300 dpi, for print
    refused = CliRunner().invoke(app, [*arguments, "poster", "--overwrite"])
    assert refused.exit_code == 2
    assert "--size must be 'journal'" in refused.stderr


@pytest.mark.parametrize("size", [(17.0, 12.0), (15.0, 10.0), (9.0, 16.0), (30.0, 12.0)])
@pytest.mark.parametrize("name", ["step-tension", "kinetic-energy-terms"])
def test_any_size_holds_all_words(name: str, size: tuple[float, float]) -> None:
    assert words_outside(picture(name, size)) == []


def test_letters_become_no_smaller_than_the_picture() -> None:
    """Than in a picture reduced as a whole; and as large as usual where there is room."""
    usual, small, large = (
        {str(text.get_text()): text.get_fontsize() for text in picture("pid", size).findobj(Text)}
        for size in (None, (15.0, 11.0), (40.0, 30.0))
    )
    made = picture("pid", None).get_size_inches()
    assert large["time [s]"] == usual["time [s]"]
    share = min(15.0 * CM / made[0], 11.0 * CM / made[1])
    assert share <= small["time [s]"] / usual["time [s]"] < 1.0


def test_the_legend_of_many_cables_stays_inside_a_column() -> None:
    section = cdcr.robots.amouri2020(damping=0.01).sections[0]
    six = replace(section, length=0.1, cable_angles=tuple(k * np.pi / 3.0 for k in range(6)))
    model = cdcr.Model(cdcr.Robot(sections=[six] * 8))
    q, tension = np.tile([0.3, 0.1], 8), 0.1 * np.arange(48.0)
    run = cdcr.simulate(model, q, np.zeros(16), t=np.linspace(0.0, 0.01, 3), tension=tension)
    figure = resize(run.plot(), "journal")
    assert not words_outside(figure)
