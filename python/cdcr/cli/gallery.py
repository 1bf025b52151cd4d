"""All pictures of the paper's scenarios, and a page that shows them beside the audit."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack, suppress
from pathlib import Path

from cdcr import scenarios
from cdcr.cli.page import page
from cdcr.files.new_file import new_file
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
    out: Path, *, overwrite: bool = False, progress: Callable[[int, str], object] | None = None
) -> tuple[Path, ...]:
    """Draw every figure of the paper as PNG and SVG, and write the page that shows them.

    The files appear together when all are complete. Needs the extra ``plot``.

    Parameters
    ----------
    out : Path
        The folder; made where missing.
    overwrite : bool, optional
        Whether existing files may be replaced.
    progress : callable, optional
        Told how many figures are done and the name of the next.

    Returns
    -------
    tuple of Path
        The files written.

    Raises
    ------
    FileExistsError
        If a file exists and ``overwrite`` is false.
    """
    drawn = paper_scenarios()
    files = targets(out)
    made = [folder for folder in (out, *out.parents) if not folder.exists()]
    out.mkdir(parents=True, exist_ok=True)
    try:
        with ExitStack() as stack:
            partial = {
                path.name: stack.enter_context(new_file(path, overwrite=overwrite))
                for path in files
            }
            for done, scenario in enumerate(drawn):
                if progress:
                    progress(done, scenario.name)
                _draw(scenario, partial)
            if progress:
                progress(len(drawn), INDEX)
            partial[INDEX].write_text(page(drawn), encoding="utf-8")
    except BaseException:
        with suppress(OSError):  # somebody else may have put something there
            for folder in made:
                folder.rmdir()
        raise
    return files


def _draw(scenario: Scenario, partial: dict[str, Path]) -> None:
    run = scenario.simulate() if scenario.has_run else None
    figure = scenario.figure(run)
    for suffix in SUFFIXES:  # the layout found for the first serves all
        # Without the date, the same picture is the same file.
        metadata = {"Date": None} if suffix == ".svg" else None
        figure.savefig(partial[f"{scenario.name}{suffix}"], metadata=metadata)
        figure.set_layout_engine("none")
