"""What ``cdcr new`` does: write a scenario file to start from."""

from __future__ import annotations

from pathlib import Path

from cdcr.files.new_file import new_file
from cdcr.scenarios.file.template import TEMPLATE


def write_template(path: Path, *, overwrite: bool) -> None:
    """Write the template as a file that ``cdcr run`` takes for one, complete or not at all.

    Raises
    ------
    ValueError
        Where the name does not end in .toml.
    OSError
        Where the folder is missing, or the file exists and is not to be replaced.
    """
    if path.suffix != ".toml":
        raise ValueError(f"the file name must end in .toml, got {path.name!r}")
    if path.exists() and not path.is_dir() and not overwrite:
        raise FileExistsError(f"{path} exists already; give --overwrite to replace it")
    with new_file(path, overwrite=overwrite) as part:
        part.write_text(TEMPLATE, encoding="utf-8", newline="\n")
