"""What ``cdcr figures`` does: draw the paper's scenarios and a page, write all files or none."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from io import BytesIO
from pathlib import Path

from rich.console import Console

from cdcr import scenarios
from cdcr.base import processes
from cdcr.base.extras import require
from cdcr.cli.page import page
from cdcr.cli.run import REPLACE, DelayedBar, Mistake, check_size
from cdcr.files.new_file import check_files, new_files
from cdcr.scenarios import Scenario

SUFFIXES = (".png", ".svg")
INDEX = "index.html"


def paper_scenarios() -> list[Scenario]:
    """Return the scenarios that redraw a figure of the paper, in its order."""
    known = [scenarios.get(name) for name in scenarios.names()]
    return sorted((one for one in known if one.paper_figure), key=lambda one: one.paper_figure or 0)


def targets(out: Path) -> tuple[Path, ...]:
    """Return all files that `write_figures` writes into a folder."""
    names = [f"{one.name}{suffix}" for one in paper_scenarios() for suffix in SUFFIXES]
    return (*(out / name for name in names), out / INDEX)


def write_figures(
    out: Path,
    *,
    overwrite: bool = False,
    size: str | None = None,
    jobs: int = 1,
    progress: Callable[[int, str], object] | None = None,
) -> tuple[Path, ...]:
    """Draw every figure of the paper as PNG and SVG, and write the page that shows them.

    The files appear together when all are complete. `jobs` processes draw, which changes no
    picture. `progress` is told how many figures are done and the name of the next. Needs the extra
    ``plot``.
    """
    drawn, files = paper_scenarios(), targets(out)
    left = [one.name for one in drawn]
    tell = progress or (lambda done, name: None)
    with new_files(files, overwrite=overwrite, replace=REPLACE) as written:
        partial = {file.name: path for file, path in zip(files, written, strict=True)}
        tell(0, left[0])
        for job, pictures in _pictures([(name, size) for name in left], jobs):
            name = drawn[job].name
            for suffix, picture in zip(SUFFIXES, pictures, strict=True):
                partial[f"{name}{suffix}"].write_bytes(picture)
            left.remove(name)
            tell(len(drawn) - len(left), left[0] if left else INDEX)
        partial[INDEX].write_text(page(drawn), encoding="utf-8")
    return files


def _pictures(wanted: list[tuple[str, str | None]], jobs: int) -> Iterator[tuple[int, list[bytes]]]:
    """Yield the place of each wanted picture and its files, as they are ready."""
    try:
        yield from processes.results(draw, wanted, jobs)
    except processes.JobFailed as failure:
        told = f"the picture of {wanted[failure.job][0]!r} failed: {failure.reason}"
        raise Mistake(told) from failure.__cause__


def draw(wanted: tuple[str, str | None]) -> list[bytes]:
    """Return the picture of a scenario, given by name and size, as files of `SUFFIXES`."""
    name, size = wanted
    scenario = scenarios.get(name)
    run = scenario.simulate() if scenario.has_run else None
    figure = scenario.figure(run, size=size)
    files = []
    for suffix in SUFFIXES:  # the layout found for the first serves all
        # Without the date, the same picture is the same file.
        metadata = {"Date": None} if suffix == ".svg" else None
        file = BytesIO()
        figure.savefig(file, format=suffix[1:], metadata=metadata)
        figure.set_layout_engine("none")
        files.append(file.getvalue())
    return files


def figures(
    out: Path,
    *,
    overwrite: bool,
    console: Console,
    size: str | None = None,
    jobs: int | None = None,
) -> tuple[Path, ...]:
    """Write the paper's figures and their page; a bar on a terminal's stderr shows how far it is.

    By default there are as many processes as processors. Returns the files written; the page is
    the last.
    """
    check_size(size)
    check_files(targets(out), overwrite=overwrite, replace=REPLACE)
    require("matplotlib", "plot")
    with DelayedBar(console, "figures", len(paper_scenarios())) as bar:
        return write_figures(
            out, overwrite=overwrite, size=size, jobs=jobs or processes.usable(), progress=bar
        )
