"""Runs as files: which format a name asks for."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from cdcr.files.new_file import file_path, new_file
from cdcr.runs.export import write_csv, write_netcdf
from cdcr.runs.mcap_log import write_mcap

if TYPE_CHECKING:
    from cdcr.runs.trajectory import Trajectory

_WRITERS = {".nc": write_netcdf, ".csv": write_csv, ".mcap": write_mcap}


def save(run: Trajectory, path: str | os.PathLike[str], *, overwrite: bool = False) -> Path:
    """Write the run to a file; see Trajectory.save."""
    path = file_path(path)
    if path.suffix not in _WRITERS:
        raise ValueError(f"the file name must end in .nc, .csv or .mcap, got {path.name!r}")
    with new_file(path, overwrite=overwrite) as part:
        write_run(run, part, path.suffix)
    return path


def write_run(run: Trajectory, path: Path, suffix: str) -> None:
    """Write the run as .nc, .csv or .mcap to a file of any name."""
    _WRITERS[suffix](run, path)
