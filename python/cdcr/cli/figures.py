"""What ``cdcr figures`` does: check first, draw, then write all files or none."""

from __future__ import annotations

from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn

from cdcr.base.extras import require
from cdcr.cli import gallery
from cdcr.cli.run import refuse_existing


def figures(out: Path, *, overwrite: bool, console: Console) -> tuple[Path, ...]:
    """Write the paper's figures and their page; a bar on a terminal's stderr shows how far it is.

    Returns the files written; the page is the last.
    """
    refuse_existing(out, gallery.targets(out), overwrite=overwrite)
    require("matplotlib", "plot")
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        console=console,
        transient=True,
        disable=not console.is_terminal,
    )
    with bar:
        task = bar.add_task("figures", total=len(gallery.paper_scenarios()))
        return gallery.write_figures(
            out,
            overwrite=overwrite,
            progress=lambda done, name: bar.update(task, completed=done, description=name),
        )
