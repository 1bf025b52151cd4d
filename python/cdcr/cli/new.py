"""What ``cdcr new`` does: write a scenario file to start from."""

from __future__ import annotations

from pathlib import Path

from cdcr import scenarios
from cdcr.files.new_file import new_file
from cdcr.scenarios.file.template import template


def write_scenario(path: Path, name: str | None, *, overwrite: bool) -> None:
    """Write a scenario of the package, or the template, as a file that ``cdcr run`` takes for one.

    Raises
    ------
    ValueError
        Where the name of the file does not end in .toml, or there is no file of that scenario.
    OSError
        Where the folder is missing, or the file exists and is not to be replaced.
    """
    if path.suffix != ".toml":
        raise ValueError(f"the file name must end in .toml, got {path.name!r}")
    text = scenarios.source_file(name).read_text(encoding="utf-8") if name else template()
    with new_file(path, overwrite=overwrite, replace="give --overwrite to replace it") as part:
        part.write_text(text, encoding="utf-8", newline="\n")
