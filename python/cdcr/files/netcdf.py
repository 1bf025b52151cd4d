"""Labelled arrays as netCDF."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cdcr.base.extras import require

if TYPE_CHECKING:
    import xarray


def write_netcdf(dataset: xarray.Dataset, path: Path) -> None:
    """Write a Dataset to a file of any name. Needs the extra ``data``."""
    h5netcdf: Any = require("h5netcdf", "data")
    xr: Any = require("xarray", "data")
    # In memory: the library crashes where a disk is full, and cannot write to a nameless file.
    whole = io.BytesIO()
    with h5netcdf.File(whole, "w") as stored:
        dataset.dump_to_store(xr.backends.H5NetCDFStore(stored))
    path.write_bytes(whole.getbuffer())
