"""The command figures: all pictures and the page that shows them, or nothing."""

from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

import cdcr

pytest.importorskip("typer")
pytest.importorskip("matplotlib")

from matplotlib.figure import Figure
from rich.console import Console
from typer.testing import Result

from cdcr.base import processes
from cdcr.cli import figures, page
from cdcr.cli.run import Mistake
from command import cdcr_

NAMES = [n for n in cdcr.scenarios.names() if cdcr.scenarios.get(n).paper_figure]
FILES = {f"{name}{suffix}" for name in NAMES for suffix in (".png", ".svg")} | {"index.html"}
VOID = {"meta", "img", "br"}


class Page(HTMLParser):
    """What the page refers to, and whether its tags are closed in order."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.images: list[dict[str, str | None]] = []
        self.ids: set[str] = set()
        self.open: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        self.ids |= {value for key, value in attrs if key == "id" and value}
        if tag == "a":
            self.links.append(str(found["href"]))
        if tag == "img":
            self.images.append(found)
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def names_in(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


@pytest.fixture(scope="module")
def first(tmp_path_factory: Any) -> tuple[Path, Result]:
    out = tmp_path_factory.mktemp("figures") / "new" / "figures"
    return out, cdcr_("figures", "--out", out, "--size", "journal")  # the fewest pixels


@pytest.fixture
def quick(quick: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw empty pictures in this process, and leave out the audit, where they do not matter."""
    monkeypatch.setattr(processes, "usable", lambda: 1)
    monkeypatch.setattr(page, "audit", list)


def test_all_files_are_written(first: tuple[Path, Result]) -> None:
    out, result = first
    assert result.exit_code == 0, result.output
    assert result.stderr == ""  # not a terminal: no bar
    assert result.stdout == f"wrote {len(FILES) - 1} pictures and {out / 'index.html'}\n"
    assert names_in(out) == FILES
    for name in NAMES:
        assert (out / f"{name}.png").read_bytes().startswith(b"\x89PNG")
        assert "<svg" in (out / f"{name}.svg").read_text(encoding="utf-8")[:1000]


def test_the_page_shows_all_pictures_with_captions(first: tuple[Path, Result]) -> None:
    out, _ = first
    text = (out / "index.html").read_text(encoding="utf-8")
    page = Page(text)
    assert page.open == []
    assert [image["src"] for image in page.images] == [f"{name}.png" for name in NAMES]
    assert all(image["alt"] for image in page.images)
    for link in page.links:
        if link.startswith("#"):
            assert link[1:] in page.ids
        elif not link.startswith("https://doi.org/"):
            assert link in FILES
    for name in NAMES:
        scenario = cdcr.scenarios.get(name)
        assert f"Fig. {scenario.paper_figure}" in text
        assert f"cdcr run {name}" in text
        end = scenario.description[-40:].replace("'", "&#x27;")
        assert end in text
        assert text.count(f">{scenario.title}<") == 1  # the picture tells it too
    assert "thetad" not in text
    assert "H1 belongs to &theta;&#775;<sup>2</sup>" in text


def test_the_page_holds_the_audit(first: tuple[Path, Result]) -> None:
    from cdcr.paper import audit

    text = (first[0] / "index.html").read_text(encoding="utf-8")
    claims = audit()
    assert len(claims) > 8
    assert text.count("<tr>") == len(claims) + 1
    for claim in claims:
        assert f"<td>{claim.verdict}</td>" in text


@pytest.mark.usefixtures("quick")
def test_what_is_in_the_audit_is_escaped(monkeypatch: pytest.MonkeyPatch) -> None:
    class Claim:
        where, claim, computed, verdict = "Fig. 1", "a < b", "a & b", "holds"

    monkeypatch.setattr(page, "audit", lambda: [Claim()])
    text = page.page([cdcr.scenarios.get("pid")])
    assert "<td>a &lt; b</td><td>a &amp; b</td>" in text
    assert Page(text).open == []


@pytest.mark.usefixtures("quick")
def test_existing_files_are_kept_unless_told_otherwise(tmp_path: Path) -> None:
    (tmp_path / "pid.svg").write_text("mine")
    result = cdcr_("figures", "--out", tmp_path)
    assert result.exit_code == 2
    assert result.stdout == ""
    assert result.stderr == (
        f"cdcr: {tmp_path / 'pid.svg'} exists already; "
        "give --overwrite to replace, or another folder with --out\n"
    )
    assert names_in(tmp_path) == {"pid.svg"}
    assert cdcr_("figures", "--out", tmp_path, "--overwrite").exit_code == 0
    assert names_in(tmp_path) == FILES
    assert (tmp_path / "pid.svg").read_text() != "mine"
    many = cdcr_("figures", "--out", tmp_path).stderr
    assert many.startswith(f"cdcr: {tmp_path / 'factors-backbone.png'}, and others exist already; ")
    assert len(many.splitlines()) == 1


@pytest.mark.usefixtures("quick")
def test_the_same_picture_is_the_same_file(tmp_path: Path) -> None:
    files = figures.write_figures(tmp_path)
    before = [path.read_bytes() for path in files]
    assert [path.read_bytes() for path in figures.write_figures(tmp_path, overwrite=True)] == before


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (KeyboardInterrupt(), pytest.raises(KeyboardInterrupt)),
        (
            RuntimeError("no ink"),
            pytest.raises(Mistake, match=r"^the picture of 'gravity-ratio' failed: no ink$"),
        ),
    ],
)
def test_what_stops_it_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException, told: Any
) -> None:
    def fail(self: Any, run: Any, **_: Any) -> Figure:
        if self.name == "gravity-ratio":
            raise error
        return Figure(figsize=(0.1, 0.1))

    monkeypatch.setattr(cdcr.scenarios.Scenario, "figure", fail)
    with told:
        figures.write_figures(tmp_path / "a" / "b")
    assert names_in(tmp_path) == set()


@pytest.mark.usefixtures("quick")
def test_progress_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[tuple[int, str]] = []
    figures.write_figures(tmp_path, progress=lambda done, name: told.append((done, name)))
    assert told == list(enumerate((*NAMES, "index.html")))


@pytest.mark.usefixtures("quick")
def test_the_bar_is_on_the_console_it_is_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from io import StringIO

    monkeypatch.setattr("cdcr.cli.run.BAR_DELAY", 0.0)
    monkeypatch.setenv("TERM", "xterm")
    stream = StringIO()
    console = Console(file=stream, force_terminal=True, width=80)
    files = figures.figures(tmp_path, overwrite=False, console=console)
    assert {path.name for path in files} == FILES
    assert "%" in stream.getvalue()


@pytest.mark.parametrize("name", ["factors-disks", "block-diagram"])
def test_run_draws_what_has_no_run(tmp_path: Path, name: str) -> None:
    result = cdcr_("run", name, "--out", tmp_path)
    assert result.exit_code == 0, result.output
    assert names_in(tmp_path) == {f"{name}.png"}
    assert f"wrote {tmp_path / name}.png" in result.stdout
    for metric in cdcr.scenarios.get(name).summary():
        assert metric.label in result.stdout


def test_run_refuses_options_where_nothing_runs(tmp_path: Path) -> None:
    result = cdcr_("run", "gravity-ratio", "--out", tmp_path, "--t-end", 1, "--method", "bdf")
    assert result.exit_code == 2
    assert result.stderr == (
        "cdcr: nothing runs in the scenario 'gravity-ratio', so it takes no --t-end, --method\n"
    )
    assert names_in(tmp_path) == set()


@pytest.mark.usefixtures("quick")
def test_run_without_a_run_as_json(tmp_path: Path) -> None:
    import json

    result = cdcr_("run", "gravity-ratio", "--out", tmp_path, "--json")
    told = json.loads(result.stdout)
    assert told["scenario"] == "gravity-ratio"
    assert told["findings"]["ratio_0"] == pytest.approx(23.78, abs=0.01)
    assert "stats" not in told


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("name", ["circle-tracking", "pid"])
def test_run_writes_data_where_there_is_a_run(tmp_path: Path, name: str) -> None:
    pytest.importorskip("h5netcdf")
    result = cdcr_("run", name, "--out", tmp_path, "--t-end", 0.4)
    assert result.exit_code == 0, result.output
    assert names_in(tmp_path) == {f"{name}{suffix}" for suffix in (".png", ".csv", ".nc")}
