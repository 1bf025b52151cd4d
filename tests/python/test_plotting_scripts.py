"""A script saves its picture, or says in one sentence why it cannot."""

import sys
from pathlib import Path

import matplotlib as mpl
import pytest

import cdcr
from cdcr.plotting import plot_robot, show_or_save

FORM = "give one file for the picture, whose name ends in .png, .pdf, .svg or the like, got "


@pytest.fixture(scope="module")
def figure() -> mpl.figure.Figure:
    figure: mpl.figure.Figure = plot_robot(cdcr.Model(cdcr.robots.amouri2020()), [0.5, 0.0]).figure
    return figure


def test_the_suffix_says_the_format(figure: mpl.figure.Figure, tmp_path: Path) -> None:
    for name, begins in (("a.png", b"\x89PNG"), ("a.PDF", b"%PDF"), ("a.png", b"\x89PNG")):
        show_or_save(figure, [str(tmp_path / name)])
        assert (tmp_path / name).read_bytes().startswith(begins)


def test_without_an_argument_it_is_shown(
    figure: mpl.figure.Figure, monkeypatch: pytest.MonkeyPatch
) -> None:
    from matplotlib import pyplot

    shown: list[bool] = []
    monkeypatch.setattr(pyplot, "show", lambda: shown.append(True))
    show_or_save(figure, [])
    assert shown == [True]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["{}/none/a.png"], "the folder {}/none does not exist; make it first"),
        (["{}/taken.png"], "{}/taken.png is a folder, not a file"),
        (["{}/file/a.png"], "{}/file is a file, not a folder to write to"),
        (["{}"], FORM + "'{}'"),
        (["{}/a.bad"], FORM + "'{}/a.bad'"),
        (["--help"], FORM + "'--help'"),
        (["a.png", "b.png"], FORM + "'a.png b.png'"),
        ([""], FORM + "''"),
    ],
)
def test_what_cannot_be_written(
    arguments: list[str],
    told: str,
    figure: mpl.figure.Figure,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "taken.png").mkdir()
    (tmp_path / "file").touch()
    monkeypatch.setattr(sys, "argv", ["/some/where/12_loop.py"])
    with pytest.raises(SystemExit) as ended:
        show_or_save(figure, [one.format(tmp_path) for one in arguments])
    assert ended.value.code == 2
    assert capsys.readouterr().err == f"12_loop.py: {told.format(tmp_path)}\n"
